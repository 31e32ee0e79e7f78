// SPDX-License-Identifier: MIT
// Reads robots from URDF files (https://wiki.ros.org/urdf/XML), with urdfdom.
#include "muro/ext/package_folders.hpp"
#include "muro/plugin.hpp"
#include "read.hpp"

namespace {

using namespace muro;

constexpr std::string_view extensions[] = {".urdf", ".xacro"};
constexpr ReaderDescription description{
    .id = "reader.urdf",
    .version = "1.0.0",
    .summary = "Reads URDF models with urdfdom and reports all their problems with line and column",
    .extensions = extensions,
};

class UrdfReader final : public ModelReader {
 public:
  void read(std::string_view path, RobotBuilder& builder) override {
    model_file::Packages packages;
    for (const PackageFolder& p : PackageFolders::of(builder)) packages.emplace(p.name, p.folder);
    urdf::read_file(std::string(path), builder, packages);
  }
};

constexpr abi::ReaderEntry readers[] = {model_reader<UrdfReader>(description)};

}  // namespace

MURO_PLUGIN(.name = "reader_urdf", .version = description.version, .licence = "MIT", .summary = "URDF models",
            .readers = readers)
