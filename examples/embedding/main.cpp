// SPDX-License-Identifier: MIT
// muro inside a program of your own, set up in C++ as in Section 2.1 of the MuRoSimF paper: a cart drives a circle.
#include <cstdio>

#include "core/simulation.hpp"
#include "muro/toolkit/rotations.hpp"
#include "muro/vocabulary.hpp"

namespace {

void wheel(muro::RobotBuilder& model, const char* joint, const char* body, double y) {
  model.translation({0, y, 0});
  model.revolute(joint, muro::Vec3::UnitY(), {});
  model.body(body);
  muro::Shape shape = muro::Shape::cylinder(0.05, 0.02);
  shape.origin.orientation = muro::from_rpy(M_PI / 2, 0, 0);  // its axis along the axle
  model.set_array(muro::keys::collision_shapes, std::span<const muro::Shape>(&shape, 1));
}

void run() {
  using namespace muro;
  Registry plugins(Registry::search_path());
  Simulation simulation(plugins);

  RobotTree cart;
  cart.base("cart");
  cart.fork();
  wheel(cart, "left_joint", "left_wheel", 0.15);
  cart.end();
  wheel(cart, "right_joint", "right_wheel", -0.15);
  cart.end();
  cart.close();
  const RobotView& robot = simulation.world().add_robot("cart", cart, {{0, 0, 0.05}, Quat::Identity()});

  const Item item{&robot, robot.base()};
  simulation.use("motion.differential_drive", 100, {item});
  simulation.use("kinematics.direct", 0, {item});
  simulation.build();

  simulation.world().value("cart/left_joint", keys::joint_velocity_target) = 8;  // rad/s
  simulation.world().value("cart/right_joint", keys::joint_velocity_target) = 10;
  for (int second = 0; second <= 10; ++second) {
    const Pose& pose = simulation.world().value("cart/cart", keys::pose);
    std::printf("t = %2d s  x = %7.4f m  y = %7.4f m  yaw = %7.4f rad\n", second, pose.position.x(), pose.position.y(),
                yaw_of(pose.orientation));
    simulation.run_for(1);
  }
}

}  // namespace

int main() {
  try {
    run();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
  return 0;
}
