// SPDX-License-Identifier: MIT
// A plugin to start from: a speedometer whose needle follows the true speed with a lag.
#include <vector>

#include "muro/base/elementary.hpp"
#include "muro/plugin.hpp"

namespace {

using namespace muro;

// A property that this plugin defines. Others bind it by the same name, unit and type.
constexpr Key<double> speed{"speedometer.speed", "m/s", "what the needle shows"};

// Settings for the user, and the description of the algorithm. All of it is constant and costs nothing at run time.
constexpr Parameter parameters[] = {
    real("time_constant", "s", 0.2, "after a jump of the speed, the needle has gone 63 % of the way")
        .between(1e-6, 1e3),
};
constexpr PropertyUse reads[] = {{"twist", "of the object it is mounted on"}};
constexpr PropertyUse writes[] = {{"speedometer.speed", "what the needle shows"}};
constexpr Description description{
    .id = "sensor.speedometer",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary = "Linear speed of a body, smoothed by a first-order lag",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

class Speedometer final : public Algorithm {
 public:
  // Runs once: reads the parameters and binds every property of every item. (When each item is a whole robot, the base
  // PerRobotAlgorithm of muro/toolkit/per_robot.hpp has this loop; examples/plugin uses it.)
  void connect(Connector& c) override {
    time_constant_ = c.parameters().real("time_constant");
    for (const Item& item : c.items())
      needles_.push_back({c.read(item.object, keys::twist), c.variable(item.object, speed, 0.0)});
  }

  // Runs many times: serves the items of the range, each only from its own properties.
  //
  // The lag dy/dt = (v - y) / T, solved exactly for the constant v of one period:
  // y(t + dt) = v + (y(t) - v) exp(-dt / T). The first run only sees the start.
  void step(const Step& step, Range range) override {
    if (step.index == 0) return;
    const double decay = elementary::exp(-step.dt / time_constant_);
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const Needle& needle = needles_[i];
      const double v = needle.twist->linear.norm();
      *needle.speed = v + (*needle.speed - v) * decay;
    }
  }

 private:
  // Handles and parameters. The state, which is the speed that the needle shows, is a property: so it is saved,
  // restored and recorded.
  struct Needle {
    In<Twist> twist;
    Out<double> speed;
  };
  std::vector<Needle> needles_;
  double time_constant_ = 0;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Speedometer>(description)};

}  // namespace

MURO_PLUGIN(.name = "sensor_speedometer", .version = description.version, .licence = "MIT", .summary = "A speedometer",
            .algorithms = algorithms)
