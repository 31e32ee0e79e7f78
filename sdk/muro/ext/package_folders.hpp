// SPDX-License-Identifier: MIT
// The folders of packages that a user has named, for readers of models.
#pragma once

#include <span>

#include "muro/detail/layout.hpp"
#include "muro/extension.hpp"

namespace muro {

/// A package, as in package://NAME/meshes/wheel.stl and model://NAME/model.sdf.
struct PackageFolder {
  std::string_view name;
  std::string_view folder;  ///< absolute
};

/// An extension of hosts, version 1, for readers: ask the builder for it.
class PackageFolders {
 public:
  /// Returns each name once. These folders have priority over all others that a reader searches. Valid while the reader
  /// reads. [setup]
  virtual std::span<const PackageFolder> package_folders() const noexcept = 0;

  static ExtensionId id() noexcept;
  /// Returns the folders that the host of a RobotBuilder or WorldBuilder names; none when it has no such extension.
  template <class Builder>
  static std::span<const PackageFolder> of(Builder& builder) {
    const auto* known = static_cast<const PackageFolders*>(builder.find_extension(id()));
    return known ? known->package_folders() : std::span<const PackageFolder>();
  }

 protected:
  ~PackageFolders() = default;
};

inline ExtensionId PackageFolders::id() noexcept {
  static constexpr abi::Place structs[] = {MURO_SIZE(PackageFolder), MURO_PLACE(PackageFolder, name),
                                           MURO_PLACE(PackageFolder, folder)};
  return {"muro.PackageFolders", 1, abi::extension_layout<PackageFolders>(structs, &PackageFolders::package_folders)};
}

}  // namespace muro
