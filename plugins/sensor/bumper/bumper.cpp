// SPDX-License-Identifier: MIT
// A bumper: whether something touches a link.
#include <algorithm>
#include <cmath>

#include "muro/plugin.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "plugins/common/internal_sensor/link_load.hpp"
#include "plugins/common/internal_sensor/mounted.hpp"
#include "plugins/common/internal_sensor/property_uses.hpp"
#include "plugins/common/text/quote.hpp"

namespace {

using namespace muro;
using namespace muro::internal_sensor;

constexpr Parameter parameters[] = {
    real("threshold", "N", 0, "force from which on it is pressed, at motions by forces; 0: any touch").between(0, 1e9),
    boolean("ignore_ground", false, "what pushes it upwards, to 45 deg, does not press it"),
};
constexpr PropertyUse reads[] = {
    {"contacts", "of the robot: where the collision algorithm answers for them"},
    {"contact.wrenches.motion", "of the robot, at motions by engines"},
    reads_contacts_of_law,
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

/// What is kept of a bumper.
struct Bumper {
  ObjectId link = no_object;
  ListIn<Contact> contacts;                 ///< of a robot that no force moves
  ListIn<ContactWrench> by_law, by_motion;  ///< of one that forces move
  Out<std::uint32_t> pressed;
};

class BumperSensor final : public PerRobotAlgorithm<Bumper> {
 public:
  void step(const Step&, Range range) override {
    for (const Bumper& b : robots(range)) {
      const bool pressed = touches(b) || presses(b, b.by_law) || presses(b, b.by_motion);
      *b.pressed = pressed ? 1 : 0;
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
    const auto has = [&](const KeyInfo& key) { return c.is_used(view.base(), key, usage::derived); };
    if (has(keys::contact_wrenches_of_law)) b.by_law = c.read_list(view.base(), keys::contact_wrenches_of_law);
    if (has(keys::contact_wrenches_of_motion)) b.by_motion = c.read_list(view.base(), keys::contact_wrenches_of_motion);
    if (!b.by_law && !b.by_motion) {
      if (c.parameters().real("threshold") > 0)
        throw Error("no force moves " + quote(view.name) +
                    ", so there is none to compare with the threshold; remove it");
      if (!c.is_used(view.base(), keys::contacts, usage::derived))
        throw Error(
            "nobody looks for contacts of " + quote(view.name) +
            ", which no force moves; give its motion `on_contact: stop`, and the scenario a collision algorithm");
      b.contacts = c.read_list(view.base(), keys::contacts);
    }
    b.pressed = c.variable(item.object, keys::bumper_pressed, std::uint32_t{0});
    return b;
  }

  bool counts(const Vec3& push) const { return !ignore_ground_ || push.z() < std::sqrt(0.5); }

  bool touches(const Bumper& b) const {
    if (!b.contacts) return false;
    const std::span<const Contact> all = *b.contacts;
    return std::any_of(all.begin(), all.end(), [&](const Contact& c) { return c.self == b.link && counts(c.normal); });
  }

  bool presses(const Bumper& b, const ListIn<ContactWrench>& list) const {
    if (!list) return false;
    double force = 0;
    bool any = false;
    for (const ContactWrench& c : *list) {
      const double sign = c.body == b.link ? 1 : c.other == b.link ? -1 : 0;
      if (sign == 0 || !counts(sign * c.normal)) continue;
      const double push = c.normal.dot(c.wrench.force);
      any = any || push > 0 || !std::isfinite(push);
      if (push > 0) force += push;
    }
    return any && force >= threshold_;
  }

  double threshold_ = 0;  ///< N
  bool ignore_ground_ = false;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<BumperSensor>(description)};

}  // namespace

MURO_PLUGIN(.name = "sensor_bumper", .version = description.version, .licence = "MIT", .summary = "A bumper",
            .algorithms = algorithms)
