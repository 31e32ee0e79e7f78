// SPDX-License-Identifier: MIT
#include "host/unsupported_features/unsupported_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/instance.hpp"
#include "host/unsupported_features/used_features.hpp"

namespace muro::host {

namespace {

/// What goes with a feature: who lacks it lacks all of these.
struct Consequence {
  Features cause, effects;
};
constexpr Features of_joints = feature_velocity_targets | feature_position_targets | feature_acceleration_targets |
                               feature_effort_targets | feature_joint_limits | feature_joint_speed_limits |
                               feature_joint_effort_limits | feature_joint_damping | feature_joint_friction |
                               feature_mimic_joints | feature_link_dynamics;
constexpr Features of_meshes = feature_convex_meshes | feature_concave_meshes;
constexpr Features of_contact = feature_friction | feature_restitution | of_meshes | feature_self_collision;
constexpr Consequence consequences[] = {
    {feature_forces, feature_contact | of_contact | feature_gyroscopic | feature_link_dynamics |
                         feature_joint_effort_limits | feature_joint_damping | feature_joint_friction},
    {feature_joints, of_joints},
    {feature_contact, of_contact},
    {feature_convex_meshes, feature_concave_meshes},
};

const FeatureInfo& info_of(Features bit) {
  return *std::find_if(std::begin(feature_infos), std::end(feature_infos),
                       [&](const FeatureInfo& f) { return f.bit == bit; });
}

bool contains(const std::vector<std::string>& names, const char* name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

class Search {
 public:
  explicit Search(const BuiltScenario& built) : built_(built), simulation_(*built.simulation) {
    const World& world = simulation_.world();
    templates_.assign(world.robots().size(), {});
    for (const RobotTemplate& t : built.scenario.robots)
      for (int i = 0; i < int(t.subsystems.size()); ++i) {
        const RobotView* robot = world.find_robot(t.counted ? t.name + "_" + std::to_string(i) : t.name);
        if (robot) templates_[robot->number] = {&t, std::size_t(i)};
      }
  }

  std::vector<Losses> all() {
    for (const auto& instance : simulation_.instances())
      if (instance->description().kind == Kind::motion) add(instance->setup());
    std::stable_sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) { return a.robot < b.robot; });
    std::vector<Losses> out;
    for (Found& f : found_)
      if (!f.losses.all.empty()) out.push_back(std::move(f.losses));
    return out;
  }

 private:
  struct Of {
    const RobotTemplate* robots = nullptr;
    std::size_t number = 0;  ///< of the robot in it
  };
  struct Found {
    std::uint32_t robot;  ///< the first
    Losses losses;
  };

  void add(const AlgorithmSetup& motion) {
    const CatalogEntry& offer = simulation_.registry().find(motion.use);
    if (!offer.features) return;
    for (std::size_t i = 0; i < motion.items.size(); ++i) {
      const RobotView* robot = motion.items[i].robot;
      if (!robot || !templates_[robot->number].robots) continue;
      if (!is_first_of_its_kind(*robot, motion)) continue;
      const bool own = contains(offer.writes, "wrench.contact");
      const MotionUse use{motion.own.empty() ? motion.parameters : motion.own[i].parameters, own,
                          own || contact_is_there()};
      Losses& losses = entry(*robot, motion);
      for (Need& n : needs_of(simulation_.world(), *robot, use)) {
        const bool known =
            std::any_of(losses.all.begin(), losses.all.end(), [&](const Loss& l) { return l.bit == n.bit; });
        if ((*offer.features & n.bit) == 0 && !known)
          losses.all.push_back({n.bit, std::move(n.amount), follows(n.bit, *offer.features)});
      }
    }
  }

  /// Robots of a template with the same subsystems lose the same.
  bool is_first_of_its_kind(const RobotView& robot, const AlgorithmSetup& motion) {
    const Of of = templates_[robot.number];
    std::string kind = of.robots->name + " " + motion.use;
    for (const Subsystem& s : of.robots->subsystems[of.number]) kind += " " + s.use + " " + s.location.text();
    return seen_.insert(std::move(kind)).second;
  }

  Losses& entry(const RobotView& robot, const AlgorithmSetup& motion) {
    const Of of = templates_[robot.number];
    for (Found& f : found_)
      if (f.losses.robots == of.robots->name && f.losses.motion == motion.use) {
        f.robot = std::min(f.robot, robot.number);
        return f.losses;
      }
    Location location = of.robots->location;
    for (const Subsystem& s : of.robots->subsystems[of.number])
      if (s.use == motion.use) location = s.location;
    found_.push_back({robot.number, {of.robots->name, motion.use, location, {}}});
    return found_.back().losses;
  }

  static bool follows(Features bit, Features has) {
    return std::any_of(std::begin(consequences), std::end(consequences),
                       [&](const Consequence& c) { return (has & c.cause) == 0 && (c.effects & bit) != 0; });
  }

  bool contact_is_there() const {
    const auto& all = simulation_.instances();
    return std::any_of(all.begin(), all.end(), [](const auto& i) { return i->description().kind == Kind::contact; }) ||
           !contains(built_.scenario.switched_off, "contact");
  }

  const BuiltScenario& built_;
  Simulation& simulation_;
  std::vector<Of> templates_;  ///< by number of the robot
  std::vector<Found> found_;
  std::set<std::string> seen_;
};

}  // namespace

std::vector<Losses> losses_of(const BuiltScenario& built) { return Search(built).all(); }

std::string text_of(const Losses& losses, Length length) {
  std::string out, following;
  for (const Loss& l : losses.all) {
    const std::string amount = l.amount.empty() ? "" : " (" + l.amount + ")";
    if (l.follows)
      following += fmt::format("{}{}{}", following.empty() ? "" : ", ", info_of(l.bit).name, amount);
    else
      out += fmt::format("{}{}{}", out.empty() ? "" : "; ", info_of(l.bit).lost, amount);
  }
  return length == Length::shortly || following.empty() ? out : out + "; with that go " + following;
}

void tell(const std::vector<Losses>& losses, Length length, bool strict) {
  std::vector<std::string> lines;
  for (const Losses& l : losses)
    lines.push_back(fmt::format("{}: {}{} by {}: {}", l.location.text(), strict ? "" : "note: ", l.robots, l.motion,
                                text_of(l, length)));
  if (strict && !lines.empty()) {
    lines.emplace_back("with --strict nothing may be lost; choose a motion that has it, or leave --strict out");
    throw SetupError(lines);
  }
  for (const std::string& l : lines) fmt::print(stderr, "{}\n", l);
}

}  // namespace muro::host
