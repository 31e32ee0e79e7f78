// SPDX-License-Identifier: MIT
// The friction anchors of contact points: the only state of contacts.
#pragma once

#include <cstdint>
#include <span>

#include "muro/handles.hpp"
#include "muro/key.hpp"
#include "plugins/common/contact_geometry/kept_contact.hpp"

namespace muro::penalty {

/// The tangential displacement of a friction spring. It is found again by the pair and point of its contact
/// (kept_contact.hpp).
struct FrictionAnchor {
  std::uint64_t pair = 0;
  Vec3 point = Vec3::Zero();         ///< m, world
  Vec3 displacement = Vec3::Zero();  ///< m, world: tangential
};
/// Further data, which only few anchors have.
struct AnchorDetail {
  double overlap = 0;       ///< m, see overlap.hpp
  Vec3 way = Vec3::Zero();  ///< m, world: way of the point in the last step, if it moves over a single body
};

using contact_geometry::pair_of, contact_geometry::previous;

}  // namespace muro::penalty

namespace muro {
MURO_OPAQUE_TYPE(penalty::FrictionAnchor, "muro.contact.penalty.FrictionAnchor", opaque);
MURO_OPAQUE_TYPE(penalty::AnchorDetail, "muro.contact.penalty.AnchorDetail", opaque);
}  // namespace muro

namespace muro::penalty {
inline constexpr Key<FrictionAnchor> anchors{"contact.friction_anchors", "m",
                                             "list on the base of a robot: friction anchors"};
inline constexpr Key<AnchorDetail> anchor_details{
    "contact.friction_anchor_details", "m",
    "list on the base of a robot: of each friction anchor; empty where all are 0"};
inline constexpr Key<std::int64_t> last_run{"contact.time", "ns",
                                            "on the world object: when contact ran last; -1: never"};

/// The anchors of a robot. Details are stored apart, because most anchors have none, and steps of most robots do not
/// touch them.
class Anchors {
 public:
  Anchors() = default;
  Anchors(ListOut<FrictionAnchor> list, ListOut<AnchorDetail> details) : list_(list), details_(details) {}

  std::span<FrictionAnchor> operator*() const { return *list_; }
  /// Returns one for each anchor, or none if all are 0.
  std::span<AnchorDetail> details() const { return *details_; }
  /// Returns the detail of an anchor of the list.
  AnchorDetail detail_of(const FrictionAnchor& anchor) const {
    const auto all = *details_;
    return all.empty() ? AnchorDetail{} : all[std::size_t(&anchor - (*list_).data())];
  }
  void clear() const {
    list_.clear();
    if (!(*details_).empty()) details_.clear();
  }
  void push_back(const FrictionAnchor& anchor, const AnchorDetail& detail = {}) const {
    const bool has_detail = detail.overlap != 0 || !detail.way.isZero(0);
    if (has_detail) add_details();
    list_.push_back(anchor);
    if (has_detail || !(*details_).empty()) details_.push_back(detail);
  }
  /// Gives each anchor its details.
  void add_details() const {
    while ((*details_).size() < (*list_).size()) details_.push_back({});
  }

 private:
  ListOut<FrictionAnchor> list_;
  ListOut<AnchorDetail> details_;
};

}  // namespace muro::penalty
