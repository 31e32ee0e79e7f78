// SPDX-License-Identifier: MIT
#include "mjcf.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <charconv>
#include <locale>

#include "mujoco_library.hpp"

namespace muro::mujoco {

namespace {

std::string named(const std::string& name) { return " name='" + name + "'"; }

}  // namespace

Mjcf::Mjcf(const MujocoMeshes& meshes, Contacts contacts)
    : meshes_(&meshes),
      contacts_(contacts),
      decimal_sign_(contacts == Contacts::of_each_geom
                        ? '.'
                        : std::use_facet<std::numpunct<char>>(std::locale()).decimal_point()) {}

/// Returns the shortest text that gives exactly this value.
std::string Mjcf::number(double value) const {
  char text[40];
  char* const end = std::to_chars(text, text + sizeof text, value).ptr;
  std::replace(text, end, '.', decimal_sign_);
  return {text, end};
}

std::string Mjcf::attribute(const char* name, std::initializer_list<double> values) const {
  std::string text = std::string(" ") + name + "='";
  for (const double v : values) text += number(v) + " ";
  text.back() = '\'';
  return text;
}

std::string Mjcf::vector(const char* name, const Vec3& v) const { return attribute(name, {v.x(), v.y(), v.z()}); }

std::string Mjcf::place(const Pose& pose) const {
  const Quat& q = pose.orientation;
  return vector("pos", pose.position) + attribute("quat", {q.w(), q.x(), q.y(), q.z()});
}

/// Returns the attributes of a geom when the defaults are those of another file. With all bits set it touches
/// everything that touches anything. The compiler refuses a body of several geoms without mass.
std::string Mjcf::own_contacts(const Surface& s) const {
  const int dimensions = s.rolling_resistance > 0 ? 6 : s.spinning_resistance > 0 ? 4 : 3;
  return attribute("mass", {1e-9}) +
         " contype='2147483647' conaffinity='2147483647' priority='0' solmix='1' margin='0' gap='0' condim='" +
         std::to_string(dimensions) + "'" + attribute("solref", {0.02, 1}) +
         attribute("solimp", {0.9, 0.95, 0.001, 0.5, 2}) +
         attribute("friction", {s.friction, s.spinning_resistance, s.rolling_resistance});
}

Principal principal_of(const Inertia& inertia) {
  const Mat3 tensor = inertia.tensor();
  if (tensor.isDiagonal(0)) return {tensor.diagonal(), Quat::Identity()};
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(tensor);
  Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(2) *= -1;
  return {solver.eigenvalues(), Quat(axes)};
}

std::string Mjcf::body_name(std::string_view name, std::size_t owner, std::size_t number) {
  std::string text(name);
  for (char& c : text)
    if (std::string_view("<>&'\"").find(c) != std::string_view::npos) c = '_';
  return text + ":" + std::to_string(owner) + "." + std::to_string(number);
}

std::string Mjcf::geom_name(const std::string& body, std::size_t number) { return body + "." + std::to_string(number); }

namespace {

std::string height_field_name(std::size_t number) { return "heightmap:" + std::to_string(number); }

/// The range of the values of a heightmap.
struct ValueRange {
  double low, high;
  explicit ValueRange(const Heightmap& map) {
    const auto [least, most] = std::minmax_element(map.values.begin(), map.values.end());
    low = double(*least);
    high = double(*most);
  }
};

}  // namespace

/// Returns the attributes of a heightmap's geom. With the contacts of this plugin it is a plane that touches nothing,
/// because the plugin finds contacts with heightmaps itself. Otherwise it is a height field of MuJoCo: its values go
/// from 0 to 1, and `pose` is shifted to the lowest value.
std::string Mjcf::terrain(const Shape& shape, Pose& pose) {
  constexpr double base = 10;  // m: solid to this depth below the lowest
  if (contacts_ == Contacts::by_default) return " type='plane' size='0 0 1' contype='0' conaffinity='0'";
  const Heightmap map = meshes_->heightmap(shape);
  const ValueRange range(map);
  const std::string name = height_field_name(height_fields_.size());
  height_fields_.push_back(map);
  const double height = map.size.z() * (range.high - range.low);
  assets_ += "<hfield" + named(name) + " nrow='" + std::to_string(map.rows) + "' ncol='" + std::to_string(map.columns) +
             "'" + attribute("size", {0.5 * map.size.x(), 0.5 * map.size.y(), height > 0 ? height : 1, base}) + "/>\n";
  pose = pose * Pose{{0, 0, map.size.z() * range.low}, Quat::Identity()};
  return " type='hfield' hfield='" + name + "'";
}

/// Scales the values to 0 to 1. The rows of MuJoCo go from -y to +y, as those of a heightmap.
void Mjcf::fill_height_fields(mjModel& model) const {
  for (std::size_t i = 0; i < height_fields_.size(); ++i) {
    const Heightmap& map = height_fields_[i];
    const ValueRange range(map);
    float* to = model.hfield_data + model.hfield_adr[mj_name2id(&model, mjOBJ_HFIELD, height_field_name(i).c_str())];
    for (const float value : map.values)
      *to++ = range.high > range.low ? float((double(value) - range.low) / (range.high - range.low)) : 0;
  }
}

std::string Mjcf::geom(const multibody::BodyShape& shape, Pose pose, const std::string& name) {
  const Vec3& s = shape.shape.size;
  std::string what;
  switch (shape.shape.kind) {
    case ShapeKind::box:
      what = " type='box'" + vector("size", 0.5 * s);
      break;
    case ShapeKind::sphere:
      what = " type='sphere'" + attribute("size", {s.x()});
      break;
    case ShapeKind::cylinder:
      what = " type='cylinder'" + attribute("size", {s.x(), 0.5 * s.z()});
      break;
    case ShapeKind::capsule:
      what = " type='capsule'" + attribute("size", {s.x(), 0.5 * s.z()});
      break;
    case ShapeKind::plane:
      what = " type='plane' size='0 0 1'";
      break;
    case ShapeKind::mesh: {
      const std::vector<Vec3>& hull = meshes_->of(shape.shape, true);
      std::string& mesh = mesh_names_[hull.data()];
      if (mesh.empty()) {
        mesh = "mesh:" + std::to_string(mesh_names_.size());
        assets_ += "<mesh" + named(mesh) + " scale='1 1 1' vertex='";
        for (const Vec3& v : hull) assets_ += number(v.x()) + " " + number(v.y()) + " " + number(v.z()) + " ";
        assets_ += "'/>\n";
      }
      what = " type='mesh' mesh='" + mesh + "'";
      break;
    }
    case ShapeKind::heightmap:
      what = terrain(shape.shape, pose);
      break;
  }
  if (contacts_ == Contacts::of_each_geom) what += own_contacts(shape.shape.surface);
  return "<geom" + named(name) + what + place(pose) + "/>\n";
}

void Mjcf::add_static_body(const multibody::ExternalBody& body, std::size_t owner) {
  const std::string name = body_name(body.name, owner, 0);
  std::string in_body;
  for (std::size_t k = 0; k < body.shapes.size(); ++k) {
    const multibody::BodyShape& s = body.shapes[k];
    const std::string in_world = geom(s, body.pose * s.shape.origin, geom_name(name, k));
    if (is_ground(s.shape)) {
      ground_ += in_world;
    } else {
      scenery_in_world_ += in_world;
      in_body += geom(s, s.shape.origin, geom_name(name, k));
    }
  }
  if (!in_body.empty()) scenery_in_bodies_ += "<body" + named(name) + place(body.pose) + ">\n" + in_body + "</body>\n";
}

void Mjcf::add_kinematic_body(const multibody::ExternalBody& body, std::size_t owner) {
  const std::string name = body_name(body.name, owner, 0);
  std::size_t k = 0;
  bodies_ += "<body mocap='true'" + named(name) + ">\n";
  for (const multibody::BodyShape& s : body.shapes)
    if (has_geom(s)) bodies_ += geom(s, s.shape.origin, geom_name(name, k++));
  moving_geoms_ += k;
  bodies_ += "</body>\n";
}

void Mjcf::add_robot(const multibody::RobotModel& model, std::size_t owner) {
  write_body(model, 0, owner);
  for (std::size_t a = 0; a < model.bodies.size(); ++a)
    for (std::size_t b = a + 1; b < model.bodies.size(); ++b) {
      if (model.bodies[a].shapes.empty() || model.bodies[b].shapes.empty()) continue;
      if (model.self_collision && !model.adjacent(std::uint32_t(a), std::uint32_t(b))) continue;
      exclusions_ += "<exclude body1='" + body_name(model.name, owner, a) + "' body2='" +
                     body_name(model.name, owner, b) + "'/>\n";
    }
}

void Mjcf::write_body(const multibody::RobotModel& model, std::size_t number, std::size_t owner) {
  const multibody::RigidBody& body = model.bodies[number];
  const bool base = number == 0, free = base && !model.fixed_base;
  const Vec3 shift = free ? body.inertia.com : Vec3(Vec3::Zero());
  const std::string name = body_name(model.name, owner, number);
  std::size_t k = 0;
  Pose origin = body.origin;
  if (body.parent == 0 && !model.fixed_base) origin.position -= model.bodies[0].inertia.com;
  bodies_ += "<body" + named(name) + (base ? std::string(free ? "" : " mocap='true'") : place(origin)) + ">\n";
  if (free) bodies_ += "<freejoint" + named(name) + "/>";
  if (!base)
    bodies_ += "<joint" + named(name) + (body.joint == JointKind::revolute ? " type='hinge'" : " type='slide'") +
               vector("axis", body.axis) + "/>\n";
  if (!base && has_friction_beside_drive(body))
    tendons_ += "<fixed" + attribute("frictionloss", {std::min(body.limits.friction, 1e30)}) +
                attribute("solimpfriction", {mjMAXIMP, mjMAXIMP, 1}) + "><joint joint='" + name +
                "' coef='1'/></fixed>\n";
  if (body.leader >= 0)
    equalities_ += "<joint" + named(name) + " joint1='" + name + "' joint2='" +
                   body_name(model.name, owner, std::size_t(body.leader)) + "'" +
                   attribute("polycoef", {body.offset, body.multiplier, 0, 0, 0}) +
                   attribute("solimp", {mjMAXIMP, mjMAXIMP, 1}) + "/>\n";
  const Principal p = principal_of(body.inertia);
  bodies_ += "<inertial" + place({body.inertia.com - shift, p.axes}) + attribute("mass", {body.inertia.mass}) +
             vector("diaginertia", p.moments) + "/>\n";
  for (const multibody::BodyShape& s : body.shapes)
    if (has_geom(s))
      bodies_ += geom(s, {s.shape.origin.position - shift, s.shape.origin.orientation}, geom_name(name, k++));
  moving_geoms_ += k;
  for (std::size_t i = number + 1; i < model.bodies.size(); ++i)
    if (model.bodies[i].parent == std::int32_t(number)) write_body(model, i, owner);
  bodies_ += "</body>\n";
}

std::string Mjcf::elements() const {
  return "<asset>" + assets_ + "</asset><worldbody>" + ground_ + scenery_in_world_ + bodies_ + "</worldbody>";
}

std::string Mjcf::text(const MujocoSettings& settings, const Sizes& sizes) const {
  const auto impedance = [this](const char* name, double d) { return attribute(name, {d, d, 1}); };
  return "<mujoco>\n<compiler angle='radian' inertiafromgeom='false' balanceinertia='true'/>\n<option cone='elliptic'" +
         vector("gravity", settings.gravity) + "><flag filterparent='disable' multiccd='" +
         (settings.several_contacts ? "enable" : "disable") + "'/></option>\n<size nconmax='" +
         std::to_string(sizes.contacts) + "' njmax='" + std::to_string(sizes.rows) +
         "'/>\n<default><geom condim='3' contype='2' conaffinity='0'" + impedance("solimp", settings.impedance) +
         "/><joint" + impedance("solimplimit", mjMAXIMP) + impedance("solimpfriction", mjMAXIMP) +
         "/></default>\n<asset>\n" + assets_ + "</asset>\n<worldbody>\n" + ground_ +
         (moving_geoms_ <= few_geoms ? scenery_in_world_ : scenery_in_bodies_) + bodies_ + "</worldbody>\n<contact>\n" +
         exclusions_ + "</contact>\n<tendon>\n" + tendons_ + "</tendon>\n<equality>\n" + equalities_ +
         "</equality>\n</mujoco>\n";
}

}  // namespace muro::mujoco
