// SPDX-License-Identifier: MIT
// Reads robots and worlds from SDFormat files (http://sdformat.org). service.cpp reads them, in the parser process.
#include "muro/ext/package_folders.hpp"
#include "muro/plugin.hpp"
#include "plugins/common/parser_process/ask.hpp"
#include "plugins/common/parser_process/builder_calls/replay.hpp"

namespace {

using namespace muro;

constexpr std::string_view extensions[] = {".sdf", ".world"};
constexpr ReaderDescription description{
    .id = "reader.sdf",
    .version = "1.0.0",
    .summary = "Reads SDFormat models and worlds with libsdformat and lists what it leaves out, with line and column",
    .extensions = extensions,
};

parser_process::Answer ask(const char* service, std::string_view path, std::span<const PackageFolder> packages) {
  parser_process::Writer request;
  request.text(path);
  request.value(std::uint32_t(packages.size()));
  for (const PackageFolder& p : packages) {
    request.text(p.name);
    request.text(p.folder);
  }
  return parser_process::ask({.service = service,
                              .subject = "model " + std::string(path),
                              .needs = "libsdformat-dev",
                              .advice = "look for what is unusual in the file and in those that it includes"},
                             request.bytes());
}

class SdfReader final : public ModelReader {
 public:
  void read(std::string_view path, RobotBuilder& builder) override {
    const parser_process::Answer calls = ask("sdf model", path, PackageFolders::of(builder));
    builder_calls::replay(calls.reader(), builder);
  }
  void read_world(std::string_view path, WorldBuilder& builder) override {
    const parser_process::Answer calls = ask("sdf world", path, PackageFolders::of(builder));
    builder_calls::replay(calls.reader(), builder);
  }
};

constexpr abi::ReaderEntry readers[] = {model_reader<SdfReader>(description)};

}  // namespace

MURO_PLUGIN(.name = "reader_sdf", .version = description.version, .licence = "MIT",
            .summary = "SDFormat models and worlds", .readers = readers)
