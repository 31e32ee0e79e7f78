// SPDX-License-Identifier: MIT
// Algorithms that fail for one robot of many: for the one whose name ends in 7.
#include "muro/plugin.hpp"
#include "muro/toolkit/per_robot.hpp"

namespace {

using namespace muro;

struct NamedRobot {
  In<Pose> pose;
  bool fails = false;
};

class Base : public PerRobotAlgorithm<NamedRobot> {
 private:
  NamedRobot connect_robot(Connector& c, const Item& item) override {
    return {c.read(item.robot->base(), keys::pose), item.robot->name.ends_with('7')};
  }
};

class Throws final : public Base {
 public:
  void step(const Step& step, Range range) override {
    for (const NamedRobot& r : robots(range))
      if (r.fails && step.index == 3) throw Error("the lens is dirty");
  }
};

class Crashes final : public Base {
 public:
  void step(const Step& step, Range range) override {
    for (const NamedRobot& r : robots(range))
      if (r.fails && step.index == 3) __builtin_trap();
  }
};

class Says final : public Base {
 public:
  void step(const Step& step, Range range) override {
    for (const NamedRobot& r : robots(range))
      if (r.fails && step.index == 3) host_->log(LogLevel::warning, "the lens is dirty");
  }

 private:
  void read_parameters(const Parameters&) override {}
  NamedRobot connect_robot(Connector& c, const Item& item) override {
    host_ = &c.host();
    return {c.read(item.robot->base(), keys::pose), item.robot->name.ends_with('7')};
  }
  Host* host_ = nullptr;
};

template <char const* Id>
constexpr Description description{.id = Id,
                                  .kind = Kind::sensor,
                                  .version = "1.0.0",
                                  .summary = "Fails for one robot",
                                  .capabilities = deterministic | batched | restorable};

constexpr char throws[] = "sensor.throws", crashes[] = "sensor.crashes", says[] = "sensor.says";
constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Throws>(description<throws>),
                                              algorithm<Crashes>(description<crashes>),
                                              algorithm<Says>(description<says>)};

}  // namespace

MURO_PLUGIN(.name = "fails", .version = "1.0.0", .licence = "MIT", .summary = "Algorithms that fail for one robot",
            .algorithms = algorithms)
