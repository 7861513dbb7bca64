// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/mlem.h"

namespace comptonaut {
namespace {

void multiply(std::span<double> lambda_Bq, std::span<const double> ratio, std::span<const double> sensitivity_s) {
  for (std::size_t j = 0; j < lambda_Bq.size(); ++j) {
    lambda_Bq[j] *= sensitivity_s[j] > 0.0 ? ratio[j] / sensitivity_s[j] : 0.0;
  }
}

}  // namespace

void mlem_step(const SystemRows& rows, std::span<const double> sensitivity_s, std::span<double> lambda_Bq) {
  multiply(lambda_Bq, ratio_back(rows, lambda_Bq), sensitivity_s);
}

std::vector<double> mlem(const SystemRows& rows, std::span<const double> sensitivity_s, int iterations) {
  std::vector<double> lambda(padded(rows.cells()), 1.0);
  multiply(lambda, rows.uniform_ratio(), sensitivity_s);  // the first step, without reading the rows
  for (int i = 1; i < iterations; ++i) mlem_step(rows, sensitivity_s, lambda);
  return lambda;
}

}  // namespace comptonaut
