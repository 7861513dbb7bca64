// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "report/measurement_csv.h"

namespace comptonaut {
namespace {

using Text = fmt::memory_buffer;

/// Seconds of so many microseconds, not negative, digit by digit.
void add_seconds(Text& text, std::int64_t us) {
  fmt::format_to(std::back_inserter(text), "{}.{:06}", us / kSecond_us, us % kSecond_us);
}

/// Numbers in as few digits as read back to the same bits.
void add_pose(Text& text, const Eigen::Vector3d& p, const Eigen::Quaterniond& q) {
  fmt::format_to(std::back_inserter(text), ",{},{},{},{},{},{},{}", p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
}

/// A batch that only goes on with the cones of another one measured nothing itself.
bool is_viewpoint(const MeasurementBatch& batch, std::int64_t singles) { return batch.live_us > 0 || singles > 0; }

std::int64_t singles_of(const MeasurementBatch& batch, const std::string& nuclide) {
  std::int64_t singles = 0;
  for (const ChannelCounts& counts : batch.channels) singles += counts.nuclide == nuclide ? counts.singles : 0;
  return singles;
}

}  // namespace

std::string viewpoints_csv(std::span<const MeasurementBatch> batches, const std::string& nuclide) {
  Text text;
  fmt::format_to(std::back_inserter(text), "{}\n", kViewpointColumns);
  for (const MeasurementBatch& batch : batches) {
    const std::int64_t singles = singles_of(batch, nuclide);
    if (!is_viewpoint(batch, singles)) continue;
    add_seconds(text, batch.utime + batch.duration_us / 2);
    fmt::format_to(std::back_inserter(text), ",{}", batch.key.sender);
    add_pose(text, batch.p_WD, batch.q_WD);
    text.push_back(',');
    add_seconds(text, batch.live_us);
    fmt::format_to(std::back_inserter(text), ",{}\n", singles);
  }
  return fmt::to_string(text);
}

std::string cones_csv(std::span<const MeasurementBatch> batches, const std::string& nuclide) {
  Text text;
  fmt::format_to(std::back_inserter(text), "{}\n", kConeColumns);
  std::int64_t event = -1;
  for (const MeasurementBatch& batch : batches) {
    std::int32_t event_in_batch = -1;
    for (const Cone& cone : batch.cones) {
      if (batch.channels.at(static_cast<std::size_t>(cone.channel)).nuclide != nuclide) continue;
      if (event_in_batch != cone.event) ++event;
      event_in_batch = cone.event;
      add_seconds(text, batch.utime + cone.offset_us);
      fmt::format_to(std::back_inserter(text), ",{},{}", batch.key.sender, event);
      add_pose(text, cone.p_WS, batch.q_WD);
      fmt::format_to(std::back_inserter(text), ",{},{},{},{},{}\n", cone.axis_W.x(), cone.axis_W.y(), cone.axis_W.z(),
                     std::acos(std::clamp(cone.cos_beta, -1.0, 1.0)), cone.weight);
    }
  }
  return fmt::to_string(text);
}

}  // namespace comptonaut
