// SPDX-License-Identifier: MIT
// How distances along rays are found: the part in which the plugins laser.* differ.
#pragma once

#include "muro/connector.hpp"
#include "rays.hpp"

namespace muro::scanner {

/// From where a scanner looks, and how far.
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

  /// Binds the bodies that are seen; reads the parameters of the method. [setup]
  virtual void connect(Connector& c) = 0;
  /// The sets of rays that will be cast, by number; they do not change afterwards. [setup]
  virtual void prepare(std::span<const RaySet> sets) = 0;
  /// All handles may be read. Also called at a reset. [setup]
  virtual void start() {}
  /// A snapshot has replaced the properties. [between steps]
  virtual void restored() {}

  /// Called before the rays of each step, with the viewpoint of one of the scanners and their count. [step, one thread]
  virtual void begin_step(const Viewpoint& example, std::size_t scanners) {
    static_cast<void>(example);
    static_cast<void>(scanners);
  }
  /// Takes the present poses of all bodies; called before the rays of an instant. [step, one thread]
  virtual void update() = 0;
  /// The distance (m) along each ray of a set to the nearest surface: max_range where there is none nearer, min_range
  /// for a nearer surface and inside of a solid; and, when `hits` is not empty, the object that the surface belongs to.
  /// A device whose pose is not finite sees nothing. [step]
  virtual void cast(std::size_t set, const Viewpoint& from, std::span<double> ranges, std::span<ObjectId> hits) = 0;

  /// Whether several threads may call cast at the same time. [setup]
  virtual bool is_parallel() const = 0;
  /// Whether a few rays cost little, so that each ray of a sweep can be cast at an instant of its own; if not, the rays
  /// of one step share an instant. [setup]
  virtual bool is_cheap_for_few_rays() const = 0;
};

}  // namespace muro::scanner
