// SPDX-License-Identifier: MIT
#include "tests/robots/trial.hpp"

#include <filesystem>

#include "tests/robots/body_shapes.hpp"
#include "tests/support/scene.hpp"

namespace muro::robots {

namespace {

constexpr double g = 9.81, clearance = 0.05, rate = 1000, look_every = 0.01;

class Trial {
 public:
  Trial(const Setting& setting, Seen& seen) : setting_(setting), seen_(seen) {
    scene_.set_log([](LogLevel, std::string_view) {});
  }

  void build() {
    tree_ = scene_.read_model(setting_.file);
    solids_ = solids_of(tree_);
    with_meshes_ = (features_of(setting_.motion) & (feature_convex_meshes | feature_concave_meshes)) != 0;
    start_ = start_positions(tree_);
    const double lowest = lowest_point(solids_, poses_of(tree_, {}, start_), true);
    Pose pose;
    pose.position.z() = std::isfinite(lowest) ? clearance - lowest : 1;
    robot_ = &scene_.add("robot", tree_, pose);
    for (std::size_t i = 0; i < start_.size(); ++i) {
      const Link& f = robot_->links[i];
      if (f.joint == JointKind::fixed) continue;
      if (f.mimic < 0) scene_.world().set(f.joint_object, keys::initial_joint_position, start_[i]);
    }
    scene_.add_ground();
    scene_.use(setting_.motion, rate, scene_.all_robots(), parameters());
    scene_.use_contacts();
    scene_.build();
    for (std::size_t i = 0; i < start_.size(); ++i) {
      const RobotTree::FlatLink& f = tree_.links()[i];
      inertias_.push_back(inertia_of(tree_.components()[std::size_t(f.body)]));
      seen_.scale += inertias_.back().mass * g;
    }
  }

  void run() {
    first_height_ = scene_.pose(*robot_).position.z();
    const int looks = int(std::lround(setting_.duration / look_every));
    for (int k = 0; k <= looks; ++k) {
      if (k > 0) scene_.run_for(look_every);
      scene_.refresh();
      if (!look(k, looks)) return;
    }
    seen_.height = scene_.pose(*robot_).position.z();
    seen_.fall = first_height_ - seen_.height;
    seen_.speed = scene_.twist(*robot_).linear.norm();
    seen_.tilt = std::acos(std::clamp((scene_.pose(*robot_).orientation * Vec3::UnitZ()).z(), -1.0, 1.0));
    look_at_joints();
  }

 private:
  std::map<std::string, ParameterInput> parameters() const {
    std::map<std::string, ParameterInput> all = setting_.more;
    if (setting_.passive) all["joints"] = std::string("passive");
    if (setting_.fixed) all["base"] = std::string("fixed");
    const Description& d = *test::plugins().algorithm(setting_.motion).description;
    std::erase_if(all, [&](const auto& p) {
      return std::none_of(d.parameters.begin(), d.parameters.end(), [&](auto& k) { return k.name == p.first; });
    });
    return all;
  }

  static Inertia inertia_of(const RobotTree::Component& component) {
    Inertia inertia;
    for (const RobotTree::Constant& c : component.constants)
      if (c.key.name == keys::inertial.name) std::memcpy(static_cast<void*>(&inertia), c.data.data(), sizeof inertia);
    return inertia;
  }

  /// Whether the run is to go on.
  bool look(int k, int looks) {
    poses_.clear();
    double energy = 0;
    for (std::size_t i = 0; i < robot_->links.size(); ++i) {
      const ObjectId body = robot_->links[i].object;
      const Pose& pose = poses_.emplace_back(scene_.world().value(body, keys::pose));
      const Twist& twist = scene_.world().value(body, keys::twist);
      seen_.from_unit = std::max(seen_.from_unit, std::abs(pose.orientation.norm() - 1));
      const Inertia& inertia = inertias_[i];
      const Vec3 arm = pose.orientation * inertia.com, spin = pose.orientation.conjugate() * twist.angular;
      energy += inertia.mass * (g * (pose.position + arm).z() + 0.5 * twist.at(arm).squaredNorm()) +
                0.5 * spin.dot(inertia.tensor() * spin);
    }
    const double lowest = lowest_point(solids_, poses_, with_meshes_);
    if (!std::isfinite(energy) || std::isnan(lowest)) {
      seen_.broken = "poses or twists are not finite";
      return false;
    }
    const bool first_half = 2 * k < looks;
    if (k == 0) first_energy_ = energy;
    if (first_half) middle_energy_ = energy;
    seen_.gained = std::max(seen_.gained, energy - first_energy_);
    if (!first_half) seen_.late = std::max(seen_.late, energy - middle_energy_);
    seen_.deepest = k == 0 ? lowest : std::min(seen_.deepest, lowest);
    seen_.lowest = lowest;
    return look_at_limits();
  }

  bool look_at_limits() {
    for (const Link& f : robot_->links) {
      if (f.joint == JointKind::fixed) continue;
      const double q = scene_.world().value(f.joint_object, keys::joint_position);
      if (!std::isfinite(q + scene_.world().value(f.joint_object, keys::joint_velocity))) {
        seen_.broken = "joint " + name_of(f) + " is not finite";
        return false;
      }
      const double beyond = std::max(f.limits.lower - q, q - f.limits.upper);
      if (f.mimic >= 0 || beyond <= seen_.beyond) continue;
      seen_.beyond = beyond;
      seen_.beyond_joint = name_of(f);
    }
    return true;
  }

  void look_at_joints() {
    for (std::size_t i = 0; i < robot_->links.size(); ++i) {
      const Link& f = robot_->links[i];
      if (f.joint == JointKind::fixed) continue;
      const double q = scene_.world().value(f.joint_object, keys::joint_position);
      seen_.joints.push_back(
          {name_of(f), f.mimic >= 0, q - start_[i], scene_.world().value(f.joint_object, keys::joint_velocity)});
      if (f.mimic < 0) continue;
      const double leader =
          scene_.world().value(robot_->links[std::size_t(f.mimic)].joint_object, keys::joint_position);
      seen_.apart = std::max(seen_.apart, std::abs(q - f.mimic_offset - f.mimic_multiplier * leader));
    }
  }

  std::string name_of(const Link& f) const {
    return scene_.world().object_name(f.joint_object).substr(robot_->name.size() + 1);
  }

  const Setting& setting_;
  Seen& seen_;
  test::Scene scene_;
  RobotTree tree_;
  const RobotView* robot_ = nullptr;
  std::vector<Solid> solids_;
  std::vector<double> start_;
  std::vector<Inertia> inertias_;
  std::vector<Pose> poses_;
  bool with_meshes_ = false;
  double first_height_ = 0, first_energy_ = 0, middle_energy_ = 0;
};

}  // namespace

Seen run(const Setting& setting) {
  Seen seen;
  Trial trial(setting, seen);
  try {
    trial.build();
  } catch (const SetupError& refusal) {
    seen.refused = refusal.what();
    return seen;
  }
  try {
    trial.run();
  } catch (const StepError& failure) {
    seen.broken = failure.what();
  }
  return seen;
}

std::vector<std::string> motions() {
  std::vector<std::string> ids;
  for (const CatalogEntry& o : test::plugins().catalog())
    if (o.kind == "motion" && o.features && (*o.features & feature_contact) != 0 && (*o.features & feature_forces) != 0)
      ids.push_back(o.id);
  return ids;
}

Features features_of(const std::string& motion) { return test::plugins().algorithm(motion).description->features; }

std::vector<std::string> descriptions_below(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".urdf") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace muro::robots
