// SPDX-License-Identifier: MIT
#include "schema.hpp"

#include <algorithm>
#include <array>

namespace muro::sdf {

namespace {

constexpr SchemaElement section(std::string_view parent, std::string_view name, std::string_view as = {}) {
  return {.parent = parent, .name = name, .type = ValueType::section, .section = as.empty() ? name : as};
}
constexpr SchemaElement sections(std::string_view parent, std::string_view name) {
  return {.parent = parent, .name = name, .type = ValueType::section, .repeatable = true, .section = name};
}
constexpr SchemaElement numbers(std::string_view parent, std::string_view name, int count = 1) {
  return {.parent = parent, .name = name, .type = ValueType::numbers, .count = count};
}
constexpr SchemaElement value(std::string_view parent, std::string_view name, ValueType type) {
  return {.parent = parent, .name = name, .type = type};
}
constexpr SchemaElement device(std::string_view parent, std::string_view name) {
  return {.parent = parent, .name = name, .type = ValueType::device, .repeatable = true};
}
/// An element without which the robot or world differs: a warning.
constexpr SchemaElement unsupported(std::string_view parent, std::string_view name, std::string_view reason,
                                    std::string_view supported_value = {}) {
  return {.parent = parent,
          .name = name,
          .type = ValueType::unsupported,
          .repeatable = true,
          .severity = Severity::warning,
          .reason = reason,
          .supported_value = supported_value};
}
/// An element for display programs or for one engine only: a note.
constexpr SchemaElement irrelevant(std::string_view parent, std::string_view name, std::string_view reason,
                                   std::string_view supported_value = {}) {
  SchemaElement e = unsupported(parent, name, reason, supported_value);
  e.severity = Severity::note;
  return e;
}

constexpr std::string_view plugin_text = "plugins of Gazebo are not run; a scenario names algorithms and controllers";
constexpr std::string_view light_text = "there are no lights";
constexpr std::string_view wind_text = "there is no wind";
constexpr std::string_view sound_text = "there is no sound";
constexpr std::string_view shown_text = "only plain colours are shown";
constexpr std::string_view engine_text =
    "the stiffness of contacts and joints is a matter of the algorithms in the scenario";
constexpr std::string_view shape_text = "shapes are box, sphere, cylinder, capsule, plane, mesh, heightmap";
constexpr std::string_view blend_text = "the first texture covers all of a heightmap";
constexpr std::string_view friction_text = "friction is one Coulomb coefficient, the same in all directions";
constexpr std::string_view frame_text = "only frames of a <model> or <world> are read";
constexpr std::string_view filter_text = "collisions are not filtered by masks";

constexpr std::array elements = {
    sections("sdf", "world"),
    sections("sdf", "model"),
    unsupported("sdf", "actor", "actors are not simulated"),
    unsupported("sdf", "light", light_text),

    sections("world", "model"),
    sections("world", "include"),
    sections("world", "frame"),
    numbers("world", "gravity", 3),
    unsupported("world", "actor", "actors are not simulated"),
    unsupported("world", "joint", "only joints within a model are read"),
    unsupported("world", "plugin", plugin_text),
    unsupported("world", "population",
                "write its models one by one, or as a robot with `count` and `place` in the scenario"),
    unsupported("world", "road", "write it as a model with a box"),
    unsupported("world", "state", "models stand where their <pose> says"),
    unsupported("world", "wind", wind_text),
    irrelevant("world", "atmosphere", "there is no air"),
    irrelevant("world", "audio", sound_text),
    irrelevant("world", "gui", "views are algorithms of the scenario"),
    irrelevant("world", "light", light_text),
    irrelevant("world", "magnetic_field", "there is no magnetic field"),
    irrelevant("world", "physics", "the scenario names what moves each robot, and how often"),
    irrelevant("world", "scene", light_text),
    irrelevant("world", "spherical_coordinates", "the world has no geographic position"),

    value("include", "uri", ValueType::text),
    value("include", "name", ValueType::text),
    value("include", "static", ValueType::flag),
    value("include", "placement_frame", ValueType::text),
    value("include", "pose", ValueType::pose),
    unsupported("include", "plugin", plugin_text),
    unsupported("include", "experimental:params", "parameters of an include are not applied"),

    sections("model", "link"),
    sections("model", "joint"),
    sections("model", "frame"),
    sections("model", "model"),
    sections("model", "include"),
    value("model", "pose", ValueType::pose),
    value("model", "static", ValueType::flag),
    unsupported("model", "enable_wind", wind_text, "false"),
    unsupported("model", "gripper", "grasp by friction, or by a controller"),
    device("model", "plugin"),
    device("model", "self_collide"),
    irrelevant("model", "allow_auto_disable", "bodies do not fall asleep"),

    value("frame", "pose", ValueType::pose),

    value("link", "pose", ValueType::pose),
    section("link", "inertial"),
    sections("link", "collision"),
    sections("link", "visual"),
    unsupported("link", "frame", frame_text),
    unsupported("inertial", "frame", frame_text),
    unsupported("collision", "frame", frame_text),
    unsupported("visual", "frame", frame_text),
    unsupported("joint", "frame", frame_text),
    unsupported("link", "battery", "there are no batteries"),
    unsupported("link", "enable_wind", wind_text, "false"),
    device("link", "gravity"),
    unsupported("link", "kinematic",
                "a motion without forces, such as motion.point, moves a robot by its commands alone", "false"),
    device("link", "self_collide"),
    device("link", "sensor"),
    unsupported("link", "velocity_decay", "damping of bodies is a parameter of the motion, where it has one"),
    irrelevant("link", "audio_sink", sound_text),
    irrelevant("link", "audio_source", sound_text),
    irrelevant("link", "light", light_text),
    irrelevant("link", "must_be_base_link", "the base is the link that is no joint's child"),
    irrelevant("link", "particle_emitter", "particles are not shown"),
    irrelevant("link", "projector", "nothing is projected"),

    numbers("inertial", "mass"),
    value("inertial", "pose", ValueType::pose),
    section("inertial", "inertia"),
    unsupported("inertial", "density", "inertia is not computed from a density; write <mass> and <inertia>"),
    unsupported("inertial", "auto_inertia_params",
                "inertia is not computed from a density; write <mass> and <inertia>"),
    unsupported("inertial", "fluid_added_mass", "there is no water"),
    numbers("inertia", "ixx"),
    numbers("inertia", "ixy"),
    numbers("inertia", "ixz"),
    numbers("inertia", "iyy"),
    numbers("inertia", "iyz"),
    numbers("inertia", "izz"),

    value("collision", "pose", ValueType::pose),
    section("collision", "geometry"),
    section("collision", "surface"),
    unsupported("collision", "density", "inertia is not computed from a density; write <mass> and <inertia>"),
    unsupported("collision", "auto_inertia_params",
                "inertia is not computed from a density; write <mass> and <inertia>"),
    irrelevant("collision", "laser_retro", "rays have no brightness"),
    irrelevant("collision", "max_contacts", engine_text),

    value("visual", "pose", ValueType::pose),
    section("visual", "geometry"),
    section("visual", "material"),
    numbers("visual", "transparency"),
    unsupported("visual", "plugin", plugin_text),
    irrelevant("visual", "cast_shadows", shown_text),
    irrelevant("visual", "laser_retro", "rays have no brightness"),
    irrelevant("visual", "meta", shown_text),
    irrelevant("visual", "visibility_flags", "all is shown to all", "4294967295"),

    section("geometry", "box"),
    section("geometry", "capsule"),
    section("geometry", "cylinder"),
    section("geometry", "heightmap"),
    section("geometry", "mesh"),
    section("geometry", "plane"),
    section("geometry", "sphere"),
    unsupported("geometry", "cone", shape_text),
    unsupported("geometry", "ellipsoid", shape_text),
    unsupported("geometry", "image", shape_text),
    unsupported("geometry", "polyline", shape_text),
    irrelevant("geometry", "empty", shape_text),
    numbers("box", "size", 3),
    numbers("capsule", "radius"),
    numbers("capsule", "length"),
    numbers("cylinder", "radius"),
    numbers("cylinder", "length"),
    numbers("sphere", "radius"),
    numbers("plane", "normal", 3),
    numbers("plane", "size", 2),
    value("heightmap", "uri", ValueType::text),
    numbers("heightmap", "size", 3),
    numbers("heightmap", "pos", 3),
    sections("heightmap", "texture"),
    irrelevant("heightmap", "blend", blend_text),
    irrelevant("heightmap", "sampling", "the surface is that of the nodes of its file", "1"),
    irrelevant("heightmap", "use_terrain_paging", shown_text, "false"),
    numbers("texture", "size"),
    value("texture", "diffuse", ValueType::text),
    irrelevant("texture", "normal", "surfaces have no maps of normals"),
    value("mesh", "uri", ValueType::text),
    numbers("mesh", "scale", 3),
    unsupported("mesh", "submesh", "all of the file's mesh is used; give each submesh a file of its own"),
    unsupported("mesh", "convex_decomposition", "the algorithm in the scenario says how meshes collide"),

    section("surface", "bounce"),
    section("surface", "friction"),
    section("surface", "contact"),
    irrelevant("surface", "soft_contact", engine_text),
    numbers("bounce", "restitution_coefficient"),
    irrelevant("bounce", "threshold", engine_text),
    section("friction", "ode", "ode friction"),
    section("friction", "bullet", "bullet friction"),
    section("friction", "torsional"),
    numbers("torsional", "coefficient"),
    numbers("torsional", "patch_radius"),
    value("torsional", "use_patch_radius", ValueType::flag),
    irrelevant("torsional", "surface_radius", "only a patch radius gives the resistance", "0"),
    irrelevant("torsional", "ode", engine_text),
    numbers("ode friction", "mu"),
    numbers("ode friction", "mu2"),
    irrelevant("ode friction", "fdir1", friction_text, "0 0 0"),
    irrelevant("ode friction", "slip1", friction_text, "0"),
    irrelevant("ode friction", "slip2", friction_text, "0"),
    numbers("bullet friction", "friction"),
    numbers("bullet friction", "friction2"),
    irrelevant("bullet friction", "fdir1", friction_text, "0 0 0"),
    numbers("bullet friction", "rolling_friction"),
    unsupported("contact", "collide_without_contact", filter_text, "false"),
    unsupported("contact", "collide_bitmask", filter_text, "65535"),
    unsupported("contact", "category_bitmask", filter_text, "65535"),
    irrelevant("contact", "collide_without_contact_bitmask", filter_text),
    irrelevant("contact", "poissons_ratio", engine_text),
    irrelevant("contact", "elastic_modulus", engine_text),
    irrelevant("contact", "ode", engine_text),
    irrelevant("contact", "bullet", engine_text),

    value("material", "ambient", ValueType::color),
    value("material", "diffuse", ValueType::color),
    irrelevant("material", "double_sided", shown_text),
    irrelevant("material", "emissive", shown_text),
    irrelevant("material", "lighting", shown_text),
    section("material", "pbr"),
    irrelevant("material", "render_order", shown_text),
    irrelevant("material", "script", "scripts of materials are not read; write <diffuse>"),
    irrelevant("material", "shader", shown_text),
    irrelevant("material", "shininess", shown_text),
    irrelevant("material", "specular", shown_text),

    section("pbr", "metal"),
    section("pbr", "specular"),
    value("metal", "albedo_map", ValueType::text),
    value("specular", "albedo_map", ValueType::text),
    irrelevant("metal", "ambient_occlusion_map", shown_text),
    irrelevant("metal", "emissive_map", shown_text),
    irrelevant("metal", "environment_map", shown_text),
    irrelevant("metal", "light_map", shown_text),
    irrelevant("metal", "metalness", shown_text),
    irrelevant("metal", "metalness_map", shown_text),
    irrelevant("metal", "normal_map", shown_text),
    irrelevant("metal", "roughness", shown_text),
    irrelevant("metal", "roughness_map", shown_text),
    irrelevant("specular", "ambient_occlusion_map", shown_text),
    irrelevant("specular", "emissive_map", shown_text),
    irrelevant("specular", "environment_map", shown_text),
    irrelevant("specular", "glossiness", shown_text),
    irrelevant("specular", "glossiness_map", shown_text),
    irrelevant("specular", "light_map", shown_text),
    irrelevant("specular", "normal_map", shown_text),
    irrelevant("specular", "specular_map", shown_text),

    value("joint", "parent", ValueType::text),
    value("joint", "child", ValueType::text),
    value("joint", "pose", ValueType::pose),
    section("joint", "axis"),
    section("joint", "axis2", "axis"),
    numbers("joint", "gearbox_ratio"),
    value("joint", "gearbox_reference_body", ValueType::text),
    numbers("joint", "thread_pitch"),
    numbers("joint", "drake:rotor_inertia"),
    numbers("joint", "drake:gear_ratio"),
    numbers("joint", "screw_thread_pitch"),
    device("joint", "sensor"),
    irrelevant("joint", "physics", engine_text),
    numbers("axis", "xyz", 3),
    value("axis", "use_parent_model_frame", ValueType::flag),
    section("axis", "dynamics"),
    section("axis", "limit"),
    section("axis", "mimic"),
    unsupported("axis", "initial_position", "`joints` of the robot in the scenario says how it starts", "0"),
    numbers("dynamics", "damping"),
    numbers("dynamics", "friction"),
    numbers("dynamics", "spring_reference"),
    numbers("dynamics", "spring_stiffness"),
    value("limit", "lower", ValueType::limit),
    value("limit", "upper", ValueType::limit),
    value("limit", "effort", ValueType::limit),
    value("limit", "velocity", ValueType::limit),
    irrelevant("limit", "stiffness", engine_text),
    irrelevant("limit", "dissipation", engine_text),
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

const SchemaElement* find_in_schema(std::string_view parent, std::string_view name) {
  const auto found = std::find_if(elements.begin(), elements.end(),
                                  [&](const SchemaElement& e) { return e.parent == parent && e.name == name; });
  return found == elements.end() ? nullptr : &*found;
}

std::span<const SchemaElement> schema() { return elements; }

bool is_attribute_of(std::string_view section, std::string_view attribute) {
  return std::any_of(std::begin(attributes), std::end(attributes),
                     [&](const Attribute& a) { return a.section == section && a.name == attribute; });
}

}  // namespace muro::sdf
