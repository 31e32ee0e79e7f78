// SPDX-License-Identifier: MIT
#include "contact_collector.hpp"

#include <algorithm>
#include <limits>

namespace muro::terrain_contact {

namespace {

constexpr double same_direction = 0.999;  ///< cosine

bool is_deeper(const TerrainContact& a, const TerrainContact& b) { return a.gap < b.gap; }

}  // namespace

void ContactCollector::add(const Vec3& position, const Vec3& normal, double gap) {
  if (gap > margin_) return;
  const TerrainContact contact{position, normal, gap};
  const auto end = found_.begin() + count_;
  const auto same = std::find_if(found_.begin(), end, [&](const TerrainContact& c) {
    return (c.position - position).squaredNorm() < same_place_ * same_place_ && c.normal.dot(normal) > same_direction;
  });
  if (same != end) {
    if (is_deeper(contact, *same)) *same = contact;
  } else if (count_ < most) {
    found_[std::size_t(count_++)] = contact;
  } else if (const auto shallowest = std::max_element(found_.begin(), found_.end(), is_deeper);
             is_deeper(contact, *shallowest)) {
    *shallowest = contact;
  }
}

int ContactCollector::take(const Pose& map_pose, TerrainContacts& out) {
  const auto first = found_.begin(), end = first + count_;
  const int kept = std::min(count_, max_contacts);
  if (count_ > max_contacts) {
    std::iter_swap(first, std::min_element(first, end, is_deeper));
    const auto distance = [&](const TerrainContact& a, const TerrainContact& b) {
      return (a.position - b.position).squaredNorm() / (size_ * size_) + (a.normal - b.normal).squaredNorm();
    };
    for (int k = 1; k < kept; ++k) {
      const auto rest = first + k;
      const auto from_chosen = [&](const TerrainContact& c) {
        double nearest = std::numeric_limits<double>::infinity();
        for (auto chosen = first; chosen != rest; ++chosen) nearest = std::min(nearest, distance(c, *chosen));
        return c.gap < 0 ? nearest : 0.1 * nearest;
      };
      std::iter_swap(rest, std::max_element(rest, end, [&](const TerrainContact& a, const TerrainContact& b) {
                       return from_chosen(a) < from_chosen(b);
                     }));
    }
  }
  for (int k = 0; k < kept; ++k) {
    const TerrainContact& c = found_[std::size_t(k)];
    out[std::size_t(k)] = {map_pose * c.position, map_pose.orientation * c.normal, c.gap};
  }
  return kept;
}

}  // namespace muro::terrain_contact
