// SPDX-License-Identifier: BSD-3-Clause
#include "sim/t3pa_writer.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

namespace comptonaut {
namespace {

constexpr int kGapOpens = 0x74;
constexpr int kGapCloses = 0x75;

}  // namespace

void T3paWriter::start(Utime start_utime) {
  text_ += "Index\tMatrix Index\tToA\tToT\tFToA\tOverflow\n";
  fmt::format_to(std::back_inserter(text_), "# start_utime_us {}\n", start_utime);
}

void T3paWriter::row(int matrix_index, std::int64_t toa_ticks, int tot, int ftoa, int overflow) {
  fmt::format_to(std::back_inserter(text_), "{}\t{}\t{}\t{}\t{}\t{}\n", index_++, matrix_index, toa_ticks, tot, ftoa,
                 overflow);
}

void T3paWriter::hit(const Hit& hit) {
  const std::int64_t toa_ticks = (hit.t + 15) / 16;  // t = 16 ToA - FToA
  row(hit.pixel, toa_ticks, hit.tot, static_cast<int>(16 * toa_ticks - hit.t), 0);
}

void T3paWriter::lost_data(std::int64_t toa_ticks, std::int64_t gap_ticks) {
  row(kGapOpens, toa_ticks, 0, 0, 1);
  row(kGapCloses, gap_ticks, 0, 0, 1);
}

void T3paWriter::alive(std::int64_t toa_ticks) { fmt::format_to(std::back_inserter(text_), "# alive {}\n", toa_ticks); }

std::string T3paWriter::take() { return std::exchange(text_, {}); }

}  // namespace comptonaut
