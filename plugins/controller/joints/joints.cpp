// SPDX-License-Identifier: MIT
// Joints and the velocity of a base, set and read by programs outside of the simulation; see README.md.
#include <array>
#include <cmath>
#include <memory>
#include <type_traits>

#include "axes.hpp"
#include "joint_group.hpp"
#include "muro/plugin.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/wire_protocol/group_text.hpp"
#include "plugins/controller/common/wire_protocol/wire_controller.hpp"

namespace {

using namespace muro;
using namespace muro::joints;

static_assert(std::is_trivially_copyable_v<AxisState> && std::has_unique_object_representations_v<AxisState>,
              "a state block is compared and hashed byte by byte");

constexpr std::string_view endings[] = {"stop", "hold"};
constexpr auto parameters = [] {
  const auto common = wire::wire_parameters(
      "\"arm=shoulder,elbow\", \"base=command.twist\": what is read and set together; joints with * and ?; default: "
      "`all` joints, and `base`",
      "joints");
  std::array<Parameter, common.size() + 2> all{};
  std::copy(common.begin(), common.end(), all.begin());
  all[common.size()] =
      text("on_disconnect", "stop",
           "what becomes of the setpoints of a client that leaves: stop: velocities and efforts become 0, position "
           "targets the position; hold: they stay")
          .one_of(endings);
  all[common.size() + 1] =
      real("timeout", "s", 0, "setpoints that are older, in simulated time, stop as with on_disconnect; 0: none do")
          .between(0, 1e6);
  return all;
}();
constexpr PropertyUse reads[] = {{"joint.position", "of joints in groups"},
                                 {"joint.velocity", "of joints in groups"},
                                 {"joint.effort", "of joints in groups, where the motion has it"},
                                 {"pose", "of the base, where a group has command.twist"},
                                 {"twist", "of the base, where a group has command.twist"}};
constexpr PropertyUse writes[] = {{"joint.position.target", "of joints in groups whose motion or servo takes it"},
                                  {"joint.velocity.target", "of joints in groups whose motion or servo takes it"},
                                  {"joint.acceleration.target", "of joints in groups whose motion takes it"},
                                  {"joint.effort.target", "of joints in groups whose motion takes it"},
                                  {"command.twist", "where a group has it"},
                                  {"state.controller.*", "who has set what, and when"}};
constexpr Description description{
    .id = "controller.joints",
    .kind = Kind::controller,
    .version = "1.0.0",
    .summary = "Setpoints in, positions out: joints and the base, for programs outside, by lines or frames of bytes",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | restorable | runs_alone,
};

class JointsController final : public wire::WireController {
 public:
  JointsController() : WireController("joints 1") {}

  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    groups_ = wire::read_groups(p.texts("groups"));
    stops_ = p.text("on_disconnect") == "stop";
    timeout_ = std::llround(1e9 * p.real("timeout"));
    for (const Item& item : c.items())
      if (!item.robot) throw Error("it serves robots; use it within one, not under `algorithms`");
    WireController::connect(c);
    const std::string block = "controller." + std::string(p.text("name"));
    for (const Item& item : c.items()) {
      const std::uint32_t count = Axes::count_states(*item.robot);
      states_.push_back(
          static_cast<AxisState*>(c.state_block(item.robot->base(), block, std::uint32_t(count * sizeof(AxisState)))));
    }
    robots_.resize(c.items().size());
  }

  void end_step(const Step& step) override {
    for (std::uint32_t i = 0; i < robots_.size(); ++i)
      for (const auto& axis : robots_[i])
        if (is_abandoned(axis->state(), i, step.time)) axis->stop();
  }

 private:
  std::vector<std::unique_ptr<wire::Group>> groups_of(Connector& c, std::uint32_t item) override {
    const RobotView& robot = *c.items()[item].robot;
    Axes axes(c, robot, states_[item]);
    std::vector<std::unique_ptr<wire::Group>> groups;
    for (const wire::GroupText& text : groups_)
      groups.push_back(std::make_unique<JointGroup>(text.name, members_of(axes, text)));
    if (groups_.empty()) {
      if (std::vector<Axis*> all = axes.all_joints(); !all.empty())
        groups.push_back(std::make_unique<JointGroup>("all", std::move(all)));
      if (axes.commands_base())
        groups.push_back(std::make_unique<JointGroup>("base", axes.find(std::string(base_member))));
    }
    if (groups.empty())
      throw Error("robot " + quote(robot.name) +
                  " has nothing to control: its motion simulates no joints, and nothing takes command.twist");
    robots_[item] = axes.take_all();
    return groups;
  }

  static std::vector<Axis*> members_of(Axes& axes, const wire::GroupText& text) {
    std::vector<Axis*> members;
    for (const std::string& member : text.members) {
      try {
        for (Axis* axis : axes.find(member)) {
          if (std::find(members.begin(), members.end(), axis) != members.end())
            throw Error(quote(axis->name()) + " is in it twice");
          members.push_back(axis);
        }
      } catch (const Error& e) {
        throw Error("`groups`: group " + quote(text.name) + ": " + e.what());
      }
    }
    return members;
  }

  /// Whether the setpoint is too old, or its client has left.
  bool is_abandoned(const AxisState& s, std::uint32_t item, std::int64_t now) const {
    if (s.set_by == 0) return false;
    return (timeout_ > 0 && now - s.set_at >= timeout_) || (stops_ && !service(item).is_connected(s.client));
  }

  std::vector<wire::GroupText> groups_;
  bool stops_ = true;
  std::int64_t timeout_ = 0;  ///< ns; 0: none
  std::vector<AxisState*> states_;
  std::vector<std::vector<std::unique_ptr<Axis>>> robots_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<JointsController>(description)};

}  // namespace

MURO_PLUGIN(.name = "controller_joints", .version = description.version, .licence = "MIT",
            .summary = "Joints and bases for programs outside", .algorithms = algorithms)
