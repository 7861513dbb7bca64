// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/column_products.h"

#include "core/simd.h"

namespace comptonaut {
namespace {

using Lanes = double __attribute__((vector_size(64), aligned(8), may_alias));
constexpr Eigen::Index kLanes = 8;

[[gnu::always_inline]] inline double sum_of(const Lanes& x) {
  return ((x[0] + x[4]) + (x[1] + x[5])) + ((x[2] + x[6]) + (x[3] + x[7]));
}

/// Of n columns of so many rows.
COMPTONAUT_SIMD_CLONES
void add(const double* columns, Eigen::Index rows, Eigen::Index n, double* sum) {
  for (Eigen::Index j = 0; j < n; j += 2) {
    const double *left = columns + j * rows, *right = left + rows;
    for (Eigen::Index i = j; i < n; i += 2) {
      const double *upper = columns + i * rows, *lower = upper + rows;
      Lanes a{}, b{}, c{}, d{};
      for (Eigen::Index r = 0; r < rows; r += kLanes) {
        const Lanes l = *reinterpret_cast<const Lanes*>(left + r), m = *reinterpret_cast<const Lanes*>(right + r);
        const Lanes u = *reinterpret_cast<const Lanes*>(upper + r), w = *reinterpret_cast<const Lanes*>(lower + r);
        a += u * l;
        b += w * l;
        c += u * m;
        d += w * m;
      }
      sum[j * n + i] += sum_of(a);
      sum[j * n + i + 1] += sum_of(b);
      sum[(j + 1) * n + i] += sum_of(c);
      sum[(j + 1) * n + i + 1] += sum_of(d);
    }
  }
}

}  // namespace

void add_products(const Eigen::MatrixXd& columns, Eigen::MatrixXd& sum) {
  add(columns.data(), columns.rows(), columns.cols(), sum.data());
}

}  // namespace comptonaut
