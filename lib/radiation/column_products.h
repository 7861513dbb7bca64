// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace comptonaut {

/// sum(i, j) += column i . column j: the half with i >= j, and what shares its squares of two by two. Rows are a
/// multiple of eight, columns an even number. The same bits on every processor.
void add_products(const Eigen::MatrixXd& columns, Eigen::MatrixXd& sum);

}  // namespace comptonaut
