// SPDX-License-Identifier: MIT
// Suggestions of similar names, for error messages.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace muro {

/// Number of characters that must be added, left out, exchanged or swapped with a neighbour to get from `a` to `b`
/// (optimal string alignment).
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> d((a.size() + 1) * width);
  const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& { return d[i * width + j]; };
  for (std::size_t i = 0; i <= a.size(); ++i) at(i, 0) = i;
  for (std::size_t j = 0; j <= b.size(); ++j) at(0, j) = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t exchange = at(i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0 : 1);
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, exchange});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  return at(a.size(), b.size());
}

/// Longer words are not misspelled names, and take long to compare.
inline constexpr std::size_t longest_misspelling = 100;

/// Returns at most `most` candidates similar to `wrong`, the nearest first; those that contain it come before.
inline std::vector<std::string> nearest_names(std::string_view wrong, std::span<const std::string> candidates,
                                              std::size_t most) {
  std::vector<std::pair<std::size_t, std::string>> found;
  if (wrong.size() > longest_misspelling) return {};
  const std::size_t too_far = wrong.size() / 3 + 2;  // a more distant name is no help
  for (const std::string& c : candidates) {
    const bool contains = wrong.size() >= 3 && c.find(wrong) != std::string::npos;
    const std::size_t longer = std::max(c.size(), wrong.size()) - std::min(c.size(), wrong.size());
    if (!contains && longer >= too_far) continue;
    const std::size_t distance = contains ? 0 : edit_distance(wrong, c);
    if (distance < too_far) found.emplace_back(distance, c);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(most, found.size()); ++i) names.push_back(found[i].second);
  return names;
}

/// " (did you mean `x`?)", or "" when no candidate is near.
inline std::string did_you_mean(std::string_view wrong, std::span<const std::string> candidates) {
  const std::vector<std::string> names = nearest_names(wrong, candidates, 1);
  return names.empty() ? "" : " (did you mean `" + names.front() + "`?)";
}

}  // namespace muro
