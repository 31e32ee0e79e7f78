// SPDX-License-Identifier: MIT
// What all collision algorithms have in common: which shapes may touch, in which order, and the lists of contacts.
#pragma once

#include "manifold.hpp"
#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"
#include "overlap_cache.hpp"
#include "transformed_shape.hpp"

namespace muro::contact_geometry {

inline constexpr PropertyUse collision_reads[] = {
    {"scene.index", "shapes and boxes"},
    {"pose", "of all bodies of robots with shapes"},
    {"contact.world", "of all robots: who resolves their contacts"},
};
inline constexpr PropertyUse collision_writes[] = {{"contacts", "list on the base of every robot that forces move"}};

/// A collider at its present pose.
struct TransformedCollider {
  const Collider* collider = nullptr;
  std::uint32_t number = 0;  ///< in SceneIndex::colliders
  TransformedShape shape;    ///< of a mesh: its bounding box
  Aabb bounds;
};

/// What a robot may touch at present. Reused, so that it stops allocating.
struct Candidates {
  struct Other : TransformedCollider {
    bool precedes = false;  ///< its robot has the lower order key, so the pair is computed from its side
    bool has_list = false;  ///< its robot lists the contact too
  };
  Aabb bounds;                           ///< of the robot
  std::vector<TransformedCollider> own;  ///< bodies in the order of the model, shapes in the order of the body
  std::vector<Other> others;             ///< scenery as declared, then robots by order key; bodies side by side
  std::vector<std::uint32_t> robots;     ///< those of `others`
  std::vector<ContactPoint> points;      ///< of one pair
};

/// A contact of two shapes without its point, normal and depth.
Contact contact_between(const Collider& own, const Collider& other);

/// Base of the collision algorithms; they provide the narrow phase.
///
/// Phase 0 updates the broad phase. In phase 1 each robot that needs it gets its list of contacts, sorted by own body,
/// other body, own shape and other shape: with scenery in the order of declaration and with robots in the order of
/// their keys. A pair of robots is computed from the side of the one with the lower key and mirrored for the other, so
/// both lists agree to the bit. Lists depend neither on the order in which robots were declared nor on the number of
/// threads. A contact is listed only where the contact algorithm resolves it (contact_responsibility.hpp), or where
/// somebody else reads the list.
class PairCollision : public Algorithm {
 public:
  void connect(Connector& c) override;
  void start() override;
  std::span<const Phase> phases() const final;
  void step(const Step& step, Range range) final;
  void restored() final { start(); }

 protected:
  struct Robot {
    ListOut<Contact> list;    ///< empty: forces do not move it
    In<std::uint64_t> world;  ///< see keys::contact_world
    std::uint64_t order_key = 0;
    ObjectId base;
    std::int32_t shadow_of = -1;  ///< robot; see keys::shadow_of
    bool has_plane = false;
    bool lists_all = false;  ///< its motion, or what chooses that, reads the list
  };

  /// The shape of a collider at its present pose. [any thread]
  virtual TransformedShape transformed_shape(std::uint32_t collider) const = 0;
  /// Adds the points in which two colliders overlap, whose bounds do; the normals point from `b` to `a`. [any thread]
  virtual void collide(const TransformedCollider& a, const TransformedCollider& b,
                       std::vector<ContactPoint>& points) = 0;
  /// Lists the contacts of all robots of a block that have a list.
  virtual void list_contacts(Range robots);

  /// Whether any robot needs contacts; if none does, the algorithm does nothing and `index_` is not connected.
  bool is_needed() const { return is_needed_; }
  /// What the robot may touch, found for the calling thread; valid until its next call. Empty where nobody needs it.
  Candidates& candidates(std::uint32_t robot);
  /// Replaces the list of the robot by its contacts with these candidates.
  void list_pairs(std::uint32_t robot, Candidates& candidates);
  /// Whether the list has contacts with scenery.
  bool lists_scenery(const Robot& robot) const;

  In<SceneIndex> index_;
  std::vector<Robot> robots_;                 ///< by number
  std::vector<TransformedCollider> scenery_;  ///< by collider
  std::vector<std::uint32_t> planes_;         ///< colliders of the scenery
  bool robots_have_planes_ = false;
  OverlapCache overlaps_;

 private:
  TransformedCollider transformed_collider(std::uint32_t collider) const;
  Aabb ball(std::uint32_t collider) const;
  bool precedes(std::uint32_t a, std::uint32_t b) const;
  bool may_touch(std::uint32_t robot, std::uint32_t other, const Aabb& bounds) const;
  void add_scenery(const OverlapCache::Overlaps& overlaps, Candidates& candidates) const;
  void add_robots(std::uint32_t robot, const OverlapCache::Overlaps& overlaps, Candidates& candidates) const;
  void list_pair(const TransformedCollider& own, const Candidates::Other& other, const ListOut<Contact>& list,
                 std::vector<ContactPoint>& points);

  bool is_needed_ = false;
  std::vector<double> radii_;  ///< by collider, m: of a ball about the origin of its body that holds it
};

}  // namespace muro::contact_geometry
