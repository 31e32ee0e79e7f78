// SPDX-License-Identifier: MIT
// A bumper: reads whether an object touches a link.
#include <algorithm>
#include <cmath>

#include "muro/plugin.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/sensor/common/internal_sensor/link_contacts.hpp"
#include "plugins/sensor/common/internal_sensor/mounted.hpp"
#include "plugins/sensor/common/internal_sensor/property_uses.hpp"

namespace {

using namespace muro;
using namespace muro::internal_sensor;

constexpr Parameter parameters[] = {
    real("threshold", "N", 0, "force from which on it is pressed, at motions by forces; 0: any touch").between(0, 1e9),
    boolean("ignore_ground", false, "what pushes it upwards, to 45 deg, does not press it"),
};
constexpr PropertyUse reads[] = {
    {"contacts", "of the robot: where the collision algorithm answers for them"},
    reads_contacts_of_motion,
    reads_contacts_of_law,
    reads_contact_world,
};
constexpr PropertyUse writes[] = {{"bumper.pressed", "1: something touches the link"}};
constexpr Description description{
    .id = "sensor.bumper",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary = "Whether something touches a link",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

/// Data of one bumper.
struct Bumper {
  ObjectId link = no_object;
  ListIn<Contact> places;  ///< contacts of a robot that no force moves; unset if the bumper compares forces
  LinkContacts contacts;   ///< contacts with their forces
  Out<std::uint32_t> pressed;
};

class BumperSensor final : public PerRobotAlgorithm<Bumper> {
 public:
  void step(const Step&, Range range) override {
    for (const Bumper& b : robots(range)) {
      *b.pressed = touches(b) || presses(b) ? 1 : 0;
    }
  }

 private:
  void read_parameters(const Parameters& p) override {
    threshold_ = p.real("threshold");
    ignore_ground_ = p.boolean("ignore_ground");
  }

  Bumper connect_robot(Connector& c, const Item& item) override {
    const RobotView& view = *item.robot;
    Bumper b;
    b.link = view.links[carrying_link(c, item)].object;
    if (c.constant_array(b.link, keys::collision_shapes).empty())
      throw Error(quote(c.object_name(b.link)) + " has no collision shape that something could touch");
    b.contacts = {c, view, carrying_link(c, item)};
    if (b.contacts.reads_other_robots()) set_reads_other_robots();
    if (!is_moved_by_forces(c, view) || !b.contacts.any()) connect_kinematic(c, view, b);
    b.pressed = c.variable(item.object, keys::bumper_pressed, std::uint32_t{0});
    return b;
  }

  /// Connects a robot that no force moves. Bodies that forces move push it with a force; other contacts have none.
  void connect_kinematic(Connector& c, const RobotView& view, Bumper& b) {
    const bool compares = c.parameters().real("threshold") > 0;
    if (compares && b.contacts.any()) return;
    if (compares)
      throw Error("no force moves " + quote(view.name) +
                  ", and no robot that forces move could push it, so there is none to compare with the threshold; "
                  "remove it");
    const bool finds_places = c.is_used(view.base(), keys::contacts, usage::derived);
    if (finds_places) b.places = c.read_list(view.base(), keys::contacts);
    if (finds_places || b.contacts.any()) return;
    throw Error("nobody looks for contacts of " + quote(view.name) +
                ", which no force moves; give its motion `on_contact: stop`, and the scenario a collision algorithm");
  }

  bool counts(const Vec3& push) const { return !ignore_ground_ || push.z() < std::sqrt(0.5); }

  bool touches(const Bumper& b) const {
    if (!b.places) return false;
    const std::span<const Contact> all = *b.places;
    return std::any_of(all.begin(), all.end(), [&](const Contact& c) { return c.self == b.link && counts(c.normal); });
  }

  bool presses(const Bumper& b) const {
    double force = 0;
    bool any = false;
    const auto add = [&](const ContactWrench& c, double sign) {
      if (!counts(sign * c.normal)) return;
      const double push = c.normal.dot(c.wrench.force);
      any = any || push > 0 || !std::isfinite(push);
      if (push > 0) force += push;
    };
    b.contacts.each_of_law(add);
    b.contacts.each_of_engines(b.contacts.is_dynamic(), add);
    return any && force >= threshold_;
  }

  double threshold_ = 0;  ///< N
  bool ignore_ground_ = false;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<BumperSensor>(description)};

}  // namespace

MURO_PLUGIN(.name = "sensor_bumper", .version = description.version, .licence = "MIT", .summary = "A bumper",
            .algorithms = algorithms)
