// SPDX-License-Identifier: MIT
// How distances along rays are found: what plugins laser.* differ in.
#pragma once

#include "muro/connector.hpp"
#include "rays.hpp"

namespace muro::scanner {

/// From where and how far a scanner looks.
struct View {
  Pose device;                      ///< in the world
  double max_range = 0;             ///< m
  std::int32_t ignored_robot = -1;  ///< the number of a robot that is not seen; -1: none
  double min_range = 0;             ///< m, what is nearer reads this
};

class Method {
 public:
  Method() = default;
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;
  virtual ~Method() = default;

  /// Binds what of the world is seen; reads the method's own parameters. [setup]
  virtual void connect(Connector& c) = 0;
  /// The sets of rays that are asked for from now on, by number; they stay as they are. [setup]
  virtual void prepare(std::span<const RaySet> sets) = 0;
  /// All handles may be read. Also called at a reset. [setup]
  virtual void start() {}
  /// A snapshot has replaced the properties. [between steps]
  virtual void restored() {}

  /// Before the rays of each step: where one of so many scanners looks from. [step, one thread]
  virtual void begin(const View& example, std::size_t scanners) {
    static_cast<void>(example);
    static_cast<void>(scanners);
  }
  /// Takes over where everything is now; called before the rays of an instant. [step, one thread]
  virtual void look() = 0;
  /// The distance (m) along each ray of a set to the nearest surface: max_range where there is none nearer, min_range
  /// for what is nearer than that and inside of a solid; and, when `hits` is not empty, the object that the surface
  /// belongs to. A device whose pose is not finite sees nothing. [step]
  virtual void cast(std::size_t set, const View& view, std::span<double> ranges, std::span<ObjectId> hits) = 0;

  /// Whether several threads may cast at once. [setup]
  virtual bool is_parallel() const = 0;
  /// Whether a few rays cost little, so that every ray of a scan that takes its time can have an instant of its own; if
  /// not, those of one step share one. [setup]
  virtual bool is_cheap_for_few() const = 0;
};

}  // namespace muro::scanner
