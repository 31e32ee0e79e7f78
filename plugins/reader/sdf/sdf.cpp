// SPDX-License-Identifier: MIT
// Reads robots and worlds from SDFormat files (http://sdformat.org), with libsdformat.
#include "muro/plugin.hpp"
#include "read.hpp"

namespace {

using namespace muro;

constexpr std::string_view extensions[] = {".sdf", ".world"};
constexpr ReaderDescription description{
    .id = "reader.sdf",
    .version = "1.0.0",
    .summary = "Reads SDFormat models and worlds with libsdformat and lists what it leaves out, with line and column",
    .extensions = extensions,
};

class SdfReader final : public ModelReader {
 public:
  void read(std::string_view path, RobotBuilder& builder) override { sdf::read_file(std::string(path), builder); }
  void read_world(std::string_view path, WorldBuilder& builder) override {
    sdf::read_world_file(std::string(path), builder);
  }
};

constexpr abi::ReaderEntry readers[] = {model_reader<SdfReader>(description)};

}  // namespace

MURO_PLUGIN(.name = "reader_sdf", .version = description.version, .licence = "MIT",
            .summary = "SDFormat models and worlds", .readers = readers)
