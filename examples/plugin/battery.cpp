// SPDX-License-Identifier: MIT
// The charge of a robot's battery while it drives: idle power and rolling resistance.
#include <algorithm>

#include "muro/plugin.hpp"
#include "muro/toolkit/per_robot.hpp"

namespace {

using namespace muro;

constexpr Key<double> energy{"battery.energy", "J", "what is left in the battery"};
constexpr Key<double> power{"battery.power", "W", "what the robot draws"};

constexpr double standard_gravity = 9.80665;  // m/s^2

constexpr Parameter parameters[] = {
    real("capacity", "J", 3.6e5, "energy of the full battery").between(0, 1e12),
    real("idle_power", "W", 10, "what electronics and sensors draw at rest").between(0, 1e9),
    real("rolling_resistance", "1", 0.02, "coefficient of rolling resistance of the wheels").between(0, 1),
    real("efficiency", "1", 0.7, "of the drive train: mechanical over electrical power").between(0.01, 1),
};
constexpr PropertyUse reads[] = {{"twist", "of the robot's base"}, {"inertial", "of all bodies: the robot's mass"}};
constexpr PropertyUse writes[] = {{"battery.energy", "what is left"}, {"battery.power", "what the robot draws"}};
constexpr Description description{
    .id = "sensor.battery",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary = "Charge of a battery that pays for electronics and rolling resistance",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

/// Data of one robot.
struct RobotBattery {
  In<Twist> twist;
  Out<double> energy;
  Out<double> power;
  double mass = 0;  ///< kg, mass of the robot
};

class Battery final : public PerRobotAlgorithm<RobotBattery> {
 public:
  /// P = P_idle + c_rr m g |v| / efficiency (rolling resistance on level ground), taken for the period that just ended.
  void step(const Step& step, Range range) override {
    for (const RobotBattery& battery : robots(range)) {
      *battery.power = idle_power_ + drag_per_mass_ * battery.mass * battery.twist->linear.norm();
      if (step.index > 0) *battery.energy = std::max(0.0, *battery.energy - *battery.power * step.dt);
    }
  }

 private:
  void read_parameters(const Parameters& p) override {
    capacity_ = p.real("capacity");
    idle_power_ = p.real("idle_power");
    drag_per_mass_ = p.real("rolling_resistance") * standard_gravity / p.real("efficiency");
  }

  RobotBattery connect_robot(Connector& c, const Item& item) override {
    double mass = 0;
    for (const Link& link : item.robot->links)
      if (const auto inertia = c.constant(link.object, keys::inertial)) mass += inertia->mass;
    if (mass == 0)
      throw Error("robot " + std::string(item.robot->name) + " has no mass; give its links an <inertial> in the model");
    const ObjectId base = item.robot->base();
    return {c.read(base, keys::twist), c.variable(base, energy, capacity_), c.variable(base, power, idle_power_), mass};
  }

  double capacity_ = 0;       ///< J
  double idle_power_ = 0;     ///< W
  double drag_per_mass_ = 0;  ///< m/s^2
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Battery>(description)};

}  // namespace

MURO_PLUGIN(.name = "sensor_battery", .version = description.version, .licence = "MIT", .summary = "A battery",
            .algorithms = algorithms)
