// SPDX-License-Identifier: MIT
#include "tests/bench/muro_team.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

namespace muro::bench {
namespace {

constexpr const char* rover_urdf = MURO_TEST_SOURCE_DIR "/examples/models/rover.urdf";

/// Writes the rover's model without <dynamics> into a file of its own; returns the path.
std::string rover_without_joint_dynamics() {
  std::stringstream text;
  text << std::ifstream(rover_urdf).rdbuf();
  const auto file = std::filesystem::temp_directory_path() / ("muro_bench_" + std::to_string(::getpid()) + ".urdf");
  std::ofstream(file) << std::regex_replace(text.str(), std::regex("<dynamics [^>]*/>"), "");
  return file.string();
}

constexpr const char* corners[] = {"front_left", "front_right", "rear_left", "rear_right"};

}  // namespace

CityScene::CityScene(const City& city, Wheels wheels, bool joint_dynamics) {
  add_ground(Rover::friction);
  int number = 0;
  for (const Block& b : city.blocks()) {
    const Shape box = Shape::box(b.lengths);
    world().add_scenery("block" + std::to_string(number++), {b.centre, Quat::Identity()}, std::span(&box, 1));
  }
  const std::string model = joint_dynamics ? rover_urdf : rover_without_joint_dynamics();
  const RobotTree rover = read_model(model);
  if (!joint_dynamics) std::filesystem::remove(model);
  for (int v = 0; v < city.vehicles(); ++v) add(std::to_string(v), rover, city.starts()[std::size_t(v)]);
  if (wheels == Wheels::cylinders) return;
  for (const RobotView* r : world().robots())
    for (const char* const corner : corners)
      for (Shape& s :
           world().values(world().object(std::string(r->name) + "/" + corner + "_wheel"), keys::collision_shapes))
        s = {.kind = ShapeKind::sphere, .size = {s.size.x(), 0, 0}, .surface = s.surface};
}

std::vector<ObjectId> CityScene::add_lasers(const Pattern& pattern, double range, bool see_self,
                                            const std::string& method) {
  std::vector<ObjectId> sensors;
  std::vector<Item> items;
  for (const RobotView* r : world().robots()) {
    sensors.push_back(add_sensor_object(*r, "laser", r->base()));
    items.push_back({r, sensors.back()});
  }
  use(method, 10, items,
      {{"rays", std::int64_t(pattern.columns)},
       {"rows", std::int64_t(pattern.rows)},
       {"min_angle", -0.5 * pattern.horizontal_fov},
       {"max_angle", 0.5 * pattern.horizontal_fov},
       {"min_elevation", -0.5 * pattern.vertical_fov},
       {"max_elevation", 0.5 * pattern.vertical_fov},
       {"max_range", range},
       {"offset", std::vector{0.0, 0.0, scanner_height}},
       {"see_self", see_self}});
  return sensors;
}

MuroTeam::MuroTeam(const City& city, int threads, Wheels wheels, const Pattern* lasers, int rate)
    : MuroTeam(city, threads, wheels, MotionSetup{.rate = rate}, lasers) {}

MuroTeam::MuroTeam(const City& city, int threads, Wheels wheels, const MotionSetup& motion, const Pattern* lasers,
                   const std::string& method)
    : scene_(city, wheels, motion.joint_dynamics) {
  scene_.use(motion.motion, motion.rate, scene_.all_robots(), motion.parameters);
  if (motion.contact)
    scene_.use_contacts();
  else
    scene_.use_kinematics();
  if (lasers) scene_.add_lasers(*lasers, 5.6, false, method);
  scene_.set_threads(unsigned(threads));
  scene_.build();
  for (const RobotView* r : scene_.world().robots()) {
    poses_.push_back(&scene_.pose(*r));
    std::array<double*, 4> targets{};
    for (std::size_t w = 0; w < 4; ++w)
      targets[w] =
          &scene_.world().value(std::string(r->name) + "/" + corners[w] + "_wheel_joint", keys::joint_velocity_target);
    targets_.push_back(targets);
  }
}

void MuroTeam::command(int vehicle, WheelSpeeds speeds) {
  for (int w = 0; w < 4; ++w)
    *targets_[std::size_t(vehicle)][std::size_t(w)] = Rover::is_left(w) ? speeds.left : speeds.right;
}

TwoTeams::TwoTeams(const City& city)
    : first_(city, 1, Wheels::balls), second_(city, 1, Wheels::balls), thread_([this] { serve(); }) {}

TwoTeams::~TwoTeams() {
  requested_.store(-1);
  requested_.notify_one();
  thread_.join();
}

void TwoTeams::command(int vehicle, WheelSpeeds speeds) {
  first_.command(vehicle, speeds);
  second_.command(vehicle, speeds);
}

void TwoTeams::run(int milliseconds) {
  const int requested = requested_.load() + milliseconds;
  requested_.store(requested);
  requested_.notify_one();
  first_.run(milliseconds);
  while (done_.load() != requested) std::this_thread::yield();
}

void TwoTeams::serve() {
  for (int done = 0;; done_.store(done)) {
    requested_.wait(done);
    const int requested = requested_.load();
    if (requested < 0) return;
    second_.run(requested - done);
    done = requested;
  }
}

MuroScanners::MuroScanners(const City& city, const Pattern& pattern, double range, int threads) : scene_(city) {
  scene_.use("motion.point", 10, scene_.all_robots());  // without commands: each stays where it is put
  scene_.use_kinematics();
  scene_.use("scene.bvh", 0);
  sensors_ = scene_.add_lasers(pattern, range, true);
  scene_.set_threads(unsigned(threads));
  scene_.build();
  for (const RobotView* r : scene_.world().robots()) poses_.push_back(&scene_.pose(*r));
}

void MuroScanners::scan(std::span<const Pose> poses, bool moved) {
  for (std::size_t v = 0; v < poses.size() && moved; ++v) *poses_[v] = poses[v];
  scene_.run_for(0.1);
}

double MuroScanners::range(int vehicle, int ray) const {
  return scene_.world().values(sensors_[std::size_t(vehicle)], keys::ranges)[std::size_t(ray)];
}

}  // namespace muro::bench
