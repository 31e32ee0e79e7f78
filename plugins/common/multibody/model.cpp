// SPDX-License-Identifier: MIT
#include "model.hpp"

#include <Eigen/Eigenvalues>

#include "muro/toolkit/mass_properties.hpp"
#include "plugins/common/multibody/physical_inertia.hpp"

namespace muro::multibody {

namespace {

/// `inertia` with at least `mass` and the principal moments of a ball of `radius`, and moments that a body can have;
/// whether it had to be changed.
bool mend(Inertia& inertia, double mass, double radius) {
  bool changed = false;
  if (!(inertia.mass >= mass)) {
    inertia.mass = mass;
    changed = true;
  }
  const double moment = 0.4 * inertia.mass * radius * radius;
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(inertia.tensor());
  if (!principal.eigenvalues().allFinite() || principal.eigenvalues().minCoeff() < moment) {
    Vec3 moments = Vec3::Constant(moment);
    Mat3 axes = Mat3::Identity();
    if (principal.eigenvalues().allFinite()) {
      moments = principal.eigenvalues().cwiseMax(moment);
      axes = principal.eigenvectors();
    }
    inertia = Inertia::from(inertia.mass, inertia.com, axes * moments.asDiagonal() * axes.transpose());
    changed = true;
  }
  const std::optional<Inertia> physical = made_physical(inertia);
  if (physical) inertia = *physical;
  return changed || physical;
}

Part part_of(const Link& f, std::uint32_t number, DriveMode mode) {
  Part p;
  p.frame = number;
  p.joint = f.joint;
  p.axis = f.axis;
  p.limits = f.limits;
  p.drive = mode;
  return p;
}

}  // namespace

Pose placed(const Part& part, double position) {
  Link f;
  f.joint = part.joint;
  f.origin = part.origin;
  f.axis = part.axis;
  return pose_in_parent(f, position);
}

RobotModel model_of(const Connector& connector, const RobotView& robot, std::span<const DriveMode> modes,
                    const InertiaFloor& floor) {
  const std::vector<Inertia> inertias = inertias_of(connector, robot);
  const std::vector<double> start = initial_joint_positions(connector, robot);
  RobotModel model;
  model.name = robot.name;
  for (const Inertia& i : inertias) model.mass += i.mass;
  if (!(model.mass > 0) || !std::isfinite(model.mass))
    throw Error("`" + model.name +
                "` has no mass; give its bodies mass and inertia (`inertial`), or move it with motion.point");
  std::vector<Place> places(robot.links.size());
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const Link& f = robot.links[i];
    Place& place = places[i];
    if (i > 0 && f.joint == JointKind::fixed) {
      place = places[std::size_t(f.parent)];
      place.pose = place.pose * f.origin;
    } else {
      place.part = std::uint32_t(model.parts.size());
      Part p = part_of(f, std::uint32_t(i), modes[i]);
      if (i > 0) {
        const Place& on = places[std::size_t(f.parent)];
        p.parent = std::int32_t(on.part);
        p.origin = on.pose * f.origin;
      }
      model.parts.push_back(std::move(p));
      model.start_positions.push_back(start[i]);
    }
    Part& part = model.parts[place.part];
    part.inertia = part.inertia + inertias[i].in(place.pose);
    const auto shapes = connector.constant_array(f.object, keys::collision_shapes);
    for (const Shape& s : shapes) {
      part.shapes.push_back({s, std::uint32_t(model.bodies.size())});
      part.shapes.back().shape.origin = place.pose * s.origin;
    }
    if (i == 0 || !shapes.empty()) model.bodies.push_back({std::uint32_t(i), !shapes.empty(), place});
  }
  for (Part& p : model.parts) {
    const Link& f = robot.links[p.frame];
    if (f.mimic >= 0) {
      p.leader = std::int32_t(places[std::size_t(f.mimic)].part);
      p.multiplier = f.mimic_multiplier;
      p.offset = f.mimic_offset;
    }
    if (mend(p.inertia, floor.least_mass * model.mass, floor.least_radius))
      model.mended.emplace_back(connector.object_name(f.object));
  }
  return model;
}

}  // namespace muro::multibody
