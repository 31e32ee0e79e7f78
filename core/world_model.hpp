// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <optional>
#include <span>

#include "core/robot_tree.hpp"
#include "muro/model_reader.hpp"
#include "muro/toolkit/pair_surface.hpp"

namespace muro {

/// A world as a file describes it (Simulation::read_world), before any part of it is in a simulation.
class WorldModel final : public WorldBuilder, public PackageFolders {
 public:
  struct Scenery {
    std::string name;
    Pose pose;
    std::vector<Shape> collisions, visuals;
  };
  /// A model that can move.
  struct Model {
    std::string name;
    Pose pose;  ///< pose of its base
    RobotTree tree;
  };

  void gravity(const Vec3& acceleration) noexcept override;
  void scenery(std::string_view name, const Pose& pose, const Rows<Shape>& collisions,
               const Rows<Shape>& visuals) noexcept override;
  RobotBuilder& model(std::string_view name, const Pose& pose) noexcept override;
  TextId intern(std::string_view text) noexcept override;
  void report(Severity severity, std::string_view text, int line, int column) noexcept override;
  void friction_rule(std::uint32_t rule) noexcept override;

  void* find_extension(const ExtensionId& id) noexcept override;
  std::span<const PackageFolder> package_folders() const noexcept override { return packages_; }
  /// Sets the folders for the reader that builds the model; they must outlive the reader.
  void set_packages(std::span<const PackageFolder> packages) { packages_ = packages; }

  /// Closes the trees, and checks what concerns several of them. Call once after building.
  void close();

  /// Gravity in the file, if it gives one.
  const std::optional<Vec3>& gravity() const { return gravity_; }
  std::optional<FrictionRule> friction_rule() const { return friction_rule_; }
  const std::deque<Scenery>& scenery() const { return scenery_; }
  const std::deque<Model>& models() const { return models_; }
  /// Texts that the shapes of scenery name; a tree has texts of its own.
  const TextTable& texts() const { return texts_; }
  /// Problems of the whole file. Those of one model are in its tree: a tree with errors makes no robot, only scenery.
  const std::vector<RobotTree::Problem>& problems() const { return problems_; }

 private:
  std::optional<Vec3> gravity_;
  std::optional<FrictionRule> friction_rule_;
  std::deque<Scenery> scenery_;
  std::deque<Model> models_;
  TextTable texts_;
  std::vector<RobotTree::Problem> problems_;
  std::span<const PackageFolder> packages_;
};

}  // namespace muro
