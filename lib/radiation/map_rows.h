// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/aligned.h"
#include "radiation/ground_tree.h"
#include "radiation/joint_data.h"
#include "radiation/response_column.h"
#include "radiation/seen_nodes.h"
#include "radiation/sight_lines.h"

namespace comptonaut {

/// How closely a map looks.
struct MapResolution {
  double merge_rad = 0.2;  ///< cells farther away than so many of their edges are merged: edge <= merge_rad distance
  double block_m = 1.0;    ///< edge of the blocks of air whose viewpoints share their counts
};

/// The singles of one drone while it was in one block of air. Counts of viewpoints are added, and so is exactly what is
/// expected of them: a coarser measurement, not a wrong one.
struct SinglesRow {
  int drone = 0;
  double live_s = 0.0;
  double counted = 0.0;
  AlignedVector<float> counts_per_Bq;  ///< per node of the block, padded
};

/// A block of air and the ground as seen from it.
struct MapBlock {
  std::vector<std::uint32_t> nodes;       ///< of the tree, each cell once
  std::vector<float> let_through;         ///< of each node by obstacles; empty: all
  std::vector<SinglesRow> singles;        ///< one per drone that was here
  std::vector<std::uint32_t> pairs;       ///< index into JointData::pairs
  AlignedVector<float> densities_per_Bq;  ///< pairs x padded nodes: t_i, mean over each node
};

/// All rows of some blocks, block by block, singles first.
[[nodiscard]] std::vector<const float*> rows_of(const std::vector<MapBlock>& blocks, bool singles, bool pairs);

/// The system matrix of the joint likelihood over a quadtree of the ground: each block of air sees near cells singly
/// and far ones merged, so that a row's length grows with the logarithm of the area.
class MapRows {
 public:
  /// So far rows may be off: half a degree, twice that where a row came after a turn. Cones are some degrees wide.
  static constexpr double kTurnKept_rad = 0.0087;

  MapRows(const Cells& cells, const MapResolution& resolution);

  /// Takes in what was appended to the data since the last call. Of earlier data only the turns of the detectors may
  /// have changed: rows are kept until a detector is turned by more than kTurnKept_rad, then all are projected anew.
  void extend(const JointPhysics& physics, const JointData& data);

  [[nodiscard]] const GroundTree& tree() const { return tree_; }
  [[nodiscard]] const std::vector<MapBlock>& blocks() const { return blocks_; }
  /// Of each viewpoint taken in: which block, which row of its singles.
  struct Place {
    std::size_t block = 0, row = 0;
    auto operator<=>(const Place&) const = default;
  };
  [[nodiscard]] const std::vector<Place>& viewpoints() const { return viewpoints_; }
  /// Per drone and node, where it was seen as one: sum of Delta_v L exp(-mu d) / d^2 over the node. A cell's
  /// sensitivity is the sum over all nodes that hold it.
  [[nodiscard]] const std::vector<std::vector<NodeField>>& singles_s() const { return singles_s_; }
  [[nodiscard]] const std::vector<std::vector<NodeField>>& pairs_s() const { return pairs_s_; }

 private:
  [[nodiscard]] std::size_t block_at(const Eigen::Vector3d& p_W);
  [[nodiscard]] std::vector<float> let_through(const std::vector<std::uint32_t>& nodes,
                                               const Eigen::Vector3d& eye_W) const;
  [[nodiscard]] Place place_of(const Viewpoints& viewpoints, std::size_t at);
  void add_singles(const JointPhysics& physics, const Viewpoints& viewpoints, const Place& place,
                   std::span<const std::size_t> of);
  void add_pairs(const JointPhysics& physics, const JointData& data, MapBlock& block, std::span<const std::size_t> of);
  void forget_rows();

  MapResolution resolution_;
  const Cells* cells_;
  GroundTree tree_;
  std::shared_ptr<SightLines> sight_;  ///< of the data
  double obstacles_per_m_ = 0.0;
  double node_max_m_ = 0.0;  ///< edge of the largest merged nodes
  std::map<VoxelKey, std::size_t> block_at_;
  std::vector<MapBlock> blocks_;
  std::vector<Place> viewpoints_;
  std::size_t pairs_ = 0;
  std::vector<Eigen::Matrix3d> R_ND_;  ///< per drone: as rows were projected, within kTurnKept_rad
  std::vector<std::vector<NodeField>> singles_s_, pairs_s_;
};

}  // namespace comptonaut
