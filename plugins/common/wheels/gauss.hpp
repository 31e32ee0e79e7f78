// SPDX-License-Identifier: MIT
#pragma once

namespace muro::wheeled {

/// Gauss and Legendre's rule of N points on 0 .. 1, and the integrals from 0 to each point of the polynomial through
/// all: together the collocation method of order 2 N (Hairer, Norsett, Wanner, Solving Ordinary Differential
/// Equations I, II.7).
template <int N>
struct Gauss {
  double at[N];
  double weight[N];
  double until[N][N] = {};  ///< integral from 0 to at[i] of what is y[j] at at[j]: sum of until[i][j] y[j]

  constexpr Gauss(const double (&points)[N], const double (&weights)[N]) {
    for (int i = 0; i < N; ++i) at[i] = points[i], weight[i] = weights[i];
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j)
        for (int k = 0; k < N; ++k) until[i][j] += at[i] * weight[k] * basis(j, at[i] * at[k]);
  }

 private:
  /// The polynomial that is 1 at point j and 0 at all others.
  constexpr double basis(int j, double t) const {
    double product = 1;
    for (int m = 0; m < N; ++m)
      if (m != j) product *= (t - at[m]) / (at[j] - at[m]);
    return product;
  }
};

inline constexpr Gauss<2> gauss_2({0.21132486540518712, 0.78867513459481288}, {0.5, 0.5});
inline constexpr Gauss<5> gauss_5({0.04691007703066800, 0.23076534494715845, 0.5, 0.76923465505284155,
                                   0.95308992296933200},
                                  {0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
                                   0.11846344252809454});

}  // namespace muro::wheeled
