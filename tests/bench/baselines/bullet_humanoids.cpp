// SPDX-License-Identifier: MIT
// Bullet: humanoids as btMultiBody in one world. Servos are torques that each step computes anew, which takes less than
// half the time of btMultiBodyJointMotor. Bullet has no rotors: the inertia of each is added to that of its link about
// its axis. Joints have no limits here, because no joint comes near them.
#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/bench/baselines/humanoids.hpp"

namespace muro::bench {

namespace {

constexpr int iterations = 4;

btVector3 bullet_vector(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
btQuaternion bullet_rotation(const Quat& q) { return {q.x(), q.y(), q.z(), q.w()}; }

btVector3 moments(const HumanoidBody& b, bool has_rotor) {
  const Inertia& i = b.inertia;
  const Vec3 rotor = has_rotor ? Vec3(Servo::armature * b.axis.cwiseAbs2()) : Vec3::Zero();
  return {i.ixx + rotor.x(), i.iyy + rotor.y(), i.izz + rotor.z()};
}

/// Returns the shape in a frame with its origin in the body's centre of mass, without a compound around it.
std::unique_ptr<btCollisionShape> shape_of(const HumanoidBody& body) {
  if (body.shapes.size() != 1) throw std::runtime_error("a body of the humanoid has more than one shape");
  const Shape& s = body.shapes.front();
  Pose pose = s.origin;
  pose.position -= body.inertia.com;
  if (s.kind == ShapeKind::box) {
    auto hull = std::make_unique<btConvexHullShape>();
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 signs(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, corner & 4 ? 0.5 : -0.5);
      hull->addPoint(bullet_vector(pose * Vec3(signs.cwiseProduct(s.size))), false);
    }
    hull->setMargin(0);
    hull->recalcLocalAabb();
    return hull;
  }
  const Vec3 half(0, 0, s.kind == ShapeKind::capsule ? 0.5 * s.size.z() : 0);
  const btVector3 centres[] = {bullet_vector(pose * half), bullet_vector(pose * Vec3(-half))};
  const btScalar radii[] = {s.size.x(), s.size.x()};
  return std::make_unique<btMultiSphereShape>(centres, radii, s.kind == ShapeKind::capsule ? 2 : 1);
}

class BulletHumanoids final : public Humanoids {
 public:
  BulletHumanoids(const HumanoidScene& scene, int friction_directions)
      : scene_(scene), com_(scene.bodies[0].inertia.com) {
    world_.setGravity({0, 0, -9.81});
    world_.setForceUpdateAllAabbs(false);
    btContactSolverInfo& solver = world_.getSolverInfo();
    solver.m_numIterations = iterations;
    // Two directions are Bullet's default for such robots; friction is then a cone.
    if (friction_directions == 1) {
      solver.m_solverMode &= ~SOLVER_USE_2_FRICTION_DIRECTIONS;
      solver.m_solverMode |= SOLVER_DISABLE_IMPLICIT_CONE_FRICTION;
    }
    ground_object_.setCollisionShape(&ground_);
    ground_object_.setFriction(std::sqrt(scene.friction));  // a pair has the product
    world_.addCollisionObject(&ground_object_, btBroadphaseProxy::StaticFilter,
                              btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter);
    for (const HumanoidBody& b : scene.bodies) shapes_.push_back(b.shapes.empty() ? nullptr : shape_of(b));
    targets_.resize(scene.robots() * scene.hinges());
    for (std::size_t r = 0; r < scene.robots(); ++r) add(r);
  }
  ~BulletHumanoids() override {
    for (const auto& c : colliders_) world_.removeCollisionObject(c.get());
    world_.removeCollisionObject(&ground_object_);
    for (const auto& r : robots_) world_.removeMultiBody(r.get());
  }
  BulletHumanoids(const BulletHumanoids&) = delete;
  BulletHumanoids& operator=(const BulletHumanoids&) = delete;

  void command(std::size_t robot, std::span<const double> targets) override {
    std::copy(targets.begin(), targets.end(), targets_.begin() + std::ptrdiff_t(robot * scene_.hinges()));
  }
  void run(int milliseconds) override {
    for (int i = 0; i < milliseconds; ++i) {
      drive();
      world_.stepSimulation(1e-3, 0);
    }
  }
  Pose trunk(std::size_t robot) const override {
    const btMultiBody& b = *robots_[robot];
    const btQuaternion q = b.getWorldToBaseRot().inverse();
    const btVector3& p = b.getBasePos();
    const Quat orientation(q.w(), q.x(), q.y(), q.z());
    return {Vec3(p.x(), p.y(), p.z()) - orientation * com_, orientation};
  }
  double position(std::size_t robot, std::size_t hinge) const override {
    return robots_[robot]->getJointPos(int(hinge));
  }

 private:
  void add(std::size_t robot) {
    const HumanoidBody& trunk = scene_.bodies[0];
    robots_.push_back(
        std::make_unique<btMultiBody>(int(scene_.hinges()), trunk.inertia.mass, moments(trunk, false), false, false));
    btMultiBody& b = *robots_.back();
    for (std::size_t i = 1; i < scene_.bodies.size(); ++i) {
      const HumanoidBody& body = scene_.bodies[i];
      const Vec3 to_joint = body.origin.position - scene_.bodies[std::size_t(body.parent)].inertia.com;
      b.setupRevolute(int(i) - 1, body.inertia.mass, moments(body, true), body.parent - 1,
                      bullet_rotation(body.origin.orientation.conjugate()), bullet_vector(body.axis),
                      bullet_vector(to_joint), bullet_vector(body.inertia.com), true);
    }
    b.finalizeMultiDof();
    b.setLinearDamping(0);
    b.setAngularDamping(0);
    b.setHasSelfCollision(false);
    const Pose& start = scene_.starts[robot];
    b.setBasePos(bullet_vector(start * com_));
    b.setWorldToBaseRot(bullet_rotation(start.orientation.conjugate()));
    for (std::size_t h = 0; h < scene_.hinges(); ++h) b.setJointPos(int(h), scene_.positions[robot][h]);
    world_.addMultiBody(&b);
    command(robot, scene_.positions[robot]);
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i)
      if (shapes_[i]) add_collider(b, int(i) - 1, *shapes_[i]);
    btAlignedObjectArray<btQuaternion> rotations;
    btAlignedObjectArray<btVector3> origins;
    b.forwardKinematics(rotations, origins);
    b.updateCollisionObjectWorldTransforms(rotations, origins);
  }

  void add_collider(btMultiBody& robot, int link, btCollisionShape& shape) {
    colliders_.push_back(std::make_unique<btMultiBodyLinkCollider>(&robot, link));
    btMultiBodyLinkCollider& c = *colliders_.back();
    c.setCollisionShape(&shape);
    c.setFriction(std::sqrt(scene_.friction));
    c.setActivationState(DISABLE_DEACTIVATION);
    world_.addCollisionObject(&c, btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter);
    if (link < 0)
      robot.setBaseCollider(&c);
    else
      robot.getLink(link).m_collider = &c;
  }

  void drive() {
    const double* target = targets_.data();
    for (const auto& r : robots_)
      for (int h = 0; h < int(scene_.hinges()); ++h) {
        const double most = scene_.bodies[std::size_t(h) + 1].effort;
        const double effort = Servo::stiffness * (*target++ - r->getJointPos(h)) - Servo::damping * r->getJointVel(h);
        r->addJointTorque(h, std::clamp(effort, -most, most));
      }
  }

  const HumanoidScene scene_;
  const Vec3 com_;  ///< of the trunk
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btMultiBodyConstraintSolver solver_;
  btMultiBodyDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btStaticPlaneShape ground_{btVector3(0, 0, 1), 0};
  btCollisionObject ground_object_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;  ///< of each body; null if it has no shape
  std::vector<std::unique_ptr<btMultiBody>> robots_;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
  std::vector<double> targets_;
};

}  // namespace

std::unique_ptr<Humanoids> bullet_humanoids(const HumanoidScene& scene, int friction_directions) {
  return std::make_unique<BulletHumanoids>(scene, friction_directions);
}

}  // namespace muro::bench
