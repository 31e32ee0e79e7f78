// SPDX-License-Identifier: MIT
// Encoders of joints: position in steps, velocity from steps.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "muro/plugin.hpp"
#include "muro/toolkit/mass_properties.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "muro/vocabulary/sensor.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/sensor/common/internal_sensor/mounted.hpp"

namespace {

using namespace muro;
using link_motion::JointMotion;

constexpr Parameter parameters[] = {
    texts("joints",
          "joints that it looks at, a name may end with *; the readings are arrays then, in the order of the model. "
          "Default: the one joint that `on` names"),
    integer("counts", 0, "steps in a turn of the encoder; 0: none, it reads the true position").between(0, 1 << 30),
    real("resolution", "rad or m", 0, "length of a step, instead of counts; for joints that shift").between(0, 1e3),
    real("gear", "1", 1, "turns of the encoder in a turn of the joint").between(1e-6, 1e6),
    boolean("single_turn", false, "it is absolute within a turn of its own, so that readings wrap"),
};
constexpr PropertyUse reads[] = {{"joint.position", "of the joints"}, {"joint.velocity", "of the joints"}};
constexpr PropertyUse writes[] = {
    {"encoder.position", "of the joint, or an array"},
    {"encoder.velocity", "likewise: steps since the last reading by the time, true without steps"},
    {"encoder.count", "likewise: steps; 0 without steps"},
    {"encoder.joint", "constant, where all joints turn or all shift"},
};
constexpr Description description{
    .id = "sensor.encoder",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary = "Position and velocity of joints as encoders count them",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

/// One joint and the destination of its readings.
struct Channel {
  JointMotion joint;
  double step = 0;      ///< rad or m; 0: none
  double per_turn = 0;  ///< steps of a turn of an encoder that is absolute within one turn; 0: readings do not wrap
  double *position = nullptr, *velocity = nullptr;
  std::int64_t* count = nullptr;

  double steps_at(double position_of_joint) const { return std::floor(position_of_joint / step + 0.5); }
  double wrapped(double steps) const { return per_turn == 0 ? steps : steps - per_turn * std::floor(steps / per_turn); }
  /// Returns the shorter way round.
  double moved(double steps) const {
    return per_turn == 0 ? steps : steps - per_turn * std::floor(steps / per_turn + 0.5);
  }

  /// `is_first`: there is no earlier reading for a difference.
  void read(bool is_first, double dt) const {
    const double q = joint.position(), v = joint.velocity();
    if (step == 0) {
      *position = q, *velocity = v;
      return;
    }
    const double now = wrapped(steps_at(q));
    const double before = is_first ? wrapped(steps_at(q - v * dt)) : double(*count);
    *count = std::int64_t(now);
    *position = now * step;
    *velocity = moved(now - before) * step / dt;
  }
};

class Encoder final : public PerRobotAlgorithm<Range> {
 public:
  void step(const Step& step, Range range) override {
    for (const Range& device : robots(range))
      for (const Channel& channel : channels_[device]) channel.read(step.index == 0, step.dt);
  }

 private:
  Range connect_robot(Connector& c, const Item& item) override {
    if (c.parameters().integer("counts") > 0 || c.parameters().real("resolution") > 0) internal_sensor::require_rate(c);
    const std::vector<std::uint32_t> links = internal_sensor::sensed_joints(c, item, "joints");
    const bool is_array = !c.parameters().texts("joints").empty();
    const auto size = std::uint32_t(links.size());
    const auto bind = [&](const auto& key, auto none) {
      return is_array ? (*c.variable_array(item.object, key, size)).data() : c.variable(item.object, key, none).get();
    };
    double* const position = bind(keys::encoder_position, 0.0);
    double* const velocity = bind(keys::encoder_velocity, 0.0);
    std::int64_t* const count = bind(keys::encoder_count, std::int64_t{0});
    const std::vector<double> start = initial_joint_positions(c, *item.robot);
    std::vector<Channel> channels;
    for (std::uint32_t k = 0; k < size; ++k) {
      const std::uint32_t link = links[k];
      Channel channel =
          steps_of(c.parameters(), item.robot->links[link], c.object_name(item.robot->links[link].joint_object));
      channel.joint = JointMotion(c, *item.robot, link, start[link], link_motion::Order::twist);
      channel.position = position + k, channel.velocity = velocity + k, channel.count = count + k;
      channels.push_back(channel);
    }
    tell_joint(c, item, links);
    return channels_.add(channels);
  }

  static void tell_joint(Connector& c, const Item& item, const std::vector<std::uint32_t>& links) {
    const Rows<Link> all = item.robot->links;
    const auto shifts = [&](std::uint32_t i) { return all[i].joint == JointKind::prismatic; };
    const bool first = shifts(links.front());
    if (std::all_of(links.begin(), links.end(), [&](std::uint32_t i) { return shifts(i) == first; }))
      c.set(item.object, keys::encoder_joint, all[links.front()].joint_object);
  }

  /// Returns a channel with the steps of an encoder on a joint.
  static Channel steps_of(const Parameters& p, const Link& link, std::string_view joint) {
    const auto counts = double(p.integer("counts"));
    if (counts > 0 && p.given("resolution"))
      throw Error("counts and resolution both say how long a step is; remove one of them");
    if (counts > 0 && link.joint == JointKind::prismatic)
      throw Error(quote(joint) + " shifts, so it has no turns to count steps in; give `resolution` in m");
    if (p.boolean("single_turn") && counts == 0) throw Error("single_turn needs `counts`, the steps of a turn");
    Channel channel;
    channel.step = counts > 0 ? 2 * std::numbers::pi / counts / p.real("gear") : p.real("resolution") / p.real("gear");
    channel.per_turn = p.boolean("single_turn") ? counts : 0;
    return channel;
  }

  PackedLists<Channel> channels_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Encoder>(description)};

}  // namespace

MURO_PLUGIN(.name = "sensor_encoder", .version = description.version, .licence = "MIT", .summary = "Encoders of joints",
            .algorithms = algorithms)
