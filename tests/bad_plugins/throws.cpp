// SPDX-License-Identifier: MIT
// Algorithms that fail, one for each place where an algorithm can fail.
#include <new>

#include "muro/plugin.hpp"

namespace {

using namespace muro;

class Base : public Algorithm {
 public:
  void connect(Connector& c) override {
    for (const Item& item : c.items()) {
      c.variable(item.object, keys::pose, Pose{});
      c.variable(item.object, keys::twist, Twist{});
    }
  }
  void step(const Step&, Range) override {}
};

class Create final : public Base {
 public:
  Create() { throw Error("no licence file; put one at /etc/example"); }
};
class Connect final : public Base {
 public:
  void connect(Connector&) override { throw 42; }  // not a std::exception
};
class Start final : public Base {
 public:
  void start() override { throw Error("port 4711 is taken; choose another one"); }
};
class StepAt final : public Base {
 public:
  void step(const Step& step, Range) override {
    if (step.index == 3) throw Error("matrix is singular");
  }
};
class Memory final : public Base {
 public:
  void step(const Step&, Range) override { throw std::bad_alloc(); }
};

template <char const* Id>
constexpr Description description{.id = Id, .kind = Kind::motion, .version = "1.0.0", .summary = "Fails on purpose"};

constexpr char create[] = "motion.create_throws";
constexpr char connect[] = "motion.connect_throws";
constexpr char start[] = "motion.start_throws";
constexpr char step[] = "motion.step_throws";
constexpr char memory[] = "motion.step_has_no_memory";
constexpr abi::AlgorithmEntry algorithms[] = {
    algorithm<Create>(description<create>), algorithm<Connect>(description<connect>),
    algorithm<Start>(description<start>), algorithm<StepAt>(description<step>), algorithm<Memory>(description<memory>)};

}  // namespace

MURO_PLUGIN(.name = "throws", .version = "1.0.0", .licence = "MIT", .summary = "Algorithms that fail",
            .algorithms = algorithms)
