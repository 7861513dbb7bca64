// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "core/csv_reader.h"
#include "fuzz/check_read.h"

namespace comptonaut {

void fuzz_csv(std::span<const char> bytes) {
  const MemoryFile file(bytes);
  check_read(file.path(), [&] {
    CsvReader reader(file.path(), {"t_s", "drone", "x_m"});
    while (reader.next()) {
      const double t_s = reader.number(0, 0.0, 1e9);
      require_law(t_s >= 0.0 && t_s <= 1e9, "numbers are in their range");
      const std::int64_t drone = reader.whole(1, 0, 99);
      require_law(drone >= 0 && drone <= 99, "whole numbers too");
      require_law(std::isfinite(reader.number(2, -1e6, 1e6)), "numbers are finite");
    }
  });
}

}  // namespace comptonaut
