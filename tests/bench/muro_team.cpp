// SPDX-License-Identifier: MIT
#include "tests/bench/muro_team.hpp"

namespace muro::bench {

CityScene::CityScene(const City& city) {
  add_ground(Rover::friction);
  int number = 0;
  for (const Block& b : city.blocks()) {
    const Shape box = Shape::box(b.lengths);
    world().add_scenery("block" + std::to_string(number++), {b.centre, Quat::Identity()}, std::span(&box, 1));
  }
  const RobotTree rover = read_model(MURO_TEST_SOURCE_DIR "/examples/models/rover.urdf");
  for (int v = 0; v < city.vehicles(); ++v) add(std::to_string(v), rover, city.starts()[std::size_t(v)]);
}

MuroTeam::MuroTeam(const City& city, int threads) : scene_(city) {
  scene_.use("motion.simplified", 1000, scene_.all_robots());
  scene_.use_contacts();
  set_threads(scene_, threads);
  scene_.build();
  for (const RobotView* r : scene_.world().robots()) {
    poses_.push_back(&scene_.pose(*r));
    std::array<double*, 4> targets{};
    const char* const wheels[] = {"front_left", "front_right", "rear_left", "rear_right"};
    for (std::size_t w = 0; w < 4; ++w)
      targets[w] =
          &scene_.world().value(std::string(r->name) + "/" + wheels[w] + "_wheel_joint", keys::joint_velocity_target);
    targets_.push_back(targets);
  }
}

void MuroTeam::command(int vehicle, WheelSpeeds speeds) {
  for (int w = 0; w < 4; ++w)
    *targets_[std::size_t(vehicle)][std::size_t(w)] = Rover::is_left(w) ? speeds.left : speeds.right;
}

}  // namespace muro::bench
