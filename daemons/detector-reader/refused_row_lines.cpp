// SPDX-License-Identifier: BSD-3-Clause
#include "refused_row_lines.h"

#include <fmt/format.h>

#include "bus/daemon.h"

namespace comptonaut {

void RefusedRowLines::tell(const RowFaults& faults) {
  for (std::size_t i = 0; i < kRowFaults; ++i) {
    if (faults.count[i] == 0 || told_.test(i)) continue;
    told_.set(i);
    const auto fault = static_cast<RowFault>(i);
    const std::string line = faults.first_line[i] > 0 ? fmt::format(":{}", faults.first_line[i]) : "";
    print_warning("comptonaut-detector-reader", fmt::format("{}{}: row refused: {}; all such rows are counted as {}",
                                                            input_, line, describe(fault), counter_name(fault)));
  }
}

}  // namespace comptonaut
