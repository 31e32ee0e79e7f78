// SPDX-License-Identifier: MIT
// The method that finds distances along rays: the part in which the plugins laser.* differ.
#pragma once

#include "muro/connector.hpp"
#include "rays.hpp"

namespace muro::scanner {

/// Pose and range of a scanner.
struct Viewpoint {
  Pose device;                       ///< in the world
  double max_range = 0;              ///< m
  RobotId ignored_robot = no_robot;  ///< a robot that is not seen
  double min_range = 0;              ///< m, the reading of what is nearer
};

class Method {
 public:
  Method() = default;
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;
  virtual ~Method() = default;

  /// Binds the bodies that are seen, reads the parameters of the method. [setup]
  virtual void connect(Connector& c) = 0;
  /// Receives the sets of rays that will be cast, by number; they do not change afterwards. [setup]
  virtual void prepare(std::span<const RaySet> sets) = 0;
  /// Prepares the first step. All handles may be read. Also called at a reset. [setup]
  virtual void start() {}
  /// Called after a snapshot has replaced the properties. [between steps]
  virtual void restored() {}

  /// Called before the rays of each step. `example`: viewpoint of one of the `scanners` scanners. [step, one thread]
  virtual void begin_step(const Viewpoint& example, std::size_t scanners) {
    static_cast<void>(example);
    static_cast<void>(scanners);
  }
  /// Takes the present poses of all bodies; called before the rays of an instant. [step, one thread]
  virtual void update() = 0;
  /// Finds the distance (m) along each ray of a set to the nearest surface: max_range if no surface is nearer,
  /// min_range for a nearer surface and inside of a solid. If `hits` is not empty, also finds the object of the
  /// surface. A device with a pose that is not finite sees nothing. [step]
  virtual void cast(std::size_t set, const Viewpoint& from, std::span<double> ranges, std::span<ObjectId> hits) = 0;

  /// Whether several threads may call cast at the same time. [setup]
  virtual bool is_parallel() const = 0;
  /// Whether a few rays cost little, so that each ray of a sweep can be cast at its own instant. Otherwise the rays of
  /// one step share an instant. [setup]
  virtual bool is_cheap_for_few_rays() const = 0;
};

}  // namespace muro::scanner
