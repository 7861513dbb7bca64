// SPDX-License-Identifier: BSD-3-Clause
// A program that libFuzzer drives: what COMPTONAUT_FUZZ_TARGET in its environment names of COMPTONAUT_FUZZ_TARGETS.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iterator>

#include "fuzz/targets.h"

namespace {

const comptonaut::FuzzTarget& named_target() {
  const char* const name = std::getenv("COMPTONAUT_FUZZ_TARGET");
  const auto* const last = std::end(comptonaut::COMPTONAUT_FUZZ_TARGETS);
  const auto* const found = std::find_if(std::begin(comptonaut::COMPTONAUT_FUZZ_TARGETS), last,
                                         [&](const auto& target) { return name && target.name == name; });
  comptonaut::require_law(found != last, "COMPTONAUT_FUZZ_TARGET must name a target of this program");
  return *found;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const comptonaut::FuzzTarget& target = named_target();
  target.run({reinterpret_cast<const char*>(data), size});
  return 0;
}
