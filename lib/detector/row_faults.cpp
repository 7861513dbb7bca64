// SPDX-License-Identifier: BSD-3-Clause
#include "detector/row_faults.h"

#include <numeric>

namespace comptonaut {
namespace {

struct Name {
  std::string_view counter;
  std::string_view description;
};

constexpr std::array<Name, kRowFaults> kNames = {{
    {"rows_not_six_numbers", "not six whole numbers"},
    {"rows_non_ascii", "holds a byte that is not ASCII text"},
    {"rows_too_long", "longer than a row can be"},
    {"rows_cut_short", "the last one is cut short"},
    {"rows_pixel_range", "pixel is not on the matrix of 256 x 256"},
    {"rows_toa_range", "ToA beyond 40 days or outside its frame"},
    {"rows_ftoa_range", "FToA above 31"},
    {"rows_tot_range", "ToT above 1023"},
    {"rows_zero_tot", "ToT is 0 (chip error)"},
    {"rows_marker", "Overflow row or comment of unknown meaning"},
    {"rows_out_of_sequence", "ToA jumps where its neighbours go on"},
    {"rows_late", "came when the batches of its time had left (stream: delay_max_ms)"},
    {"rows_no_time_base", "no UTC known for chip time 0"},
    {"rows_not_a_cluster", "neither Frame N (start, length s) nor a cluster [x, y, E, ToA] ..."},
    {"rows_no_frame", "a cluster that belongs to no frame"},
    {"rows_energy_range", "energy below 1 eV or above 1 GeV"},
}};

}  // namespace

std::string_view counter_name(RowFault fault) { return kNames[static_cast<std::size_t>(fault)].counter; }
std::string_view describe(RowFault fault) { return kNames[static_cast<std::size_t>(fault)].description; }

void RowFaults::move(RowFault from, RowFault to, std::int64_t line) {
  const auto i = static_cast<std::size_t>(from);
  if (--count[i] == 0) first_line[i] = 0;
  add(to, line);
}

std::int64_t RowFaults::total() const { return std::accumulate(count.begin(), count.end(), std::int64_t{0}); }

std::int64_t RowFaults::hits_lost() const {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < kRowFaults; ++i) sum += loses_hit(static_cast<RowFault>(i)) ? count[i] : 0;
  return sum;
}

RowFaults& RowFaults::operator+=(const RowFaults& later) {
  for (std::size_t i = 0; i < kRowFaults; ++i) {
    if (count[i] == 0) first_line[i] = later.first_line[i];
    count[i] += later.count[i];
  }
  return *this;
}

}  // namespace comptonaut
