// SPDX-License-Identifier: MIT
#include "host/commands/model_check/model_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/instance.hpp"
#include "host/names.hpp"
#include "host/scenario/features/unsupported_features.hpp"

namespace muro::host {

namespace {

std::string counted(const std::vector<std::string>& names, const char* noun, std::size_t most) {
  return fmt::format("{} ({})", plural(names.size(), noun), first_of(names, most));
}

/// Templates with the same findings.
struct Block {
  std::vector<std::string> templates;
  std::size_t robots = 0;
  std::string model;  ///< "arm.urdf: 7 links, 6 joints, 12 kg; motion.ode"
  std::vector<Finding> findings;
};

/// Adds what a second motion of the same robot lacks, each finding once.
void add_findings(std::vector<Finding>& all, const std::vector<Finding>& more) {
  for (const Finding& f : more) {
    const auto same = std::find_if(all.begin(), all.end(), [&](const Finding& k) { return k.what == f.what; });
    if (same == all.end()) {
      all.push_back(f);
      continue;
    }
    for (const Effect& e : f.effects) {
      const auto known =
          std::find_if(same->effects.begin(), same->effects.end(), [&](const Effect& k) { return k.text == e.text; });
      if (known == same->effects.end())
        same->effects.push_back(e);
      else
        for (const std::string& motion : e.motions)
          if (std::find(known->motions.begin(), known->motions.end(), motion) == known->motions.end())
            known->motions.push_back(motion);
    }
  }
}

/// Returns "motion.ode, motion.bullet: joints follow ..."
std::string text_of(const Effect& e) { return e.motions.empty() ? e.text : comma_separated(e.motions) + ": " + e.text; }

class ModelCheck {
 public:
  ModelCheck(const BuiltScenario& built, Length length)
      : built_(built), names_(length == Length::full ? 1000 : 3), unsupported_(find_unsupported_features(built)) {
    for (const RobotTemplate& t : built.scenario.robots) add(t);
  }
  const std::vector<Block>& blocks() const { return blocks_; }

 private:
  void add(const RobotTemplate& t) {
    const World& world = built_.simulation->world();
    if (t.subsystems.size() == 0) return;
    const RobotView* const robot = world.find_robot(instance_name(t.name, t.numbered, 0));
    if (!robot) return;
    const std::vector<CheckedMotion> motions = motions_of(*robot);
    if (motions.empty()) return;
    const ModelFacts facts = model_facts(world, *robot, t);
    Block block;
    block.templates = {t.name};
    block.robots = t.subsystems.size();
    std::string used;
    for (const CheckedMotion& m : motions) {
      if (used.find(m.id) == used.npos) used += (used.empty() ? "" : ", ") + m.id;
      add_findings(block.findings, findings_of(facts, m, names_));
      for (const UnsupportedFeatures& u : unsupported_)
        if (u.robots == t.name && u.motion == m.id)
          block.findings.push_back({"", {{text_of(u, Detail::brief), {m.id}}}, ""});
    }
    const std::string file = t.shape        ? "a shape"
                             : t.from_world ? "a model of the world file"
                                            : std::filesystem::path(t.model).filename().string();
    block.model = fmt::format("{}: {}, {}, {:.4g} kg; {}", file, plural(facts.links, "link"),
                              plural(facts.joints.size(), "joint"), facts.mass, used);
    join(std::move(block));
  }

  std::vector<CheckedMotion> motions_of(const RobotView& robot) const {
    std::vector<CheckedMotion> all;
    for (const auto& instance : built_.simulation->instances()) {
      if (instance->description().kind != Kind::motion) continue;
      const AlgorithmSetup& setup = instance->setup();
      for (std::size_t i = 0; i < setup.items.size(); ++i) {
        if (setup.items[i].robot != &robot) continue;
        const auto& parameters = setup.item_setups.empty() ? setup.parameters : setup.item_setups[i].parameters;
        const auto base = parameters.find("base");
        const auto* text = base == parameters.end() ? nullptr : std::get_if<std::string>(&base->second);
        CheckedMotion& motion = all.emplace_back();
        motion = {setup.use, instance->description().features, text && *text == "fixed", {}, {}};
        if ((motion.features & feature_forces) == 0) continue;
        UncommandedJoints joints =
            uncommanded_joints(built_.simulation->world(), robot, instance->description(), parameters);
        (joints.are_all ? motion.held : motion.freed) = joints.are_all ? joints.all : joints.with_stops;
      }
    }
    return all;
  }

  void join(Block block) {
    for (Block& b : blocks_)
      if (b.model == block.model && b.findings == block.findings) {
        b.templates.push_back(block.templates.front());
        b.robots += block.robots;
        return;
      }
    blocks_.push_back(std::move(block));
  }

  const BuiltScenario& built_;
  std::size_t names_;
  std::vector<UnsupportedFeatures> unsupported_;
  std::vector<Block> blocks_;
};

void add_text(const Block& b, std::size_t names, std::vector<std::string>& lines) {
  const std::string count = b.robots > b.templates.size() ? fmt::format(" ({} robots)", b.robots) : "";
  lines.push_back(fmt::format("{}{}, {}", first_of(b.templates, names), count, b.model));
  for (const Finding& f : b.findings) {
    std::string text = "  - " + f.what;
    for (const Effect& e : f.effects) {
      const bool one_line = f.what.empty() || (f.effects.size() == 1 && f.what.size() + text_of(e).size() < 90);
      text += (f.what.empty() ? "" : one_line ? "; " : ";\n      ") + text_of(e);
    }
    if (!f.remedy.empty()) text += "\n      " + f.remedy;
    lines.push_back(std::move(text));
  }
}

}  // namespace

std::string first_of(const std::vector<std::string>& names, std::size_t most) {
  std::string text;
  const std::size_t shown = names.size() <= most + 1 ? names.size() : most;  // "and 1 more" is not shorter than a name
  for (std::size_t i = 0; i < shown; ++i) text += fmt::format("{}`{}`", i > 0 ? ", " : "", names[i]);
  return shown < names.size() ? fmt::format("{} and {} more", text, names.size() - shown) : text;
}

std::vector<Finding> findings_of(const ModelFacts& facts, const CheckedMotion& motion, std::size_t names) {
  std::vector<Finding> all;
  const bool forces = (motion.features & feature_forces) != 0;
  const auto says = [&](const char* text) { return std::vector<Effect>{{text, {motion.id}}}; };
  if (forces && motion.fixed_base && facts.moving_links > 0 && !facts.moves_mass())
    all.push_back({fmt::format("no link that moves has mass: {}", counted(facts.without_mass, "link", names)),
                   says("joints follow targets of position or velocity within limits, without forces"),
                   "For forces, give the links mass and inertia: `<inertial>`."});
  if (!facts.has_collision_shapes)
    all.push_back({"no link has a shape for collision",
                   says(!forces             ? "nothing meets it"
                        : motion.fixed_base ? "nothing meets it, and it meets nothing"
                                            : "nothing holds it: it falls through the ground"),
                   "Give its links shapes: `<collision>`."});
  if (!facts.clamped.empty())
    all.push_back({counted(facts.clamped, "joint", names) + " cannot be at 0 at the start",
                   {{"the nearest limit is taken", {}}},
                   "To start elsewhere, set `joints: {NAME: POSITION}` of the robot."});
  if (facts.moves_mass() || !motion.fixed_base) {
    if (!motion.held.empty())
      all.push_back({"nothing commands " + counted(motion.held, "joint", names),
                     says("held at speed 0, as a program outside may command them"),
                     "`joints: passive` lets them turn freely, `joints: velocity` says that they are to be held."});
    if (!motion.freed.empty())
      all.push_back({"nothing commands " + counted(motion.freed, "joint", names) + ", but others of the robot",
                     says("they turn freely"), "To hold them, name them in `velocity_joints` or `position_joints`."});
  }
  if ((motion.features & feature_joint_effort_limits) != 0 && facts.moves_mass() && !facts.of_any_strength.empty())
    all.push_back({counted(facts.of_any_strength, "driven joint", names) + " without a limit of effort",
                   says("drives are as strong as it takes"), "State it: `<limit effort>`, N m or N."});
  return all;
}

std::vector<std::string> check_lines(const BuiltScenario& built, Length length) {
  const ModelCheck check(built, length);
  constexpr std::size_t most_lines = 32;
  const std::size_t names = length == Length::full ? 1000 : 3;
  std::vector<std::string> lines, fine, left;
  std::size_t printed = 0;
  for (const Block& b : check.blocks()) {
    if (b.findings.empty()) {
      fine.insert(fine.end(), b.templates.begin(), b.templates.end());
      continue;
    }
    std::vector<std::string> text;
    add_text(b, names, text);
    std::size_t size = 0;
    for (const std::string& line : text) size += 1 + std::size_t(std::count(line.begin(), line.end(), '\n'));
    if (length == Length::screen && printed > 0 && printed + size > most_lines) {
      left.insert(left.end(), b.templates.begin(), b.templates.end());
      continue;
    }
    printed += size;
    lines.insert(lines.end(), text.begin(), text.end());
  }
  if (!left.empty())
    lines.push_back(fmt::format("and {} more lack something: {}; `muro check --full` tells what",
                                plural(left.size(), "model"), first_of(left, names)));
  if (!fine.empty()) lines.push_back(fmt::format("{}: nothing is lacking", first_of(fine, names)));
  return lines;
}

}  // namespace muro::host
