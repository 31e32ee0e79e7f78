// SPDX-License-Identifier: MIT
#pragma once

#include "terrain_contacts.hpp"

namespace muro::terrain_contact {

/// Collects contacts in the frame of the heightmap. Contacts in one place are kept once.
class ContactCollector {
 public:
  /// Omits contacts with a larger gap than `margin` (m). `size` (m): of the shape.
  ContactCollector(double margin, double size) : margin_(margin), size_(size), same_place_(1e-4 * size) {}

  double margin() const { return margin_; }
  int count() const { return count_; }
  /// `point` (m): on the surface of the shape.
  void add_on_shape(const Vec3& point, const Vec3& normal, double gap) { add(point - 0.5 * gap * normal, normal, gap); }
  /// `point` (m): on the surface of the heightmap.
  void add_on_terrain(const Vec3& point, const Vec3& normal, double gap) {
    add(point + 0.5 * gap * normal, normal, gap);
  }
  /// Writes the contacts in the world. If there are too many: the deepest, then repeatedly the farthest from those
  /// chosen.
  int take(const Pose& map_pose, TerrainContacts& out);

 private:
  static constexpr int most = 96;
  void add(const Vec3& position, const Vec3& normal, double gap);

  double margin_, size_, same_place_;
  int count_ = 0;
  std::array<TerrainContact, most> found_;
};

}  // namespace muro::terrain_contact
