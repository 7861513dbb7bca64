// SPDX-License-Identifier: BSD-3-Clause
#include "report/read_mission.h"

#include <fmt/format.h>

#include <functional>
#include <set>
#include <stdexcept>

#include "bus/bus.h"
#include "bus/codec.h"

namespace comptonaut {
namespace {

/// Decodes as a T for `use`, or counts the refusal.
template <class T>
void take(MissionRecorder& recorder, const LogEvent& event, const std::function<void(const T&)>& use) {
  if (const auto message = decode<T>(event.bytes)) {
    use(*message);
  } else {
    recorder.on_refused(mav_of_channel(event.channel), event.channel);
  }
}

/// Whether the message was one of a drone (or, of its STATUS, the ground station).
bool record_mav_event(MissionRecorder& recorder, const LogEvent& event, int mav) {
  const auto is = [&](const char* name) { return event.channel == mav_channel(mav, name); };
  if (is("STATUS")) {
    take<DaemonStatus>(recorder, event, [&](const DaemonStatus& m) { recorder.on_status(mav, m); });
  } else if (mav == 0) {
    return false;
  } else if (is("MEASUREMENTS")) {
    take<MeasurementBatch>(recorder, event, [&](const MeasurementBatch& m) { recorder.on_measurements(m); });
  } else if (is("TERRAIN")) {
    take<TerrainTile>(recorder, event, [&](const TerrainTile& m) { recorder.on_terrain(m); });
  } else if (is("POSE")) {
    take<StampedPose>(recorder, event, [&](const StampedPose& m) { recorder.on_pose(mav, m); });
  } else if (is("POSE_QUALITY")) {
    take<PoseQuality>(recorder, event, [&](const PoseQuality& m) { recorder.on_pose_quality(mav, m); });
  } else if (is("VEHICLE")) {
    take<VehicleState>(recorder, event, [&](const VehicleState& m) { recorder.on_vehicle(mav, m); });
  } else if (is("PLAN")) {
    take<Plan>(recorder, event, [&](const Plan& m) { recorder.on_plan(mav, m); });
  } else {
    return false;
  }
  return true;
}

bool record_team_event(MissionRecorder& recorder, const LogEvent& event) {
  if (event.channel == "SOURCES") {
    take<SourceReport>(recorder, event, [&](const SourceReport& m) { recorder.on_sources(m); });
  } else if (event.channel == "RADIATION_MAP") {
    take<MapTile>(recorder, event, [&](const MapTile& m) { recorder.on_map(m); });
  } else if (event.channel == "RADIATION_CLEARANCE") {
    take<ClearanceTile>(recorder, event, [&](const ClearanceTile& m) { recorder.on_clearance(m); });
  } else if (event.channel == "PATCHES") {
    take<PatchReport>(recorder, event, [&](const PatchReport& m) { recorder.on_patches(m); });
  } else if (event.channel == "COORDINATOR") {
    take<CoordinatorState>(recorder, event, [&](const CoordinatorState& m) { recorder.on_coordinator(m); });
  } else if (event.channel == "SIM_TRUTH") {
    take<Truth>(recorder, event, [&](const Truth& m) { recorder.on_truth(m); });
  } else {
    return false;
  }
  return true;
}

std::string some_of(const std::set<std::string>& channels) {
  std::string list;
  for (const std::string& channel : channels) {
    if (list.size() > 60) return list + ", ...";
    list += (list.empty() ? "" : ", ") + channel;
  }
  return list;
}

}  // namespace

void record_event(MissionRecorder& recorder, const LogEvent& event) {
  const int mav = mav_of_channel(event.channel);
  const bool known = mav >= 0 ? record_mav_event(recorder, event, mav) : record_team_event(recorder, event);
  if (!known) recorder.on_other(event.channel);
}

MissionRecord read_mission(const std::filesystem::path& log) {
  MissionRecorder recorder;
  std::set<std::string> channels;
  std::string damage;
  try {
    read_log(log, [&](const LogEvent& event) {
      channels.insert(event.channel);
      record_event(recorder, event);
    });
  } catch (const std::runtime_error& error) {
    if (channels.empty()) throw;
    damage = error.what();
  }
  MissionRecord record = std::move(recorder).finish();
  if (record.messages == 0) {
    throw std::runtime_error(fmt::format("{}: holds no message of a mission that can be read; its channels are {}",
                                         log.string(), some_of(channels)));
  }
  record.damage = damage;
  return record;
}

}  // namespace comptonaut
