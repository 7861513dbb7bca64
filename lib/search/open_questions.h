// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace comptonaut {

/// What a second above one square adds to what is known of each question, without what is next to nothing: most
/// questions are about places far away. In blocks of kLanes questions.
struct View {
  static constexpr std::size_t kLanes = 16;
  std::vector<std::uint32_t> blocks;  ///< their first questions, rising
  std::vector<float> per_s;           ///< kLanes for each of them
};

/// From [question, square].
[[nodiscard]] std::vector<View> views_of(const Eigen::ArrayXXf& per_s);

/// What of each question's weight is open:  weight * exp(-known). Longer than them, to whole blocks.
[[nodiscard]] Eigen::ArrayXf open_weight(const Eigen::ArrayXf& weight, const Eigen::ArrayXf& known);

/// Some looks, and what they add to what is known. The same bits on every processor.
class Looks {
 public:
  /// For what has so many questions, to whole blocks.
  explicit Looks(Eigen::Index questions)
      : known_(static_cast<std::size_t>(questions)), touched_(known_.size() / View::kLanes) {}

  void add(const View& view, double time_s);

  /// Takes from what is open what they answer, and returns it.
  double answer(Eigen::ArrayXf& open) const;

 private:
  std::vector<float> known_;
  std::vector<std::uint8_t> touched_;  ///< blocks
};

}  // namespace comptonaut
