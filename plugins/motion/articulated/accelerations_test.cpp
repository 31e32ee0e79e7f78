// SPDX-License-Identifier: MIT
// Accelerations of random trees compared with those of MuJoCo: mj_forward on the same model as MJCF.
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <Eigen/Eigenvalues>
#include <memory>
#include <sstream>

#include "mimic_joints.hpp"
#include "point_mobility.hpp"
#include "random_robot_testing.hpp"
#include "tests/support/files.hpp"

namespace muro::articulated {
namespace {

struct MujocoModel {
  std::unique_ptr<mjModel, decltype(&mj_deleteModel)> model{nullptr, mj_deleteModel};
  std::unique_ptr<mjData, decltype(&mj_deleteData)> data{nullptr, mj_deleteData};
};

std::string numbers_of(const Vec3& v) {
  std::ostringstream text;
  text.precision(17);
  text << v.x() << " " << v.y() << " " << v.z();
  return text.str();
}

void write_body(std::ostream& out, const multibody::RobotModel& robot, std::size_t i) {
  const multibody::RigidBody& body = robot.bodies[i];
  const Quat& q = body.origin.orientation;
  out << "<body pos='" << numbers_of(body.origin.position) << "' quat='" << q.w() << " " << q.x() << " " << q.y() << " "
      << q.z() << "'>\n";
  out << "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>\n";  // replaced below
  if (i == 0 && !robot.fixed_base) out << "<freejoint/>\n";
  if (i > 0)
    out << "<joint type='" << (body.joint == JointKind::revolute ? "hinge" : "slide") << "' axis='"
        << numbers_of(body.axis) << "' armature='" << body.limits.armature << "'/>\n";
  for (std::size_t k = i + 1; k < robot.bodies.size(); ++k)
    if (robot.bodies[k].parent == int(i)) write_body(out, robot, k);
  out << "</body>\n";
}

/// Numbers bodies as MuJoCo does: depth first.
void number_bodies(const multibody::RobotModel& robot, std::size_t i, std::vector<std::size_t>& numbers) {
  numbers.push_back(i);
  for (std::size_t k = i + 1; k < robot.bodies.size(); ++k)
    if (robot.bodies[k].parent == int(i)) number_bodies(robot, k, numbers);
}

MujocoModel mujoco_model(const multibody::RobotModel& robot, const std::vector<std::size_t>& numbers) {
  std::ostringstream xml;
  xml.precision(17);
  xml << "<mujoco><option gravity='0.3 -0.5 -9.81'/><compiler angle='radian'/><worldbody>\n";
  write_body(xml, robot, 0);
  xml << "</worldbody></mujoco>\n";
  const test::ScratchFolder folder;
  char error[1000] = "";
  MujocoModel m;
  m.model.reset(mj_loadXML(folder.file("tree.xml", xml.str()).c_str(), nullptr, error, sizeof error));
  if (!m.model) throw std::runtime_error(error);
  for (std::size_t n = 0; n < numbers.size(); ++n) {  // exact values, which MuJoCo's compiler does not keep
    const Inertia& inertia = robot.bodies[numbers[n]].inertia;
    const Eigen::SelfAdjointEigenSolver<Mat3> moments(inertia.tensor());
    Mat3 axes = moments.eigenvectors();
    if (axes.determinant() < 0) axes.col(0) *= -1;
    const Quat q(axes);
    mjtNum* const quat = m.model->body_iquat + 4 * (n + 1);
    quat[0] = q.w(), quat[1] = q.x(), quat[2] = q.y(), quat[3] = q.z();
    m.model->body_mass[n + 1] = inertia.mass;
    for (int k = 0; k < 3; ++k) {
      m.model->body_inertia[3 * (n + 1) + std::size_t(k)] = moments.eigenvalues()[k];
      m.model->body_ipos[3 * (n + 1) + std::size_t(k)] = inertia.com[k];
    }
    m.model->body_sameframe[n + 1] = 0;
    m.model->body_simple[n + 1] = 0;
  }
  for (int k = 0; k < m.model->nv; ++k) m.model->dof_simplenum[k] = 0;
  m.data.reset(mj_makeData(m.model.get()));
  mj_setConst(m.model.get(), m.data.get());
  mj_resetData(m.model.get(), m.data.get());
  return m;
}

/// A state of a robot, with efforts at its joints and wrenches on its bodies.
struct RandomState {
  Pose pose;
  Twist twist;
  std::vector<double> q, qd, effort;
  std::vector<Wrench> wrenches;  ///< at the origins of bodies, world axes

  RandomState(test::Randoms& random, std::size_t bodies, bool fixed) {
    pose = {Vec3(random.uniform(0, 3) * random.direction()), random.rotation()};
    if (fixed) pose = {};
    if (!fixed) twist = {random.uniform(0, 3) * random.direction(), random.uniform(0, 5) * random.direction()};
    for (std::size_t i = 0; i < bodies; ++i) {
      q.push_back(random.uniform(-2, 2)), qd.push_back(random.uniform(-6, 6)), effort.push_back(random.uniform(-9, 9));
      wrenches.push_back({random.uniform(0, 9) * random.direction(), random.uniform(0, 2) * random.direction()});
    }
  }
};

using Values = std::vector<double>;

/// Sets the state. Returns the first degree of freedom of a joint.
int set_state(const multibody::RobotModel& robot, const std::vector<std::size_t>& numbers, const RandomState& s,
              mjData& d) {
  int q = 0, v = 0;
  if (!robot.fixed_base) {
    const Quat& o = s.pose.orientation;
    const Vec3 spin = o.conjugate() * s.twist.angular;
    for (int k = 0; k < 3; ++k) d.qpos[k] = s.pose.position[k], d.qvel[k] = s.twist.linear[k], d.qvel[3 + k] = spin[k];
    d.qpos[3] = o.w(), d.qpos[4] = o.x(), d.qpos[5] = o.y(), d.qpos[6] = o.z();
    q = 7, v = 6;
  }
  for (std::size_t n = 1; n < numbers.size(); ++n) {
    d.qpos[q + int(n) - 1] = s.q[numbers[n]];
    d.qvel[v + int(n) - 1] = s.qd[numbers[n]];
    d.qfrc_applied[v + int(n) - 1] = s.effort[numbers[n]];
  }
  return v;
}

/// Returns the linear and angular acceleration of a free base (world axes), then those of the joints in the order of
/// the model.
Values by_mujoco(const multibody::RobotModel& robot, const RandomState& s) {
  std::vector<std::size_t> numbers;
  number_bodies(robot, 0, numbers);
  const MujocoModel m = mujoco_model(robot, numbers);
  mjData& d = *m.data;
  const int v = set_state(robot, numbers, s, d);
  mj_kinematics(m.model.get(), &d);
  for (std::size_t n = 0; n < numbers.size(); ++n) {  // MuJoCo takes forces at centres of mass
    const Wrench& w = s.wrenches[numbers[n]];
    const mjtNum *origin = d.xpos + 3 * (n + 1), *centre = d.xipos + 3 * (n + 1);
    const Vec3 arm(origin[0] - centre[0], origin[1] - centre[1], origin[2] - centre[2]);
    const Vec3 torque = w.torque + arm.cross(w.force);
    for (int k = 0; k < 3; ++k) {
      d.xfrc_applied[6 * (n + 1) + std::size_t(k)] = w.force[k];
      d.xfrc_applied[6 * (n + 1) + 3 + std::size_t(k)] = torque[k];
    }
  }
  mj_forward(m.model.get(), &d);
  Values all;
  if (!robot.fixed_base) {
    const Vec3 turning = s.pose.orientation * Vec3(d.qacc[3], d.qacc[4], d.qacc[5]);
    all = {d.qacc[0], d.qacc[1], d.qacc[2], turning.x(), turning.y(), turning.z()};
  }
  Values joints(robot.bodies.size());
  for (std::size_t n = 1; n < numbers.size(); ++n) joints[numbers[n]] = d.qacc[v + int(n) - 1];
  all.insert(all.end(), joints.begin() + 1, joints.end());
  return all;
}

using V = lanes::V3<double>;
V lane_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 of_lane(const V& v) { return {v.x, v.y, v.z}; }

Values by_the_plugin(const multibody::RobotModel& robot, const RandomState& s) {
  const Model model = model_of_bodies(robot);
  const std::vector<Mass> mass = masses_of_bodies(robot);
  const Structure structure = model.structure();
  const std::size_t count = model.bodies.size();
  std::vector<lanes::BodyStep<double>> bodies(count);
  std::vector<lanes::Inertia<double>> slots(std::size_t(model.slots)), external(count);
  std::vector<const lanes::Inertia<double>*> acts_on(count);
  lanes::Masses<double> masses;
  masses.at.at[0] = reinterpret_cast<const double*>(mass.data());
  const Mat3 r = s.pose.orientation.toRotationMatrix();
  bodies[0].axes = {lane_of(r.col(0)), lane_of(r.col(1)), lane_of(r.col(2))};
  bodies[0].origin = lane_of(s.pose.position);
  bodies[0].w = lane_of(r.transpose() * s.twist.angular);
  bodies[0].v = lane_of(r.transpose() * s.twist.linear);
  for (std::size_t i = 1; i < count; ++i) {
    const double sign = model.bodies[i].sign;
    bodies[i].q = sign * s.q[i], bodies[i].qd = sign * s.qd[i];
    bodies[i].terms = {sign * s.effort[i], model.joints[i].armature, 0, 1};
  }
  lanes::place_all(structure, bodies.data());
  for (std::size_t i = 0; i < count; ++i) {
    external[i] = {};
    external[i].f = -transposed_times(bodies[i].axes, lane_of(s.wrenches[i].force));
    external[i].n = -transposed_times(bodies[i].axes, lane_of(s.wrenches[i].torque));
    acts_on[i] = &external[i];
  }
  const Vec3 gravity(0.3, -0.5, -9.81);
  const V fall = structure.fixed ? lane_of(r.transpose() * -gravity) : V{0, 0, 0};
  lanes::Inertia<double> base;
  lanes::accelerate_all(structure, masses, bodies.data(), slots.data(), acts_on.data(), base, fall,
                        lanes::NoCoupling());
  Values all;
  if (!structure.fixed) {
    const lanes::BodyStep<double>& b = bodies[0];
    const Vec3 linear = r * of_lane(b.a + cross(b.w, b.v)) + gravity, angular = r * of_lane(b.alpha);
    all = {linear.x(), linear.y(), linear.z(), angular.x(), angular.y(), angular.z()};
  }
  for (std::size_t i = 1; i < count; ++i) all.push_back(model.bodies[i].sign * bodies[i].qdd);
  return all;
}

double norm_of(const Values& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}

class AccelerationsOfTrees : public ::testing::TestWithParam<bool> {};

TEST_P(AccelerationsOfTrees, AreThoseOfMujoco) {
  test::Randoms random(GetParam() ? 1 : 2);
  double worst = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const multibody::RobotModel robot = testing::random_robot(random, 2 + random.below(24), GetParam());
    const RandomState state(random, robot.bodies.size(), GetParam());
    const Values expected = by_mujoco(robot, state);
    Values seen = by_the_plugin(robot, state);
    ASSERT_EQ(seen.size(), expected.size());
    for (std::size_t k = 0; k < seen.size(); ++k) seen[k] -= expected[k];
    const double error = norm_of(seen) / norm_of(expected);
    EXPECT_LT(error, 1e-9) << "trial " << trial << ", " << robot.bodies.size() << " bodies";
    worst = std::max(worst, error);
  }
  RecordProperty("worst", std::to_string(worst * 1e12) + "e-12");
}

INSTANTIATE_TEST_SUITE_P(, AccelerationsOfTrees, ::testing::Bool(),
                         [](const auto& base) { return base.param ? "FixedBase" : "FreeBase"; });

TEST_P(AccelerationsOfTrees, AreThoseOfMujocoForForcesBetweenTwoBodies) {
  test::Randoms random(GetParam() ? 3 : 4);
  for (int trial = 0; trial < 50; ++trial) {
    const multibody::RobotModel robot = testing::random_robot(random, 3 + random.below(20), GetParam());
    const RandomState state(random, robot.bodies.size(), GetParam());
    std::vector<std::size_t> numbers;
    number_bodies(robot, 0, numbers);
    const MujocoModel m = mujoco_model(robot, numbers);
    mjData& d = *m.data;
    set_state(robot, numbers, state, d);
    mj_forward(m.model.get(), &d);
    std::vector<Pose> poses(numbers.size());
    for (std::size_t n = 0; n < numbers.size(); ++n) {
      const mjtNum *at = d.xpos + 3 * (n + 1), *o = d.xquat + 4 * (n + 1);
      poses[numbers[n]] = {Vec3::Map(at), Quat(o[0], o[1], o[2], o[3])};
    }
    const int a = random.below(int(numbers.size())),
              b = (a + 1 + random.below(int(numbers.size()) - 1)) % int(numbers.size());
    const Vec3 point = random.uniform(0, 2) * random.direction();
    using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;
    Rows first(3, m.model->nv), second(3, m.model->nv), solved(3, m.model->nv);
    mj_jac(m.model.get(), &d, first.data(), nullptr, point.data(), a + 1);
    mj_jac(m.model.get(), &d, second.data(), nullptr, point.data(), b + 1);
    const Rows jacobian = first - second;
    mj_solveM(m.model.get(), &d, solved.data(), jacobian.data(), 3);
    const Mat3 expected = jacobian * solved.transpose();
    PointMobility mobility(robot);
    mobility.set_poses(poses);
    const Mat3 seen =
        mobility.between(std::uint32_t(numbers[std::size_t(a)]), std::uint32_t(numbers[std::size_t(b)]), point);
    EXPECT_LT((seen - expected).norm(), 1e-9 * expected.norm()) << "trial " << trial;
  }
}

}  // namespace
}  // namespace muro::articulated
