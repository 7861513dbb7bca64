// SPDX-License-Identifier: BSD-3-Clause
#include "sim/campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <exception>
#include <optional>
#include <stdexcept>
#include <thread>

namespace comptonaut {
namespace {

constexpr std::size_t kSeedsMax = 1'000'000;
constexpr std::chrono::milliseconds kProgressPeriod{200};

std::optional<std::uint64_t> parse_whole(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool complete = error == std::errc() && end == text.data() + text.size();
  return complete ? std::optional(value) : std::nullopt;
}

/// Missions that threads take one after another.
class Queue {
 public:
  Queue(const MissionSetup& setup, SeedRange seeds) : setup_(setup), seeds_(seeds), results_(seeds.size()) {}

  void work() {
    for (std::size_t i = next_++; i < results_.size(); i = next_++) {
      try {
        results_[i] = fly_mission(setup_, seeds_.first + i, seconds_done_);
      } catch (...) {
        if (!failed_.exchange(true)) failure_ = std::current_exception();
        next_ = results_.size();
      }
    }
    ++workers_done_;
  }

  [[nodiscard]] int workers_done() const { return workers_done_; }
  [[nodiscard]] double share_done() const {
    return static_cast<double>(seconds_done_) / (setup_.scenario.horizon_s * static_cast<double>(results_.size()));
  }

  /// Once all workers are done.
  std::vector<MissionResult> results() {
    if (failure_) std::rethrow_exception(failure_);
    return std::move(results_);
  }

 private:
  const MissionSetup& setup_;
  SeedRange seeds_;
  std::vector<MissionResult> results_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<std::int64_t> seconds_done_ = 0;
  std::atomic<int> workers_done_ = 0;
  std::atomic<bool> failed_ = false;
  std::exception_ptr failure_;
};

}  // namespace

SeedRange parse_seeds(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto first = parse_whole(std::string_view(text).substr(0, colon));
  const auto last = colon == std::string::npos ? first : parse_whole(std::string_view(text).substr(colon + 1));
  if (!first || !last) throw std::invalid_argument("must be FIRST:LAST, for example 1:10");
  if (*last < *first) throw std::invalid_argument(fmt::format("ends before it begins, must be {}:{}", *last, *first));
  if (*last - *first >= kSeedsMax) throw std::invalid_argument(fmt::format("must be at most {} seeds", kSeedsMax));
  return {.first = *first, .last = *last};
}

std::vector<MissionResult> run_campaign(const MissionSetup& setup, SeedRange seeds, int jobs,
                                        const std::function<void(double)>& progress) {
  Queue queue(setup, seeds);
  std::vector<std::jthread> threads;
  for (int i = 0; i < jobs; ++i) threads.emplace_back([&] { queue.work(); });
  while (queue.workers_done() < jobs) {
    std::this_thread::sleep_for(kProgressPeriod);
    progress(queue.share_done());
  }
  threads.clear();
  return queue.results();
}

}  // namespace comptonaut
