// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace comptonaut {

/// Distances between places: place 0 is the start, place i + 1 is point i.
class Distances {
 public:
  Distances(const Eigen::Vector3d& start, std::span<const Eigen::Vector3d> points);
  [[nodiscard]] std::size_t places() const { return n_; }
  [[nodiscard]] double operator()(std::size_t a, std::size_t b) const { return m_[a * n_ + b]; }

 private:
  std::size_t n_;
  std::vector<double> m_;
};

/// A path of places that begins at the start, place 0. Its end is free.
using Path = std::vector<std::size_t>;

[[nodiscard]] double length_m(const Distances& d, const Path& path);

/// Shortens a path by moves around places: turning a stretch round (2-opt) and moving one of up to three places
/// elsewhere, either way round (Or-opt), where that brings a place beside one of its nearest neighbours or makes a new
/// end.
class TourDescent {
 public:
  explicit TourDescent(const Distances& d);

  /// Until no such move around the places in `waiting` or around those that moves touch shortens the path.
  void shorten(Path& path, std::vector<std::size_t> waiting);

 private:
  bool improve(std::size_t place);
  bool turn(std::size_t first, std::size_t last);
  bool move(std::size_t first, std::size_t last, std::size_t after);
  bool move_beside(std::size_t place, std::size_t neighbour);
  [[nodiscard]] double link_m(std::size_t i, std::size_t j) const;
  void changed(std::size_t first, std::size_t last);
  void wait(std::size_t i);

  const Distances& d_;
  std::vector<std::vector<std::size_t>> near_;  ///< of each place, the nearest first
  Path path_;
  std::vector<std::size_t> position_;  ///< of each place in path_
  std::vector<std::size_t> waiting_;
  std::vector<bool> waits_;
};

}  // namespace comptonaut
