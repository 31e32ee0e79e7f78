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

/// Builds a world with its builder.
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
        leave_out(model, location, "libsdformat: " + errors.front().Message());
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

  void leave_out(const ::sdf::Model& model, const FileLocation& location, const std::string& reason) {
    problems_.warning(location, concat("model ", quote(model.Name()), " is left out: ", reason));
  }

  void add_scenery(const ::sdf::Model& model, const Pose& pose) {
    // mistakes in one model end the reading of that model only
    Problems own([&](Severity severity, std::string_view text, int line, int column) {
      if (severity == Severity::error)
        leave_out(model, Location{line, column}, std::string(text));
      else
        problems_.report(severity, Location{line, column}, std::string(text));
    });
    const Assembly assembly = assemble(model, false, sources_, own);
    std::vector<std::pair<const Body*, LinkBody>> solids;
    for (const Body& body : assembly.bodies) {
      LinkBody solid = body_of(
          *body.link, body.name, false, sources_, [this](std::string_view text) { return builder_.intern(text); }, own);
      if (!solid.collisions.empty() || !solid.visuals.empty()) solids.emplace_back(&body, std::move(solid));
    }
    if (own.found_error()) return;
    for (const auto& [body, solid] : solids)
      builder_.scenery(unique(solids.size() == 1 ? model.Name() : model.Name() + "::" + body->name), pose * body->pose,
                       solid.collisions, solid.visuals);
  }

  void add_model(const ::sdf::Model& model, const Pose& pose) {
    // problems go to the robot's builder: a model that is not used as a robot may be invalid
    std::vector<std::tuple<Severity, std::string, int, int>> reports;
    Problems own([&reports](Severity s, std::string_view text, int line, int column) {
      reports.emplace_back(s, std::string(text), line, column);
    });
    Assembly assembly = assemble(model, true, sources_, own);
    if (assembly.bodies.empty()) return;
    make_tree(assembly, model, own);
    RobotBuilder& robot = builder_.model(unique(model.Name()), pose * assembly.bodies[std::size_t(assembly.base)].pose);
    build(assembly, model, sources_, robot, own);
    for (const auto& [severity, text, line, column] : reports) robot.report(severity, text, line, column);
  }

  const SourceFiles& sources_;
  WorldBuilder& builder_;
  Problems& problems_;
  std::set<std::string> names_;
};

/// Sets the limits of memory and time. libsdformat takes 90 kB and 0.3 ms for an element.
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

/// Returns the models and includes of the world that is read.
std::vector<Element*> models_of(const SourceFiles& sources) {
  std::vector<Element*> models;
  for (Element* e : model_file::children(*sources.main().content))
    if (std::string_view(e->Name()) == "model" || std::string_view(e->Name()) == "include") models.push_back(e);
  return models;
}

/// Removes from the world the models that libsdformat cannot read, and reports each reason. Returns false if
/// libsdformat can read each model alone.
bool leave_out_bad_models(SourceFiles& sources, Library& library, Problems& problems) {
  bool found = false;
  for (Element* model : models_of(sources)) {
    ::sdf::Root alone;
    const auto mistakes = library.load(sources, sources.with_only(*model), alone);
    if (mistakes.empty()) continue;
    found = true;
    const FileLocation here = sources.main().location_of(*model);
    const char* name = model->Attribute("name");
    problems.warning(here, concat(name ? "model " : "an included model", name ? quote(name) : "",
                                  " is left out: ", mistakes.front().text));
    sources.remove_from_world(*model);
  }
  return found;
}

/// Returns false, with errors reported, if libsdformat cannot read the world.
bool load_world(SourceFiles& sources, Library& library, ::sdf::Root& root, Problems& problems) {
  auto mistakes = library.load(sources, sources.main().normalized, root);
  if (!mistakes.empty() && leave_out_bad_models(sources, library, problems)) {
    root = ::sdf::Root();
    mistakes = library.load(sources, sources.main().normalized, root);
  }
  for (const Library::Mistake& m : mistakes) problems.error(m.location, m.text);
  return mistakes.empty();
}

/// Builds a robot without links: for a light, an actor, or an empty static model.
void build_frame(const std::string& name, RobotBuilder& builder) { builder.base(plain_name(name)); }

}  // namespace

void read_text(std::string bytes, const fs::path& folder, RobotBuilder& builder, const model_file::Packages& packages) {
  Problems problems = Problems::reported_to(builder);
  SourceFiles sources(folder, problems, packages);
  if (!sources.load(std::move(bytes), Content::model)) return;
  if (!sources.main().content) return build_frame(sources.main().alone, builder);
  allow_for(sources);
  Library library;
  ::sdf::Root root;
  for (const Library::Mistake& m : library.load(sources, sources.main().normalized, root))
    problems.error(m.location.line > 0 ? m.location : sources.main().location_of(*sources.main().content), m.text);
  if (problems.found_error()) return;
  const ::sdf::Model* model = root.Model();
  if (!model) return problems.error({}, "libsdformat finds no model in the file, and gives no reason");
  tell_pose(*model, sources, problems);
  Assembly assembly = assemble(*model, true, sources, problems);
  if (assembly.bodies.empty()) {
    problems.warning(location_of(sources, model->Element()),
                     "the model has no link; the robot is a frame without a body");
    return build_frame(model->Name(), builder);
  }
  if (problems.found_error()) return;
  make_tree(assembly, *model, problems);
  build(assembly, *model, sources, builder, problems);
}

void read_world_text(std::string bytes, const fs::path& folder, WorldBuilder& builder,
                     const model_file::Packages& packages) {
  Problems problems = Problems::reported_to(builder);
  SourceFiles sources(folder, problems, packages);
  if (!sources.load(std::move(bytes), Content::world)) return;
  allow_for(sources);
  Library library;
  ::sdf::Root root;
  if (!load_world(sources, library, root, problems)) return;
  if (root.WorldCount() == 0) return problems.error({}, "libsdformat finds no world in the file, and gives no reason");
  WorldReader(sources, builder, problems).run(*root.WorldByIndex(0));
}

void read_file(const std::string& path, RobotBuilder& builder, const model_file::Packages& packages) {
  read_text(model_file::load_file(path, ".sdf"), fs::absolute(path).parent_path(), builder, packages);
}

void read_world_file(const std::string& path, WorldBuilder& builder, const model_file::Packages& packages) {
  read_world_text(model_file::load_file(path, ".sdf"), fs::absolute(path).parent_path(), builder, packages);
}

}  // namespace muro::sdf
