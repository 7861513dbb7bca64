// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "radiation/measurement_batch.h"

namespace comptonaut {

/// Measurements of one nuclide as two CSV files, for recordings of any kind and for people to look at. Numbers are in
/// the world W (east-north-up) and must be finite; q = (w, x, y, z) rotates the detector's frame D to W. A quaternion
/// or an axis whose length is within 0.001 of 1 is scaled to 1. Reading throws std::runtime_error as CsvReader does.

/// Where a detector was, for how long it could see, and what it counted.
///   t_s             middle of that time, s: since 1970, or since any moment that both files share
///   drone           1..250; background and scale of the response are estimated per drone
///   x_m,y_m,z_m, qw,qx,qy,qz   pose of D in W, in the middle of that time
///   live_s          0..2000; of 0 the row adds nothing
///   singles         counts of single clusters in the nuclide's window
inline constexpr const char* kViewpointColumns = "t_s,drone,x_m,y_m,z_m,qw,qx,qy,qz,live_s,singles";

/// One hypothesis of a Compton pair each; a source in direction u has angle(u, axis) = beta_rad.
///   t_s, drone      as above, of the photon
///   event           >= 0: rows of one drone and event are the hypotheses of one photon: two at most, equal in time and
///   pose x_m,y_m,z_m, qw,qx,qy,qz   pose of D in W when the photon came; its position is the cone's apex
///   axis_x,axis_y,axis_z       unit vector in W, to the source's side
///   beta_rad        0..pi
///   weight          probability of the hypothesis, above 0; those of one photon sum to 1 at most
inline constexpr const char* kConeColumns =
    "t_s,drone,event,x_m,y_m,z_m,qw,qx,qy,qz,axis_x,axis_y,axis_z,beta_rad,weight";

/// One batch per row, in the order of the rows.
[[nodiscard]] std::vector<MeasurementBatch> read_viewpoints_csv(const std::filesystem::path& file,
                                                                const std::string& nuclide);
/// One batch per photon, without live time, in the order of their first rows.
[[nodiscard]] std::vector<MeasurementBatch> read_cones_csv(const std::filesystem::path& file,
                                                           const std::string& nuclide);

/// The nuclide's part of the batches as text that reads back to the same measurements.
[[nodiscard]] std::string viewpoints_csv(std::span<const MeasurementBatch> batches, const std::string& nuclide);
[[nodiscard]] std::string cones_csv(std::span<const MeasurementBatch> batches, const std::string& nuclide);

}  // namespace comptonaut
