// SPDX-License-Identifier: MIT
// Reads robots and worlds from MJCF, MuJoCo's format. service.cpp reads them, in the parser process.
#include "muro/plugin.hpp"
#include "plugins/common/parser_process/ask.hpp"
#include "plugins/common/parser_process/builder_calls/replay.hpp"

namespace {

using namespace muro;

constexpr std::string_view extensions[] = {".xml", ".mjcf"};
constexpr ReaderDescription description{
    .id = "reader.mjcf",
    .version = "1.0.0",
    .summary = "Reads MuJoCo's models and worlds with MuJoCo's own compiler and lists by name what it leaves out",
    .extensions = extensions,
};

parser_process::Answer ask(const char* service, std::string_view path) {
  parser_process::Writer request;
  request.text(path);
  return parser_process::ask({.service = service,
                              .subject = "model " + std::string(path),
                              .needs = "libmujoco-dev and libtinyxml2-dev",
                              .advice = "look for what is unusual in the file and in those that it names"},
                             request.bytes());
}

class MjcfReader final : public ModelReader {
 public:
  void read(std::string_view path, RobotBuilder& builder) override {
    const parser_process::Answer calls = ask("mjcf model", path);
    builder_calls::replay(calls.reader(), builder);
  }
  void read_world(std::string_view path, WorldBuilder& builder) override {
    const parser_process::Answer calls = ask("mjcf world", path);
    builder_calls::replay(calls.reader(), builder);
  }
};

constexpr abi::ReaderEntry readers[] = {model_reader<MjcfReader>(description)};

}  // namespace

MURO_PLUGIN(.name = "reader_mjcf", .version = description.version, .licence = "MIT",
            .summary = "MuJoCo's models and worlds (MJCF)", .readers = readers)
