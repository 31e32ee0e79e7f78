// SPDX-License-Identifier: MIT
// Scenes of robots that touch, for tests of the scene index and of collision algorithms.
#pragma once

#include <map>
#include <random>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/bodies.hpp"

namespace muro::test {

inline const Inertia unit_inertia = Inertia::from(1, Vec3::Zero(), 0.1 * Mat3::Identity());

/// Robots moved by forces (motion.simplified) or by commands (motion.point), without gravity, with the scene index and
/// one collision algorithm.
struct CollisionScene : Scene {
  std::string algorithm;
  std::map<std::string, ParameterInput> parameters, index_parameters;

  explicit CollisionScene(std::string collision = "collision.native") : algorithm(std::move(collision)) {
    world().set(world_object, keys::gravity, Vec3(0, 0, 0));
  }
  const RobotView& add_dynamic(const std::string& name, const RobotTree& tree, const Pose& start) {
    const RobotView& r = add(name, tree, start);
    use("motion.simplified", 100, {{&r, r.base()}});
    return r;
  }
  const RobotView& add_dynamic(const std::string& name, const Shape& shape, const Pose& start) {
    return add_dynamic(name, single_body(shape, unit_inertia), start);
  }
  const RobotView& add_kinematic(const std::string& name, const Shape& shape, const Pose& start) {
    const RobotView& r = add(name, single_body(shape, unit_inertia), start);
    use("motion.point", 100, {{&r, r.base()}});
    return r;
  }
  ObjectId add_scenery(const std::string& name, const Shape& shape, const Pose& pose) {
    world().add_scenery(name, pose, std::span<const Shape>(&shape, 1));
    return world().object(name);
  }
  void finish_setup() {
    use_kinematics();
    use("scene.bvh", 0, {}, index_parameters);
    use(algorithm, 100, {}, parameters);
    build();
  }
  /// Makes one step. Afterwards contacts are those of the poses before it.
  void step_once() { run_for(0.01); }
  std::vector<Contact> contacts(const RobotView& r) {
    const std::span<Contact> list = world().values(r.base(), keys::contacts);
    return {list.begin(), list.end()};
  }
};

/// A crowd on a field with obstacles, and random places for it.
struct Crowd : CollisionScene {
  std::vector<const RobotView*> all;
  std::mt19937_64 engine;

  /// `margin`: parameter of scene.bvh.
  explicit Crowd(double margin, unsigned seed = 1) : engine(seed) {
    index_parameters = {{"margin", margin}};
    add_ground();
    for (int i = 0; i < 20; ++i) {
      const Shape shapes[] = {Shape::box({0.5, 1, 2}), Shape::cylinder(0.4, 1)};
      world().add_scenery("obstacle" + std::to_string(i), place(), std::span<const Shape>(&shapes[i % 2], 1));
    }
    const Shape kinds[] = {Shape::box({1, 0.6, 0.4}), Shape::sphere(0.4), Shape::cylinder(0.4, 0.6),
                           Shape::capsule(0.3, 0.6)};
    for (int i = 0; i < 24; ++i) {
      const std::string name = "r" + std::to_string(i);
      all.push_back(i % 5 == 4 ? &add_kinematic(name, kinds[i % 4], {}) : &add_dynamic(name, kinds[i % 4], {}));
    }
    finish_setup();
  }
  Pose place() {
    std::uniform_real_distribution<double> at(-2.5, 2.5), up(0, 0.5), angle(-3, 3);
    return {{at(engine), at(engine), up(engine)}, from_rpy(angle(engine), angle(engine), angle(engine))};
  }
  void put(std::span<const Pose> poses) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      pose(*all[i]) = poses[i];
      twist(*all[i]) = {};
    }
  }
  std::vector<Contact> every_contact() {
    std::vector<Contact> contacts_of_all;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (i % 5 != 4)
        for (const Contact& c : contacts(*all[i])) contacts_of_all.push_back(c);
    return contacts_of_all;
  }
};

/// A wedge: half of the box from (0, 0, 0) to (1, 2, 4).
inline const char* const wedge =
    "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 4\nv 1 0 4\nv 0 2 4\n"
    "f 1 3 2\nf 4 5 6\nf 1 2 5 4\nf 2 3 6 5\nf 3 1 4 6\n";

template <class Interns>
Shape mesh_shape(Interns& texts, const std::string& file) {
  Shape mesh{.kind = ShapeKind::mesh, .size = {1, 1, 1}};
  mesh.mesh = texts.intern(file);
  return mesh;
}

/// Returns one body with a mesh and a box around its origin.
inline RobotTree meshed_body(const std::string& file) {
  return tree_of([&](RobotBuilder& b) {
    const Shape shapes[] = {mesh_shape(b, file), Shape::box({0.1, 0.1, 0.1})};
    b.base("body");
    b.set(keys::inertial, unit_inertia);
    b.set_array(keys::collision_shapes, std::span<const Shape>(shapes));
  });
}

}  // namespace muro::test
