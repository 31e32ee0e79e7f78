// SPDX-License-Identifier: MIT
// What a collision engine does for EngineCollision: the narrow phase, one pair of geometries at a time.
#pragma once

#include <memory>
#include <vector>

#include "collision_object.hpp"
#include "muro/connector.hpp"

namespace muro::contact_geometry {

/// One point in which an engine has found two geometries to overlap.
struct EngineContact {
  Vec3 point;                  ///< m, world: on either surface or between them
  Vec3 normal;                 ///< unit, world: from the second geometry to the first
  double depth = 0;            ///< m, along the normal
  std::int64_t triangle = -1;  ///< of the second geometry, when that is an exact mesh; -1: the engine does not tell
  bool rough = false;          ///< the normal separates the geometries, but may be far from the shortest way to do so
};

/// Finds the contacts of pairs. Holds the buffers that an engine needs for that: one thread uses it at a time, and its
/// results do not depend on earlier pairs.
class NarrowPhase {
 public:
  NarrowPhase() = default;
  NarrowPhase(const NarrowPhase&) = delete;
  NarrowPhase& operator=(const NarrowPhase&) = delete;
  virtual ~NarrowPhase() = default;

  /// Adds where the geometries with numbers `a` and `b` overlap at these poses. Only `b` may be a plane or an exact
  /// mesh; of the latter every triangle that is touched is reported, by its number or by a point on it.
  virtual void collide(std::uint32_t a, const Pose& pose_a, std::uint32_t b, const Pose& pose_b,
                       std::vector<EngineContact>& contacts) = 0;
};

class Engine {
 public:
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;

  /// Whether it takes heightmaps as exact meshes. Else their contacts are found in closed form, without the engine.
  virtual bool takes_heightmaps_as_meshes() const { return false; }
  /// Where the engine's messages go. [setup]
  virtual void use_log(Host& host) { static_cast<void>(host); }
  /// The geometry gets the next number, from 0 on; it outlives the engine at the same address. [setup]
  virtual void add(const CollisionGeometry& geometry) = 0;
  /// [any thread]
  virtual std::unique_ptr<NarrowPhase> make_narrow_phase() const = 0;
};

}  // namespace muro::contact_geometry
