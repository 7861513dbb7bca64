// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>

#include "report/recording_test.h"

namespace comptonaut {

/// Pages in a real browser. Skips where there is none.
class Browser : public Recording {
 protected:
  void SetUp() override {
    if (std::system("command -v chromium > /dev/null") != 0) GTEST_SKIP() << "chromium is not installed";
  }

  /// The document after its script ran. The script must not have complained.
  std::string rendered(const std::string& html, const std::string& hash = "") {
    const std::string file = write("page.html", html).string();
    const std::string text =
        run("timeout 90 chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
            "--disable-background-networking --disable-component-update --disable-sync --enable-logging=stderr "
            "--window-size=1366,768 --virtual-time-budget=2000 --dump-dom --user-data-dir=" +
            (folder_ / "profile").string() + " 'file://" + file + hash + "'");
    EXPECT_EQ(exit_code_, 0) << text.substr(0, 2000);
    EXPECT_EQ(text.find("CONSOLE"), std::string::npos) << text.substr(text.find("CONSOLE"), 500);
    return text;
  }

  static std::string element(const std::string& page, const std::string& id) {
    const std::size_t start = page.find('>', page.find("id=\"" + id + "\"")) + 1;
    return page.substr(start, page.find("</", start) - start);
  }
};

}  // namespace comptonaut
