// SPDX-License-Identifier: MIT
// Humanoids look at goals, lines and each other by their cameras; the true places of all of these are known.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "examples/common/robot_testing.hpp"
#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

struct Stand {
  double x = 0, y = 0, yaw = 0;  ///< m, rad
};

/// Returns the field with robots, given as text of a scenario with an indentation of two spaces.
std::string field_with(const std::string& robots) {
  return R"(
world: {file: SOCCER/field.sdf}
robots:
)" + robots;
}
/// Returns players with cameras that stand as in the walk.
std::string watchers(const std::string& name, const std::vector<Stand>& places, double pan, double tilt,
                     bool is_red = false) {
  std::string list;
  for (const Stand& s : places)
    list += (list.empty() ? "" : ", ") + std::string("{x: ") + std::to_string(s.x) + ", y: " + std::to_string(s.y) +
            ", yaw: " + std::to_string(s.yaw) + "}";
  return "  " + name + R"(:
    model: MODELS/humanoid.urdf
    count: )" +
         std::to_string(places.size()) + "\n    place: {list: [" + list + R"(]}
    motion: {use: motion.biped, rate: 100, feet: [l_foot_link, r_foot_link], interpolate: 0.01}
    joints: {l_sho_roll: -1.3, r_sho_roll: 1.3, l_el: -0.4, r_el: 0.4, l_hip_pitch: -0.47, l_knee: 0.94, l_ank_pitch: -0.47,
             r_hip_pitch: -0.47, r_knee: 0.94, r_ank_pitch: -0.47, head_pan: )" +
         std::to_string(pan) + ", head_tilt: " + std::to_string(tilt) + R"(}
    camera: {use: camera.opengl, on: camera_link, rate: 5, width: 160, height: 120, horizontal_fov: 1.0123, shadows: false}
    imu: {use: sensor.imu, on: imu_link, rate: 5}
    look:
      use: controller.library
      library: look
      rate: 5
      inputs: ["joint.position=head_pan:joint.position,head_tilt:joint.position"]
      outputs: ["joint.position.target=head_pan:joint.position.target,head_tilt:joint.position.target"]
      tunables: [trunk_height=0.257]
    materials: {team: {color: )" +
         (is_red ? "[0.8, 0.08, 0.08]" : "[0.1, 0.35, 0.8]") + "}}\n";
}
std::string ball(double x, double y) {
  return "  ball: {shape: {sphere: 0.07}, mass: 0.205, color: [1, 1, 1], texture: SOCCER/ball.png, at: {x: " +
         std::to_string(x) + ", y: " + std::to_string(y) + "}, motion: {use: motion.point}}\n";
}

/// Robots on the field after their first picture.
class Looks {
 public:
  explicit Looks(const std::string& robots) : built_(build(read_scenario(file(robots), {}), test::plugins())) {
    simulation().run_for(0.01);
  }
  Simulation& simulation() { return *built_.simulation; }
  std::vector<double> told(const std::string& robot, const std::string& name, const std::string& unit) {
    const World& world = simulation().world();
    return example_test::values_of(world, world.find_robot(robot)->base(), name, unit);
  }
  std::vector<double> posts(const std::string& robot) { return told(robot, "goal.seen", "1, m, m"); }
  std::vector<double> players(const std::string& robot) { return told(robot, "players.seen", "1, m, m, 1"); }
  std::vector<double> lines(const std::string& robot) { return told(robot, "lines.seen", "1, m, m"); }
  /// Returns a point of the field in the heading frame of a robot.
  Vec3 own(const std::string& robot, double x, double y) {
    const Pose& p = simulation().world().value(simulation().world().find_robot(robot)->base(), keys::pose);
    const Vec3 ahead = p.orientation * Vec3::UnitX();
    const Vec3 level = Vec3(ahead.x(), ahead.y(), 0).normalized(), d(x - p.position.x(), y - p.position.y(), 0);
    return {level.dot(d), level.x() * d.y() - level.y() * d.x(), 0};
  }

 private:
  std::string file(const std::string& robots) {
    std::string text = field_with(robots);
    const auto replace = [&](const std::string& what, const std::string& by) {
      for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
    };
    replace("SOCCER", MURO_TEST_SOURCE_DIR "/examples/soccer");
    replace("MODELS", MURO_TEST_SOURCE_DIR "/examples/models");
    return folder_.file("field.yaml", text);
  }
  test::ScratchFolder folder_;
  BuiltScenario built_;
};

std::string nth(const std::string& name, std::size_t i) { return name + "_" + std::to_string(i); }
/// Returns the distance (m) from `to` to the nearest of the reported points, `stride` numbers each.
double nearest(const std::vector<double>& told, std::size_t stride, const Vec3& to) {
  double least = 1e3;
  for (std::size_t i = 0; i < std::size_t(told[0]); ++i)
    least = std::min(least, std::hypot(told[1 + stride * i] - to.x(), told[2 + stride * i] - to.y()));
  return least;
}

constexpr double post_x = 4.475, post_y = 1.35;  // m: axes of posts

TEST(Look, FindsPostsWithinATwentiethOfTheirDistance) {
  const std::vector<double> distances = {0.9, 1.6, 2.4, 3.3, 4.2, 5.1};
  std::vector<Stand> places;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double a = 2.4 + 0.3 * double(i);
    places.push_back({post_x + distances[i] * std::cos(a), post_y + distances[i] * std::sin(a), a + M_PI - 0.1});
  }
  Looks looks(watchers("watcher", places, 0, 0.25));
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const std::vector<double> seen = looks.posts(nth("watcher", i));
    EXPECT_GE(seen[0], 1) << distances[i];
    const Vec3 truth = looks.own(nth("watcher", i), post_x, post_y);
    EXPECT_LT(nearest(seen, 2, truth), 0.01 + 0.05 * distances[i]) << distances[i] << " m";
  }
}

TEST(Look, NamesTheLeftPostFirst) {
  Looks looks(watchers("watcher", {{0.5, 0, 0}, {-0.3, 0.4, 3.1}}, 0, 0.1));
  for (const char* name : {"watcher_0", "watcher_1"}) {
    const std::vector<double> seen = looks.posts(name);
    ASSERT_EQ(seen[0], 2) << name;
    EXPECT_NEAR(seen[2] - seen[4], 2 * post_y, 0.25) << name;
  }
}

TEST(Look, TakesNothingElseForAPostOrAPlayer) {
  // lines, the ball and its own arms and feet; a ball on a line; a net from behind, and from within
  Looks looks(watchers("down", {{0.5, 0, 0}, {1, 2.6, 1}, {2.5, 2.2, 0}}, 1.2, 0.85) +
              watchers("ahead", {{3, -2.7, -1.5}, {-2.7, 0.5, 1.4}, {4.75, 0.4, 0}, {-4.9, -0.3, 3.1}}, 0, 0.35) +
              ball(-2.55, 1.6));
  for (const char* name : {"down_0", "down_1", "down_2", "ahead_0", "ahead_1", "ahead_2", "ahead_3"}) {
    EXPECT_EQ(looks.posts(name)[0], 0) << name;
    EXPECT_EQ(looks.players(name)[0], 0) << name;
  }
}

TEST(Look, FindsPlayersAndTheirTeams) {
  Looks looks(watchers("blue", {{-1, 0, 0}, {-0.12, 0.36, 1}, {1.3, 0.2, -2}}, 0, 0.3) +
              watchers("red", {{0.6, -0.22, 3}, {-0.3, -0.28, 0.4}}, 0, 0.3, true));
  const std::vector<double> seen = looks.players("blue_0");
  ASSERT_EQ(seen[0], 4);
  for (const auto& [x, y, team] :
       {std::tuple(-0.12, 0.36, 1), std::tuple(1.3, 0.2, 1), std::tuple(0.6, -0.22, -1), std::tuple(-0.3, -0.28, -1)}) {
    const Vec3 truth = looks.own("blue_0", x, y);
    bool found = false;
    for (std::size_t i = 0; i < 4; ++i)
      found |= std::hypot(seen[1 + 3 * i] - truth.x(), seen[2 + 3 * i] - truth.y()) < 0.03 + 0.05 * truth.norm() &&
               seen[3 + 3 * i] == team;
    EXPECT_TRUE(found) << x << ", " << y;
  }
}

TEST(Look, FindsPointsOfLinesWithinCentimetres) {
  Looks looks(watchers("watcher", {{-0.9, -0.4, 0.3}, {0.8, 1.2, 0.9}, {2.2, -1.8, -1.1}}, 0, 0.45));
  for (const char* name : {"watcher_0", "watcher_1", "watcher_2"}) {
    const std::vector<double> seen = looks.lines(name);
    EXPECT_GE(seen[0], 10) << name;
    const Pose& p = looks.simulation().world().value(looks.simulation().world().find_robot(name)->base(), keys::pose);
    const Vec3 ahead = p.orientation * Vec3::UnitX();
    for (std::size_t i = 0; i < std::size_t(seen[0]); ++i) {
      const double fx = seen[1 + 2 * i], fy = seen[2 + 2 * i];
      const double x = std::abs(p.position.x() + ahead.x() * fx - ahead.y() * fy);
      const double y = std::abs(p.position.y() + ahead.y() * fx + ahead.x() * fy);
      // centre line, circle, touch line, goal line, penalty area, goal area, penalty mark
      const double off = std::min({x, std::abs(std::hypot(x, y) - 0.75), std::abs(y - 2.975), std::abs(x - 4.475),
                                   std::max(std::abs(x - 2.525), y - 2.475), std::max(std::abs(y - 2.475), 2.525 - x),
                                   std::max(std::abs(x - 3.525), y - 1.475), std::max(std::abs(y - 1.475), 3.525 - x),
                                   std::hypot(x - 3, y)});
      EXPECT_LT(off, 0.01 + 0.015 * (fx * fx + fy * fy)) << name << ": " << fx << ", " << fy;
    }
  }
}

TEST(Look, GlancesUpFromABallInSightAndFindsItAgain) {
  Looks looks(watchers("watcher", {{1.6, 0.4, 0}}, 0, 0.4) + ball(2.8, 0.4));
  double oldest = 0, highest = 1;
  int posts = 0;
  for (int k = 0; k < 28; ++k) {
    looks.simulation().run_for(0.2);
    if (k > 3) oldest = std::max(oldest, looks.told("watcher_0", "ball.seen", "1, m, m, s")[3]);
    posts += looks.posts("watcher_0")[0] > 0;
    highest = std::min(highest, looks.simulation().world().value("watcher_0/head_tilt", keys::joint_position));
  }
  EXPECT_LT(highest, 0.2) << "rad: up";
  EXPECT_LT(oldest, 1.3) << "s";
  EXPECT_GE(posts, 2) << "pictures";
}

/// Robots look at objects at random places of the field; errors are judged by the distance of the objects.
TEST(SlowLook, ErrorsGrowWithTheDistanceAndHardlyAnythingIsFalse) {
  std::mt19937 random(5);
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  double post_error = 0, player_error = 0;
  int posts = 0, players = 0, false_posts = 0, false_players = 0;
  for (int round = 0; round < 12; ++round) {
    std::vector<Stand> blue, red;
    for (int i = 0; i < 8; ++i) {
      const Stand s{uniform(-3.8, 3.8), -2.8 + 0.8 * i + uniform(-0.2, 0.2), uniform(-M_PI, M_PI)};
      (i % 2 ? red : blue).push_back(s);
    }
    Looks looks(watchers("blue", blue, uniform(-0.6, 0.6), uniform(0.1, 0.4)) +
                watchers("red", red, uniform(-0.6, 0.6), uniform(0.1, 0.4), true));
    std::vector<Stand> all = blue;
    all.insert(all.end(), red.begin(), red.end());
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::string name = i < 4 ? nth("blue", i) : nth("red", i - 4);
      const auto own = [&](const Stand& s) { return looks.own(name, s.x, s.y); };
      for (const auto& [told, stride, truths] :
           {std::tuple(looks.posts(name), 2,
                       std::vector<Stand>{{post_x, post_y}, {post_x, -post_y}, {-post_x, post_y}, {-post_x, -post_y}}),
            std::tuple(looks.players(name), 3, all)})
        for (std::size_t k = 0; k < std::size_t(told[0]); ++k) {
          double least = 1e3, distance = 1;
          for (const Stand& s : truths) {
            const Vec3 truth = own(s);
            const double e = std::hypot(told[1 + std::size_t(stride) * k] - truth.x(),
                                        told[2 + std::size_t(stride) * k] - truth.y());
            if (e < least && truth.norm() > 0.1) least = e, distance = truth.norm();
          }
          const bool is_false = least > 0.2 + 0.1 * distance;
          (stride == 2 ? false_posts : false_players) += is_false;
          if (is_false) continue;
          (stride == 2 ? post_error : player_error) += least / distance;
          ++(stride == 2 ? posts : players);
        }
    }
  }
  EXPECT_GT(posts, 20);
  EXPECT_LT(post_error / posts, 0.03);
  EXPECT_LE(false_posts, 0.1 * posts) << "heads beside a net, and tubes behind a post";
  EXPECT_GT(players, 60);
  EXPECT_LT(player_error / players, 0.05);
  EXPECT_LE(false_players, 0.1 * players);
}

/// A robot that walks by forces towards a goal, with its head on a ball near a post.
TEST(Look, SeesPostsWhileItWalks) {
  const std::vector<std::string> alone = {"robots.red=off",
                                          "robots.blue_keeper=off",
                                          "robots.red_keeper=off",
                                          "robots.blue.count=1",
                                          "robots.blue.variants={}",
                                          "robots.blue.play=off",
                                          "robots.blue.place={list: [{x: 1.3, y: 1.1}]}",
                                          "robots.ball.at={x: 3.9, y: 1.1}",
                                          "algorithms={}"};
  BuiltScenario built =
      build(read_scenario(MURO_TEST_SOURCE_DIR "/examples/soccer/match.yaml", alone), test::plugins());
  Simulation& s = *built.simulation;
  const ObjectId base = s.world().find_robot("blue_0")->base();
  double errors = 0;
  int seen = 0;
  s.run_for(2.01);
  const double start = s.world().value(base, keys::pose).position.x();
  for (int k = 0; k < 15; ++k) {
    s.run_for(0.2);
    const auto told = s.world().values(base, Key<double>{"goal.seen", "1, m, m", ""});
    const Pose& p = s.world().value(base, keys::pose);
    const Vec3 ahead = p.orientation * Vec3::UnitX(), d(post_x - p.position.x(), post_y - p.position.y(), 0);
    const double x = ahead.x() * d.x() + ahead.y() * d.y(), y = ahead.x() * d.y() - ahead.y() * d.x();
    if (told[0] == 0) continue;
    ++seen, errors += std::hypot(told[1] - x, told[2] - y);
  }
  EXPECT_GT(s.world().value(base, keys::pose).position.x(), start + 0.15) << "m: it walks";
  EXPECT_GE(seen, 4) << "of 15 pictures";
  EXPECT_LT(errors / seen, 0.2) << "m";
}

}  // namespace
}  // namespace muro::host
