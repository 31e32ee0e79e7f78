// SPDX-License-Identifier: MIT
#include "known.hpp"

#include <algorithm>
#include <array>

namespace muro::sdf {

namespace {

using Form = Known::Form;

constexpr Known section(std::string_view inside, std::string_view name, std::string_view as = {}) {
  return {.inside = inside, .name = name, .form = Form::section, .section = as.empty() ? name : as};
}
constexpr Known sections(std::string_view inside, std::string_view name) {
  return {.inside = inside, .name = name, .form = Form::section, .many = true, .section = name};
}
constexpr Known numbers(std::string_view inside, std::string_view name, int count = 1) {
  return {.inside = inside, .name = name, .form = Form::numbers, .count = count};
}
constexpr Known value(std::string_view inside, std::string_view name, Form form) {
  return {.inside = inside, .name = name, .form = form};
}
/// Without it the robot or world is another one.
constexpr Known lost(std::string_view inside, std::string_view name, std::string_view why,
                     std::string_view harmless = {}) {
  return {.inside = inside,
          .name = name,
          .form = Form::left_out,
          .many = true,
          .severity = Severity::warning,
          .why = why,
          .harmless = harmless};
}
/// Of interest to a program for display or to one engine only.
constexpr Known spared(std::string_view inside, std::string_view name, std::string_view why,
                       std::string_view harmless = {}) {
  return {.inside = inside,
          .name = name,
          .form = Form::left_out,
          .many = true,
          .severity = Severity::note,
          .why = why,
          .harmless = harmless};
}

constexpr std::string_view plugin_text = "plugins of Gazebo are not run; a scenario names algorithms and controllers";
constexpr std::string_view light_text = "there are no lights";
constexpr std::string_view sensor_text = "sensors are subsystems of a robot in the scenario";
constexpr std::string_view wind_text = "there is no wind";
constexpr std::string_view sound_text = "there is no sound";
constexpr std::string_view shown_text = "only plain colours are shown";
constexpr std::string_view engine_text =
    "how hard contacts and joints are is a matter of the algorithms in the scenario";
constexpr std::string_view shape_text = "shapes are box, sphere, cylinder, capsule, plane, mesh";
constexpr std::string_view friction_text = "friction is one Coulomb coefficient, the same in all directions";
constexpr std::string_view frame_text = "only frames of a <model> or <world> are read";
constexpr std::string_view filter_text = "what collides is not chosen by masks";

constexpr std::array all = {
    sections("sdf", "world"),
    sections("sdf", "model"),
    lost("sdf", "actor", "actors are not simulated"),
    lost("sdf", "light", light_text),

    sections("world", "model"),
    sections("world", "include"),
    sections("world", "frame"),
    numbers("world", "gravity", 3),
    lost("world", "actor", "actors are not simulated"),
    lost("world", "joint", "only joints within a model are read"),
    lost("world", "plugin", plugin_text),
    lost("world", "population", "write its models one by one, or as a robot with `count` and `place` in the scenario"),
    lost("world", "road", "write it as a model with a box"),
    lost("world", "state", "models stand where their <pose> says"),
    lost("world", "wind", wind_text),
    spared("world", "atmosphere", "there is no air"),
    spared("world", "audio", sound_text),
    spared("world", "gui", "views are algorithms of the scenario"),
    spared("world", "light", light_text),
    spared("world", "magnetic_field", "there is no magnetic field"),
    spared("world", "physics", "the scenario names what moves each robot, and how often"),
    spared("world", "scene", light_text),
    spared("world", "spherical_coordinates", "the world has no place on the earth"),

    value("include", "uri", Form::text),
    value("include", "name", Form::text),
    value("include", "static", Form::flag),
    value("include", "placement_frame", Form::text),
    value("include", "pose", Form::pose),
    lost("include", "plugin", plugin_text),
    lost("include", "experimental:params", "parameters of an include are not applied"),

    sections("model", "link"),
    sections("model", "joint"),
    sections("model", "frame"),
    sections("model", "model"),
    sections("model", "include"),
    value("model", "pose", Form::pose),
    value("model", "static", Form::flag),
    lost("model", "enable_wind", wind_text, "false"),
    lost("model", "gripper", "it holds things by friction, or by a controller"),
    lost("model", "plugin", plugin_text),
    lost("model", "self_collide", "`self_collision` of a motion that has it decides", "false"),
    spared("model", "allow_auto_disable", "bodies do not fall asleep"),

    value("frame", "pose", Form::pose),

    value("link", "pose", Form::pose),
    section("link", "inertial"),
    sections("link", "collision"),
    sections("link", "visual"),
    lost("link", "frame", frame_text),
    lost("inertial", "frame", frame_text),
    lost("collision", "frame", frame_text),
    lost("visual", "frame", frame_text),
    lost("joint", "frame", frame_text),
    lost("link", "battery", "there are no batteries"),
    lost("link", "enable_wind", wind_text, "false"),
    lost("link", "gravity", "all bodies are heavy", "true"),
    lost("link", "kinematic", "a motion without forces, such as motion.point, moves a robot as it is told", "false"),
    lost("link", "self_collide", "`self_collision` of a motion that has it decides", "false"),
    lost("link", "sensor", sensor_text),
    lost("link", "velocity_decay", "damping of bodies is a parameter of the motion, where it has one"),
    spared("link", "audio_sink", sound_text),
    spared("link", "audio_source", sound_text),
    spared("link", "light", light_text),
    spared("link", "must_be_base_link", "the base is the link that is no joint's child"),
    spared("link", "particle_emitter", "particles are not shown"),
    spared("link", "projector", "nothing is projected"),

    numbers("inertial", "mass"),
    value("inertial", "pose", Form::pose),
    section("inertial", "inertia"),
    lost("inertial", "density", "inertia is not computed from a density; write <mass> and <inertia>"),
    lost("inertial", "auto_inertia_params", "inertia is not computed from a density; write <mass> and <inertia>"),
    lost("inertial", "fluid_added_mass", "there is no water"),
    numbers("inertia", "ixx"),
    numbers("inertia", "ixy"),
    numbers("inertia", "ixz"),
    numbers("inertia", "iyy"),
    numbers("inertia", "iyz"),
    numbers("inertia", "izz"),

    value("collision", "pose", Form::pose),
    section("collision", "geometry"),
    section("collision", "surface"),
    lost("collision", "density", "inertia is not computed from a density; write <mass> and <inertia>"),
    lost("collision", "auto_inertia_params", "inertia is not computed from a density; write <mass> and <inertia>"),
    spared("collision", "laser_retro", "rays have no brightness"),
    spared("collision", "max_contacts", engine_text),

    value("visual", "pose", Form::pose),
    section("visual", "geometry"),
    section("visual", "material"),
    numbers("visual", "transparency"),
    lost("visual", "plugin", plugin_text),
    spared("visual", "cast_shadows", shown_text),
    spared("visual", "laser_retro", "rays have no brightness"),
    spared("visual", "meta", shown_text),
    spared("visual", "visibility_flags", "all is shown to all", "4294967295"),

    section("geometry", "box"),
    section("geometry", "capsule"),
    section("geometry", "cylinder"),
    section("geometry", "mesh"),
    section("geometry", "plane"),
    section("geometry", "sphere"),
    lost("geometry", "cone", shape_text),
    lost("geometry", "ellipsoid", shape_text),
    lost("geometry", "heightmap", shape_text),
    lost("geometry", "image", shape_text),
    lost("geometry", "polyline", shape_text),
    spared("geometry", "empty", shape_text),
    numbers("box", "size", 3),
    numbers("capsule", "radius"),
    numbers("capsule", "length"),
    numbers("cylinder", "radius"),
    numbers("cylinder", "length"),
    numbers("sphere", "radius"),
    numbers("plane", "normal", 3),
    numbers("plane", "size", 2),
    value("mesh", "uri", Form::text),
    numbers("mesh", "scale", 3),
    lost("mesh", "submesh", "all of the file's mesh is used; give each submesh a file of its own"),
    lost("mesh", "convex_decomposition", "the algorithm in the scenario says how meshes collide"),

    section("surface", "bounce"),
    section("surface", "friction"),
    section("surface", "contact"),
    spared("surface", "soft_contact", engine_text),
    numbers("bounce", "restitution_coefficient"),
    spared("bounce", "threshold", engine_text),
    section("friction", "ode", "ode friction"),
    section("friction", "bullet", "bullet friction"),
    spared("friction", "torsional", friction_text),
    numbers("ode friction", "mu"),
    numbers("ode friction", "mu2"),
    spared("ode friction", "fdir1", friction_text, "0 0 0"),
    spared("ode friction", "slip1", friction_text, "0"),
    spared("ode friction", "slip2", friction_text, "0"),
    numbers("bullet friction", "friction"),
    numbers("bullet friction", "friction2"),
    spared("bullet friction", "fdir1", friction_text, "0 0 0"),
    spared("bullet friction", "rolling_friction", friction_text, "0"),
    lost("contact", "collide_without_contact", filter_text, "false"),
    lost("contact", "collide_bitmask", filter_text, "65535"),
    lost("contact", "category_bitmask", filter_text, "65535"),
    spared("contact", "collide_without_contact_bitmask", filter_text),
    spared("contact", "poissons_ratio", engine_text),
    spared("contact", "elastic_modulus", engine_text),
    spared("contact", "ode", engine_text),
    spared("contact", "bullet", engine_text),

    value("material", "ambient", Form::color),
    value("material", "diffuse", Form::color),
    spared("material", "double_sided", shown_text),
    spared("material", "emissive", shown_text),
    spared("material", "lighting", shown_text),
    section("material", "pbr"),
    spared("material", "render_order", shown_text),
    spared("material", "script", "scripts of materials are not read; write <diffuse>"),
    spared("material", "shader", shown_text),
    spared("material", "shininess", shown_text),
    spared("material", "specular", shown_text),

    section("pbr", "metal"),
    section("pbr", "specular"),
    value("metal", "albedo_map", Form::text),
    value("specular", "albedo_map", Form::text),
    spared("metal", "ambient_occlusion_map", shown_text),
    spared("metal", "emissive_map", shown_text),
    spared("metal", "environment_map", shown_text),
    spared("metal", "light_map", shown_text),
    spared("metal", "metalness", shown_text),
    spared("metal", "metalness_map", shown_text),
    spared("metal", "normal_map", shown_text),
    spared("metal", "roughness", shown_text),
    spared("metal", "roughness_map", shown_text),
    spared("specular", "ambient_occlusion_map", shown_text),
    spared("specular", "emissive_map", shown_text),
    spared("specular", "environment_map", shown_text),
    spared("specular", "glossiness", shown_text),
    spared("specular", "glossiness_map", shown_text),
    spared("specular", "light_map", shown_text),
    spared("specular", "normal_map", shown_text),
    spared("specular", "specular_map", shown_text),

    value("joint", "parent", Form::text),
    value("joint", "child", Form::text),
    value("joint", "pose", Form::pose),
    section("joint", "axis"),
    section("joint", "axis2", "axis"),
    numbers("joint", "gearbox_ratio"),
    value("joint", "gearbox_reference_body", Form::text),
    numbers("joint", "thread_pitch"),
    numbers("joint", "screw_thread_pitch"),
    lost("joint", "sensor", sensor_text),
    spared("joint", "physics", engine_text),
    numbers("axis", "xyz", 3),
    value("axis", "use_parent_model_frame", Form::flag),
    section("axis", "dynamics"),
    section("axis", "limit"),
    section("axis", "mimic"),
    lost("axis", "initial_position", "`joints` of the robot in the scenario says how it starts", "0"),
    numbers("dynamics", "damping"),
    numbers("dynamics", "friction"),
    numbers("dynamics", "spring_reference"),
    numbers("dynamics", "spring_stiffness"),
    value("limit", "lower", Form::limit),
    value("limit", "upper", Form::limit),
    value("limit", "effort", Form::limit),
    value("limit", "velocity", Form::limit),
    spared("limit", "stiffness", engine_text),
    spared("limit", "dissipation", engine_text),
    numbers("mimic", "multiplier"),
    numbers("mimic", "offset"),
    numbers("mimic", "reference"),
};

struct Attribute {
  std::string_view section, name;
};
constexpr Attribute attributes[] = {
    {"sdf", "version"},
    {"world", "name"},
    {"model", "name"},
    {"model", "canonical_link"},
    {"model", "placement_frame"},
    {"include", "merge"},
    {"link", "name"},
    {"joint", "name"},
    {"joint", "type"},
    {"frame", "name"},
    {"frame", "attached_to"},
    {"collision", "name"},
    {"visual", "name"},
    {"pose", "relative_to"},
    {"pose", "frame"},
    {"pose", "rotation_format"},
    {"pose", "degrees"},
    {"xyz", "expressed_in"},
    {"mimic", "joint"},
    {"mimic", "axis"},
};

}  // namespace

const Known* find_known(std::string_view inside, std::string_view name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Known& k) { return k.inside == inside && k.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::span<const Known> all_known() { return all; }

bool knows_attribute(std::string_view section, std::string_view attribute) {
  return std::any_of(std::begin(attributes), std::end(attributes),
                     [&](const Attribute& a) { return a.section == section && a.name == attribute; });
}

}  // namespace muro::sdf
