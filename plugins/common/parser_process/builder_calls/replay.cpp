// SPDX-License-Identifier: MIT
#include "replay.hpp"

#include "call.hpp"
#include "muro/toolkit/joint_drives.hpp"

namespace muro::builder_calls {

namespace {

using parser_process::Reader;

[[noreturn]] void fail() { throw Error("what the parser process has recorded is garbled"); }

/// Numbers that a builder has given to texts, by the numbers of the record.
class Texts {
 public:
  void add(TextId id) { ids_.push_back(id); }
  TextId operator[](TextId recorded) const {
    if (std::size_t(recorded) >= ids_.size()) fail();
    return ids_[std::size_t(recorded)];
  }

 private:
  std::vector<TextId> ids_{no_text};
};

std::vector<Shape> shapes_in(Reader& calls, const Texts& texts) {
  std::vector<Shape> shapes = calls.list<Shape>();
  for (Shape& s : shapes) {
    if (s.kind > ShapeKind::heightmap || s.material_source > MaterialSource::model) fail();
    s.mesh = texts[s.mesh];
    s.texture = texts[s.texture];
  }
  return shapes;
}

struct Report {
  Severity severity;
  std::string text;
  int line, column;
};

Report report_in(Reader& calls) {
  const auto severity = calls.value<Severity>();
  if (severity > Severity::lost_collision) fail();
  std::string text = calls.text();
  const int line = calls.value<int>();
  return {severity, std::move(text), line, calls.value<int>()};
}

/// Makes the calls for one robot.
class RobotReplay {
 public:
  explicit RobotReplay(RobotBuilder& builder) : builder_(builder) {}

  void run(Call call, Reader& calls) {
    switch (call) {
      case Call::base:
        return builder_.base(calls.text());
      case Call::fork:
        return builder_.fork();
      case Call::end:
        return builder_.end();
      case Call::translation:
        return builder_.translation(calls.value<Vec3>());
      case Call::rotation:
        return builder_.rotation(calls.value<Quat>());
      case Call::revolute:
      case Call::prismatic:
        return joint(call, calls);
      case Call::mimic: {
        const std::string leader = calls.text();
        const auto multiplier = calls.value<double>();
        return builder_.mimic(leader, multiplier, calls.value<double>());
      }
      case Call::body:
        return builder_.body(calls.text());
      case Call::intern:
        return texts_.add(builder_.intern(calls.text()));
      case Call::report: {
        const Report r = report_in(calls);
        return builder_.report(r.severity, r.text, r.line, r.column);
      }
      case Call::inertial:
        return builder_.set(keys::inertial, calls.value<Inertia>());
      case Call::collision_shapes:
        return builder_.set_array<Shape>(keys::collision_shapes, shapes_in(calls, texts_));
      case Call::visual_shapes:
        return builder_.set_array<Shape>(keys::visual_shapes, shapes_in(calls, texts_));
      case Call::visual_materials:
        return builder_.set_array<TextId>(keys::visual_materials, texts_in(calls));
      case Call::model_subsystems:
        return builder_.set_array<TextId>(keys::model_subsystems, texts_in(calls));
      case Call::model_subsystem_places:
        return builder_.set_array<std::int32_t>(keys::model_subsystem_places, calls.list<std::int32_t>());
      case Call::initial_joint_position:
        return builder_.set(keys::initial_joint_position, calls.value<double>());
      case Call::joint_drive:
        return drive(calls.value<std::uint32_t>());
      case Call::joint_drive_stiffness:
        return builder_.set(keys::joint_drive_stiffness, calls.value<double>());
      case Call::joint_drive_damping:
        return builder_.set(keys::joint_drive_damping, calls.value<double>());
      case Call::joint_position_target:
        return builder_.set(keys::joint_position_target, calls.value<double>());
      case Call::mjcf_file:
        return builder_.set(model_constants::mjcf_file, texts_[calls.value<TextId>()]);
      case Call::mjcf_in_world:
        return builder_.set(model_constants::mjcf_in_world, calls.value<std::uint32_t>());
      case Call::mjcf_body:
        return builder_.set(model_constants::mjcf_body, calls.value<std::uint32_t>());
      case Call::mjcf_joint:
        return builder_.set(model_constants::mjcf_joint, calls.value<std::uint32_t>());
      default:
        fail();
    }
  }

 private:
  std::vector<TextId> texts_in(Reader& calls) const {
    std::vector<TextId> texts = calls.list<TextId>();
    for (TextId& text : texts) text = texts_[text];
    return texts;
  }

  void drive(std::uint32_t mode) {
    if (mode > std::uint32_t(DriveMode::passive)) fail();
    builder_.set(keys::joint_drive, mode);
  }

  void joint(Call kind, Reader& calls) {
    const std::string name = calls.text();
    const Vec3 axis = calls.value<Vec3>();
    const auto limits = calls.value<JointLimits>();
    kind == Call::revolute ? builder_.revolute(name, axis, limits) : builder_.prismatic(name, axis, limits);
  }

  RobotBuilder& builder_;
  Texts texts_;
};

}  // namespace

void replay(Reader calls, RobotBuilder& builder) {
  RobotReplay robot(builder);
  while (!calls.at_end()) robot.run(calls.value<Call>(), calls);
}

void replay(Reader calls, WorldBuilder& builder) {
  Texts texts;
  std::vector<RobotReplay> model;  // the last one
  while (!calls.at_end()) {
    switch (const auto call = calls.value<Call>()) {
      case Call::gravity:
        builder.gravity(calls.value<Vec3>());
        break;
      case Call::friction_rule:
        builder.friction_rule(calls.value<std::uint32_t>());
        break;
      case Call::scenery: {
        const std::string name = calls.text();
        const auto pose = calls.value<Pose>();
        const std::vector<Shape> collisions = shapes_in(calls, texts);
        builder.scenery(name, pose, collisions, shapes_in(calls, texts));
        break;
      }
      case Call::model: {
        const std::string name = calls.text();
        model.clear();
        model.emplace_back(builder.model(name, calls.value<Pose>()));
        break;
      }
      case Call::world_intern:
        texts.add(builder.intern(calls.text()));
        break;
      case Call::world_report: {
        const Report r = report_in(calls);
        builder.report(r.severity, r.text, r.line, r.column);
        break;
      }
      default:
        if (model.empty()) fail();
        model.back().run(call, calls);
    }
  }
}

}  // namespace muro::builder_calls
