// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace comptonaut {

/// A column of its own for each row, so that the sum of the costs is least [Kuhn 1955, Munkres 1957; shortest
/// augmenting paths as Jonker and Volgenant 1987]. Needs as many columns as rows or more, and finite costs.
[[nodiscard]] std::vector<int> assign_rows(const Eigen::MatrixXd& cost);

}  // namespace comptonaut
