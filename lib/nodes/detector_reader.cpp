// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/detector_reader.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace comptonaut {
namespace {

// Uncertainty of chip time against UTC, by what tells it.
constexpr std::int32_t kStampSigma_us = 100;
constexpr std::int32_t kRecordingSigma_us = 1'000;
constexpr std::int32_t kContinuedSigma_us = 1'000'000;

// Batches follow the fit of arrivals so much each, so that live time and counts stay right to half a per cent, and
// begin anew where the clock was set.
constexpr Utime kFollow_us = kBatch_us / 200;
constexpr Utime kClockSet_us = 500'000;

/// Of a longer time without life only the first batch is told, so that receivers are not flooded when it ends.
constexpr Utime kDeadMax_us = kSecond_us;
/// A stream whose chip time is beyond this when it begins was joined.
constexpr Utime kJoined_us = 60 * kSecond_us;

HitStream new_stream(const DetectorReaderConfig& config, const EventFinder& finder, const StreamOrigin& origin) {
  return HitStream(config.stream, finder.quiet(), origin.recording, origin.format);
}

ChipTime first_time(const StreamPart& part) { return part.hits.empty() ? part.until : part.hits.front().t; }

/// Of an event that is a pair.
PairEvent pair_event(const DetectorEvent& event, ChipTime batch_from) {
  const double offset_ns = static_cast<double>(event.first.t - batch_from) * kChipTime_ns + event.first.offset_ns;
  return {.offset_ns = static_cast<std::int32_t>(std::clamp(offset_ns, 0.0, 1e3 * kBatch_us - 1.0)),
          .channel = event.channel,
          .e1_keV = event.first.energy_keV,
          .e2_keV = event.second.energy_keV,
          .a = event.hypotheses->a,
          .b = event.hypotheses->b};
}

}  // namespace

Utime DetectorReader::TimeBase::utime(ChipTime t) const { return start_utime + t / kChipTimePerUs; }

DetectorReader::DetectorReader(const DetectorReaderConfig& config, Calibration calibration, const BatchKey& first_key)
    : config_(config),
      finder_(config.rules, std::move(calibration)),
      hot_pixels_(config.hot_pixels),
      stream_(new_stream(config, finder_, origin_)),
      next_key_(first_key) {}

void DetectorReader::on_open(const StreamOrigin& origin) {
  origin_ = origin;
  stream_ = new_stream(config_, finder_, origin);
}

std::vector<EventBatch> DetectorReader::on_bytes(std::span<const char> bytes, std::optional<Utime> arrival_utime) {
  arrival_utime_ = arrival_utime;
  stream_.feed(bytes);
  return drain();
}

std::vector<EventBatch> DetectorReader::on_silence(double silent_ms) {
  arrival_utime_.reset();
  stream_.on_silence(silent_ms);
  return drain();
}

std::vector<EventBatch> DetectorReader::on_end() {
  arrival_utime_.reset();
  stream_.end();
  std::vector<EventBatch> batches = drain();
  counts_ += stream_.counts();
  epoch_end_.reset();
  on_open({});
  return batches;
}

std::vector<EventBatch> DetectorReader::drain() {
  while (const auto part = stream_.next()) take(*part);
  return std::exchange(ready_, {});
}

void DetectorReader::take(const StreamPart& part) {
  if (arrival_utime_ && stream_.newest() > 0) arrivals_.add(stream_.newest(), *arrival_utime_);
  if (!base_) begin_epoch(part);
  if (base_) {
    find_events(part);
  } else {
    hits_without_time_ += std::ssize(part.hits);
  }
  if (part.ends_epoch) end_epoch(part);
}

std::optional<DetectorReader::TimeBase> DetectorReader::time_base() const {
  if (const auto start = stream_.start_utime()) return TimeBase{*start, kStampSigma_us};
  if (const auto fit = arrivals_.fit()) return TimeBase{fit->start_utime, fit->sigma_us, true};
  if (epoch_end_) return TimeBase{*epoch_end_, kContinuedSigma_us};
  if (origin_.start_utime) return TimeBase{*origin_.start_utime, kRecordingSigma_us};
  return std::nullopt;
}

/// Batches begin with the epoch, or where the stream joins an epoch that is long under way, there.
void DetectorReader::begin_epoch(const StreamPart& part) {
  if (part.hits.empty() && part.until <= 0) return;
  base_ = time_base();
  if (!base_) return;
  const Utime first_utime = base_->utime(first_time(part));
  const bool under_way = base_->fitted || first_utime - base_->start_utime > kJoined_us;
  const Utime utime = floor_to(under_way ? first_utime : base_->start_utime, kBatch_us);
  open_batch(utime, base_->chip_time(utime));
}

void DetectorReader::end_epoch(const StreamPart& part) {
  if (base_ && part.until >= batch_from_) close_batch();
  if (base_) epoch_end_ = base_->utime(part.until);
  base_.reset();
  arrivals_ = {};
}

void DetectorReader::add(const DetectorEvent& event) {
  close_batches_before(event.first.t);
  batch_totals_.add(event);
  switch (event.kind) {
    case EventKind::kSingle:
      ++batch_.channels[static_cast<std::size_t>(event.channel)].singles;
      ++singles_;
      return;
    case EventKind::kPair:
      ++batch_.channels[static_cast<std::size_t>(event.channel)].pairs;
      batch_.pairs.push_back(pair_event(event, batch_from_));
      ++pairs_;
      return;
    case EventKind::kOther:
      ++batch_.others;
      ++others_;
      return;
  }
}

/// Those of hits of hot pixels stand between the events, each in the batch of its time.
void DetectorReader::find_events(const StreamPart& part) {
  auto [kept, left_out] = hot_pixels_.split(part.hits, part.until);
  for (const DetectorEvent& event : finder_.find(kept)) {
    for (; !left_out.empty() && left_out.front().t < event.first.t; left_out = left_out.subspan(1)) {
      add_left_out(left_out.front());
    }
    add(event);
  }
  for (const Hit& hit : left_out) add_left_out(hit);
  close_batches_before(part.until);
}

void DetectorReader::add_left_out(const Hit& hit) {
  close_batches_before(hit.t);
  batch_totals_.add(hit);
}

/// Of the pixels, those whose hits are left out.
double DetectorReader::masked_share() const {
  const Calibration& calibration = finder_.calibration();
  const auto hot = hot_pixels_.masked();
  const auto only_hot =
      std::count_if(hot.begin(), hot.end(), [&](const HotPixel& h) { return !calibration.masked(h.pixel); });
  return static_cast<double>(calibration.masked_pixels() + only_hot) / static_cast<double>(Calibration::kPixels);
}

/// Of a fitted time base: true where the clock was set, and time begins anew.
bool DetectorReader::follow_arrivals() {
  if (!base_->fitted) return false;
  const auto fit = arrivals_.fit();
  const Utime behind_us = fit->start_utime - base_->start_utime;
  const bool set = std::abs(behind_us) > kClockSet_us;
  clock_steps_ += set ? 1 : 0;
  const Utime step_us = set ? behind_us : std::clamp(behind_us, -kFollow_us, kFollow_us);
  base_->start_utime += step_us;
  base_->sigma_us = fit->sigma_us + static_cast<std::int32_t>(std::abs(behind_us - step_us));
  return set;
}

void DetectorReader::open_batch(Utime utime, ChipTime from) {
  batch_ = {.key = next_key_, .utime = utime, .utime_sigma_us = base_->sigma_us};
  for (const NuclideChannel& channel : config_.rules.channels) batch_.channels.push_back({.nuclide = channel.name});
  batch_from_ = from;
  batch_to_ = base_->chip_time(utime + kBatch_us);
}

void DetectorReader::close_batches_before(ChipTime t) {
  while (t >= batch_to_) {
    close_batch();
    const bool paused = base_->utime(t) - batch_.utime > kDeadMax_us && stream_.life().live(batch_to_, t) == 0;
    const bool clock_set = follow_arrivals();
    if (!paused && !clock_set) {
      open_batch(batch_.utime + kBatch_us, batch_to_);
      continue;
    }
    const Utime utime = floor_to(base_->utime(paused ? t : batch_to_), kBatch_us);
    open_batch(utime, std::max(batch_to_, base_->chip_time(utime)));
  }
}

void DetectorReader::close_batch() {
  const ChipTime live = stream_.life().live(batch_from_, batch_to_);
  const RateTotals totals = std::exchange(batch_totals_, {});
  const RateLoss loss = rate_loss(totals, live, max_drift_ns(config_.rules.sensor));
  const double live_us = static_cast<double>(live) / static_cast<double>(kChipTimePerUs);
  const std::int64_t hits_lost = stream_.life().hits_lost(batch_from_, batch_to_);
  const double paid_us = lost_hits_.pay(totals.hits, hits_lost, live_us, batch_.duration_us);
  const double seen_us = paid_us * loss.seen_share() * (1.0 - masked_share());
  batch_.live_us = static_cast<std::int32_t>(std::min<std::int64_t>(std::llround(seen_us), batch_.duration_us));
  if (10 * live_us > batch_.duration_us) saturation_.add(loss.saturation);
  live_us_ += batch_.live_us;
  dead_us_ += batch_.duration_us - batch_.live_us;
  newest_utime_ = batch_.utime + batch_.duration_us;
  ++next_key_.number;
  stream_.forget_life_before(batch_to_);
  ready_.push_back(batch_);
}

HitStreamCounts DetectorReader::counts() const {
  HitStreamCounts counts = counts_;
  counts += stream_.counts();
  counts.faults.count[static_cast<std::size_t>(RowFault::kNoTimeBase)] += hits_without_time_;
  return counts;
}

std::vector<Counter> DetectorReader::counters() const {
  const HitStreamCounts counts = this->counts();
  std::vector<Counter> counters = {
      {"batches", next_key_.number},
      {"rows", counts.rows},
      {"hits", counts.hits},
      {"hits_repaired", counts.repaired},
      {"hits_saturated", counts.saturated},
      {"hits_repeated", finder_.cluster_finder().repeated()},
      {"hits_without_energy", finder_.cluster_finder().without_energy()},
      {"hits_of_hot_pixels", hot_pixels_.hits()},
      {"pixels_masked", finder_.calibration().masked_pixels()},
      {"pixels_hot", std::ssize(hot_pixels_.masked())},
      {"pixels_hot_times", hot_pixels_.times()},
      {"lost_data_gaps", counts.lost_gaps},
      {"epochs", counts.epochs},
      {"singles", singles_},
      {"pairs", pairs_},
      {"others", others_},
      {"live_ms", live_us_ / 1000},
      {"dead_ms", dead_us_ / 1000},
      {"utime_sigma_us", batch_.utime_sigma_us},
      {"clock_steps", clock_steps_},
      {"rate_hits_s", std::llround(saturation_.share() * kHitsMax_per_s)},
      {"keep_out", saturation_.keep_out() ? 1 : 0},
      {"keep_outs", saturation_.times()},
  };
  for (std::size_t i = 0; i < kRowFaults; ++i) {
    counters.push_back({std::string(counter_name(static_cast<RowFault>(i))), counts.faults.count[i]});
  }
  return counters;
}

}  // namespace comptonaut
