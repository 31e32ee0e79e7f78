// SPDX-License-Identifier: MIT
#include "bodies.hpp"

#include <algorithm>
#include <string>

#include "muro/composite.hpp"
#include "muro/random.hpp"

namespace muro::penalty {

void Bodies::connect(Connector& c) {
  all.resize(c.object_count());
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    all[i].name = fnv1a(c.object_name(ObjectId{i}));
    all[i].whole = i;
    for (const Shape& s : c.constant_array(ObjectId{i}, keys::collision_shapes))
      if (std::none_of(materials.begin(), materials.end(),
                       [&](const Material& m) { return m.restitution == s.restitution; }))
        materials.push_back({s.restitution, damping_ratio_of(s.restitution)});
  }
  robot_of.assign(c.robots().size(), nobody);
  for (const RobotView* robot : c.robots()) connect_robot(c, *robot);
}

void Bodies::connect_robot(Connector& c, const RobotView& view) {
  const bool moved = c.is_used(view.base(), keys::external_wrench, Access::read_sum);
  for (const Frame& f : view.frames) {
    Body& b = all[index_of(f.object)];
    b.whole = index_of(view.base());
    b.robot = moved ? std::int32_t(robots.size()) : nobody;
    if (c.constant_array(f.object, keys::collision_shapes).empty()) continue;
    b.pose = c.read(f.object, keys::pose).get();
    b.twist = c.read(f.object, keys::twist).get();
  }
  if (!moved) return;
  const Inertia composite = composite_inertia(view.frames, inertias_of(c, view), initial_joint_positions(c, view));
  if (!(composite.mass > 0))
    throw Error("`" + std::string(view.name) + "` has no mass, so no contact can push it; give its bodies `inertial`");
  const Mat3 inverse = composite.tensor().inverse();
  MassProperties mass{
      .inverse_mass = 1 / composite.mass,
      .inverse_inertia = {inverse(0, 0), inverse(1, 1), inverse(2, 2), inverse(0, 1), inverse(0, 2), inverse(1, 2)}};
  std::copy_n(composite.com.data(), 3, mass.com);
  Robot r;
  r.contacts = c.read_list(view.base(), keys::contacts);
  r.grips = c.variable_list(view.base(), grips);
  r.wrench = c.accumulate(view.base(), keys::external_wrench);
  r.base = c.read(view.base(), keys::pose);
  r.twist = c.read(view.base(), keys::twist);
  r.mass = note(mass);
  r.rank = view.key;
  robot_of[view.number] = std::int32_t(robots.size());
  robots.push_back(r);
}

std::uint32_t Bodies::note(const MassProperties& mass) {
  const auto found = std::find(masses.begin(), masses.end(), mass);
  if (found != masses.end()) return std::uint32_t(found - masses.begin());
  masses.push_back(mass);
  return std::uint32_t(masses.size() - 1);
}

}  // namespace muro::penalty
