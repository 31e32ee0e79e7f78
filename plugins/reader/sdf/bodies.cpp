// SPDX-License-Identifier: MIT
#include "bodies.hpp"

#include <algorithm>
#include <sdf/sdf.hh>

#include "assembly.hpp"
#include "muro/base/limits.hpp"
#include "muro/toolkit/rotations.hpp"
#include "plugins/common/model_file/inertia.hpp"

namespace muro::sdf {

namespace {

Vec3 vector_of(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

::sdf::ElementPtr child(const ::sdf::ElementPtr& e, const char* name) {
  return e && e->HasElement(name) ? e->FindElement(name) : nullptr;
}

/// Returns the number in a child if the file states it.
std::optional<double> number(const ::sdf::ElementPtr& e, const char* name) {
  const ::sdf::ElementPtr found = child(e, name);
  if (!found || !found->GetExplicitlySetInFile()) return std::nullopt;
  return found->Get<double>();
}

std::optional<Shape> shape_of(const ::sdf::Geometry& g, const Intern& intern) {
  switch (g.Type()) {
    case ::sdf::GeometryType::BOX:
      return Shape::box(vector_of(g.BoxShape()->Size()));
    case ::sdf::GeometryType::SPHERE:
      return Shape::sphere(g.SphereShape()->Radius());
    case ::sdf::GeometryType::CYLINDER:
      return Shape::cylinder(g.CylinderShape()->Radius(), g.CylinderShape()->Length());
    case ::sdf::GeometryType::CAPSULE:
      return Shape::capsule(g.CapsuleShape()->Radius(), g.CapsuleShape()->Length());
    case ::sdf::GeometryType::PLANE: {
      Shape plane = Shape::plane();
      plane.origin.orientation = turn_between(Vec3::UnitZ(), vector_of(g.PlaneShape()->Normal()).normalized());
      return plane;
    }
    case ::sdf::GeometryType::MESH:
      return Shape{
          .kind = ShapeKind::mesh, .mesh = intern(g.MeshShape()->Uri()), .size = vector_of(g.MeshShape()->Scale())};
    case ::sdf::GeometryType::HEIGHTMAP: {
      const ::sdf::Heightmap& map = *g.HeightmapShape();
      Shape shape{.kind = ShapeKind::heightmap, .mesh = intern(map.Uri()), .size = vector_of(map.Size())};
      shape.origin.position = vector_of(map.Position());
      if (map.TextureCount() == 0) return shape;
      shape.texture = intern(map.TextureByIndex(0)->Diffuse());
      shape.material_source = MaterialSource::model;
      shape.color.setOnes();
      return shape;
    }
    default:
      return std::nullopt;
  }
}

class LinkReader {
 public:
  LinkReader(const ::sdf::Link& link, const std::string& name, const SourceFiles& sources, const Intern& intern,
             Problems& problems)
      : link_(link), owner_("link " + quote(name)), sources_(sources), intern_(intern), problems_(problems) {}

  LinkBody run(bool movable) {
    LinkBody out;
    for (std::uint64_t i = 0; i < link_.CollisionCount(); ++i) {
      const ::sdf::Collision& c = *link_.CollisionByIndex(i);
      const auto shape = placed(c.Geom(), c.SemanticPose(), c.Element());
      if (!shape) continue;
      out.collisions.push_back(*shape);
      surface(out.collisions.back(), c.Element());
    }
    for (std::uint64_t i = 0; i < link_.VisualCount(); ++i) {
      const ::sdf::Visual& v = *link_.VisualByIndex(i);
      const auto shape = placed(v.Geom(), v.SemanticPose(), v.Element());
      if (!shape) continue;
      out.visuals.push_back(*shape);
      out.materials.push_back(intern_(v.Name()));
      color(out.visuals.back(), v.Element());
    }
    if (movable) out.inertial = inertial(out.collisions.empty() ? out.visuals : out.collisions);
    return out;
  }

 private:
  std::optional<Shape> placed(const ::sdf::Geometry* geometry, const ::sdf::SemanticPose& pose,
                              const ::sdf::ElementPtr& element) {
    std::optional<Shape> shape = geometry ? shape_of(*geometry, intern_) : std::nullopt;
    if (!shape) return shape;
    ignition::math::Pose3d p;
    const ::sdf::Errors errors = pose.Resolve(p, link_.Name());
    if (!errors.empty()) {
      problems_.error(location_of(sources_, element), "libsdformat: " + errors.front().Message());
      return std::nullopt;
    }
    shape->origin = pose_of(p) * shape->origin;
    return shape;
  }

  void surface(Shape& shape, const ::sdf::ElementPtr& collision) {
    const ::sdf::ElementPtr surface = child(collision, "surface"), friction = child(surface, "friction");
    const ::sdf::ElementPtr ode = child(friction, "ode"), bullet = child(friction, "bullet");
    const std::optional<double> mu = number(ode, "mu"), mu2 = number(ode, "mu2");
    const std::optional<double> other = number(bullet, "friction"), other2 = number(bullet, "friction2");
    const std::optional<double> first = mu ? mu : other, second = mu ? mu2 : other2;
    shape.surface.friction = first.value_or(1);
    const FileLocation location = location_of(sources_, friction ? friction : collision);
    if (first && second && *first != *second)
      problems_.note(location, concat(owner_, ": friction is ", *first, " along and ", *second,
                                      " across; it is the same in all directions, and the first is used"));
    shape.surface.friction = std::min(shape.surface.friction, limits::friction);
    if (shape.surface.friction < 0) {
      problems_.warning(location, concat(owner_, ": friction ", shape.surface.friction,
                                         " is negative; 1 is used, SDFormat's default"));
      shape.surface.friction = 1;
    }
    shape.surface.restitution = number(child(surface, "bounce"), "restitution_coefficient").value_or(0);
    if (!(shape.surface.restitution >= 0 && shape.surface.restitution <= 1)) {
      problems_.warning(location,
                        concat(owner_, ": restitution_coefficient ", shape.surface.restitution, " is taken as ",
                               std::clamp(shape.surface.restitution, 0.0, 1.0), "; it is between 0 and 1"));
      shape.surface.restitution = std::clamp(shape.surface.restitution, 0.0, 1.0);
    }
    turning_resistance(shape.surface, friction, location);
  }

  /// Sets Bullet's rolling friction, and the torsional friction 3 pi / 16 mu a of a patch with an even pressure under a
  /// ball (SDFormat, torsional friction).
  void turning_resistance(Surface& surface, const ::sdf::ElementPtr& friction, const FileLocation& location) {
    const ::sdf::ElementPtr torsional = child(friction, "torsional");
    const bool has_patch = torsional && torsional->Get<bool>("use_patch_radius", true).first;
    surface.rolling_resistance = number(child(friction, "bullet"), "rolling_friction").value_or(0);
    surface.spinning_resistance = has_patch ? 3 * M_PI / 16 * number(torsional, "coefficient").value_or(1) *
                                                  number(torsional, "patch_radius").value_or(0)
                                            : 0;
    for (double* resistance : {&surface.rolling_resistance, &surface.spinning_resistance}) {
      if (*resistance >= 0 && *resistance <= limits::max_size) continue;
      problems_.warning(location, concat(owner_, ": a rolling or torsional friction of ", *resistance,
                                         " m is left out; it is from 0 to 1e6 m"));
      *resistance = 0;
    }
  }

  void color(Shape& shape, const ::sdf::ElementPtr& visual) {
    const ::sdf::ElementPtr material = child(visual, "material");
    for (const char* name : {"ambient", "diffuse"}) {
      const ::sdf::ElementPtr found = child(material, name);
      if (!found || !found->GetExplicitlySetInFile()) continue;
      const auto c = found->Get<ignition::math::Color>();
      shape.color = Eigen::Vector4f(c.R(), c.G(), c.B(), c.A()).cast<double>().cwiseMax(0).cwiseMin(1);
      shape.material_source = MaterialSource::model;
    }
    const ::sdf::ElementPtr pbr = child(material, "pbr");
    for (const char* workflow : {"metal", "specular"}) {
      const ::sdf::ElementPtr map = child(child(pbr, workflow), "albedo_map");
      if (!map || map->Get<std::string>().empty()) continue;
      shape.texture = intern_(map->Get<std::string>());
      if (shape.material_source == MaterialSource::file) shape.color.setOnes();
      shape.material_source = MaterialSource::model;
    }
    shape.color[3] *= 1 - std::clamp(number(visual, "transparency").value_or(0), 0.0, 1.0);
  }

  Inertia inertial(std::span<const Shape> shapes) {
    const ::sdf::ElementPtr given = child(link_.Element(), "inertial");
    const FileLocation location = location_of(sources_, given ? given : link_.Element());
    if (!given)
      problems_.warning(location,
                        owner_ + " has no <inertial>; SDFormat's default is used, 1 kg and 1 kg m^2 about each axis");
    const ::sdf::ElementPtr tensor = child(given, "inertia");
    Inertia i{.mass = number(given, "mass").value_or(1),
              .ixx = number(tensor, "ixx").value_or(1),
              .iyy = number(tensor, "iyy").value_or(1),
              .izz = number(tensor, "izz").value_or(1),
              .ixy = number(tensor, "ixy").value_or(0),
              .ixz = number(tensor, "ixz").value_or(0),
              .iyz = number(tensor, "iyz").value_or(0)};
    if (given && !tensor)
      problems_.warning(location, owner_ + " has no <inertia>; SDFormat's default is used, 1 kg m^2 about each axis");
    const ::sdf::ElementPtr pose = child(given, "pose");
    const Pose frame = pose ? pose_of(pose->Get<ignition::math::Pose3d>()) : Pose{};
    return model_file::checked_inertia(i, frame, shapes, owner_, location, problems_);
  }

  const ::sdf::Link& link_;
  std::string owner_;
  const SourceFiles& sources_;
  const Intern& intern_;
  Problems& problems_;
};

}  // namespace

LinkBody body_of(const ::sdf::Link& link, const std::string& name, bool movable, const SourceFiles& sources,
                 const Intern& intern, Problems& problems) {
  return LinkReader(link, name, sources, intern, problems).run(movable);
}

}  // namespace muro::sdf
