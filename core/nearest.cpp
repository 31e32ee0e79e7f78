// SPDX-License-Identifier: MIT
#include "core/nearest.hpp"

#include <algorithm>
#include <vector>

namespace muro {

namespace {

/// Optimal string alignment distance.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

}  // namespace

std::string nearest(std::string_view wrong, std::span<const std::string> candidates) {
  std::string best;
  std::size_t least = wrong.size() / 3 + 2;  // farther away is no help
  for (const std::string& c : candidates) {
    const bool part = wrong.size() >= 3 && c.find(wrong) != std::string::npos;
    const std::size_t d = part ? 1 : distance(wrong, c);
    if (d < least) {
      least = d;
      best = c;
    }
  }
  return best;
}

std::string suggestion(std::string_view wrong, std::span<const std::string> candidates) {
  const std::string best = nearest(wrong, candidates);
  return best.empty() ? "" : " (did you mean `" + best + "`?)";
}

}  // namespace muro
