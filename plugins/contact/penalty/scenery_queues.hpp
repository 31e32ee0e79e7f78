// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <new>

#include "scenery_contacts.hpp"

namespace muro::penalty {

/// Input of the kernel for a robot whose contacts are not those of the step before.
struct SceneryContacts::Plan {
  int count = 0;
  std::uint32_t groups = 0;
  KernelContact contacts[max_contacts];
  std::size_t before_count = 0;
  FrictionAnchor before[max_contacts];  ///< anchors of the step before, group by group
  AnchorDetail details[max_contacts];   ///< details of these anchors
};

/// Queues by number of contacts, since the kernel takes as long as the robot with the most of them, and by their
/// groups, since it takes longer if these differ.
struct SceneryContacts::Queues {
  static constexpr std::uint32_t sizes = 8, patterns = 8;  // the last size is for all larger numbers

  std::uint64_t used = 0;  ///< a bit for each of `by_size` that is in use
  Queue by_size[sizes * patterns];
  Queue changed{};
  alignas(Plan) std::byte plans[8][sizeof(Plan)];  ///< of `changed`; most steps need none, so they are not initialised

  Plan& plan(std::uint32_t i) { return *std::launder(reinterpret_cast<Plan*>(plans[i])); }

  /// Returns a queue. `groups`: see KernelRobot. Different groups may share a queue, which only costs time.
  Queue& of(std::uint32_t contacts, std::uint32_t groups) {
    constexpr std::uint32_t golden_ratio = 0x9e3779b1;  // 2^32 times that ratio; spreads bits
    const std::uint32_t i = std::min(contacts - 1, sizes - 1) * patterns + (groups * golden_ratio >> 29);
    if (!(used >> i & 1)) by_size[i].count = 0;
    used |= std::uint64_t(1) << i;
    return by_size[i];
  }
};

}  // namespace muro::penalty
