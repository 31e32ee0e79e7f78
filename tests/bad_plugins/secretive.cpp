// SPDX-License-Identifier: MIT
// Motions that access more than they have declared, each in another way, and one correct motion.
#include <vector>

#include "muro/plugin.hpp"

namespace {

using namespace muro;

constexpr Phase own[] = {{Phase::IndexSpace::items, Phase::Scope::own_robot}};
constexpr Phase wide[] = {{Phase::IndexSpace::items, Phase::Scope::reads_all}};

/// Falls at 1 m/s.
class Honest : public Algorithm {
 public:
  void connect(Connector& c) override {
    for (const Item& item : c.items()) {
      poses_.push_back(c.variable(item.object, keys::pose, Pose{}));
      c.variable(item.object, keys::twist, Twist{});
    }
  }
  std::span<const Phase> phases() const override { return own; }
  void step(const Step& step, Range range) override {
    for (std::uint32_t i = range.begin; i < range.end; ++i) poses_[i]->position.z() -= step.dt;
  }

 protected:
  std::vector<Out<Pose>> poses_;
};

/// Follows the first robot, which is in another block than the last robots.
class ReadsAnother : public Honest {
 public:
  void step(const Step& step, Range range) override {
    Honest::step(step, range);
    for (std::uint32_t i = range.begin; i < range.end; ++i) poses_[i]->position.x() = poses_[0]->position.z();
  }
};

/// Declares that it reads other robots, but writes one.
class WritesAnother final : public Honest {
 public:
  std::span<const Phase> phases() const override { return wide; }
  void step(const Step& step, Range range) override {
    Honest::step(step, range);
    poses_[0]->position.y() += 1;
  }
};

/// Keeps state in a member that should be a property.
class KeepsState final : public Honest {
 public:
  void step(const Step& step, Range range) override {
    Honest::step(step, range);
    ++steps_;
    for (std::uint32_t i = range.begin; i < range.end; ++i) poses_[i]->position.x() = steps_;
  }

 private:
  int steps_ = 0;
};

template <char const* Id>
constexpr Description description{.id = Id,
                                  .kind = Kind::motion,
                                  .version = "1.0.0",
                                  .summary = "Touches what it should not",
                                  .capabilities = deterministic | batched | restorable};

constexpr char honest[] = "motion.honest";
constexpr char reads[] = "motion.reads_another";
constexpr char writes[] = "motion.writes_another";
constexpr char keeps[] = "motion.keeps_state";
constexpr abi::AlgorithmEntry algorithms[] = {
    algorithm<Honest>(description<honest>), algorithm<ReadsAnother>(description<reads>),
    algorithm<WritesAnother>(description<writes>), algorithm<KeepsState>(description<keeps>)};

}  // namespace

MURO_PLUGIN(.name = "secretive", .version = "1.0.0", .licence = "MIT", .summary = "Algorithms with secrets",
            .algorithms = algorithms)
