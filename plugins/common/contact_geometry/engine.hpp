// SPDX-License-Identifier: MIT
// What a collision engine does for EngineCollision: pairs of solids, one at a time.
#pragma once

#include <memory>
#include <vector>

#include "solid.hpp"

namespace muro::encounters {

/// One point in which an engine has found two solids to overlap.
struct Touch {
  Vec3 point;                  ///< m, world: on either surface or between them
  Vec3 normal;                 ///< unit, world: from the second solid to the first
  double depth = 0;            ///< m, along the normal
  std::int64_t triangle = -1;  ///< of the second solid, when that is a mesh taken as it is
  bool rough = false;          ///< the normal is one that parts the solids, but may be far from the shortest way
};

/// Works out pairs. Holds what an engine needs for that beside the solids: one thread uses it at a time, and nothing
/// is left in it that has a say in the next pair.
class Narrowphase {
 public:
  Narrowphase() = default;
  Narrowphase(const Narrowphase&) = delete;
  Narrowphase& operator=(const Narrowphase&) = delete;
  virtual ~Narrowphase() = default;

  /// Adds where solids `a` and `b` (numbers) overlap, their frames standing at these poses. `b` alone may be a plane or
  /// a mesh taken as it is, of which every triangle that is touched is named; where an engine does not tell, it
  /// is looked for at the point.
  virtual void touch(std::uint32_t a, const Pose& at_a, std::uint32_t b, const Pose& at_b,
                     std::vector<Touch>& touches) = 0;
};

class Engine {
 public:
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;

  /// Solid number 0, 1, ...; it stays where it is. [setup]
  virtual void add(const Solid& solid) = 0;
  /// [any thread]
  virtual std::unique_ptr<Narrowphase> narrowphase() const = 0;
};

}  // namespace muro::encounters
