// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "response/make_response.h"

namespace comptonaut {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Photons of Cs-137 from one direction that left hits far enough apart for a pair, photon by photon.
struct Recording {
  std::string name;
  Eigen::Vector3d u_D;
  std::vector<std::vector<Hit>> photons;
};

bool may_be_pair(const PhotonHistory& history) {
  if (history.escaped_keV > 200.0) return false;  // beyond the window of 20 %
  const auto apart_m = [&](const Deposit& a, const Deposit& b) { return (a.p_D - b.p_D).head<2>().norm(); };
  for (const Deposit& a : history.deposits) {
    for (const Deposit& b : history.deposits) {
      if (apart_m(a, b) > 10.0 * 1e-6 * kPixelPitch_um) return true;
    }
  }
  return false;
}

Recording record(double theta_deg, double phi_deg, int photons) {
  Recording recording{.name = fmt::format("theta {} phi {}", theta_deg, phi_deg),
                      .u_D = direction_D(phi_deg * kDegree, theta_deg * kDegree),
                      .photons = {}};
  static const Transport transport(sensor_block({}), load_cdte());
  Digitizer digitizer({}, {}, Calibration::uniform());
  Random random(12, static_cast<std::uint64_t>(1000.0 * theta_deg + phi_deg));
  for (int i = 0; i < photons; ++i) {
    const Photon photon = sample_entry(transport.block(), recording.u_D, 5.0, 661.657, random);
    const PhotonHistory history = transport.follow(photon, random);
    if (!may_be_pair(history)) continue;
    digitizer.digitize(history.deposits, 1e6, random, recording.photons.emplace_back());
  }
  return recording;
}

const std::vector<Recording>& recordings() {
  static const std::vector<Recording> all = [] {
    std::vector<Recording> made;
    for (const double theta_deg : {30.0, 45.0, 60.0}) {
      for (const double phi_deg : {30.0, 45.0, 60.0}) made.push_back(record(theta_deg, phi_deg, 800'000));
    }
    return made;
  }();
  return all;
}

/// What is wrong with the detector or its reader.
struct Fault {
  std::function<void(std::vector<Hit>&)> in_hits = [](auto&) {};
  std::function<void(DetectorEvent&)> in_event = [](auto&) {};
  SensorConfig reader = {};
};

AngularSummary read(const Recording& recording, const Fault& fault) {
  EventFinder finder({.sensor = fault.reader}, Calibration::uniform());
  std::vector<SimulatedPair> pairs;
  for (std::vector<Hit> hits : recording.photons) {
    fault.in_hits(hits);
    std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
    for (DetectorEvent event : finder.find(hits)) {
      if (event.kind != EventKind::kPair) continue;
      fault.in_event(event);
      const auto view = [&](const ConeHypothesis& cone) {
        return ConeView{recording.u_D.dot(cone.axis_D), cone.cos_beta, cone.probability};
      };
      pairs.push_back({.a = view(event.hypotheses->a), .b = view(event.hypotheses->b), .a_is_true = {}});
    }
  }
  return summarize(pairs);
}

/// Directions in which half of all pairs have a cone within 3 degrees of the source, and 95 % one within 20.
int good_directions(const Fault& fault) {
  return static_cast<int>(std::count_if(recordings().begin(), recordings().end(), [&](const Recording& recording) {
    const AngularSummary summary = read(recording, fault);
    return summary.best_median_rad <= 3.0 * kDegree && summary.best_q95_rad <= 20.0 * kDegree;
  }));
}

// From photon to cone, with 3 % FWHM at 662 keV and the depth's error of the digitizer.
TEST(ReaderCones, HoldTheirSourceInObliqueDirections) {
  for (const Recording& recording : recordings()) {
    const AngularSummary summary = read(recording, {});
    EXPECT_GT(summary.pairs, 1500) << recording.name;
    EXPECT_LE(summary.best_median_rad / kDegree, 3.0) << recording.name;
    EXPECT_LE(summary.best_q95_rad / kDegree, 20.0) << recording.name;
  }
  EXPECT_EQ(good_directions({}), 9);
}

TEST(ReaderCones, MissItWhereXIsMirrored) { EXPECT_EQ(good_directions({.reader = {.mirror_x = true}}), 0); }

TEST(ReaderCones, MissItWhereTheDriftsSignIsFlipped) {
  const auto flip = [](std::vector<Hit>& hits) {
    for (Hit& hit : hits) hit.t = static_cast<ChipTime>(2e6 / kChipTime_ns) - hit.t;
  };
  EXPECT_EQ(good_directions({.in_hits = flip}), 0);
}

// phi = 45 degrees lies on the mirror between the axes: there nothing can tell.
TEST(ReaderCones, MissItWhereXAndYAreSwapped) {
  const auto swap = [](std::vector<Hit>& hits) {
    for (Hit& hit : hits) hit.pixel = static_cast<std::uint16_t>(kChipPixels * pixel_x(hit.pixel) + pixel_y(hit.pixel));
  };
  EXPECT_EQ(good_directions({.in_hits = swap}), 3);
}

TEST(ReaderCones, MissItWhereTheConesPointAway) {
  const auto turn = [](DetectorEvent& event) { std::swap(event.hypotheses->a.axis_D, event.hypotheses->b.axis_D); };
  EXPECT_EQ(good_directions({.in_event = turn}), 0);
}

}  // namespace
}  // namespace comptonaut
