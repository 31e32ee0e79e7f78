// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/text_table.hpp"
#include "muro/ext/package_folders.hpp"
#include "muro/robot_builder.hpp"
#include "muro/shape.hpp"

namespace muro {

/// The tree of a robot model: built block by block, and flattened for traversal. A model is read once and makes any
/// number of robots (World::add_robot).
class RobotTree final : public RobotBuilder, public PackageFolders {
 public:
  /// One block, in the order of building (depth first).
  struct Node {
    NodeKind kind;
    std::string name;          ///< base, joints and bodies
    std::int32_t parent = -1;  ///< index of the preceding block of its branch
  };
  /// A constant of a component.
  struct Constant {
    KeyInfo key;
    std::uint32_t count;  ///< elements of an array, or single_value
    std::vector<std::byte> data;
  };
  /// A body or joint; it becomes an object.
  struct Component {
    std::string name;
    std::vector<Constant> constants;
    std::vector<TextId> visual_materials;  ///< names, for each of `visual.shapes`; shapes beyond its end have none
  };
  /// A replacement for a material.
  struct Material {
    std::optional<Eigen::Vector4d> color;  ///< red, green, blue, alpha, 0..1
    std::string texture;                   ///< path of a picture; empty: unchanged
  };
  /// A link that still has indices of components instead of objects.
  struct FlatLink {
    std::int32_t body = -1;
    std::int32_t joint = -1;  ///< -1: none
    Link link;                ///< without object ids
    std::string mimic_leader;
  };
  /// A subsystem that the model contains, written as in a scenario.
  struct Subsystem {
    std::string text;
    int line = 0, column = 0;  ///< in the model's file, from 1; 0: unknown
  };
  struct Problem {
    Severity severity;
    std::string text;
    int line = 0, column = 0;
  };

  void base(std::string_view name) noexcept override;
  void fork() noexcept override;
  void end() noexcept override;
  void translation(const Vec3& offset) noexcept override;
  void rotation(const Quat& turn) noexcept override;
  void revolute(std::string_view name, const Vec3& axis, const JointLimits& limits) noexcept override;
  void prismatic(std::string_view name, const Vec3& axis, const JointLimits& limits) noexcept override;
  void mimic(std::string_view leader, double multiplier, double offset) noexcept override;
  void body(std::string_view name) noexcept override;
  TextId intern(std::string_view text) noexcept override;
  void report(Severity severity, std::string_view text, int line, int column) noexcept override;

  void* find_extension(const ExtensionId& id) noexcept override;
  std::span<const PackageFolder> package_folders() const noexcept override { return packages_; }
  /// Sets the folders for the reader that builds the tree; they must outlive the reader.
  void set_packages(std::span<const PackageFolder> packages) { packages_ = packages; }

  /// Closes the tree: adds missing bodies, resolves mimics, reports mistakes. Call once after building.
  void close();

  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<Component>& components() const { return components_; }
  const std::vector<FlatLink>& links() const { return links_; }
  const TextTable& texts() const { return texts_; }
  const std::vector<Problem>& problems() const { return problems_; }
  const std::vector<Subsystem>& subsystems() const { return subsystems_; }
  bool usable() const;

  /// Returns the corners (m) of the convex hull of a mesh file; empty: the mesh counts as a point.
  using CornersOfMesh = std::function<std::span<const Vec3>(const std::string& path)>;
  /// Height (m) of the base above the lowest point of the robot's collision shapes. `positions`: position of the joint
  /// of each link (rad or m); empty: all at 0.
  double standing_height(std::span<const double> positions = {}, const CornersOfMesh& corners_of_mesh = {}) const;
  /// Radius (m) of the vertical cylinder about the base's origin that holds all collision shapes.
  double footprint_radius(std::span<const double> positions = {}, const CornersOfMesh& corners_of_mesh = {}) const;
  bool has_collision_meshes() const;
  /// Replaces the limits of the joint of a link. They must be within their ranges, and the link must have a joint.
  void set_limits(std::size_t link, const JointLimits& limits);
  /// Names of all materials of visual shapes, sorted.
  std::vector<std::string> material_names() const;
  /// Replaces the material of all visual shapes whose material has this name. Returns false when there is none.
  bool set_material(std::string_view name, const Material& material);
  /// Removes the shapes for which `is_lost` returns true; `body`: name of the shape's body.
  void remove_collision_shapes(const std::function<bool(const std::string& body, const Shape& shape)>& is_lost);

 private:
  void set_raw(const KeyInfo& key, const void* data, std::uint32_t count) noexcept override;
  void take_materials(std::span<const TextId> names);
  void take_subsystems(std::span<const TextId> texts);
  bool are_interned(std::span<const TextId> ids, const char* what);
  void joint(NodeKind kind, std::string_view name, const Vec3& axis, const JointLimits& limits);
  std::int32_t add_component(std::string_view name);
  void add_node(NodeKind kind, std::string_view name);
  bool started(std::string_view call);
  void check_mass();
  template <class Visit>
  void each_collision_shape(std::span<const double> positions, const CornersOfMesh& corners_of_mesh, Visit visit) const;

  struct Cursor {
    std::int32_t node = -1;
    std::int32_t link = -1;
    Pose since;            ///< pose relative to that link
    bool unnamed = false;  ///< the link's joint has no body yet, and is the last block
    int branches = 0;      ///< number of closed branches of a fork
    bool closed = false;   ///< after a fork with two closed branches: nothing may follow
  };
  Cursor at_;
  std::vector<Cursor> forks_;
  std::int32_t last_component_ = -1;
  std::vector<Node> nodes_;
  std::vector<Component> components_;
  std::vector<FlatLink> links_;
  TextTable texts_;
  std::vector<Problem> problems_;
  std::vector<Subsystem> subsystems_;
  std::span<const PackageFolder> packages_;
  std::map<std::string, std::int32_t, std::less<>> component_index_;
};

}  // namespace muro
