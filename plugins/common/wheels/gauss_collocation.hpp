// SPDX-License-Identifier: MIT
#pragma once

namespace muro::wheels {

/// Gauss's collocation method with N points on 0 .. 1, of order 2 N, as a Butcher tableau (Hairer, Norsett, Wanner,
/// Solving Ordinary Differential Equations I, II.7).
template <int N>
struct GaussCollocation {
  double node[N];
  double weight[N];
  double matrix[N][N] = {};  ///< integral from 0 to node[i] of what is y[j] at node[j]: sum of matrix[i][j] y[j]

  constexpr GaussCollocation(const double (&nodes)[N], const double (&weights)[N]) {
    for (int i = 0; i < N; ++i) node[i] = nodes[i], weight[i] = weights[i];
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j)
        for (int k = 0; k < N; ++k) matrix[i][j] += node[i] * weight[k] * lagrange(j, node[i] * node[k]);
  }

 private:
  /// Returns Lagrange's polynomial that is 1 at node j and 0 at all other nodes.
  constexpr double lagrange(int j, double t) const {
    double product = 1;
    for (int m = 0; m < N; ++m)
      if (m != j) product *= (t - node[m]) / (node[j] - node[m]);
    return product;
  }
};

inline constexpr GaussCollocation<2> gauss_2({0.21132486540518712, 0.78867513459481288}, {0.5, 0.5});
inline constexpr GaussCollocation<5> gauss_5({0.04691007703066800, 0.23076534494715845, 0.5, 0.76923465505284155,
                                              0.95308992296933200},
                                             {0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                              0.23931433524968324, 0.11846344252809454});

}  // namespace muro::wheels
