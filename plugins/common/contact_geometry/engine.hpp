// SPDX-License-Identifier: MIT
// Interface of a collision engine for EngineCollision: the narrow phase, one pair of geometries at a time.
#pragma once

#include <memory>
#include <vector>

#include "collision_object.hpp"
#include "muro/connector.hpp"

namespace muro::contact_geometry {

/// A point in which an engine has found two geometries to overlap.
struct EngineContact {
  Vec3 point;                  ///< m, world: on either surface or between them
  Vec3 normal;                 ///< unit, world: from the second geometry to the first
  double depth = 0;            ///< m, along the normal
  std::int64_t triangle = -1;  ///< of the second geometry, when that is an exact mesh; -1: unknown
  bool rough = false;          ///< the normal separates the geometries, but may be far from the shortest way to do so
};

/// Finds the contacts of pairs. Holds the buffers that an engine needs, so one thread uses it at a time. Its results do
/// not depend on earlier pairs.
class NarrowPhase {
 public:
  NarrowPhase() = default;
  NarrowPhase(const NarrowPhase&) = delete;
  NarrowPhase& operator=(const NarrowPhase&) = delete;
  virtual ~NarrowPhase() = default;

  /// Adds the points in which geometries number `a` and `b` overlap at these poses. Only `b` may be a plane or an exact
  /// mesh. Of an exact mesh every touched triangle is reported, by its number or by a point on it.
  virtual void collide(std::uint32_t a, const Pose& pose_a, std::uint32_t b, const Pose& pose_b,
                       std::vector<EngineContact>& contacts) = 0;
};

class Engine {
 public:
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;

  /// Whether it takes heightmaps as exact meshes. Otherwise their contacts are found in closed form, without the
  /// engine.
  virtual bool takes_heightmaps_as_meshes() const { return false; }
  /// Sends the engine's messages to the log of a host. [setup]
  virtual void use_log(Host& host) { static_cast<void>(host); }
  /// Adds a geometry, which gets the next number, from 0 on. It outlives the engine at the same address. [setup]
  virtual void add(const CollisionGeometry& geometry) = 0;
  /// [any thread]
  virtual std::unique_ptr<NarrowPhase> make_narrow_phase() const = 0;
};

}  // namespace muro::contact_geometry
