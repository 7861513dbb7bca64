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
#include <stop_token>
#include <thread>
#include <utility>

#include "world/footprint.h"

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

/// The runs of a shard, which threads take one after another.
class Queue {
 public:
  Queue(std::span<const CampaignTeam> teams, SeedRange seeds, Shard shard) : teams_(teams) {
    for (std::size_t run = 0; run < teams.size() * seeds.size(); ++run) {
      if (!shard.holds(run)) continue;
      runs_.push_back({.team = run / seeds.size(), .seed = seeds.first + run % seeds.size()});
      seconds_ += teams[runs_.back().team].setup.scenario.horizon_s;
    }
  }

  void work(const std::stop_token& stop) {
    for (std::size_t i = next_++; i < runs_.size() && !stop.stop_requested(); i = next_++) {
      Run& run = runs_[i];
      try {
        run.result = fly_mission(teams_[run.team].setup, run.seed, seconds_done_, stop);
      } catch (const std::exception& failure) {
        run.failure = failure.what();
      }
      ++missions_done_;
    }
    ++workers_done_;
  }

  [[nodiscard]] int workers_done() const { return workers_done_; }
  [[nodiscard]] CampaignProgress progress() const {
    return {.share = seconds_ > 0.0 ? std::min(1.0, static_cast<double>(seconds_done_) / seconds_) : 1.0,
            .missions_done = missions_done_,
            .missions = runs_.size()};
  }

  /// Once all workers are done.
  CampaignResult result() {
    CampaignResult result;
    for (const CampaignTeam& team : teams_) result.parts.push_back({.names = team.names, .missions = {}});
    for (Run& run : runs_) {
      CampaignPart& part = result.parts[run.team];
      if (run.result) {
        part.missions.push_back(std::move(*run.result));
      } else {
        result.missing.push_back(fmt::format("{}, {}, {}, seed {}: {}", part.names.scenario, part.names.strategy,
                                             part.names.estimator, run.seed, run.failure));
      }
    }
    return result;
  }

 private:
  struct Run {
    std::size_t team = 0;
    std::uint64_t seed = 0;
    std::optional<MissionResult> result = {};
    std::string failure = "not flown";
  };

  std::span<const CampaignTeam> teams_;
  std::vector<Run> runs_;
  double seconds_ = 0.0;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<std::int64_t> seconds_done_ = 0;
  std::atomic<std::size_t> missions_done_ = 0;
  std::atomic<int> workers_done_ = 0;
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

CampaignFacts facts_of(std::span<const CampaignTeam> teams, SeedRange seeds) {
  const Scenario& scenario = teams.front().setup.scenario;
  const std::string& name = teams.front().names.scenario;
  std::string line = fmt::format("{}, seeds {}:{}", name, seeds.first, seeds.last);
  for (const CampaignTeam& team : teams) {
    line += fmt::format(", {} {}, lane {} m", team.names.strategy, team.names.estimator,
                        team.setup.coordinator.search.zigzag.lane_m);
  }
  line += fmt::format(", setup {:016x}", teams.front().setup.fingerprint);
  return {.line = line,
          .seeds = seeds,
          .scenario = name,
          .area = scenario.area,
          .horizon_s = scenario.horizon_s,
          .mavs = scenario.mavs.count,
          .buildings = footprint(scenario.world, scenario.area)};
}

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  const auto index = parse_whole(std::string_view(text).substr(0, slash));
  const auto of = slash == std::string::npos ? std::nullopt : parse_whole(std::string_view(text).substr(slash + 1));
  if (!index || !of || *index < 1 || *index > *of || *of > kSeedsMax) {
    throw std::invalid_argument("must be I/N with I in 1..N, for example 2/5");
  }
  return {.index = *index, .of = *of};
}

CampaignResult run_campaign(std::span<const CampaignTeam> teams, SeedRange seeds, Shard shard, int jobs,
                            const std::function<bool(const CampaignProgress&)>& progress) {
  Queue queue(teams, seeds, shard);
  std::stop_source stop;
  std::vector<std::jthread> threads;
  for (int i = 0; i < jobs; ++i) threads.emplace_back([&] { queue.work(stop.get_token()); });
  for (bool done = false; !done;) {
    std::this_thread::sleep_for(kProgressPeriod);
    done = queue.workers_done() == jobs;
    if (!progress(queue.progress())) stop.request_stop();
  }
  threads.clear();
  return queue.result();
}

}  // namespace comptonaut
