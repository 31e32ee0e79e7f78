// SPDX-License-Identifier: MIT
#include "tests/robots/trial.hpp"

#include <filesystem>

#include "tests/robots/body_shapes.hpp"
#include "tests/support/scene.hpp"

namespace muro::robots {

namespace {

constexpr double g = 9.81, rate = 1000, sampling_interval = 0.01;

class Trial {
 public:
  Trial(const TrialSettings& settings, Observations& seen) : settings_(settings), observations_(seen) {
    scene_.set_log([](LogLevel, std::string_view) {});
  }

  void build() {
    tree_ = scene_.read_model(settings_.file);
    solids_ = solids_of(tree_);
    with_meshes_ = (features_of(settings_.motion) & (feature_convex_meshes | feature_concave_meshes)) != 0;
    start_ = start_positions(tree_);
    const double lowest = lowest_point(solids_, poses_of(tree_, {}, start_), true);
    Pose pose;
    pose.position.z() = std::isfinite(lowest) ? settings_.clearance - lowest : 1;
    robot_ = &scene_.add("robot", tree_, pose);
    for (std::size_t i = 0; i < start_.size(); ++i) {
      const Link& link = robot_->links[i];
      if (link.joint == JointKind::fixed) continue;
      if (link.mimic < 0) scene_.world().set(link.joint_object, keys::initial_joint_position, start_[i]);
    }
    scene_.add_ground();
    scene_.use(settings_.motion, rate, scene_.all_robots(), parameters());
    scene_.use_contacts();
    scene_.build();
    for (std::size_t i = 0; i < start_.size(); ++i) {
      const RobotTree::FlatLink& link = tree_.links()[i];
      inertias_.push_back(inertia_of(tree_.components()[std::size_t(link.body)]));
      observations_.energy_scale += inertias_.back().mass * g;
    }
  }

  void run() {
    first_height_ = scene_.pose(*robot_).position.z();
    const int samples = int(std::lround(settings_.duration / sampling_interval));
    for (int k = 0; k <= samples; ++k) {
      if (k > 0) scene_.run_for(sampling_interval);
      scene_.refresh();
      if (!observe(k, samples)) return;
    }
    observations_.height = scene_.pose(*robot_).position.z();
    observations_.fall = first_height_ - observations_.height;
    observations_.speed = scene_.twist(*robot_).linear.norm();
    observations_.tilt = std::acos(std::clamp((scene_.pose(*robot_).orientation * Vec3::UnitZ()).z(), -1.0, 1.0));
    observe_joints();
  }

 private:
  std::map<std::string, ParameterInput> parameters() const {
    std::map<std::string, ParameterInput> all = settings_.more;
    if (settings_.passive) all["joints"] = std::string("passive");
    if (settings_.fixed) all["base"] = std::string("fixed");
    const Description& d = *test::plugins().algorithm(settings_.motion).description;
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

  /// Returns whether the run continues.
  bool observe(int k, int samples) {
    poses_.clear();
    double energy = 0;
    for (std::size_t i = 0; i < robot_->links.size(); ++i) {
      const ObjectId body = robot_->links[i].object;
      const Pose& pose = poses_.emplace_back(scene_.world().value(body, keys::pose));
      const Twist& twist = scene_.world().value(body, keys::twist);
      observations_.norm_error = std::max(observations_.norm_error, std::abs(pose.orientation.norm() - 1));
      const Inertia& inertia = inertias_[i];
      const Vec3 arm = pose.orientation * inertia.com, spin = pose.orientation.conjugate() * twist.angular;
      energy += inertia.mass * (g * (pose.position + arm).z() + 0.5 * twist.at(arm).squaredNorm()) +
                0.5 * spin.dot(inertia.tensor() * spin);
    }
    const double lowest = lowest_point(solids_, poses_, with_meshes_);
    if (!std::isfinite(energy) || std::isnan(lowest)) {
      observations_.failure = "poses or twists are not finite";
      return false;
    }
    const bool first_half = 2 * k < samples;
    if (k == 0) first_energy_ = energy;
    if (first_half) middle_energy_ = energy;
    observations_.energy_gain = std::max(observations_.energy_gain, energy - first_energy_);
    if (!first_half) observations_.late_energy_gain = std::max(observations_.late_energy_gain, energy - middle_energy_);
    observations_.deepest = k == 0 ? lowest : std::min(observations_.deepest, lowest);
    observations_.lowest = lowest;
    return observe_limits();
  }

  bool observe_limits() {
    for (const Link& link : robot_->links) {
      if (link.joint == JointKind::fixed) continue;
      const double q = scene_.world().value(link.joint_object, keys::joint_position);
      if (!std::isfinite(q + scene_.world().value(link.joint_object, keys::joint_velocity))) {
        observations_.failure = "joint " + name_of(link) + " is not finite";
        return false;
      }
      const double limit_violation = std::max(link.limits.lower - q, q - link.limits.upper);
      if (link.mimic >= 0 || limit_violation <= observations_.limit_violation) continue;
      observations_.limit_violation = limit_violation;
      observations_.violating_joint = name_of(link);
    }
    return true;
  }

  void observe_joints() {
    for (std::size_t i = 0; i < robot_->links.size(); ++i) {
      const Link& link = robot_->links[i];
      if (link.joint == JointKind::fixed) continue;
      const double q = scene_.world().value(link.joint_object, keys::joint_position);
      observations_.joints.push_back({name_of(link), link.mimic >= 0, q - start_[i],
                                      scene_.world().value(link.joint_object, keys::joint_velocity)});
      if (link.mimic < 0) continue;
      const double leader =
          scene_.world().value(robot_->links[std::size_t(link.mimic)].joint_object, keys::joint_position);
      observations_.mimic_error =
          std::max(observations_.mimic_error, std::abs(q - link.mimic_offset - link.mimic_multiplier * leader));
    }
  }

  std::string name_of(const Link& link) const {
    return scene_.world().object_name(link.joint_object).substr(robot_->name.size() + 1);
  }

  const TrialSettings& settings_;
  Observations& observations_;
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

Observations run(const TrialSettings& settings) {
  Observations seen;
  Trial trial(settings, seen);
  try {
    trial.build();
  } catch (const SetupError& refusal) {
    seen.refused = refusal.what();
    return seen;
  }
  try {
    trial.run();
  } catch (const StepError& failure) {
    seen.failure = failure.what();
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
