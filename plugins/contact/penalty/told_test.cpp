// SPDX-License-Identifier: MIT
// Contacts that contact.penalty reports: every robot with a part in them gets them, with equal and opposite wrenches.
#include <gtest/gtest.h>

#include "penalty_testing.hpp"

namespace muro {
namespace {

using test::g;

struct ToldScene : test::ContactScene {
  ListIn<ContactWrench> told(const RobotView& robot) {
    PropertyStore& store = world().store();
    return ListIn<ContactWrench>(store.bind(store.add_accessor("the test"), robot.base(), keys::contact_wrenches_of_law,
                                            usage::read, Multiplicity::list, 1, nullptr));
  }
};

/// Returns the contacts of a list with a body of a robot, in the order of the list.
std::vector<ContactWrench> with_robot(const ListIn<ContactWrench>& list, const RobotView& other) {
  std::vector<ContactWrench> some;
  for (const ContactWrench& c : *list)
    if (c.other == other.base()) some.push_back(c);
  return some;
}

void expect_opposite(const std::vector<ContactWrench>& a, const std::vector<ContactWrench>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].body, b[i].other);
    EXPECT_EQ(a[i].other, b[i].body);
    EXPECT_EQ(a[i].point, b[i].point);
    EXPECT_EQ(a[i].depth, b[i].depth);
    EXPECT_EQ(a[i].normal, Vec3(-b[i].normal));
    EXPECT_EQ(a[i].wrench.force, Vec3(-b[i].wrench.force));
    EXPECT_EQ(a[i].wrench.torque, Vec3(-b[i].wrench.torque));
  }
}

Wrench total(const std::vector<ContactWrench>& contacts) {
  Wrench sum;
  for (const ContactWrench& c : contacts) sum.force += c.wrench.force, sum.torque += c.wrench.torque;
  return sum;
}

/// A ball falls on a box and rolls along it: an impact, then springs, friction and rolling resistance.
TEST(ToldContacts, OfTwoRobotsStandInTheListsOfBoth) {
  for (const bool swapped : {false, true}) {
    ToldScene s;
    Shape sphere = Shape::sphere(0.1);
    sphere.surface = {.friction = 0.8, .restitution = 0.3, .rolling_resistance = 0.004};
    const RobotView& box =
        s.add(swapped ? "b" : "a", test::block(5, {3, 1, 0.2}, 0.6), {{0, 0, 0.1}, Quat::Identity()});
    const RobotView& ball = s.add(swapped ? "a" : "b", test::single_body(sphere, test::round_body(1, 0.1)),
                                  {{-1, 0, 0.35}, Quat::Identity()}, {{1, 0, 0}, Vec3::Zero()});
    s.add_ground(0.6);
    const ListIn<ContactWrench> of_box = s.told(box), of_ball = s.told(ball);
    s.start();
    double largest = 0;
    for (int k = 0; k < 1000; ++k) {
      s.run_for(0.001);
      const std::vector<ContactWrench> seen = with_robot(of_ball, box);
      expect_opposite(with_robot(of_box, ball), seen);
      largest = std::max(largest, total(seen).force.norm());
    }
    const Wrench on_ball = total(with_robot(of_ball, box));
    EXPECT_GT(largest, 100) << "it has hit the box";
    EXPECT_NEAR(on_ball.force.z(), g, 1e-3 * g);
    EXPECT_NEAR(on_ball.torque.y(), -0.004 * g, 1e-3 * g) << "rolling resistance";
    double on_box = 0;
    for (const ContactWrench& c : *of_box) on_box += c.wrench.force.z();
    EXPECT_NEAR(on_box, 5 * g, 1e-3 * g) << "it weighs what it carries, too";
  }
}

TEST(ToldContacts, OfAKinematicRobotAreThoseOfWhoStandsOnIt) {
  ToldScene s;
  const RobotView& table = s.add("table", test::block(5, {1, 1, 0.2}, 0.6), {{0, 0, 0.9}, Quat::Identity()});
  std::vector<Item> boxes;
  for (int i = 0; i < 3; ++i) {
    const RobotView& r = s.add("box_" + std::to_string(i), test::block(1 + i, {0.2, 0.2, 0.2}, 0.6),
                               {{0.3 * (i - 1), 0, 1.1}, Quat::Identity()});
    boxes.push_back({&r, r.base()});
  }
  const ListIn<ContactWrench> of_table = s.told(table);
  s.use("motion.point", 1000, {{&table, table.base()}});
  s.use("motion.simplified", 1000, boxes);
  s.use_contacts();
  s.build();
  s.run_for(1);
  for (int i = 0; i < 3; ++i) {
    const Wrench by_box = total(with_robot(of_table, *boxes[std::size_t(i)].robot));
    EXPECT_NEAR(by_box.force.z(), -(1 + i) * g, 1e-6 * g) << i;
  }
  for (const ContactWrench& c : *of_table) {
    EXPECT_EQ(c.body, table.base());
    EXPECT_NEAR(c.normal.z(), -1, 1e-9) << "it is pushed downwards";
  }
}

/// Robots in contact, many enough to be divided among threads.
TEST(ToldContacts, AreTheSameOnAnyNumberOfThreads) {
  const auto seen = [](unsigned threads) {
    ToldScene s;
    const RobotView& table = s.add("table", test::block(50, {4, 4, 0.2}, 0.6), {{0, 0, 0.1}, Quat::Identity()});
    std::vector<Item> balls;
    for (int i = 0; i < 40; ++i) {
      const RobotView& r = s.add("ball_" + std::to_string(i), test::ball(1, 0.1, 0.5),
                                 {{0.19 * (i % 8), 0.19 * (i / 8), 0.3}, Quat::Identity()});
      balls.push_back({&r, r.base()});
    }
    const ListIn<ContactWrench> of_table = s.told(table), of_ball = s.told(*balls[9].robot);
    s.use("motion.point", 1000, {{&table, table.base()}});
    s.use("motion.simplified", 1000, balls);
    s.use_contacts();
    s.set_threads(threads);
    s.build();
    s.run_for(0.1);
    std::vector<double> numbers;
    for (const ListIn<ContactWrench>& list : {of_table, of_ball})
      for (const ContactWrench& c : *list)
        for (const Vec3& v : {c.point, c.normal, c.wrench.force}) numbers.insert(numbers.end(), v.data(), v.data() + 3);
    return numbers;
  };
  const std::vector<double> alone = seen(1);
  EXPECT_GT(alone.size(), 9u * 40);
  EXPECT_EQ(seen(3), alone);
}

TEST(ToldContacts, OfAShadowAreToldToNobodyElse) {
  ToldScene s;
  const RobotView& box = s.add("box", test::block(1, {0.2, 0.2, 0.2}, 0.6), {{0, 0, 0.1}, Quat::Identity()});
  const RobotView& shadow = s.add("shadow", test::block(1, {0.2, 0.2, 0.2}, 0.6), {{1, 0, 0.5}, Quat::Identity()});
  const RobotView& table = s.add("table", test::block(5, {0.4, 0.4, 0.4}, 0.6), {{1, 0, 0.2}, Quat::Identity()});
  s.world().set(shadow.base(), keys::shadow_of, box.base());
  s.add_ground();
  const ListIn<ContactWrench> of_shadow = s.told(shadow), of_table = s.told(table);
  s.start();
  s.run_for(0.3);
  EXPECT_NEAR(total(with_robot(of_shadow, table)).force.z(), g, 1e-3 * g);
  EXPECT_TRUE(with_robot(of_table, shadow).empty());
}

}  // namespace
}  // namespace muro
