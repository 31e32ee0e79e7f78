// SPDX-License-Identifier: MIT
#include "mimic_groups.hpp"

#include <algorithm>
#include <numeric>

namespace muro::articulated {

namespace {

/// Bodies behind two joints, below the body from which both joints hang.
struct Way {
  int anchor = 0;
  std::vector<int> bodies;  ///< sorted, in rising order
};

/// Returns the way between the joints of two bodies.
Way way_between(const std::vector<Body>& bodies, int a, int b) {
  const auto parent = [&](int i) { return bodies[std::size_t(i)].parent; };
  Way way;
  int of_a = parent(a), of_b = parent(b);
  while (of_a != of_b) (of_a > of_b ? of_a : of_b) = parent(std::max(of_a, of_b));
  way.anchor = of_a;
  for (const int end : {a, b})
    for (int i = end; i != way.anchor; i = parent(i)) way.bodies.push_back(i);
  std::sort(way.bodies.begin(), way.bodies.end());
  way.bodies.erase(std::unique(way.bodies.begin(), way.bodies.end()), way.bodies.end());
  return way;
}

bool share_bodies(const Way& a, const Way& b) {
  return std::any_of(a.bodies.begin(), a.bodies.end(),
                     [&](int i) { return std::binary_search(b.bodies.begin(), b.bodies.end(), i); });
}

/// Returns the way that has the bodies of both. The anchor of one lies above that of the other.
Way joined(const Way& a, const Way& b) {
  Way way{std::min(a.anchor, b.anchor), {}};
  std::set_union(a.bodies.begin(), a.bodies.end(), b.bodies.begin(), b.bodies.end(), std::back_inserter(way.bodies));
  return way;
}

/// A group during its construction.
struct Group {
  Way way;
  std::vector<int> followers;
};

/// Adds a group, joined with those of `groups` that share bodies with it.
void take_in(std::vector<Group>& groups, Group group) {
  for (;;) {
    const auto other =
        std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return share_bodies(g.way, group.way); });
    if (other == groups.end()) break;
    group.way = joined(group.way, other->way);
    group.followers.insert(group.followers.end(), other->followers.begin(), other->followers.end());
    groups.erase(other);
  }
  groups.push_back(std::move(group));
}

}  // namespace

MimicGroups mimic_groups_of(const std::vector<Body>& bodies, const std::vector<Joint>& joints) {
  std::vector<Group> groups;
  for (std::size_t k = 1; k < joints.size(); ++k)
    if (joints[k].leader >= 0) take_in(groups, {way_between(bodies, int(k), joints[k].leader), {int(k)}});
  std::sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
    return a.way.anchor != b.way.anchor ? a.way.anchor > b.way.anchor : a.way.bodies < b.way.bodies;
  });
  MimicGroups all;
  for (Group& group : groups) {
    std::sort(group.followers.begin(), group.followers.end());
    const std::vector<int>& of_group = group.way.bodies;
    all.numbers = std::max(all.numbers, (int(group.followers.size()) + 1) * int(of_group.size()));
    all.groups.push_back({group.way.anchor, int(all.ways.size()), int(group.followers.size()), int(all.bodies.size()),
                          int(of_group.size())});
    all.bodies.insert(all.bodies.end(), of_group.begin(), of_group.end());
    for (const int k : group.followers) {
      // bodies on the way up to the anchor of the group
      const int leader = joints[std::size_t(k)].leader, first = int(all.places.size());
      for (int i = int(of_group.size()); i-- > 0;) {
        const auto is_above = [&](int end) {
          while (end > of_group[std::size_t(i)]) end = bodies[std::size_t(end)].parent;
          return end == of_group[std::size_t(i)];
        };
        if (is_above(k) || is_above(leader)) all.places.push_back(i);
      }
      all.ways.push_back({k, first, int(all.places.size()) - first});
    }
  }
  return all;
}

}  // namespace muro::articulated
