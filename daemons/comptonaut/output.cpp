// SPDX-License-Identifier: BSD-3-Clause
#include "output.h"

#include <fmt/core.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace comptonaut {
namespace {

std::runtime_error not_writable(const std::filesystem::path& file) {
  return std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

}  // namespace

void show_progress(double share) {
  constexpr int kWidth = 50;
  const int done = static_cast<int>(kWidth * share);
  fmt::print(stderr, "\r[{:=<{}}{:{}}] {:3.0f} %", "", done, "", kWidth - done, 100.0 * share);
  std::fflush(stderr);
}

void hide_progress() { fmt::print(stderr, "\r\033[K"); }

void require_writable(const std::filesystem::path& file) {
  if (!file.empty() && !std::ofstream(file, std::ios::app)) throw not_writable(file);
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  if (!(text << in.rdbuf())) throw std::runtime_error(fmt::format("{}: cannot be read, or is empty", file.string()));
  return text.str();
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  if (file.empty()) return;
  std::ofstream out(file, std::ios::binary);
  out << text << std::flush;
  if (!out) throw not_writable(file);
}

}  // namespace comptonaut
