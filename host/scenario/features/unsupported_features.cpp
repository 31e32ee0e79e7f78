// SPDX-License-Identifier: MIT
#include "host/scenario/features/unsupported_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "core/instance.hpp"
#include "host/scenario/features/used_features.hpp"
#include "muro/detail/names.hpp"

namespace muro::host {

namespace {

/// A motion that does not support `cause` supports none of `implied` either.
struct Implication {
  Features cause, implied;
};
constexpr Features of_joints = feature_velocity_targets | feature_position_targets | feature_acceleration_targets |
                               feature_effort_targets | feature_joint_limits | feature_joint_speed_limits |
                               feature_joint_effort_limits | feature_joint_damping | feature_joint_friction |
                               feature_armature | feature_mimic_joints | feature_link_dynamics;
constexpr Features of_meshes = feature_convex_meshes | feature_concave_meshes;
constexpr Features of_contact = feature_friction | feature_restitution | feature_rolling_resistance |
                                feature_spinning_resistance | of_meshes | feature_self_collision;
constexpr Implication implications[] = {
    {feature_forces, feature_contact | of_contact | feature_gyroscopic | feature_link_dynamics |
                         feature_joint_effort_limits | feature_joint_damping | feature_joint_friction |
                         feature_armature},
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

/// Compares what each robot uses with what its motions support.
class Search {
 public:
  explicit Search(const BuiltScenario& built) : built_(built), simulation_(*built.simulation) {
    const World& world = simulation_.world();
    origins_.assign(world.robots().size(), {});
    for (const RobotTemplate& t : built.scenario.robots)
      for (std::size_t i = 0; i < t.subsystems.size(); ++i)
        if (const RobotView* robot = world.find_robot(instance_name(t.name, t.numbered, i)))
          origins_[index_of(robot->id)] = {&t, i};
  }

  std::vector<UnsupportedFeatures> all() {
    for (const auto& instance : simulation_.instances())
      if (instance->description().kind == Kind::motion) add(instance->setup());
    std::stable_sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) { return a.robot < b.robot; });
    std::vector<UnsupportedFeatures> out;
    for (Found& f : found_)
      if (!f.unsupported.all.empty()) out.push_back(std::move(f.unsupported));
    return out;
  }

 private:
  struct Origin {
    const RobotTemplate* robots = nullptr;
    std::size_t index = 0;  ///< index of the robot within the template
    const std::vector<Subsystem>& subsystems() const { return robots->subsystems[index]; }
  };
  struct Found {
    std::uint32_t robot;  ///< number of the first robot
    UnsupportedFeatures unsupported;
  };

  void add(const AlgorithmSetup& motion) {
    const CatalogEntry& entry = simulation_.registry().find(motion.use);
    if (!entry.features) return;
    for (std::size_t i = 0; i < motion.items.size(); ++i) {
      const RobotView* robot = motion.items[i].robot;
      if (!robot || !origins_[index_of(robot->id)].robots) continue;
      if (!is_first_of_its_kind(*robot, motion)) continue;
      const bool own = contains(entry.writes, "wrench.contact");
      const MotionUse use{motion.item_setups.empty() ? motion.parameters : motion.item_setups[i].parameters, own,
                          own || has_contact_algorithm()};
      std::vector<UnsupportedFeature>& unsupported = found_for(*robot, motion).all;
      for (UsedFeature& used : used_features(simulation_.world(), scenery_, *robot, use)) {
        const bool listed = std::any_of(unsupported.begin(), unsupported.end(),
                                        [&](const UnsupportedFeature& u) { return u.bit == used.bit; });
        if ((*entry.features & used.bit) == 0 && !listed)
          unsupported.push_back({used.bit, std::move(used.amount), is_implied(used.bit, *entry.features)});
      }
    }
  }

  /// Whether no earlier robot of the template has the same subsystems: such robots use the same features.
  bool is_first_of_its_kind(const RobotView& robot, const AlgorithmSetup& motion) {
    const Origin& origin = origins_[index_of(robot.id)];
    std::string kind = origin.robots->name + " " + motion.use;
    for (const Subsystem& s : origin.subsystems()) kind += " " + s.use + " " + s.location.text();
    return seen_.insert(std::move(kind)).second;
  }

  /// Returns the findings for the robot's template and this motion.
  UnsupportedFeatures& found_for(const RobotView& robot, const AlgorithmSetup& motion) {
    const Origin& origin = origins_[index_of(robot.id)];
    for (Found& f : found_)
      if (f.unsupported.robots == origin.robots->name && f.unsupported.motion == motion.use) {
        f.robot = std::min(f.robot, index_of(robot.id));
        return f.unsupported;
      }
    Location location = origin.robots->location;
    for (const Subsystem& s : origin.subsystems())
      if (s.use == motion.use) location = s.location;
    found_.push_back({index_of(robot.id), {origin.robots->name, motion.use, location, {}}});
    return found_.back().unsupported;
  }

  static bool is_implied(Features bit, Features supported) {
    return std::any_of(std::begin(implications), std::end(implications),
                       [&](const Implication& i) { return (supported & i.cause) == 0 && (i.implied & bit) != 0; });
  }

  bool has_contact_algorithm() const {
    const auto& all = simulation_.instances();
    return std::any_of(all.begin(), all.end(), [](const auto& i) { return i->description().kind == Kind::contact; }) ||
           !contains(built_.scenario.switched_off, "contact");
  }

  const BuiltScenario& built_;
  Simulation& simulation_;
  SceneryTraits scenery_ = scenery_traits(simulation_.world());
  std::vector<Origin> origins_;  ///< by number of the robot
  std::vector<Found> found_;
  std::set<std::string> seen_;
};

}  // namespace

std::vector<UnsupportedFeatures> find_unsupported_features(const BuiltScenario& built) { return Search(built).all(); }

std::string text_of(const UnsupportedFeatures& unsupported, Detail detail) {
  std::string out, implied;
  for (const UnsupportedFeature& u : unsupported.all) {
    const std::string amount = u.amount.empty() ? "" : " (" + u.amount + ")";
    if (u.implied)
      implied += fmt::format("{}{}{}", implied.empty() ? "" : ", ", info_of(u.bit).name, amount);
    else
      out += fmt::format("{}{}{}", out.empty() ? "" : "; ", info_of(u.bit).consequence, amount);
  }
  return detail == Detail::brief || implied.empty() ? out : out + "; therefore not supported either: " + implied;
}

void report_unsupported(const BuiltScenario& built, Detail detail, bool strict) {
  std::vector<std::string> lines;
  if (strict) lines = built.lost_collisions;
  if (!lines.empty())
    lines.emplace_back(
        "--strict lets no collision shape be left out; mend the files or their paths, or leave --strict out");
  for (const std::string& clamped : built.clamped) lines.push_back((strict ? "" : "warning: ") + clamped);
  const auto unsupported = find_unsupported_features(built);
  for (const UnsupportedFeatures& u : unsupported)
    lines.push_back(fmt::format("{}: {}`{}` does not support all features that `{}` uses: {}", u.location.text(),
                                strict ? "" : "note: ", u.motion, u.robots, text_of(u, detail)));
  if (strict && !built.clamped.empty())
    lines.emplace_back("--strict lets no joint start at a limit unasked; set `joints`, or leave --strict out");
  if (strict && !unsupported.empty())
    lines.emplace_back(
        "--strict allows no unsupported features; choose a motion that supports them, or leave --strict out");
  if (strict && !lines.empty()) throw SetupError(lines);
  for (const std::string& l : lines) fmt::print(stderr, "{}\n", message_text(l));
}

}  // namespace muro::host
