// SPDX-License-Identifier: MIT
// Multi-body dynamics by Bullet (Coumans, bulletphysics.org): robots in joint coordinates (Featherstone), contacts and
// drives by sequential impulses.
#include "bullet_world.hpp"
#include "muro/plugin.hpp"
#include "plugins/motion/common/multibody/engine_description.hpp"
#include "plugins/motion/common/multibody/engine_parameters.hpp"
#include "plugins/motion/common/multibody/world_motion.hpp"

namespace {

using namespace muro;

constexpr Parameter own_parameters[] = {
    integer("iterations", 10, "of the solver").between(1, 10000),
    real("erp", "1", 0.2, "part of a depth or of a passed limit that a step takes back").between(0, 1),
    real("cfm", "s/kg", 0, "softness of contacts").between(0, 1),
    real("slop", "m", 1e-4, "depth of contacts that is not taken back").between(0, 0.01),
    multibody::correcting_speed,
    multibody::bounce_speed,
    real("warm_start", "1", 1, "part of the last step's impulses that the solver begins with").between(0, 1),
    multibody::scenery_meshes,
};
constexpr auto parameters = joined(multibody::common_parameters, own_parameters);
constexpr Description bullet_description = multibody::engine_description(
    "motion.bullet", "1.0.0", "Multi-body dynamics by Bullet; robots of one world touch in it", parameters,
    feature_armature | feature_rolling_resistance | feature_spinning_resistance | feature_heightmaps);

class BulletMotion final : public multibody::WorldMotion {
  const Description& description() const override { return bullet_description; }
  multibody::MinInertia min_inertia() const override {
    return {1e-6, 1e-4, [this](const Shape& s) { return bullet::box_around(s, *meshes_); }};
  }
  std::size_t memory_of(const multibody::RobotModel& model) const override {
    return bullet::ImpulseCache::size_of(model);
  }
  void configure(Connector& c) override {
    const Parameters& p = c.parameters();
    settings_.gravity = gravity();
    settings_.friction_rule = friction_rule();
    settings_.iterations = int(p.integer("iterations"));
    settings_.erp = p.real("erp");
    settings_.cfm = p.real("cfm");
    settings_.slop = p.real("slop");
    settings_.correcting_speed = p.real(multibody::correcting_speed.name);
    settings_.bounce_speed = p.real(multibody::bounce_speed.name);
    settings_.warm_start = p.real("warm_start");
    auto meshes = std::make_shared<bullet::BulletMeshes>();
    meshes->load(c, p.text(multibody::scenery_meshes.name) == "exact", &bullet::convex_hull_shape,
                 &bullet::triangle_mesh_shape);
    meshes_ = std::move(meshes);
  }
  std::unique_ptr<multibody::World> make_world() const override {
    return std::make_unique<bullet::BulletWorld>(settings_, meshes_);
  }
  std::string_view advice() const override { return "a higher rate, `substeps` or more `iterations`"; }

  bullet::BulletSettings settings_;
  std::shared_ptr<const bullet::BulletMeshes> meshes_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<BulletMotion>(bullet_description)};

}  // namespace

MURO_PLUGIN(.name = "motion_bullet", .version = bullet_description.version, .licence = "MIT",
            .summary = "Multi-body dynamics by Bullet", .algorithms = algorithms)
