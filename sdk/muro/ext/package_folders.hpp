// SPDX-License-Identifier: MIT
// Where a reader of models asks for the folders of packages that its user has named.
#pragma once

#include <span>
#include <string_view>

namespace muro {

/// A package, as in package://NAME/meshes/wheel.stl and model://NAME/model.sdf.
struct PackageFolder {
  std::string_view name;
  std::string_view folder;  ///< absolute
};

inline namespace package_folders_1 {

/// A RobotBuilder or WorldBuilder may also be this. A builder is asked by its type, whose name has the version of this
/// interface in it: one of another version is none.
class PackageFolders {
 public:
  /// Each name once. They go before whatever else the reader would look for. Valid while the reader reads. [setup]
  virtual std::span<const PackageFolder> package_folders() const noexcept = 0;

  /// Of `builder`; none where it does not know any.
  template <class Builder>
  static std::span<const PackageFolder> of(const Builder& builder) {
    const auto* known = dynamic_cast<const PackageFolders*>(&builder);
    return known ? known->package_folders() : std::span<const PackageFolder>();
  }

 protected:
  ~PackageFolders() = default;
};

}  // namespace package_folders_1

}  // namespace muro
