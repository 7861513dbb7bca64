// SPDX-License-Identifier: BSD-3-Clause
#include "detector/events.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "detector/make_hits.h"
#include "detector/pair.h"
#include "physics/kinematics.h"

namespace comptonaut {
namespace {

constexpr double kLine_keV = 661.657;
constexpr double kDegree = std::numbers::pi / 180.0;

std::vector<DetectorEvent> events_of(std::vector<Hit> hits, const EventRules& rules = {}) {
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
  return find_events(hits, rules, typical_calibration());
}

TEST(Events, OneClusterInTheWindowIsASingle) {
  const auto events = events_of({make_hit(10, 20, 300.0, 1000.0), make_hit(11, 20, 350.0, 1010.0)});
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, EventKind::kSingle);
  EXPECT_EQ(events[0].channel, 0);
  EXPECT_NEAR(events[0].energy_keV, 650.0, 1.0);
  EXPECT_EQ(events[0].first.size_px, 2);
  EXPECT_NEAR(events[0].first.x_px, 10.0 + 350.0 / 650.0, 0.01);
}

TEST(Events, EnergiesOutsideTheWindowAreOthers) {
  for (const double energy_keV : {15.0, 32.0, 39.0, 803.0}) {
    const auto events = events_of({make_hit(10, 20, energy_keV, 1000.0)});
    ASSERT_EQ(events.size(), 1u) << energy_keV;
    EXPECT_EQ(events[0].kind, EventKind::kOther) << energy_keV;
  }
}

TEST(Events, ASaturatedClusterIsNeitherSingleNorPair) {
  EventRules rules;
  rules.channels[0].singles_max_keV = 2000.0;
  Hit hit = make_hit(10, 20, 300.0, 1000.0);
  hit.tot = kSaturatedTot;
  ASSERT_EQ(events_of({hit}, rules).size(), 1u);
  EXPECT_EQ(events_of({hit}, rules)[0].kind, EventKind::kOther);
}

TEST(Events, FluorescenceWithinReachIsItsNeighboursEnergy) {
  const auto near = events_of({make_hit(100, 100, 400.0, 1000.0), make_hit(109, 109, 27.0, 1030.0)});
  ASSERT_EQ(near.size(), 1u);
  EXPECT_EQ(near[0].kind, EventKind::kSingle);
  EXPECT_EQ(near[0].clusters, 2);
  EXPECT_NEAR(near[0].first.energy_keV, 427.0, 1.0);
  EXPECT_DOUBLE_EQ(near[0].first.x_px, 100.0) << "the photon interacted where the energy but for fluorescence is";

  const auto far = events_of({make_hit(100, 100, 400.0, 1000.0), make_hit(112, 112, 27.0, 1030.0)});
  ASSERT_EQ(far.size(), 1u);
  EXPECT_EQ(far[0].kind, EventKind::kOther) << "17 pixels away";

  const auto strong = events_of({make_hit(100, 100, 400.0, 1000.0), make_hit(109, 109, 45.0, 1030.0)});
  EXPECT_EQ(strong[0].kind, EventKind::kOther) << "45 keV is no fluorescence, and 13 pixels no pair";
}

TEST(Events, OfTwoThatMayBeFluorescenceTheWeakerIs) {
  for (const double first_keV : {22.0, 32.0}) {
    const auto events = events_of({make_hit(100, 100, first_keV, 1000.0), make_hit(109, 100, 27.0, 1030.0)});
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].clusters, 2);
    EXPECT_EQ(events[0].second.size_px, 0);
    EXPECT_NEAR(events[0].first.energy_keV, first_keV + 27.0, 1.0);
    EXPECT_EQ(events[0].first.size_px, 2);
    EXPECT_EQ(events[0].first.x_px, first_keV < 27.0 ? 109.0 : 100.0) << "where the stronger one is";
  }
}

TEST(Events, ClustersBeyondTheDriftTimeAreTwoEvents) {
  for (const double dt_ns : {80.0, 92.0}) {
    const auto events = events_of({make_hit(10, 10, 300.0, 1000.0), make_hit(60, 10, 361.657, 1000.0 + dt_ns)});
    EXPECT_EQ(events.size(), dt_ns < 86.0 ? 1u : 2u) << dt_ns;
  }
}

TEST(Events, PairsAreAtLeastFifteenPixelsApart) {
  const auto at = [](int x) { return events_of({make_hit(10, 10, 300.0, 1000.0), make_hit(x, 10, 361.657, 1000.0)}); };
  EXPECT_EQ(at(24)[0].kind, EventKind::kOther);
  EXPECT_EQ(at(25)[0].kind, EventKind::kPair);
}

TEST(Events, ThePairWindowIsAShareOfTheLine) {
  for (const auto& [sum_keV, kind] : {std::pair{520.0, EventKind::kOther},
                                      {535.0, EventKind::kPair},
                                      {790.0, EventKind::kPair},
                                      {800.0, EventKind::kOther}}) {
    const auto events = events_of({make_hit(10, 10, 0.5 * sum_keV, 0.0), make_hit(60, 10, 0.5 * sum_keV, 5.0)});
    EXPECT_EQ(events[0].kind, kind) << sum_keV;
  }
}

TEST(Events, AnElectronAboveTheComptonEdgeLeavesOneHypothesis) {
  const auto events = events_of({make_hit(10, 10, 100.0, 0.0), make_hit(60, 10, 561.657, 20.0)});
  ASSERT_EQ(events[0].kind, EventKind::kPair);
  EXPECT_EQ(events[0].hypotheses->a.probability, 1.0);
  EXPECT_EQ(events[0].hypotheses->b.probability, 0.0);
}

TEST(Events, ProbabilitiesSumToOneAndSwapWithTheClusters) {
  const auto there = events_of({make_hit(10, 10, 300.0, 0.0), make_hit(60, 10, 361.657, 20.0)});
  const auto back = events_of({make_hit(10, 10, 361.657, 0.0), make_hit(60, 10, 300.0, 20.0)});
  EXPECT_DOUBLE_EQ(there[0].hypotheses->a.probability + there[0].hypotheses->b.probability, 1.0);
  EXPECT_GT(there[0].hypotheses->a.probability, 0.05);
  EXPECT_GT(there[0].hypotheses->b.probability, 0.05);
  EXPECT_NEAR(there[0].hypotheses->a.probability, back[0].hypotheses->b.probability, 1e-3);
  EXPECT_TRUE(there[0].hypotheses->a.axis_D.isApprox(-there[0].hypotheses->b.axis_D));
}

/// A photon from direction (theta, phi) that scatters by beta at azimuth psi around its way, and is absorbed after
/// 1.5 mm: both deposits as hits, without noise.
std::vector<Hit> photon_hits(const SensorConfig& sensor, double theta, double phi, double beta, double psi) {
  const Eigen::Vector3d u(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  const Eigen::Vector3d way = -u;
  const Eigen::Vector3d e1 = way.unitOrthogonal(), e2 = way.cross(e1);
  const Eigen::Vector3d out = std::cos(beta) * way + std::sin(beta) * (std::cos(psi) * e1 + std::sin(psi) * e2);
  const Eigen::Vector3d p1_um(300.0, -500.0, 0.0), p2_um = p1_um + 1500.0 * out;
  const double photon_keV = scattered_keV(kLine_keV, std::cos(beta));
  const auto at = [&](const Eigen::Vector3d& p_um, double energy_keV) {
    const double side = sensor.mirror_x ? -1.0 : 1.0;
    const double x = side * p_um.x() / kPixelPitch_um + 127.5, y = p_um.y() / kPixelPitch_um + 127.5;
    const double drift_ns = (p_um.z() + 0.5 * sensor.thickness_um) / drift_velocity_um_ns(sensor);
    return make_hit(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)), energy_keV, 1e6 + drift_ns,
                    sensor);
  };
  return {at(p1_um, kLine_keV - photon_keV), at(p2_um, photon_keV)};
}

/// Angle between the source and the nearest cone of the event, degrees.
double cone_error_deg(const DetectorEvent& event, double theta, double phi) {
  const Eigen::Vector3d u(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  double best = 180.0;
  for (const ConeHypothesis* cone : {&event.hypotheses->a, &event.hypotheses->b}) {
    if (cone->probability == 0.0) continue;
    best = std::min(best, std::abs(std::acos(u.dot(cone->axis_D)) - std::acos(cone->cos_beta)) / kDegree);
  }
  return best;
}

/// Median error of the better cone over oblique directions and scatter azimuths; `read` may differ from the `truth`
/// that made the hits, to see that it must not.
double median_error_deg(const SensorConfig& truth, const SensorConfig& read, double drift_sign = 1.0) {
  EventRules rules;
  rules.sensor = read;
  std::vector<double> errors;
  for (const double theta : {30.0, 45.0, 60.0}) {
    for (const double phi : {30.0, 45.0, 60.0}) {
      for (const double beta : {40.0, 70.0, 100.0}) {
        for (int k = 0; k < 12; ++k) {
          auto hits = photon_hits(truth, theta * kDegree, phi * kDegree, beta * kDegree, k * 30.0 * kDegree);
          if (drift_sign < 0.0) std::swap(hits[0].t, hits[1].t);
          for (const DetectorEvent& event : events_of(hits, rules)) {
            if (event.kind == EventKind::kPair) {
              errors.push_back(cone_error_deg(event, theta * kDegree, phi * kDegree));
            }
          }
        }
      }
    }
  }
  EXPECT_GT(errors.size(), 150u);
  std::nth_element(errors.begin(), errors.begin() + std::ssize(errors) / 2, errors.end());
  return errors[errors.size() / 2];
}

TEST(Events, AConeOfAnObliquePairHoldsItsSource) { EXPECT_LT(median_error_deg({}, {}), 1.5); }

TEST(Events, AMirroredChipIsReadThroughTheMirror) {
  EXPECT_LT(median_error_deg({.mirror_x = true}, {.mirror_x = true}), 1.5);
}

TEST(Events, AMirrorThatIsNotToldPutsConesWrong) { EXPECT_GT(median_error_deg({.mirror_x = true}, {}), 5.0); }

TEST(Events, AFlippedDriftSignPutsConesWrong) { EXPECT_GT(median_error_deg({}, {}, -1.0), 5.0); }

TEST(Events, TheLaterClusterLayFartherFromThePixels) {
  const Cluster early{.t = 0}, late{.t = chip_time_ns(50.0)};
  EXPECT_NEAR(depth_difference_um({}, early, late), -50.0 * 23.27, 2.0);
}

TEST(Events, StretchesGiveTheEventsOfTheWhole) {
  std::vector<Hit> hits;
  for (int i = 0; i < 200; ++i) hits.push_back(make_hit(i, 100, 100.0, 1000.0 * i));
  EventFinder finder(EventRules{}, typical_calibration());
  std::size_t parts = 0;
  for (const Hit& hit : hits) parts += finder.find({&hit, 1}).size();
  EXPECT_EQ(parts, finder.find(hits).size());
}

TEST(Events, WrongRulesAreRefusedByName) {
  EventRules rules;
  rules.sensor.bias_V = 450.0;
  EXPECT_THROW(check(rules), std::invalid_argument);
  rules = {};
  rules.channels.push_back(rules.channels[0]);
  EXPECT_THROW(check(rules), std::invalid_argument) << "windows of singles overlap";
}

TEST(CdTe, PhotoelectricFitFollowsXcom) {
  // XCOM, 5.85 g/cm^3, 1/cm
  for (const auto& [energy_keV, per_cm] : {std::pair{60.0, 36.24},
                                           {100.0, 8.559},
                                           {200.0, 1.1665},
                                           {400.0, 0.17066},
                                           {600.0, 0.061385},
                                           {1500.0, 0.0091096}}) {
    EXPECT_NEAR(cdte_photoelectric_per_m(energy_keV) / (100.0 * per_cm), 1.0, 0.01) << energy_keV;
  }
  EXPECT_NEAR(cdte_compton_per_m(300.0), 50.45, 2.0);
}

}  // namespace
}  // namespace comptonaut
