// SPDX-License-Identifier: MIT
#include "build.hpp"

#include "bodies.hpp"
#include "devices.hpp"
#include "joints.hpp"
#include "muro/vocabulary.hpp"
#include "muro/vocabulary/model.hpp"
#include "plugins/common/model_file/build_tree.hpp"

namespace muro::sdf {

namespace {

class TreeBuilder {
 public:
  TreeBuilder(Assembly& assembly, const SourceFiles& sources, RobotBuilder& builder, Problems& problems)
      : a_(assembly),
        sources_(sources),
        builder_(builder),
        problems_(problems),
        joints_(assembly, sources, builder, problems) {}

  void run(const ::sdf::Model& model) {
    builder_.base(body(a_.base).name);
    add_devices(a_, model, sources_, builder_, problems_);
    fill(a_.base);
    model_file::build_tree(builder_, children_of(a_.base), [this](const Child& child) { return add(child); });
    if (problems_.found_error()) return;
    joints_.check_mimic_limits();
    if (mass_ == 0)
      problems_.warning(body(a_.base).location, "no link has a mass; only motion without forces can move the robot");
  }

 private:
  struct Child {
    int body;
    int joint = -1;   ///< the joint that leads to it; -1: none
    int holder = -1;  ///< the body that holds it if there is no joint
  };

  const Body& body(int i) const { return a_.bodies[std::size_t(i)]; }

  std::vector<Child> children_of(int parent) const {
    std::vector<Child> children;
    for (const int j : body(parent).child_joints) children.push_back({a_.joints[std::size_t(j)].child, j});
    for (const int b : body(parent).attached) children.push_back({b, -1, parent});
    return children;
  }

  std::vector<Child> add(const Child& child) {
    if (child.joint >= 0)
      joints_.add(child.joint);
    else
      joints_.add_transform(body(child.holder).pose.inverse() * body(child.body).pose);
    builder_.body(body(child.body).name);
    fill(child.body);
    return children_of(child.body);
  }

  void fill(int i) {
    const Body& b = body(i);
    if (!b.link) return;
    LinkBody solid = body_of(
        *b.link, b.name, true, sources_, [this](std::string_view text) { return builder_.intern(text); }, problems_);
    if (b.is_caster_ball)
      for (Shape& s : solid.collisions) s.surface.friction = 0;
    mass_ += solid.inertial.mass;
    if (solid.inertial.mass > 0) builder_.set(keys::inertial, solid.inertial);
    if (!solid.collisions.empty()) builder_.set_array<Shape>(keys::collision_shapes, solid.collisions);
    if (solid.visuals.empty()) return;
    builder_.set_array<Shape>(keys::visual_shapes, solid.visuals);
    builder_.set_array<TextId>(keys::visual_materials, solid.materials);
  }

  Assembly& a_;
  const SourceFiles& sources_;
  RobotBuilder& builder_;
  Problems& problems_;
  Joints joints_;
  double mass_ = 0;
};

}  // namespace

void build(Assembly& assembly, const ::sdf::Model& model, const SourceFiles& sources, RobotBuilder& builder,
           Problems& problems) {
  TreeBuilder(assembly, sources, builder, problems).run(model);
}

}  // namespace muro::sdf
