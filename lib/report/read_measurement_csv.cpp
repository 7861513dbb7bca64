// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "bus/valid.h"
#include "core/csv_reader.h"
#include "report/measurement_csv.h"

namespace comptonaut {
namespace {

constexpr double kLiveMax_s = 2000.0;  // fits the microseconds of a batch
constexpr double kCsvUnitTolerance = 1e-3;
constexpr double kWeightTolerance = 1e-3;
constexpr double kAnyNumber = 1e9;

// Places of the columns in kViewpointColumns and kConeColumns.
namespace viewpoint {
enum Column : std::size_t { kTime, kDrone, kPosition, kRotation = 5, kLive = 9, kSingles };
}
namespace cone {
enum Column : std::size_t { kTime, kDrone, kEvent, kPosition, kRotation = 6, kAxis = 10, kBeta = 13, kWeight };
}

std::vector<std::string> names_in(const char* columns) {
  std::vector<std::string> names;
  std::istringstream in(columns);
  for (std::string name; std::getline(in, name, ',');) names.push_back(name);
  return names;
}

Utime utime_of(const CsvReader& csv, std::size_t column) {
  return microseconds(csv.number(column, 0.0, seconds(kMaxUtime)));
}

/// As many numbers as the vector has, from `first` on.
template <class Vector>
Vector vector_of(const CsvReader& csv, std::size_t first, double max) {
  Vector v;
  for (int i = 0; i < v.size(); ++i) v[i] = csv.number(first + static_cast<std::size_t>(i), -max, max);
  return v;
}

/// The same, of length 1. What is so within the rounding of messages stays as it is, so that a recording that was
/// written out reads back to the same bits.
template <class Vector>
Vector unit_of(const CsvReader& csv, std::size_t first, const char* what) {
  const auto v = vector_of<Vector>(csv, first, kAnyNumber);
  const double off = std::abs(v.norm() - 1.0);
  if (off <= kUnitTolerance) return v;
  if (off <= kCsvUnitTolerance) return v.normalized();
  throw csv.error(fmt::format("{} of length {:.6g}: must be 1 within {}", what, v.norm(), kCsvUnitTolerance));
}

Eigen::Quaterniond rotation_of(const CsvReader& csv, std::size_t first) {
  const auto q = unit_of<Eigen::Vector4d>(csv, first, "the quaternion qw,qx,qy,qz is");
  return {q[0], q[1], q[2], q[3]};
}

/// What rows of both kinds have in common.
MeasurementBatch batch_of(const CsvReader& csv, std::size_t drone, std::size_t position, std::size_t rotation,
                          const std::string& nuclide) {
  MeasurementBatch batch;
  batch.key.sender = static_cast<std::int32_t>(csv.whole(drone, 1, kMaxMav));
  batch.p_WD = vector_of<Eigen::Vector3d>(csv, position, kMaxCoordinate);
  batch.q_WD = rotation_of(csv, rotation);
  batch.channels = {{.nuclide = nuclide}};
  return batch;
}

Cone cone_of(const CsvReader& csv, const MeasurementBatch& photon) {
  Cone cone{.p_WS = photon.p_WD,
            .axis_W = unit_of<Eigen::Vector3d>(csv, cone::kAxis, "the axis is"),
            .cos_beta = std::cos(csv.number(cone::kBeta, 0.0, std::numbers::pi + 1e-6)),
            .weight = csv.number(cone::kWeight, 0.0, 1.0)};
  if (!(cone.weight > 0.0)) throw csv.error(cone::kWeight, "a number above 0, at most 1");
  return cone;
}

/// A further hypothesis of a photon that has one.
void join(const CsvReader& csv, MeasurementBatch& photon, const MeasurementBatch& row) {
  if (row.utime != photon.utime || row.p_WD != photon.p_WD || row.q_WD.coeffs() != photon.q_WD.coeffs()) {
    throw csv.error(cone::kEvent, "of rows with the same time, position and attitude: hypotheses of one photon");
  }
  if (photon.cones.size() > 1) throw csv.error(cone::kEvent, "of two rows at most");
  if (photon.cones[0].weight + row.cones[0].weight > 1.0 + kWeightTolerance) {
    throw csv.error(cone::kWeight, fmt::format("{:.6g} at most, since that of the event's other row is {:.6g}",
                                               1.0 - photon.cones[0].weight, photon.cones[0].weight));
  }
  photon.cones.push_back(row.cones[0]);
}

}  // namespace

std::vector<MeasurementBatch> read_viewpoints_csv(const std::filesystem::path& file, const std::string& nuclide) {
  CsvReader csv(file, names_in(kViewpointColumns));
  std::vector<MeasurementBatch> batches;
  while (csv.next()) {
    MeasurementBatch batch = batch_of(csv, viewpoint::kDrone, viewpoint::kPosition, viewpoint::kRotation, nuclide);
    const double live_s = csv.number(viewpoint::kLive, 0.0, kLiveMax_s);
    batch.live_us = batch.duration_us = static_cast<std::int32_t>(microseconds(live_s));
    batch.utime = utime_of(csv, viewpoint::kTime) - batch.duration_us / 2;
    constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
    batch.channels[0].singles = static_cast<std::int32_t>(csv.whole(viewpoint::kSingles, 0, kMost));
    batches.push_back(std::move(batch));
  }
  return batches;
}

std::vector<MeasurementBatch> read_cones_csv(const std::filesystem::path& file, const std::string& nuclide) {
  CsvReader csv(file, names_in(kConeColumns));
  std::vector<MeasurementBatch> photons;
  std::map<std::pair<std::int32_t, std::int64_t>, std::size_t> photon_at;
  while (csv.next()) {
    MeasurementBatch row = batch_of(csv, cone::kDrone, cone::kPosition, cone::kRotation, nuclide);
    row.utime = utime_of(csv, cone::kTime);
    row.cones = {cone_of(csv, row)};
    const std::int64_t event = csv.whole(cone::kEvent, 0, std::numeric_limits<std::int64_t>::max());
    const auto [at, fresh] = photon_at.emplace(std::pair(row.key.sender, event), photons.size());
    if (fresh) {
      photons.push_back(std::move(row));
    } else {
      join(csv, photons[at->second], row);
    }
  }
  return photons;
}

}  // namespace comptonaut
