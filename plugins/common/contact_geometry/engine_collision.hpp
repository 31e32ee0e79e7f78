// SPDX-License-Identifier: MIT
#pragma once

#include <deque>

#include "engine.hpp"
#include "muro/algorithm.hpp"
#include "neighbours.hpp"
#include "per_thread.hpp"
#include "plugins/common/mesh/store.hpp"

namespace muro::encounters {

inline constexpr std::string_view mesh_words[] = {"convex", "exact"};
/// What every EngineCollision offers; its plugin's description names them.
inline constexpr Parameter engine_parameters[] = {
    text("meshes", "convex", "whether a mesh collides as its convex hull or, exact, as it is").one_of(mesh_words),
};
inline constexpr PropertyUse engine_reads[] = {{"scene.index", "shapes and boxes"},
                                               {"pose", "of all bodies of robots with shapes"},
                                               {"contact.world", "who answers for contacts of a robot"}};
inline constexpr PropertyUse engine_writes[] = {{"contacts", "list on the base of every robot that forces move"}};

/// Where robots touch, found by an engine: pairs from the spatial index, in an order that does not depend on who was
/// declared first, each worked out by the engine and listed as muro::Contact asks. Of two robots the pair is worked out
/// as the one with the lower key sees it, and mirrored for the other. A pair is listed only where the contact algorithm
/// answers for it (keys::contact_world).
class EngineCollision : public Algorithm {
 public:
  explicit EngineCollision(std::unique_ptr<Engine> engine);
  ~EngineCollision() override;

  void connect(Connector& c) override;
  void start() override;
  std::span<const Phase> phases() const override;
  void step(const Step& step, Range range) override;
  void restored() override { start(); }

 private:
  static constexpr std::uint32_t none = 0xffffffff;
  struct Robot {
    ListOut<Contact> list;  ///< empty: no force moves it
    In<std::uint64_t> world;
    std::uint64_t key = 0;
    std::int32_t shadow_of = -1;  ///< robot; see keys::shadow_of
    bool has_plane = false;
    bool wants_all = false;  ///< its motion, or what chooses that, reads the list
  };
  /// The solids of a shape, by number: as it collides, and what stands in where another mesh is taken as it is.
  struct Solids {
    std::uint32_t usual = none, convex = none;
  };
  struct Near {
    const Collider* collider = nullptr;
    Solids solids;
    Standing at;
    Aabb bounds;
  };
  struct Other : Near {
    bool mirrored = false, has_list = false;
  };
  struct Scratch;

  void add_solids(Connector& c, ObjectId body, const Shape& shape, bool exact);
  std::uint32_t add_solid(const Solid& solid);
  const mesh::Hull* hull_if_any(const std::string& path, const Vec3& scale);
  Near near(std::uint32_t collider) const;
  void touch_robot(std::uint32_t robot, Scratch& scratch);
  void add_scenery(const Neighbours::Of& near, Scratch& scratch) const;
  void add_mates(std::uint32_t robot, const Neighbours::Of& near, Scratch& scratch) const;
  void list_contacts(const ListOut<Contact>& list, Scratch& scratch) const;
  void touch_pair(const Near& own, const Other& other, const ListOut<Contact>& list, Scratch& scratch) const;
  bool precedes(std::uint32_t a, std::uint32_t b) const;

  std::unique_ptr<Engine> engine_;
  PerThread<Scratch> scratch_;  ///< freed before the engine
  In<SceneIndex> index_;
  std::vector<Robot> robots_;  ///< by number
  bool any_list_ = false, robots_have_planes_ = false;

  mesh::Store meshes_;
  std::deque<Terrain> terrains_;
  std::deque<Solid> solids_;
  std::vector<std::pair<Shape, Solids>> known_;            ///< each shape once
  std::vector<std::pair<const Shape*, Solids>> by_shape_;  ///< sorted

  std::vector<Solids> by_collider_;
  std::vector<Near> scenery_;          ///< by collider
  std::vector<std::uint32_t> planes_;  ///< colliders of the scenery
  Neighbours neighbours_;
};

}  // namespace muro::encounters
