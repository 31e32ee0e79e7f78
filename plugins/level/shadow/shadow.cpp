// SPDX-License-Identifier: MIT
// Measures the distance between a robot and its shadow, which another motion moves by the same commands.
#include "muro/plugin.hpp"
#include "muro/toolkit/rotations.hpp"

namespace {

using namespace muro;

constexpr Key<double> distance{"shadow.distance", "m", "between the bases of a robot and its shadow"};
constexpr Key<double> angle{"shadow.angle", "rad", "between the orientations of a robot and its shadow"};
constexpr Key<double> max_distance{"shadow.distance.max", "m", "the largest so far"};
constexpr Key<double> max_angle{"shadow.angle.max", "rad", "the largest so far"};

constexpr PropertyUse reads[] = {{"pose", "of the bases of the robot and its shadow"}, {"shadow.of", "of the shadow"}};
constexpr PropertyUse writes[] = {{"shadow.distance", "of the shadow's base"},
                                  {"shadow.angle", "of the shadow's base"},
                                  {"shadow.distance.max", "of the shadow's base"},
                                  {"shadow.angle.max", "of the shadow's base"}};
constexpr Description description{
    .id = "level.shadow",
    .kind = Kind::level,
    .version = "1.0.0",
    .summary = "Measures how far a robot and its shadow come apart",
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

class Shadow final : public Algorithm {
 public:
  void connect(Connector& c) override {
    for (const Item& item : c.items()) {
      const auto original = item.robot ? c.constant(item.robot->base(), keys::shadow_of) : std::nullopt;
      if (!original) throw Error("it measures shadows, but `" + std::string(c.object_name(item.object)) + "` is none");
      const ObjectId base = item.robot->base();
      pairs_.push_back({c.read(*original, keys::pose), c.read(base, keys::pose), c.variable(base, distance, 0.0),
                        c.variable(base, angle, 0.0), c.variable(base, max_distance, 0.0),
                        c.variable(base, max_angle, 0.0)});
    }
  }

  void step(const Step&, Range range) override {
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const Pair& p = pairs_[i];
      *p.distance = (p.shadow->position - p.robot->position).norm();
      *p.angle = angle_of(p.shadow->orientation.conjugate() * p.robot->orientation);
      *p.max_distance = std::max(*p.max_distance, *p.distance);
      *p.max_angle = std::max(*p.max_angle, *p.angle);
    }
  }

 private:
  struct Pair {
    In<Pose> robot, shadow;
    Out<double> distance, angle, max_distance, max_angle;
  };
  std::vector<Pair> pairs_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Shadow>(description)};

}  // namespace

MURO_PLUGIN(.name = "level_shadow", .version = description.version, .licence = "MIT",
            .summary = "Robots and their shadows", .algorithms = algorithms)
