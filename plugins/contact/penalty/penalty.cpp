// SPDX-License-Identifier: MIT
// Contact forces by penalty: springs and dampers where bodies overlap. Scene-wide.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "contact_law.hpp"
#include "grip.hpp"
#include "muro/composite.hpp"
#include "muro/plugin.hpp"
#include "muro/random.hpp"
#include "patch.hpp"
#include "standings.hpp"

namespace {

using namespace muro;
using namespace muro::penalty;

constexpr Parameter parameters[] = {
    real("frequency", "Hz", 50, "stiffness: that of a body bobbing on a contact; at most 0.095 of the rate")
        .between(1, 1e5),
};
constexpr Use reads[] = {
    {"contacts", "of every robot that forces move"},
    {"pose", "of every body with a collision shape"},
    {"twist", "of every body with a collision shape"},
    {"inertial", "of every body of robots that forces move"},
};
constexpr Use writes[] = {
    {"wrench.external", "of every robot that forces move"},
    {"contact.grips", "friction springs, of every robot that forces move"},
    {"contact.time", "of the last run, on the world object"},
};
constexpr Description description{
    .id = "contact.penalty",
    .kind = Kind::contact,
    .version = "1.0.0",
    .summary = "Spring-damper contact with restitution and Coulomb friction, stiffness from effective masses",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .promises = deterministic | allocation_free | restorable,
};

/// Normals of one patch differ by less than 8 degrees.
constexpr double same_direction = 0.99;

class Penalty final : public Algorithm {
 public:
  void connect(Connector& c) override {
    omega_ = 2 * M_PI * c.parameters().real("frequency");
    host_ = &c.host();
    bodies_.resize(c.object_count());
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
      bodies_[i].name = fnv1a(c.object_name(ObjectId{i}));
      bodies_[i].whole = i;
    }
    for (std::uint32_t i = 0; i < bodies_.size(); ++i)
      for (const Shape& s : c.constant_array(ObjectId{i}, keys::collision_shapes)) note_restitution(s.restitution);
    number_.assign(c.robots().size(), nobody);
    for (const RobotView* robot : c.robots()) connect_robot(c, *robot);
    last_run_ = c.variable(world_object, last_run, std::int64_t{-1});
  }

  void start() override {
    for (Robot& r : robots_) {
      r.standing.clear();
      r.standing.simple = false;
      r.standing.view.base_pose = r.base->position.data();
      r.standing.view.base_twist = r.twist->linear.data();
      r.standing.view.mass = &r.mass;
      r.standing.view.wrench = r.wrench->force.data();
    }
  }
  void restored() override { start(); }

  /// First every robot that stands on scenery with one patch, which is nearly every one; then the others.
  std::span<const Phase> phases() const override {
    static constexpr Phase phases[] = {{Phase::Over::robots, Phase::Reach::own}, {Phase::Over::whole}};
    return phases;
  }

  void step(const Step& step, Range range) override {
    const double elapsed = *last_run_ < 0 ? 0 : 1e-9 * double(step.time - *last_run_);
    if (step.phase == 0) return stand(step.dt, elapsed, range);
    *last_run_ = step.time;
    left_.clear();
    for (std::uint32_t i = 0; i < robots_.size(); ++i)
      if (robots_[i].left) left_.push_back(i);
    set_stiffness(step.dt);
    if (left_.empty()) return;
    elapsed_ = elapsed;
    for (const std::uint32_t i : left_) {
      *robots_[i].wrench = Wrench{};
      robots_[i].placed = false;
    }
    touches_.clear();
    touch_of_.clear();
    for (const std::uint32_t i : left_) gather(i);
    for (Touch& t : touches_) share(t);
    for (const std::uint32_t i : left_)
      if (robots_[i].placed) robots_[i].load = robots_[i].resistance.greatest(robots_[i].mobility);
    for (Touch& t : touches_) t.friction = FrictionLaw(stiffness_, load_of(t));
    std::size_t next = 0;
    for (const std::uint32_t i : left_) next = push(i, next);
  }

 private:
  static constexpr std::int32_t nobody = -1;
  static constexpr std::uint32_t not_ours = 0xffffffffu;

  /// What a step needs of an object.
  struct Body {
    const Pose* pose = nullptr;    ///< null: scenery
    const Twist* twist = nullptr;  ///< null: scenery, which does not move
    std::int32_t robot = nobody;   ///< in robots_, when forces move it
    std::uint32_t whole = 0;       ///< equal for all bodies of a robot
    std::uint64_t name = 0;        ///< hash
  };
  /// A robot that forces move.
  struct Robot {
    ListIn<Contact> contacts;
    ListOut<Grip> grips;
    Sum<Wrench> wrench;
    In<Pose> base;
    In<Twist> twist;
    double inverse_mass = 0;
    Vec3 com = Vec3::Zero();
    Mat3 inverse_inertia = Mat3::Zero();  ///< axes of the base
    std::uint64_t rank = 0;               ///< of two robots, the one with the lower rank works out their contacts
    StandingMass mass;
    Standing standing;
    bool left = false;  ///< for the second phase
    // of the present step:
    bool placed = false;
    Mobility mobility;
    Resistance resistance;  ///< of all its contacts, in units of omega^2
    double load = 0;        ///< its stiffest motion, in units of omega^2
  };
  /// A patch between a robot and something else.
  struct Touch {
    Patch patch;
    std::uint32_t self;            ///< in robots_
    std::int32_t other;            ///< in robots_, or nobody
    std::uint32_t whole;           ///< of the other
    double along = 0, across = 0;  ///< effective mass of each point, kg
    double inverse_across = 0;
    double restitution = -1;  ///< that `normal` is for
    NormalLaw normal{};
    FrictionLaw friction{};
  };

  void connect_robot(Connector& c, const RobotView& view) {
    const bool moved = c.is_used(view.base(), keys::external_wrench, Access::read_sum);
    for (const Frame& f : view.frames) {
      Body& b = bodies_[index_of(f.object)];
      b.whole = index_of(view.base());
      b.robot = moved ? std::int32_t(robots_.size()) : nobody;
      if (c.constant_array(f.object, keys::collision_shapes).empty()) continue;
      b.pose = c.read(f.object, keys::pose).get();
      b.twist = c.read(f.object, keys::twist).get();
    }
    if (!moved) return;
    const Inertia composite = composite_inertia(view.frames, inertias_of(c, view), initial_joint_positions(c, view));
    if (!(composite.mass > 0))
      throw Error("`" + std::string(view.name) +
                  "` has no mass, so no contact can push it; give its bodies `inertial`");
    Robot r;
    r.contacts = c.read_list(view.base(), keys::contacts);
    r.grips = c.variable_list(view.base(), grips);
    r.wrench = c.accumulate(view.base(), keys::external_wrench);
    r.base = c.read(view.base(), keys::pose);
    r.twist = c.read(view.base(), keys::twist);
    r.inverse_mass = 1 / composite.mass;
    r.com = composite.com;
    r.inverse_inertia = composite.tensor().inverse();
    r.rank = view.key;
    r.mass.inverse_mass = r.inverse_mass;
    std::copy_n(r.com.data(), 3, r.mass.com);
    std::copy_n(r.inverse_inertia.data(), 9, r.mass.inverse_inertia);
    number_[view.number] = std::int32_t(robots_.size());
    robots_.push_back(r);
  }

  void note_restitution(double restitution) {
    for (const Material& m : materials_)
      if (m.restitution == restitution) return;
    materials_.push_back({restitution, damping_ratio_of(restitution)});
  }
  std::uint32_t material_of(double restitution) const {
    std::uint32_t i = 0;
    while (i + 1 < materials_.size() && materials_[i].restitution != restitution) ++i;
    return i;
  }

  /// Whether the kernels serve a robot with these contacts.
  bool recognise(Robot& r, std::span<const Contact> contacts) const {
    Standing& s = r.standing;
    s.clear();
    if (contacts.empty() || contacts.size() > most_contacts) return false;
    const std::uint32_t whole = bodies_[index_of(contacts[0].other)].whole;
    s.restitution = contacts[0].restitution;
    for (const Contact& c : contacts) {
      const Body &self = bodies_[index_of(c.self)], &other = bodies_[index_of(c.other)];
      if (other.twist || other.robot != nobody || other.whole != whole || c.restitution != s.restitution) return false;
      s.add(c, pair_of(self.name, other.name, c.self_shape, c.other_shape), self.pose->position.data(),
            self.twist->linear.data());
    }
    s.kind = s.signature(material_of(s.restitution));
    return true;
  }

  /// Robots of one kind, which wait until they fill a lane.
  struct Queue {
    std::uint32_t count = 0;
    Robot* robots[8];
  };

  void stand(double dt, double elapsed, Range range) {
    StandingWork work;
    work.omega = std::min(omega_, finest_step / dt);
    work.h = dt;
    work.elapsed = elapsed;
    work.same_direction = same_direction;
    constexpr std::size_t kinds = 4;
    Queue queues[kinds];
    std::size_t oldest = 0;
    for (std::uint32_t number = range.begin; number < range.end; ++number) {
      if (number_[number] == nobody) continue;
      Robot& r = robots_[std::size_t(number_[number])];
      const auto contacts = *r.contacts;
      const auto springs = *r.grips;
      r.left = false;
      if (contacts.empty()) {
        r.grips.clear();
        *r.wrench = Wrench{};
        continue;
      }
      if (!r.standing.matches(contacts, springs)) {
        r.standing.simple = recognise(r, contacts);
        r.left = !r.standing.simple || !r.standing.matches(contacts, springs);
        if (r.left) r.standing.clear();
        if (r.left) continue;
      }
      r.standing.view.contacts = contacts[0].point.data();
      r.standing.view.grips = springs[0].point.data();
      std::size_t q = 0;
      while (q < kinds && !(queues[q].count > 0 && queues[q].robots[0]->standing.kind == r.standing.kind)) ++q;
      if (q == kinds)
        for (q = 0; q < kinds && queues[q].count > 0;) ++q;
      if (q == kinds) serve(work, queues[q = oldest++ % kinds]);
      queues[q].robots[queues[q].count++] = &r;
      if (queues[q].count == 8) serve(work, queues[q]);
    }
    for (Queue& q : queues) serve(work, q);
  }

  /// Serves and empties a queue.
  void serve(StandingWork& work, Queue& q) const {
    if (q.count == 0) return;
    const Standing& first = q.robots[0]->standing;
    first.describe(work);
    work.zeta = materials_[material_of(first.restitution)].damping_ratio;
    work.z = std::tanh(work.zeta * work.omega * work.h);
    const StandingRobot* views[8];
    for (std::uint32_t i = 0; i < 8; ++i) views[i] = &q.robots[i < q.count ? i : 0]->standing.view;
    unsigned left = 0;
    if (q.count >= 4)  // a lane costs less than four robots one by one; who fills it up is served like itself
      left = kernels_->push_eight(work, views);
    else
      for (std::uint32_t i = 0; i < q.count; ++i) left |= kernels_->push_one(work, views + i) << i;
    for (std::uint32_t i = 0; i < q.count; ++i) q.robots[i]->left = (left >> i & 1) != 0;
    q.count = 0;
  }

  /// As stiff as wanted, as far as the step resolves it.
  void set_stiffness(double dt) {
    if (dt == stiffness_.h) return;
    stiffness_ = {std::min(omega_, finest_step / dt), dt};
    if (stiffness_.omega < omega_ && !std::exchange(told_, true))
      host_->log(LogLevel::info, "contact.penalty: at a step of " + std::to_string(dt) + " s, contacts have " +
                                     std::to_string(stiffness_.omega / (2 * M_PI)) + " Hz instead of " +
                                     std::to_string(omega_ / (2 * M_PI)) +
                                     "; a higher rate of motion makes them as stiff as asked");
  }

  /// Whether robot `self` works out the contact: both robots of a pair list it.
  bool owns(std::uint32_t self, std::int32_t other) const {
    if (other == nobody) return true;
    const std::uint64_t mine = robots_[self].rank, theirs = robots_[std::size_t(other)].rank;
    return mine != theirs ? mine < theirs : self < std::uint32_t(other);
  }

  void place(Robot& r) const {
    if (r.placed) return;
    r.placed = true;
    r.resistance = Resistance{};
    const Mat3 turn = r.base->orientation.toRotationMatrix();
    r.mobility = {r.inverse_mass, turn * r.inverse_inertia * turn.transpose(), r.base->position + turn * r.com};
  }

  /// Sorts the contacts of a robot into patches.
  void gather(std::uint32_t self) {
    const auto contacts = *robots_[self].contacts;
    if (contacts.empty()) return;
    place(robots_[self]);
    const std::size_t first = touches_.size();
    for (const Contact& contact : contacts) {
      const Body& other = bodies_[index_of(contact.other)];
      if (!owns(self, other.robot)) {
        touch_of_.push_back(not_ours);
        continue;
      }
      std::size_t t = touches_.size();
      while (t > first && !(touches_[t - 1].whole == other.whole &&
                            touches_[t - 1].patch.normal().dot(contact.normal) > same_direction))
        --t;
      if (t == first) {
        t = touches_.size() + 1;
        touches_.push_back({Patch(contact.normal, contact.point), self, other.robot, other.whole});
        if (other.robot != nobody) place(robots_[std::size_t(other.robot)]);
      }
      touches_[t - 1].patch.add(contact.point);
      touch_of_.push_back(std::uint32_t(t - 1));
    }
  }

  /// Shares the effective mass of a patch among its points, and adds their springs to those of its robots.
  void share(Touch& t) {
    Robot& a = robots_[t.self];
    Robot* const b = t.other == nobody ? nullptr : &robots_[std::size_t(t.other)];
    Yield middle = t.patch.at_middle(a.mobility);
    if (b) middle = middle + t.patch.at_middle(b->mobility);
    t.along = 1 / (middle.along * t.patch.count());
    t.inverse_across = 0.5 * middle.across * t.patch.count();
    t.across = 1 / t.inverse_across;
    a.resistance += t.patch.resistance(a.mobility, t.along, t.across);
    if (b) b->resistance += t.patch.resistance(b->mobility, t.along, t.across);
  }

  /// The velocity of the point of a body, m/s.
  static Vec3 velocity(const Body& body, const Vec3& point) {
    return body.twist ? body.twist->at(point - body.pose->position) : Vec3::Zero();
  }

  static Vec3 centre_velocity(const Robot& r) { return r.twist->at(r.mobility.centre - r.base->position); }

  double load_of(const Touch& t) const {
    return robots_[t.self].load + (t.other == nobody ? 0 : robots_[std::size_t(t.other)].load);
  }

  /// The law of a patch for a restitution; a patch rarely has two.
  const NormalLaw& normal_law(Touch& t, double restitution) {
    if (restitution == t.restitution) return t.normal;
    if (restitution != restitution_) {
      restitution_ = restitution;
      damping_ratio_ = damping_ratio_of(restitution);
    }
    t.restitution = restitution;
    return t.normal = NormalLaw(stiffness_, damping_ratio_, load_of(t));
  }

  /// Works out the contacts of a robot; theirs begin at `next` in touch_of_. Returns where the next robot's begin.
  std::size_t push(std::uint32_t self, std::size_t next) {
    Robot& robot = robots_[self];
    const auto contacts = *robot.contacts;
    const auto old = *robot.grips;
    if (contacts.empty() && old.empty()) return next;
    old_grips_.assign(old.begin(), old.end());
    robot.grips.clear();
    Wrench total;
    std::size_t ours = 0;
    for (const Contact& contact : contacts) {
      const std::uint32_t place_of_touch = touch_of_[next++];
      if (place_of_touch == not_ours) continue;
      Touch& touch = touches_[place_of_touch];
      const std::uint64_t pair = pair_of(bodies_[index_of(contact.self)].name, bodies_[index_of(contact.other)].name,
                                         contact.self_shape, contact.other_shape);
      const Grip* const before = previous(old_grips_, ours++, pair, contact.point);
      Grip grip{pair, contact.point, before ? before->stretch : Vec3::Zero()};
      const Vec3 force = force_on_self(touch, contact, grip.stretch);
      robot.grips.push_back(grip);
      total.add_force(force, contact.point - robot.base->position);
      if (touch.other != nobody) push_back(robot, robots_[std::size_t(touch.other)], force, contact.point, before);
    }
    *robot.wrench += total;
    return next;
  }

  /// The force of a contact on the other robot. The levers are those of the middle of the step, to which both centres
  /// and the point move on: so the pair keeps its angular momentum.
  void push_back(const Robot& robot, const Robot& other, const Vec3& force, const Vec3& point,
                 const Grip* before) const {
    other.wrench->add_force(-force, point - other.base->position);
    const Vec3 v = centre_velocity(robot), u = centre_velocity(other);
    Vec3 wander = 0.5 * (v + u);  // velocity of the point, which belongs to no body
    if (before && elapsed_ > 0) {
      const Vec3 seen = (point - before->point) / elapsed_;
      if ((seen - wander).norm() <= (v - u).norm()) wander = seen;  // else it is another point
    }
    robot.wrench->torque += (0.5 * stiffness_.h * (wander - v)).cross(force);
    other.wrench->torque -= (0.5 * stiffness_.h * (wander - u)).cross(force);
  }

  /// `stretch`: of the friction spring, brought up to date.
  Vec3 force_on_self(Touch& touch, const Contact& contact, Vec3& stretch) {
    const Vec3& n = contact.normal;
    const Vec3 motion = velocity(bodies_[index_of(contact.self)], contact.point) -
                        velocity(bodies_[index_of(contact.other)], contact.point);
    const double approach = -motion.dot(n);
    const Vec3 slip = motion + approach * n;
    const double normal = touch.along * normal_law(touch, contact.restitution).force(contact.depth, approach);
    stretch += slip * elapsed_;
    stretch -= n * n.dot(stretch);
    return normal * n +
           touch.across * touch.friction.force(stretch, slip, contact.friction * normal * touch.inverse_across);
  }

  struct Material {
    double restitution, damping_ratio;
  };

  const StandingKernels* kernels_ = &standing_kernels_for(lane::best_isa());
  double omega_ = 0;
  std::vector<Material> materials_;   ///< of all shapes; a pair has the larger restitution of two
  std::vector<std::int32_t> number_;  ///< by robot number: in robots_
  Host* host_ = nullptr;
  bool told_ = false;
  std::vector<Body> bodies_;  ///< by object id
  std::vector<Robot> robots_;
  std::vector<std::uint32_t> left_;  ///< robots of the second phase
  Out<std::int64_t> last_run_;

  // of the present step
  Stiffness stiffness_;
  double elapsed_ = 0;  ///< s since the last run
  std::vector<Touch> touches_;
  std::vector<std::uint32_t> touch_of_;  ///< one a contact, in the order of robots and lists
  std::vector<Grip> old_grips_;
  double restitution_ = -1, damping_ratio_ = 0;  ///< the last answer of damping_ratio_of
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Penalty>(description)};

}  // namespace

MURO_PLUGIN(.name = "contact_penalty", .version = "1.0.0", .licence = "MIT", .summary = "Contact forces by penalty",
            .algorithms = algorithms)
