// SPDX-License-Identifier: MIT
// The part of a motion by a multi-body engine that does not depend on the engine: an external algorithm that imports
// properties, lets its world advance, and exports (MuRoSimF, Section 3.2).
#pragma once

#include <deque>

#include "muro/description.hpp"
#include "world.hpp"

namespace muro::multibody {

class Motion : public Algorithm {
 public:
  void connect(Connector& c) final;
  void start() final;
  void restored() final { start(); }
  void on_handover(std::uint32_t item) final;
  void step(const Step& step, Range range) final;

 protected:
  /// What the plugin says of itself.
  virtual const Description& description() const = 0;
  /// What the engine needs of inertias.
  virtual InertiaFloor inertia_floor() const = 0;
  /// How many numbers of its own the engine keeps of a robot from step to step.
  virtual std::size_t memory_of(const RobotModel& model) const = 0;
  /// Throws Error for a robot that the engine cannot simulate. [setup]
  virtual void check(const RobotModel& model) const { static_cast<void>(model); }
  /// Reads the engine's own parameters. [setup]
  virtual void configure(Connector& c) = 0;
  /// An empty world.
  virtual std::unique_ptr<World> make_world() const = 0;

  Vec3 gravity() const { return gravity_; }

 private:
  /// Of a body of the model: what acts on it from outside, and what contacts of the own world do.
  struct Touched {
    SumIn<Wrench> external;
    Out<Wrench> contact;
  };
  struct Joint {
    Out<double> position, velocity, effort;
    In<double> target;
  };
  struct Robot {
    RobotModel model;
    RobotState state;
    std::uint32_t level = 0;
    In<std::uint32_t> active_level;
    Out<std::uint64_t> contact_world;
    Out<double> twist_lag;
    Out<Pose> pose;
    Out<Twist> twist;
    std::vector<Joint> joints;  ///< one a part
    std::vector<Touched> touched;
    std::span<double> last;  ///< state: what the last step left, and whether it did; see forget()
    std::vector<PartMotion> parts;
  };
  struct Other {
    Fixture fixture;
    FixtureState state;
    In<Pose> pose;
    In<Twist> twist;
    In<std::uint64_t> contact_world;
  };

  void check_parameters(const Connector& c) const;
  void connect_robot(Connector& c, const Item& item, const Parameters& p);
  void connect_joints(Connector& c, const RobotView& view, Robot& r) const;
  void connect_touched(Connector& c, const RobotView& view, Robot& r) const;
  void connect_others(Connector& c);
  void import(Robot& r) const;
  static void import(Other& o);
  void set_demands(Robot& r, double dt) const;
  static void remember(Robot& r);
  void export_robot(Robot& r) const;
  static void clear_outputs(const Robot& r);
  static void import_wrenches(Robot& r);
  static void export_contacts(Robot& r);

  Vec3 gravity_ = Vec3::Zero();
  std::uint64_t number_ = 0;  ///< of the world, see keys::contact_world
  double position_gain_ = 0;
  int substeps_ = 1;
  std::deque<Robot> robots_;
  std::vector<Fixture> scenery_;
  std::deque<Other> others_;
  std::unique_ptr<World> world_;
};

}  // namespace muro::multibody
