// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/response_lookup.h"

#include <memory>

namespace comptonaut {

ResponseLookup pair_lookup(ResponseTable table) {
  return [shared = std::make_shared<const ResponseTable>(std::move(table))](
             const float* x, const float* y, const float* z, float* value, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) value[i] = static_cast<float>(shared->pair({x[i], y[i], z[i]}));
  };
}

}  // namespace comptonaut
