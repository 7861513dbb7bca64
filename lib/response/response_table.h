// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace comptonaut {

/// One direction of a response table. single and pair are chances per decay of a source at 1 m in that direction
/// (branching included, no air); sigmas are relative and statistical.
struct ResponseEntry {
  double phi_rad = 0.0;    ///< atan2(u_y, u_x)
  double theta_rad = 0.0;  ///< angle(u, +z_D)
  double single = 0.0;
  double single_rel_sigma = 0.0;
  double pair = 0.0;
  double pair_rel_sigma = 0.0;

  bool operator==(const ResponseEntry&) const = default;
};

/// Unit vector of spherical angles in the detector frame D.
[[nodiscard]] Eigen::Vector3d direction_D(double phi_rad, double theta_rad);

/// The table L(theta, phi) of one nuclide. A direction's value is that of the entry nearest to it on the sphere, found
/// without trigonometry on an octahedral map (Cigolle et al. 2014); exact also on borders between entries. Immutable.
class ResponseTable {
 public:
  /// Facts about the table, by key: `nuclide`, `line_keV`, `branching`, `photons`, `seed`, `command`, ...
  using Facts = std::map<std::string, std::string>;

  /// Throws std::invalid_argument unless there are 1 to 20,000 entries, all with angles on the sphere and finite
  /// values >= 0, and spread out enough for the map.
  explicit ResponseTable(std::vector<ResponseEntry> entries, Facts facts = {});

  /// From a CSV file: `# key: value` lines, a header, one row per entry. Throws std::runtime_error with file, line and
  /// reason.
  static ResponseTable load(const std::filesystem::path& file);
  /// Throws std::runtime_error if the file cannot be written. What `load` reads back is the same table bit for bit.
  void save(const std::filesystem::path& file) const;

  /// Place of the entry nearest to a direction; any length but zero, all components finite.
  [[nodiscard]] std::size_t nearest(const Eigen::Vector3d& u_D) const {
    const MapCell& cell = map_[map_index(u_D)];
    return cell.candidates == 1 ? cell.first : nearest_of(cell, u_D);
  }
  [[nodiscard]] double single(const Eigen::Vector3d& u_D) const { return single_[nearest(u_D)]; }
  [[nodiscard]] double pair(const Eigen::Vector3d& u_D) const { return pair_[nearest(u_D)]; }

  [[nodiscard]] const std::vector<ResponseEntry>& entries() const { return entries_; }
  [[nodiscard]] const Facts& facts() const { return facts_; }

 private:
  static constexpr int kMapEdge = 256;  ///< cells along each edge of the unfolded octahedron

  /// Cell of the map: the direction is projected on the octahedron |x| + |y| + |z| = 1, its lower half folded out.
  static std::size_t map_index(const Eigen::Vector3d& u_D) {
    const double scale = 1.0 / (std::abs(u_D.x()) + std::abs(u_D.y()) + std::abs(u_D.z()));
    double a = u_D.x() * scale, b = u_D.y() * scale;
    if (u_D.z() < 0.0) {
      const double folded = std::copysign(1.0 - std::abs(b), a);
      b = std::copysign(1.0 - std::abs(a), b);
      a = folded;
    }
    const auto cell = [](double x) {
      const int i = static_cast<int>((x + 1.0) * (0.5 * kMapEdge));
      return i < kMapEdge ? i : kMapEdge - 1;
    };
    return static_cast<std::size_t>(cell(b) * kMapEdge + cell(a));
  }

  /// Entries that may be nearest to a direction in a cell of the map: the only one, or a stretch of candidates_.
  struct MapCell {
    std::uint32_t first = 0;
    std::uint32_t candidates = 0;
  };
  struct Candidate {
    Eigen::Vector3d u_D;
    std::size_t entry = 0;
  };
  [[nodiscard]] std::size_t nearest_of(const MapCell& cell, const Eigen::Vector3d& u_D) const {
    const Candidate* best = &candidates_[cell.first];
    double best_cosine = best->u_D.dot(u_D);
    for (const Candidate* other = best + 1; other != &candidates_[cell.first] + cell.candidates; ++other) {
      const double cosine = other->u_D.dot(u_D);
      best = cosine > best_cosine ? other : best;
      best_cosine = cosine > best_cosine ? cosine : best_cosine;
    }
    return best->entry;
  }
  void fill_map(const std::vector<Eigen::Vector3d>& directions_D);
  [[nodiscard]] MapCell make_cell(const std::vector<std::uint32_t>& nearest,
                                  const std::vector<Eigen::Vector3d>& directions_D);

  std::vector<ResponseEntry> entries_;
  Facts facts_;
  std::vector<double> single_, pair_;
  std::vector<MapCell> map_;
  std::vector<Candidate> candidates_;
};

/// Mean of `single` over all directions.
[[nodiscard]] double mean_single(const ResponseTable& table);

}  // namespace comptonaut
