// SPDX-License-Identifier: MIT
// Multi-body dynamics by the articulated-body algorithm; robots of one structure are in the lanes of vector registers.
#include <algorithm>
#include <bit>
#include <deque>
#include <memory>

#include "description.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/motion/common/motion/watched_motion.hpp"
#include "plugins/motion/common/multibody/kinematic_robot.hpp"
#include "robot.hpp"

namespace {

using namespace muro;
using namespace muro::articulated;

/// Memory of a kernel; there is one for each thread.
class WorkMemory {
 public:
  void* of(std::size_t bytes) {
    if (bytes > size_) {
      memory_.reset(static_cast<std::byte*>(::operator new[](bytes, alignment)));
      size_ = bytes;
    }
    return memory_.get();
  }

 private:
  static constexpr std::align_val_t alignment{64};
  struct Delete {
    void operator()(std::byte* p) const { ::operator delete[](p, alignment); }
  };
  std::unique_ptr<std::byte, Delete> memory_;
  std::size_t size_ = 0;
};

class Articulated final : public WatchedMotion {
 public:
  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    gravity_ = c.constant(world_object, keys::gravity).value_or(Vec3(0, 0, -9.81));
    omega_ = 2 * M_PI * p.real("frequency");
    correcting_speed_ = p.real("correcting_speed");
    runge_kutta_ = p.text("integrator") == "rk4";
    bodies_.connect(c);
    for (std::uint32_t i = 0; i < c.items().size(); ++i) connect_robot(c, i);
    report(c);
  }

  void start() override {
    for (std::uint32_t i = 0; i < served_.size(); ++i) {
      if (!served_[i].robot) continue;
      served_[i].robot->start();
      begin_watch_of(i);
    }
  }
  void restored() override { start(); }
  void on_handover(std::uint32_t item) override {
    const Served& s = served_[item];
    if (!s.robot) return s.by_targets->take_over();
    s.robot->take_over();
    begin_watch_of(item);
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase phases[] = {{Phase::IndexSpace::items, Phase::Scope::reads_all},
                                       {Phase::IndexSpace::items, Phase::Scope::own_robot}};
    return phases;
  }

 private:
  void bind_robots_by_name(Connector& c) override {
    bodies_.connect_by_name(c);
    for (std::uint32_t i = 0; i < served_.size(); ++i) {
      Robot* const robot = served_[i].robot;
      if (!robot) continue;
      robot->connect_by_name(c, *c.items()[i].robot, c.parameters());
      served_[i].model = number_of(robot->kernel_model(), models_);
      served_[i].masses = number_of(robot->masses(), masses_);
    }
    for (const Model& m : models_) {
      const Structure& s = structures_.emplace_back(m.structure());
      most_bodies_ = std::max(most_bodies_, s.count);
      most_slots_ = std::max(most_slots_, s.slots);
      most_mimic_numbers_ = std::max(most_mimic_numbers_, s.mimic_numbers);
    }
  }

  MovedBase moved_base(std::uint32_t i) const override {
    const Robot* const robot = served_[i].robot;
    if (!robot || robot->model().fixed_base) return {.keeps_applied = robot != nullptr};
    return {BaseMotion::by_forces, robot->model().bodies.front().inertia, true};
  }

  std::pair<Pose, Twist> state_of(std::uint32_t i) const override {
    return {served_[i].robot->pose(), served_[i].robot->twist()};
  }

  /// Looks up contacts in a phase of its own, since they are with robots that others move.
  bool prepare(const Step& step, Range range) override {
    if (step.phase != 0) return WatchedMotion::prepare(step, range);
    for (std::uint32_t i = range.begin; i < range.end; ++i)
      if (served_[i].robot) served_[i].robot->look_up_contacts(bodies_);
    return false;
  }

  /// Moves neighbours of one model eight at a time.
  void move(const Step& step, Range range) override {
    for (std::uint32_t i = range.begin, end = i; i < range.end; i = end) {
      end = i + 1;
      if (!served_[i].robot) {
        served_[i].by_targets->step(step.dt);
        continue;
      }
      while (end < range.end && end < i + lane_width && served_[end].robot && served_[end].model == served_[i].model)
        ++end;
      move_batch(i, end, step);
    }
  }

  static constexpr std::uint32_t lane_width = 8;
  static constexpr double hard_way = 1e-3;  ///< m: a contact point that comes farther in a step is stopped at once

  /// An item: a robot that forces move, or one that only its targets move.
  struct Served {
    Robot* robot = nullptr;
    multibody::KinematicRobot* by_targets = nullptr;
    std::uint32_t model = 0, masses = 0;  ///< in models_, masses_
  };

  void connect_robot(Connector& c, std::uint32_t i) {
    const Item& item = c.items()[i];
    const RobotView& view = *item.robot;
    const Parameters& p = c.parameters();
    if (multibody::KinematicRobot::is_one(c, view, p)) {
      served_.push_back({.by_targets = &kinematic_robots_.emplace_back(c, view, p, item.level)});
      return;
    }
    Robot& robot = robots_.emplace_back(c, view, p, item.level);
    watch_robot(c, i, robot.velocities());
    served_.push_back({.robot = &robot});
  }

  void begin_watch_of(std::uint32_t i) {
    served_[i].robot->each_external([&](const SumIn<Wrench>& external) { begin_watch(i, &external); });
  }

  /// Returns the number of `one` in `known`, to which a new one is added.
  template <class T>
  static std::uint32_t number_of(const T& one, std::vector<T>& known) {
    const auto same = std::find(known.rbegin(), known.rend(), one);  // mostly it is the last one
    if (same != known.rend()) return std::uint32_t(known.rend() - same) - 1;
    known.push_back(one);
    return std::uint32_t(known.size() - 1);
  }

  void report(Connector& c) const;

  void move_batch(std::uint32_t begin, std::uint32_t end, const Step& step) {
    thread_local WorkMemory memory;
    RobotState states[lane_width];
    std::size_t contacts = 0;
    Batch batch{.structure = structures_[served_[begin].model],
                .gravity = {gravity_.x(), gravity_.y(), gravity_.z()},
                .dt = step.dt,
                .omega = omega_,
                .impact_speed = std::max(0.02, gravity_.norm() / omega_),
                .hard_speed = hard_way / step.dt,
                .correcting_speed = correcting_speed_,
                .runge_kutta = runge_kutta_};
    for (std::uint32_t i = begin; i < end; ++i) {
      Robot& robot = *served_[i].robot;
      robot.prepare(step.dt);
      states[i - begin] = robot.state();
      contacts += robot.contact_count();
      batch.equal_masses = batch.equal_masses && served_[i].masses == served_[begin].masses;
    }
    constexpr std::size_t some = 256;
    batch.work = memory.of(kernels_->work_bytes(most_bodies_, most_slots_, most_mimic_numbers_,
                                                int(std::max(some, std::bit_ceil(contacts)))));
    const unsigned broken = kernels_->step(batch, states, int(end - begin));
    if (broken != 0) throw Error(served_[begin + std::uint32_t(std::countr_zero(broken))].robot->failure());
    for (std::uint32_t i = begin; i < end; ++i) {
      served_[i].robot->take_impacts(step);
      served_[i].robot->export_contacts();
    }
  }

  Vec3 gravity_ = Vec3::Zero();
  double omega_ = 0, correcting_speed_ = 0;
  bool runge_kutta_ = false;
  const Kernels* kernels_ = &kernels_for(lane::best_isa());
  TouchedBodies bodies_;
  std::vector<Model> models_;
  std::vector<Structure> structures_;                              ///< structures of the models
  int most_bodies_ = 0, most_slots_ = 0, most_mimic_numbers_ = 0;  ///< largest numbers of the models
  std::vector<std::vector<Mass>> masses_;
  std::deque<Robot> robots_;
  std::deque<multibody::KinematicRobot> kinematic_robots_;
  std::vector<Served> served_;  ///< one an item
};

/// Reports to the user which links were changed, and which robots only targets move.
void Articulated::report(Connector& c) const {
  std::vector<std::string_view> links;
  for (const Robot& r : robots_)
    links.insert(links.end(), r.model().regularized_links.begin(), r.model().regularized_links.end());
  if (!links.empty())
    c.host().log(
        LogLevel::info,
        "motion.articulated: bodies without mass and inertia, or with a moment of inertia that exceeds the sum "
        "of the two others, cannot be moved; what they lack was added to " +
            quoted_list(links) + "; give them an `inertial` that fits");
  std::vector<const multibody::KinematicRobot*> by_targets;
  for (const Served& s : served_) by_targets.push_back(s.by_targets);
  multibody::tell_of(c, by_targets);
}

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Articulated>(description)};

}  // namespace

MURO_PLUGIN(.name = "motion_articulated", .version = description.version, .licence = "MIT",
            .summary = "Multi-body dynamics by the articulated-body algorithm", .algorithms = algorithms)
