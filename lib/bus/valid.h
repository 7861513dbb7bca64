// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "core/batch_key.h"
#include "core/time.h"
#include "nodes/mav_channel.h"

/// What a number in a message may be. Each is false for NaN and infinity unless its name says otherwise.
namespace comptonaut {

inline constexpr double kMaxCoordinate = 1e6;              // m, m/s, m/s^2, rad/s: beyond it nothing flies
inline constexpr double kMaxActivity_Bq = 1e18;            // more than a reactor's core
inline constexpr Utime kMaxUtime = 4'102'444'800'000'000;  // the year 2100
inline constexpr double kUnitTolerance = 1e-6;             // of a norm after rounding to float
inline constexpr std::size_t kMaxText = 256;

[[nodiscard]] inline bool within(double value, double min, double max) { return value >= min && value <= max; }
[[nodiscard]] inline bool unknown_or_within(double value, double min, double max) {
  return std::isnan(value) || within(value, min, max);
}
[[nodiscard]] inline bool valid_utime(Utime utime) { return utime >= 0 && utime <= kMaxUtime; }
[[nodiscard]] inline bool valid_mav(std::int32_t mav) { return mav >= 0 && mav <= kMaxMav; }
[[nodiscard]] inline bool valid_vector(const Eigen::Vector3d& v) {
  return v.allFinite() && v.cwiseAbs().maxCoeff() <= kMaxCoordinate;
}

[[nodiscard]] inline bool unknown_or_vector(const Eigen::Vector3d& v) {
  return v.array().isNaN().all() || valid_vector(v);
}
[[nodiscard]] inline bool valid_unit(const Eigen::Vector3d& v) {
  return v.allFinite() && std::abs(v.norm() - 1.0) <= kUnitTolerance;
}
[[nodiscard]] inline bool valid_unit(const Eigen::Quaterniond& q) {
  return q.coeffs().allFinite() && std::abs(q.norm() - 1.0) <= kUnitTolerance;
}
[[nodiscard]] inline bool valid_text(const std::string& text) {
  if (text.size() > kMaxText) return false;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) return false;
  }
  return true;
}
/// What a receiver accepts of any text: control characters become '?', what is too long is cut.
[[nodiscard]] inline std::string clean_text(const std::string& text) {
  std::string clean = text.substr(0, kMaxText);
  for (char& c : clean) c = valid_text({c}) ? c : '?';
  return clean;
}
[[nodiscard]] inline bool valid_key(const BatchKey& key) {
  return key.mission >= 0 && valid_mav(key.sender) && valid_utime(key.boot_epoch) && key.number >= 0;
}

}  // namespace comptonaut
