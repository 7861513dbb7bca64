// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bitset>
#include <string>

#include "detector/row_faults.h"

namespace comptonaut {

/// Says in the journal which row was the first to be refused, once of each kind.
class RefusedRowLines {
 public:
  /// `input` as --input names it.
  explicit RefusedRowLines(std::string input) : input_(std::move(input)) {}
  void tell(const RowFaults& faults);

 private:
  std::string input_;
  std::bitset<kRowFaults> told_;
};

}  // namespace comptonaut
