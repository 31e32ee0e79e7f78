// SPDX-License-Identifier: MIT
#include "read.hpp"

#include <sdf/sdf.hh>

#include "bodies.hpp"
#include "build.hpp"
#include "plugins/common/model_file/text_file.hpp"
#include "plugins/common/parser_process/limits.hpp"

namespace muro::sdf {

namespace {

namespace fs = std::filesystem;

/// Reports a world to its builder.
class WorldReader {
 public:
  WorldReader(const SourceFiles& sources, WorldBuilder& builder, Problems& problems)
      : sources_(sources), builder_(builder), problems_(problems) {}

  void run(const ::sdf::World& world) {
    const auto gravity = world.Gravity();
    if (world.Element()->HasElement("gravity") && world.Element()->FindElement("gravity")->GetExplicitlySetInFile())
      builder_.gravity({gravity.X(), gravity.Y(), gravity.Z()});
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      const ::sdf::Model& model = *world.ModelByIndex(i);
      ignition::math::Pose3d pose;
      const FileLocation location = location_of(sources_, model.Element());
      const ::sdf::Errors errors = model.SemanticPose().Resolve(pose);
      if (!errors.empty())
        problems_.error(location, "libsdformat: " + errors.front().Message());
      else if (model.Static())
        add_scenery(model, pose_of(pose));
      else
        add_model(model, pose_of(pose));
    }
  }

 private:
  std::string unique(std::string_view wanted) {
    std::string name = plain_name(wanted);
    while (!names_.insert(name).second) name += "_";
    return name;
  }

  void add_scenery(const ::sdf::Model& model, const Pose& pose) {
    const Assembly assembly = assemble(model, false, sources_, problems_);
    std::vector<std::pair<const Body*, LinkBody>> solids;
    for (const Body& body : assembly.bodies) {
      LinkBody solid = body_of(
          *body.link, body.name, false, sources_, [this](std::string_view text) { return builder_.intern(text); },
          problems_);
      if (!solid.collisions.empty() || !solid.visuals.empty()) solids.emplace_back(&body, std::move(solid));
    }
    for (const auto& [body, solid] : solids)
      builder_.scenery(unique(solids.size() == 1 ? model.Name() : model.Name() + "::" + body->name), pose * body->pose,
                       solid.collisions, solid.visuals);
  }

  void add_model(const ::sdf::Model& model, const Pose& pose) {
    // who builds a robot reports to it: a model that nobody uses as a robot need not be one
    std::vector<std::tuple<Severity, std::string, int, int>> reports;
    Problems own([&reports](Severity s, std::string_view text, int line, int column) {
      reports.emplace_back(s, std::string(text), line, column);
    });
    Assembly assembly = assemble(model, true, sources_, own);
    if (assembly.bodies.empty()) return;
    make_tree(assembly, model, own);
    RobotBuilder& robot = builder_.model(unique(model.Name()), pose * assembly.bodies[std::size_t(assembly.base)].pose);
    build(assembly, sources_, robot, own);
    for (const auto& [severity, text, line, column] : reports) robot.report(severity, text, line, column);
  }

  const SourceFiles& sources_;
  WorldBuilder& builder_;
  Problems& problems_;
  std::set<std::string> names_;
};

/// libsdformat takes 90 kB and 0.3 ms for an element.
void allow_for(const SourceFiles& sources) {
  const std::size_t elements = sources.main().elements;
  parser_process::allow({std::uint64_t(elements) * 150'000, double(elements) * 0.005});
}

void tell_pose(const ::sdf::Model& model, const SourceFiles& sources, Problems& problems) {
  if (model.RawPose() != ignition::math::Pose3d::Zero)
    problems.note(location_of(sources, model.Element()),
                  "the <pose> of the model is not used: the scenario says where a robot stands");
  if (model.Static())
    problems.note(location_of(sources, model.Element()), "the model is static; a robot without a motion stands still");
}

}  // namespace

void read_text(std::string bytes, const fs::path& folder, RobotBuilder& builder) {
  Problems problems = Problems::reported_to(builder);
  SourceFiles sources(folder, problems);
  if (!sources.load(std::move(bytes), Content::model)) return;
  allow_for(sources);
  Library library;
  ::sdf::Root root;
  if (!library.load(sources, root, problems)) return;
  const ::sdf::Model* model = root.Model();
  if (!model) return problems.error({}, "libsdformat finds no model in the file, and gives no reason");
  tell_pose(*model, sources, problems);
  Assembly assembly = assemble(*model, true, sources, problems);
  if (assembly.bodies.empty()) return problems.error(location_of(sources, model->Element()), "the model has no link");
  if (problems.found_error()) return;
  make_tree(assembly, *model, problems);
  build(assembly, sources, builder, problems);
}

void read_world_text(std::string bytes, const fs::path& folder, WorldBuilder& builder) {
  Problems problems = Problems::reported_to(builder);
  SourceFiles sources(folder, problems);
  if (!sources.load(std::move(bytes), Content::world)) return;
  allow_for(sources);
  Library library;
  ::sdf::Root root;
  if (!library.load(sources, root, problems)) return;
  if (root.WorldCount() == 0) return problems.error({}, "libsdformat finds no world in the file, and gives no reason");
  WorldReader(sources, builder, problems).run(*root.WorldByIndex(0));
}

void read_file(const std::string& path, RobotBuilder& builder) {
  read_text(model_file::load_file(path, ".sdf"), fs::absolute(path).parent_path(), builder);
}

void read_world_file(const std::string& path, WorldBuilder& builder) {
  read_world_text(model_file::load_file(path, ".sdf"), fs::absolute(path).parent_path(), builder);
}

}  // namespace muro::sdf
