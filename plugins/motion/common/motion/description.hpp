// SPDX-License-Identifier: MIT
// Lists that descriptions of motions share.
#pragma once

#include <array>

#include "muro/toolkit/accelerations.hpp"

namespace muro {

namespace detail {
template <class List>
inline constexpr std::size_t length_of = std::tuple_size_v<List>;
template <class T, std::size_t n>
inline constexpr std::size_t length_of<T[n]> = n;
}  // namespace detail

/// Joins lists of parameters, or of uses of properties, in this order.
template <class First, class... Lists>
constexpr auto joined(const First& first, const Lists&... lists) {
  using T = std::remove_cvref_t<decltype(first[0])>;
  std::array<T, (detail::length_of<First> + ... + detail::length_of<Lists>)> all{};
  std::size_t count = 0;
  const auto add = [&](const auto& list) {
    for (const T& one : list) all[count++] = one;
  };
  add(first), (add(lists), ...);
  return all;
}

/// Properties that every motion writes.
inline constexpr PropertyUse motion_writes[] = {{"pose", "of the base"},
                                                {"twist", "of the base"},
                                                {"joint.position", "of every joint"},
                                                {"joint.velocity", "of every joint"},
                                                writes_acceleration,
                                                writes_joint_acceleration};
/// State at the start.
inline constexpr PropertyUse reads_start[] = {
    {"pose.initial", "of the base"}, {"twist.initial", "of the base"}, {"joint.position.initial", "of every joint"}};

}  // namespace muro
