// SPDX-License-Identifier: MIT
// recorder.contacts in real simulations: forces against statics and Coulomb's law, with every motion that obeys forces.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/support/bodies.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

using test::ScratchFolder;

constexpr double g = 9.81;

struct Row {
  double time, depth;
  std::string body, other;
  Vec3 point, normal, force, torque;
};

/// A scene on ground at 0 that records its contacts.
struct ContactScene : test::Scene {
  std::vector<Row> rows() {
    finish();
    std::istringstream lines(test::text_of(folder.path("contacts.csv")));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line,
              "time,body,other,point.x,point.y,point.z,normal.x,normal.y,normal.z,depth,wrench.fx,wrench.fy,wrench.fz,"
              "wrench.tx,wrench.ty,wrench.tz\r");
    std::vector<Row> rows;
    while (std::getline(lines, line)) {
      std::istringstream fields(line);
      std::vector<std::string> f;
      for (std::string field; std::getline(fields, field, ',');) f.push_back(field);
      EXPECT_EQ(f.size(), 16u) << line;
      const auto number = [&](std::size_t i) { return std::stod(f[i]); };
      const auto vector = [&](std::size_t i) { return Vec3(number(i), number(i + 1), number(i + 2)); };
      rows.push_back({number(0), number(9), f[1], f[2], vector(3), vector(6), vector(10), vector(13)});
    }
    return rows;
  }
  /// Returns the rows of the last instant.
  std::vector<Row> last_rows() {
    std::vector<Row> last = rows();
    const double end = last.empty() ? 0 : last.back().time;
    std::erase_if(last, [&](const Row& r) { return r.time != end; });
    return last;
  }
  void record(std::vector<std::string> bodies = {}, double rate = 100) {
    use("recorder.contacts", rate, {}, {{"file", folder.path("contacts.csv")}, {"bodies", std::move(bodies)}});
  }
  void move(const std::string& motion, double rate = 1000, std::map<std::string, ParameterInput> parameters = {}) {
    for (const Item& item : all_robots()) use(motion, rate, {item}, parameters);
    use_contacts();
  }

  ScratchFolder folder;
};

Wrench sum_of(const std::vector<Row>& rows) {
  Wrench sum;
  for (const Row& r : rows) {
    sum.force += r.force;
    sum.torque += r.torque;
  }
  return sum;
}

class ContactsOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Motions, ContactsOf,
                         testing::Values("motion.simplified", "motion.articulated", "motion.ode", "motion.bullet",
                                         "motion.mujoco"),
                         [](const auto& motion) { return std::string(motion.param).substr(7); });

TEST_P(ContactsOf, ABoxAtRestCarryItsWeightAndPushItUp) {
  ContactScene s;
  const double mass = 3;
  s.add("box", test::block(mass, {0.4, 0.2, 0.2}, 0.6), {{0, 0, 0.1}, Quat::Identity()});
  s.add_ground(0.6);
  s.move(GetParam());
  s.record();
  s.build();
  s.run_for(1);
  const std::vector<Row> rows = s.last_rows();
  ASSERT_GE(rows.size(), 3u);
  Vec3 moment = Vec3::Zero();
  for (const Row& r : rows) {
    EXPECT_EQ(r.body, "box/body");
    EXPECT_EQ(r.other, "ground");
    EXPECT_LT((r.normal - Vec3::UnitZ()).norm(), 1e-3);
    EXPECT_NEAR(r.point.z(), 0, 2e-3);
    EXPECT_GT(r.force.z(), 0);
    EXPECT_GT(r.depth, -1e-3);
    EXPECT_LT(r.depth, 2e-3);
    moment += (r.point - s.pose(*s.world().find_robot("box")).position).cross(r.force) + r.torque;
  }
  EXPECT_LT((sum_of(rows).force - mass * g * Vec3::UnitZ()).norm(), 1e-3 * mass * g);
  EXPECT_LT(moment.norm(), 1e-3 * mass * g * 0.2);
}

TEST_P(ContactsOf, ASlidingBoxHaveCoulombsFriction) {
  ContactScene s;
  const double mass = 2, mu = 0.3;
  s.add("box", test::block(mass, {0.4, 0.4, 0.1}, mu), {{0, 0, 0.05}, Quat::Identity()}, {{3, 0, 0}, Vec3::Zero()});
  s.add_ground(mu);
  s.move(GetParam());
  s.record();
  s.build();
  s.run_for(0.7);
  const Wrench sum = sum_of(s.last_rows());
  EXPECT_GT(s.twist(*s.world().find_robot("box")).linear.x(), 0.5) << "it slides";
  EXPECT_NEAR(sum.force.z(), mass * g, 0.01 * mass * g);
  EXPECT_NEAR(-sum.force.x(), mu * sum.force.z(), 0.02 * mu * mass * g);
  EXPECT_NEAR(sum.force.y(), 0, 0.01 * mass * g);
}

TEST_P(ContactsOf, AStackAreOneRowEach) {
  ContactScene s;
  s.add("lower", test::block(2, {0.4, 0.4, 0.2}, 0.6), {{0, 0, 0.1}, Quat::Identity()});
  s.add("upper", test::block(1, {0.2, 0.2, 0.2}, 0.6), {{0, 0, 0.3}, Quat::Identity()});
  s.add_ground(0.6);
  s.move(GetParam());
  s.record();
  s.build();
  s.run_for(1.5);
  double on_upper = 0, on_lower = 0;
  for (const Row& r : s.last_rows()) {
    if (r.other == "ground") {
      EXPECT_EQ(r.body, "lower/body");
      on_lower += r.force.z();
      continue;
    }
    const bool of_upper = r.body == "upper/body";
    EXPECT_EQ(of_upper ? r.other : r.body, "lower/body");
    EXPECT_EQ(of_upper ? r.body : r.other, "upper/body");
    EXPECT_NEAR(r.normal.z(), of_upper ? 1 : -1, 1e-3) << "the direction in which the first is pushed";
    on_upper += of_upper ? r.force.z() : -r.force.z();
  }
  EXPECT_NEAR(on_upper, g, 0.01 * g);
  EXPECT_NEAR(on_lower, 3 * g, 0.01 * g);
}

TEST_P(ContactsOf, RollingBallsHaveTheTorqueThatResistsThem) {
  ContactScene s;
  const double mass = 2, radius = 0.2, resistance = 0.004, speed = 1;
  Shape shape = Shape::sphere(radius);
  shape.surface = {.friction = 0.8, .rolling_resistance = resistance};
  s.add("ball", test::single_body(shape, test::round_body(mass, radius)), {{0, 0, radius}, Quat::Identity()},
        {{speed, 0, 0}, {0, speed / radius, 0}});
  s.add_ground(0.8);
  s.move(GetParam());
  s.record();
  s.build();
  s.run_for(1);
  EXPECT_GT(s.twist(*s.world().find_robot("ball")).linear.x(), 0.5) << "it rolls";
  const std::vector<Row> rows = s.last_rows();
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_NEAR(rows[0].torque.y(), -resistance * mass * g, 0.02 * resistance * mass * g);
  EXPECT_NEAR(rows[0].torque.x(), 0, 1e-3 * resistance * mass * g);
}

TEST_P(ContactsOf, WhatIsRecordedIsWhatIsToldOfTheBody) {
  ContactScene s;
  s.add("ball", test::ball(1, 0.1, 0.5), {{0, 0, 0.3}, Quat::Identity()}, {{1, 0, 0}, Vec3::Zero()});
  s.add_ground(0.5);
  s.move(GetParam());
  s.record();
  s.build();
  double largest = 0;
  std::vector<std::pair<double, Vec3>> velocities;
  for (int i = 0; i < 600; ++i) {
    s.run_for(1e-3);
    velocities.emplace_back(1e-3 * (i + 1), s.twist(*s.world().find_robot("ball")).linear);
  }
  // rows at 100 Hz record every tenth step; the forces there match the changes of velocity
  for (const Row& r : s.rows()) {
    const auto step = std::size_t(std::lround(r.time * 1000));
    const std::size_t k = step - 1;
    if (step < 2 || k >= velocities.size()) continue;
    const Vec3 change = (velocities[k].second - velocities[k - 1].second) / 1e-3;
    EXPECT_LT((r.force - (change + g * Vec3::UnitZ())).norm(), 1e-2 * (1 + r.force.norm())) << r.time;
    largest = std::max(largest, r.force.norm());
  }
  EXPECT_GT(largest, 0.99 * g) << "it has landed";
}

TEST(RecorderContacts, DoesNotChangeWhatItSees) {
  for (const char* motion :
       {"motion.simplified", "motion.articulated", "motion.ode", "motion.bullet", "motion.mujoco"}) {
    Pose poses[2];
    for (const bool recorded : {false, true}) {
      ContactScene s;
      const RobotView& box =
          s.add("box", test::block(2, {0.4, 0.3, 0.1}, 0.4),
                {{0, 0, 0.3}, Quat(Eigen::AngleAxisd(0.4, Vec3(1, 2, 0).normalized()))}, {{1, 0, 0}, {0, 1, 2}});
      s.add("ball", test::ball(1, 0.1, 0.5), {{0.1, 0, 0.6}, Quat::Identity()});
      s.add_ground(0.5);
      s.move(motion);
      if (recorded) s.record();
      s.build();
      s.run_for(1);
      poses[recorded] = s.pose(box);
    }
    EXPECT_EQ(poses[0].position, poses[1].position) << motion;
    EXPECT_EQ(poses[0].orientation.coeffs(), poses[1].orientation.coeffs()) << motion;
  }
}

TEST(RecorderContacts, TakesTheBodiesThatItIsAskedFor) {
  ContactScene s;
  for (int i = 0; i < 3; ++i)
    s.add("box_" + std::to_string(i), test::block(1, {0.2, 0.2, 0.2}, 0.6), {{double(i), 0, 0.1}, Quat::Identity()});
  s.add_ground(0.6);
  s.move("motion.simplified");
  s.record({"box_1/*"});
  s.build();
  s.run_for(0.5);
  const std::vector<Row> rows = s.rows();
  EXPECT_FALSE(rows.empty());
  for (const Row& r : rows) EXPECT_EQ(r.body, "box_1/body");
}

TEST(RecorderContacts, HasNoForcesWhereOdeIsToldToFindNone) {
  ContactScene s;
  s.add("box", test::block(3, {0.4, 0.2, 0.2}, 0.6), {{0, 0, 0.1}, Quat::Identity()});
  s.add_ground(0.6);
  s.move("motion.ode", 1000, {{"reactions", false}});
  s.record();
  s.build();
  s.run_for(0.1);
  const std::vector<Row> rows = s.last_rows();
  ASSERT_GE(rows.size(), 3u);
  for (const Row& r : rows) {
    EXPECT_TRUE(std::isnan(r.force.z()) && std::isnan(r.torque.z()));
    EXPECT_EQ(r.other, "ground");
  }
}

TEST(RecorderContacts, OfAnMjcfModelWithItsOwnSettingsCarryItsWeight) {
  ContactScene s;
  const std::string path =
      s.folder.file("ball.xml",
                    "<mujoco><worldbody><geom name='floor' type='plane' size='5 5 1'/><body name='ball' pos='0 0 0.1'>"
                    "<freejoint/><geom size='0.1' condim='6' friction='1 0.01 0.01'/></body></worldbody></mujoco>");
  const WorldModel world = s.read_world(path);
  for (const auto& object : world.scenery())
    s.world().add_scenery(object.name, object.pose, object.collisions, object.visuals);
  const auto& model = world.models().at(0);
  const RobotView& ball = s.add(model.name, model.tree, model.pose, {{1, 0, 0}, {0, 10, 0}});
  s.use("motion.mujoco", 500, {{&ball, ball.base()}}, {{"settings", "model"}});
  s.record({}, 500);
  s.build();
  s.run_for(1);
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  for (const Row& r : s.rows()) {
    EXPECT_EQ(r.body, "ball/ball");
    EXPECT_EQ(r.other, "floor");
    if (r.time < 0.3) continue;  // it sinks in at first
    force += r.force;
    torque += r.torque;
  }
  const double instants = 350;  // in some of them it touches nothing
  const double weight = 1000 * 4.0 / 3 * M_PI * 0.001 * g;
  EXPECT_NEAR(force.z() / instants, weight, 0.02 * weight);
  EXPECT_NEAR(torque.y() / force.z(), -0.01, 0.001) << "rolling friction of the file";
}

std::string refusal(const std::string& motion, std::vector<std::string> bodies) {
  ContactScene s;
  s.add("box", test::block(1, {0.2, 0.2, 0.2}, 0.6), {{0, 0, 0.1}, Quat::Identity()});
  s.add_ground(0.6);
  s.move(motion);
  s.record(std::move(bodies));
  try {
    s.build();
  } catch (const SetupError& e) {
    return e.what();
  }
  return "it was accepted";
}

TEST(RecorderContacts, SaysWhyThereIsNothingToRecord) {
  EXPECT_NE(refusal("motion.point", {}).find("there are no contacts to record: no robot is moved by forces"),
            std::string::npos)
      << refusal("motion.point", {});
  EXPECT_NE(refusal("motion.simplified", {"bxo/*"}).find("no body matches `bxo/*`"), std::string::npos)
      << refusal("motion.simplified", {"bxo/*"});
}

TEST(RecorderContacts, ReplacesTheRowsSinceARestoredSnapshot) {
  ContactScene s;
  s.add("box", test::block(1, {0.2, 0.2, 0.2}, 0.5), {{0, 0, 0.12}, Quat::Identity()}, {{1, 0, 0}, {0, 0, 1}});
  s.add_ground(0.5);
  s.move("motion.ode");
  s.record();
  s.build();
  s.run_for(0.4);
  const Snapshot middle = s.snapshot();
  s.run_for(0.4);
  s.finish();
  const std::string straight = test::text_of(s.folder.path("contacts.csv"));
  s.restore(middle);
  s.run_for(0.4);
  s.finish();
  EXPECT_EQ(test::text_of(s.folder.path("contacts.csv")), straight);
  EXPECT_NE(straight.find("\n0.4,box/body,ground,"), std::string::npos) << "it touches when the snapshot is taken";
}

}  // namespace
}  // namespace muro
