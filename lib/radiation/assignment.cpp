// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/assignment.h"

#include <limits>
#include <stdexcept>

namespace comptonaut {
namespace {

constexpr int kNone = -1;

/// Rows are added one by one. Row and column potentials keep every reduced cost cost - u - v at least zero, and zero
/// on the assignment, which is therefore the cheapest of the rows so far.
struct Assignment {
  const Eigen::MatrixXd& cost;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(cost.rows());
  Eigen::VectorXd v = Eigen::VectorXd::Zero(cost.cols());
  std::vector<int> row_of = std::vector<int>(static_cast<std::size_t>(cost.cols()), kNone);

  /// Shortest path by reduced costs from a new row to a free column; each step goes from a row to a column and back
  /// along the assignment to that column's row.
  void add_row(int new_row) {
    const auto columns = static_cast<std::size_t>(cost.cols());
    std::vector<double> distance(columns, std::numeric_limits<double>::infinity());
    std::vector<int> came_from(columns, kNone);
    std::vector<bool> done(columns, false);
    std::vector<int> visited;
    int row = new_row, at = kNone;
    double so_far = 0.0;
    do {
      int next = kNone;
      for (int j = 0; j < static_cast<int>(columns); ++j) {
        if (done[j]) continue;
        const double via = so_far + cost(row, j) - u(row) - v(j);
        if (via < distance[j]) {
          distance[j] = via;
          came_from[j] = at;
        }
        if (next == kNone || distance[j] < distance[next]) next = j;
      }
      at = next;
      so_far = distance[at];
      done[at] = true;
      visited.push_back(at);
      row = row_of[at];
    } while (row != kNone);
    u(new_row) += so_far;
    for (const int j : visited) {
      if (row_of[j] != kNone) u(row_of[j]) += so_far - distance[j];
      v(j) -= so_far - distance[j];
    }
    for (; came_from[at] != kNone; at = came_from[at]) row_of[at] = row_of[came_from[at]];
    row_of[at] = new_row;
  }
};

}  // namespace

std::vector<int> assign_rows(const Eigen::MatrixXd& cost) {
  if (cost.cols() < cost.rows() || !cost.allFinite()) {
    throw std::invalid_argument("an assignment needs a column for each row and finite costs");
  }
  Assignment assignment{.cost = cost};
  for (int i = 0; i < static_cast<int>(cost.rows()); ++i) assignment.add_row(i);
  std::vector<int> column_of(static_cast<std::size_t>(cost.rows()), kNone);
  for (int j = 0; j < static_cast<int>(cost.cols()); ++j) {
    if (assignment.row_of[j] != kNone) column_of[assignment.row_of[j]] = j;
  }
  return column_of;
}

}  // namespace comptonaut
