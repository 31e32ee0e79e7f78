// SPDX-License-Identifier: MIT
// Services of the parser process: mjcf.cpp gets the calls that build a robot or a world, motion.mujoco gets a compiled
// model.
#include "plugins/common/parser_process/service.hpp"

#include "plugins/common/parser_process/builder_calls/record.hpp"
#include "read.hpp"

namespace muro::mjcf {
namespace {

using parser_process::Reader;
using parser_process::Registration;
using parser_process::Writer;

const Registration models("mjcf model", [](Reader& request, Writer& answer) {
  builder_calls::RobotRecorder recorder(answer);
  read_file(request.text(), recorder);
});

const Registration worlds("mjcf world", [](Reader& request, Writer& answer) {
  builder_calls::WorldRecorder recorder(answer);
  read_world_file(request.text(), recorder);
});

const Registration compiled("mjcf compiled", [](Reader& request, Writer& answer) {
  const std::string path = request.text();
  write_compiled(path, request.text(), answer);
});

}  // namespace
}  // namespace muro::mjcf
