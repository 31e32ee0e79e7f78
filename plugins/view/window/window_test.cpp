// SPDX-License-Identifier: MIT
// The window as a user sees it: on a display without a screen (Xvfb), driven by mouse and keys (xdotool), checked by
// its pictures.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <thread>

#include "tests/support/bodies.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"
#include "tests/support/picture.hpp"

namespace muro {
namespace {

using Settings = std::map<std::string, ParameterInput>;
using namespace std::chrono_literals;

bool is_there(const char* program) { return test::run_command(std::string("command -v ") + program).exit_code == 0; }

/// A display of its own for all tests of this program.
class Display {
 public:
  Display() {
    int ends[2];
    if (pipe(ends) != 0) return;
    server_ = fork();
    if (server_ == 0) {
      dup2(ends[1], 3);
      execlp("Xvfb", "Xvfb", "-displayfd", "3", "-screen", "0", "1280x800x24", "-nolisten", "tcp", nullptr);
      _exit(1);
    }
    close(ends[1]);
    std::string number;
    for (char letter = 0; read(ends[0], &letter, 1) == 1 && letter != '\n';) number += letter;
    close(ends[0]);
    if (!number.empty()) name_ = ":" + number;
  }
  ~Display() {
    if (server_ <= 0) return;
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
  }
  const std::string& name() const { return name_; }

 private:
  pid_t server_ = -1;
  std::string name_;
};

using Picture = test::Picture<>;

/// Mean colour of a square of 20 pixels, 0..255.
Vec3 about(const Picture& picture, std::uint32_t x, std::uint32_t y) {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t row = y - 10; row < y + 10; ++row)
    for (std::uint32_t column = x - 10; column < x + 10; ++column)
      for (std::uint32_t k = 0; k < 3; ++k) sum[k] += picture.values[3 * (row * picture.width + column) + k] / 400.0;
  return sum;
}

constexpr int width = 1100, height = 700;
constexpr int middle_x = 679, middle_y = 286;  ///< middle of the area that the panels leave free

/// A red box on the ground in the middle of the window, a robot that drives behind it.
struct Show : test::Scene {
  const RobotView* robot;
  test::ScratchFolder folder;

  Show() {
    Shape box = Shape::box({1, 1, 1});
    box.color = {0.9, 0.1, 0.1, 1};
    add_ground();
    world().add_scenery("box", {{0, 0, 0.5}, Quat::Identity()}, std::span<const Shape>(&box, 1));
    robot = &add("robot", test::block(1, {0.4, 0.4, 0.2}, 0.5), {{-3, 0, 0.1}, Quat::Identity()});
  }
  std::string picture() const { return folder.path("window.png"); }
  void use_window(const Settings& more) {
    Settings settings{
        {"width", std::int64_t(width)},           {"height", std::int64_t(height)},       {"speed", 0.0},
        {"from", std::vector<double>{6, 0, 1.3}}, {"to", std::vector<double>{0, 0, 0.6}}, {"picture", picture()}};
    if (more.count("follow") > 0) settings.erase("from"), settings.erase("to");
    for (const auto& [name, value] : more) settings[name] = value;
    use("motion.point", 100, all_robots());
    use_kinematics();
    use("scene.bvh", 0);
    const ObjectId scanner = add_sensor_object(*robot, "laser", robot->base());
    use("laser.raycast", 10, {{robot, scanner}}, {{"rays", std::int64_t(90)}});
    use("view.window", 60, {}, settings);
    build();
    world().value(robot->base(), keys::command_twist) = {{1, 0, 0}, {0, 0, 0.5}};
  }
};

struct TheWindow : ::testing::Test {
  void SetUp() override {
    if (!is_there("Xvfb") || !is_there("xdotool")) GTEST_SKIP() << "needs the packages xvfb and xdotool";
    static const Display display;
    ASSERT_NE(display.name(), "") << "Xvfb gives no display";
    ::setenv("DISPLAY", display.name().c_str(), 1);
    ::unsetenv("WAYLAND_DISPLAY");
  }
  static void drive(const std::string& what) { test::run_command("xdotool " + what); }
  static void click(int x, int y) {
    drive("mousemove " + std::to_string(x) + " " + std::to_string(y) + " sleep 0.2 mousedown 1 sleep 0.1 mouseup 1");
  }
};

constexpr int play_x = 43, step_x = 120, controls_y = 26;

using SlowWindow = TheWindow;

TEST_F(TheWindow, ShowsTheSceneBetweenItsPanels) {
  Show s;
  s.use_window({});
  s.run_for(0.5);
  s.finish();
  const Picture p(s.picture());
  ASSERT_EQ(p.width, std::uint32_t(width));
  ASSERT_EQ(p.height, std::uint32_t(height));
  const Vec3 middle = about(p, middle_x, middle_y);
  EXPECT_GT(middle.x(), 2 * middle.y()) << "the red box";
  const Vec3 sky = about(p, middle_x, 90), ground = about(p, middle_x + 250, middle_y + 150);
  EXPECT_GT(sky.z(), sky.x() + 15) << "blue above";
  EXPECT_LT(std::abs(ground.x() - ground.z()), 40) << "grey below";
  for (const auto& [x, y] : {std::pair{600U, 40U}, {100U, 400U}, {900U, 660U}})
    EXPECT_LT(about(p, x, y).sum(), 330) << "panels are dark: " << x << ", " << y;
}

TEST_F(TheWindow, StaysWithTheRobotsThatMove) {
  test::Scene s;
  s.add_ground();
  const test::ScratchFolder folder;
  Shape red = Shape::box({0.8, 0.8, 0.4}), grey = red;
  red.color = {0.9, 0.1, 0.1, 1};
  const RobotView& goes =
      s.add("goes", test::single_body(red, test::solid_box(1, red.size)), {{0, 0, 0.2}, Quat::Identity()});
  s.add("stays", test::single_body(grey, test::solid_box(1, red.size)), {{0, 6, 0.2}, Quat::Identity()});
  s.use("motion.point", 100, s.all_robots());
  s.use("view.window", 60, {},
        {{"width", std::int64_t(640)},
         {"height", std::int64_t(480)},
         {"panels", false},
         {"speed", 0.0},
         {"pictures", 1000.0},
         {"picture", folder.path("window.png")}});
  s.build();
  s.world().value(goes.base(), keys::command_twist) = {{8, 0, 0}, Vec3::Zero()};
  s.run_for(5);
  s.world().value(goes.base(), keys::command_twist) = {};
  s.run_for(4);  // the camera comes to rest at it
  s.finish();
  const Vec3 middle = about(Picture(folder.path("window.png")), 320, 240);
  EXPECT_GT(middle.x(), 2 * middle.y()) << "40 m from where it started, it is in the middle";
}

TEST_F(TheWindow, GivesTheSameStateAsWithoutIt) {
  std::uint64_t hashes[2];
  for (const bool view : {false, true}) {
    Show s;
    if (view) {
      s.use_window({{"pictures", 5.0}});
    } else {
      s.use("motion.point", 100, s.all_robots());
      s.use_kinematics();
      s.use("scene.bvh", 0);
      s.use("laser.raycast", 10, {{s.robot, s.add_sensor_object(*s.robot, "laser", s.robot->base())}},
            {{"rays", std::int64_t(90)}});
      s.build();
      s.world().value(s.robot->base(), keys::command_twist) = {{1, 0, 0}, {0, 0, 0.5}};
    }
    s.set_threads(2);
    s.run_for(2);
    hashes[view] = s.state_hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

/// Runs for `seconds` of simulated time. Meanwhile a user watches for a second, and then repeats `act` until the run is
/// over: on a busy machine two clicks may fall into one frame and count as one. Returns the number of acts, or 0 when
/// the run was over before.
int acts_until_over(Simulation& simulation, double seconds, const std::function<void()>& act) {
  std::atomic<bool> over{false};
  int acts = 0;
  std::thread hand([&] {
    std::this_thread::sleep_for(1s);
    for (; !over && acts < 30; ++acts) {
      act();
      for (int i = 0; i < 20 && !over; ++i) std::this_thread::sleep_for(50ms);
    }
  });
  simulation.run_for(seconds);
  over = true;
  hand.join();
  return acts;
}

TEST_F(TheWindow, WaitsWhilePausedUntilPlayIsPressed) {
  Show s;
  s.use_window({{"paused", true}});
  EXPECT_GE(acts_until_over(s, 0.5, [] { click(play_x, controls_y); }), 1);
  EXPECT_EQ(s.now(), 500'000'000);
}

TEST_F(SlowWindow, GoesFrameByFrameByItsButton) {
  Show s;
  s.use_window({{"paused", true}});
  // at 0, 1/60 and 2/60 s
  EXPECT_GE(acts_until_over(s, 0.04, [] { click(step_x, controls_y); }), 3);
}

TEST_F(SlowWindow, PausesAndPlaysByTheSpaceBar) {
  Show s;
  s.use_window({{"paused", true}});
  const auto act = [] { drive("mousemove 550 300 search --name muro windowfocus sleep 0.2 key space"); };
  EXPECT_GE(acts_until_over(s, 0.1, act), 1);
}

TEST_F(SlowWindow, HoldsTheSpeedThatItIsTold) {
  Show s;
  s.use_window({{"speed", 0.5}});
  const auto start = std::chrono::steady_clock::now();
  s.run_for(0.5);
  EXPECT_GT(std::chrono::steady_clock::now() - start, 900ms) << "half as fast as real time";
}

TEST_F(TheWindow, ShowsThePropertiesOfWhatIsClickedOn) {
  Show s;
  s.use_window({{"paused", true}});
  const Vec3 corner = [&] {
    acts_until_over(s, 0.1, [] {
      for (int i = 0; i < 2; ++i) {  // on a busy machine a frame may take longer than a click
        click(middle_x, middle_y);
        std::this_thread::sleep_for(500ms);
      }
      click(play_x, controls_y);
    });
    s.finish();
    return about(Picture(s.picture()), width - 30, 130);
  }();
  EXPECT_LT(corner.sum(), 330) << "a panel where the scene was";
}

/// Returns the x of a robot whose pose a user edits, with `pause` between the actions.
double edited_x(std::chrono::milliseconds pause) {
  Show s;
  s.use_window({{"paused", true}, {"follow", std::string("robot")}});
  s.world().value(s.robot->base(), keys::command_twist) = {};
  bool edited = false;
  const auto act = [&] {
    // the fifth row, after constants of the model, is the pose: opens it and enters another x
    TheWindow::click(731, 182);
    std::this_thread::sleep_for(pause);
    TheWindow::click(805, 202);
    std::this_thread::sleep_for(pause / 2);
    TheWindow::drive("search --name muro windowfocus");
    for (const char* key : {"2", "period", "5"}) {
      std::this_thread::sleep_for(pause / 2);
      TheWindow::drive(std::string("key ") + key);
    }
    std::this_thread::sleep_for(pause / 2);
    TheWindow::drive("keydown Return sleep 1 keyup Return sleep 0.3");
    edited = true;
    TheWindow::click(play_x, controls_y);
  };
  EXPECT_GE(acts_until_over(s, 0.05, [&] { edited ? TheWindow::click(play_x, controls_y) : act(); }), 1);
  return s.pose(*s.robot).position.x();
}

TEST_F(SlowWindow, ChangesAPropertyThatTheUserEdits) {
  double x = edited_x(500ms);
  for (int tries = 0; tries < 3 && x != 2.5; ++tries) x = edited_x(2s);  // a busy machine misses fast input
  EXPECT_EQ(x, 2.5);
}

TEST_F(SlowWindow, TakesAsManySamplesAsTheDriverHas) {
  Show s;
  std::string said;
  s.set_log([&](LogLevel, std::string_view text) { said += std::string(text) + "\n"; });
  s.use_window({{"samples", std::int64_t(16)}});
  s.run_for(0.1);
  s.finish();
  EXPECT_SAYS(said, "samples is 16, but this driver of OpenGL has at most ");
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  const Picture p(s.picture());
  const Vec3 middle = about(p, middle_x, middle_y);
  EXPECT_GT(middle.x(), 2 * middle.y()) << "the red box";
}

TEST_F(TheWindow, MayLoseItsDisplayAndTheRunGoesOn) {
  auto own = std::make_unique<Display>();
  ASSERT_NE(own->name(), "");
  ::setenv("DISPLAY", own->name().c_str(), 1);
  Show s;
  std::string said;
  s.set_log([&](LogLevel, std::string_view text) { said += std::string(text) + "\n"; });
  s.use_window({{"picture", std::string()}, {"width", std::int64_t(320)}, {"height", std::int64_t(240)}});
  s.run_for(0.1);
  own.reset();
  for (int tries = 0; said.empty() && tries < 100; ++tries) {
    std::this_thread::sleep_for(50ms);
    s.run_for(0.1);
  }
  const std::int64_t lost = s.now();
  s.run_for(1);
  EXPECT_EQ(s.now(), lost + 1'000'000'000);
  EXPECT_SAYS(said, "the display of the window is gone; the run goes on without it\n");
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
}

TEST_F(TheWindow, SaysWhatToDoWhereThereIsNoDisplay) {
  ::setenv("DISPLAY", ":no-such-display", 1);
  Show s;
  std::string said;
  try {
    s.use_window({});
  } catch (const std::exception& e) {
    said = e.what();
  }
  EXPECT_NE(said.find("there is no display to open a window on"), std::string::npos) << said;
  EXPECT_NE(said.find("muro render"), std::string::npos) << said;
}

TEST_F(TheWindow, ExplainsWhatIsWrongWithItsParameters) {
  const auto complaint = [](const Settings& settings) -> std::string {
    Show s;
    try {
      s.use_window(settings);
    } catch (const SetupError& e) {
      return e.what();
    }
    return {};
  };
  EXPECT_NE(complaint({{"follow", std::string("nobody")}}).find("`nobody`, which is neither a robot nor a part of one"),
            std::string::npos);
  EXPECT_NE(complaint({{"from", std::vector<double>{1, 2}}}).find("three numbers"), std::string::npos);
}

}  // namespace
}  // namespace muro
