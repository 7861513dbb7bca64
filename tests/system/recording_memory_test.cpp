// SPDX-License-Identifier: BSD-3-Clause
// Reading a recording takes the memory of the reorder window, however long it is.
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <fstream>

#include "core/random.h"
#include "detector/hit_row.h"
#include "detector/make_hits.h"
#include "scratch.h"
#include "system/write_calibration.h"

extern char** environ;

namespace comptonaut {
namespace {

/// So many clusters of two hits at 100,000 hits/s, half of them out of order, one hit in 30 off by an epoch; now and
/// then a gap of lost data, a record that is wrong and a pixel that is hot for a while.
std::filesystem::path write_recording(const std::string& name, int clusters) {
  const auto file = scratch_file(name);
  std::ofstream out(file, std::ios::binary);
  Random random(1);
  double t_ticks = 1000.0;
  for (int i = 0; i < clusters; ++i) {
    t_ticks += 800.0 * random.exponential();
    const auto toa = static_cast<std::uint64_t>(t_ticks);
    const auto pixel = static_cast<std::uint64_t>(i % 100'000 < 2000 ? 777 : random() % 65000);
    const std::uint64_t fault = random.uniform() < 0.03 ? 16384 : 0;
    out << t3p_record(pixel, toa + 2 + fault, 0, 5, 60) << t3p_record(pixel + 1, toa, 0, 3, 80);
    if (i % 50 == 0) out << t3p_record(kGapBegins, toa + 9, 1, 0, 0) << t3p_record(kGapEnds, 40, 1, 0, 0);
    if (i % 70 == 0) out << t3p_record(pixel, toa, 0, 77, 60);
  }
  return file;
}

/// Of comptonaut detect on this file.
double peak_MB(const std::filesystem::path& file) {
  const std::string calibration = scratch_folder().string();
  const std::string program = std::string(COMPTONAUT_BINARY_DIR) + "/bin/comptonaut", path = file.string();
  const char* const arguments[] = {program.c_str(),     "detect", path.c_str(), "--calibration",
                                   calibration.c_str(), nullptr};
  pid_t child = 0;
  if (posix_spawn(&child, program.c_str(), nullptr, nullptr, const_cast<char**>(arguments), environ) != 0) return -1.0;
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child || status != 0) return -1.0;
  return 1e-3 * static_cast<double>(usage.ru_maxrss);
}

TEST(RecordingMemory, DoesNotGrowWithTheRecording) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer keeps what was freed";
#endif
  write_calibration();
  const double short_MB = peak_MB(write_recording("short.t3p", 200'000));
  const double long_MB = peak_MB(write_recording("long.t3p", 2'000'000));
  RecordProperty("short_MB", std::to_string(short_MB));
  RecordProperty("long_MB", std::to_string(long_MB));
  ASSERT_GT(short_MB, 1.0);
  EXPECT_LT(long_MB, short_MB + 0.5);
}

}  // namespace
}  // namespace comptonaut
