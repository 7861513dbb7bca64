// SPDX-License-Identifier: BSD-3-Clause
#include "search/strategy.h"

#include <fmt/format.h>

#include <stdexcept>

#include "search/information.h"
#include "search/look_first.h"
#include "search/werner2024.h"
#include "search/zigzag.h"

namespace comptonaut {

namespace {

std::unique_ptr<Strategy> named(const SearchConfig& config) {
  if (config.strategy == "werner2024") return std::make_unique<Werner2024>(config);
  if (config.strategy == "zigzag") return std::make_unique<Zigzag>(config);
  if (config.strategy == "information") return std::make_unique<Information>(config);
  if (config.strategy == "none") return nullptr;
  throw std::invalid_argument(
      fmt::format("search strategy '{}' is unknown, must be information, werner2024, zigzag or none", config.strategy));
}

}  // namespace

std::unique_ptr<Strategy> make_strategy(const SearchConfig& config) {
  std::unique_ptr<Strategy> strategy = named(config);
  if (!strategy || config.look_first.empty()) return strategy;
  return std::make_unique<LookFirst>(config, std::move(strategy));
}

}  // namespace comptonaut
