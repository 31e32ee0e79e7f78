// SPDX-License-Identifier: MIT
// What the parser process offers to sdf.cpp: the calls that build a robot or a world. A request is the path of a file.
#include "plugins/common/parser_process/service.hpp"

#include "plugins/common/builder_calls/record.hpp"
#include "read.hpp"

namespace muro::sdf {
namespace {

using parser_process::Reader;
using parser_process::Registration;
using parser_process::Writer;

const Registration models("sdf model", [](Reader& request, Writer& answer) {
  builder_calls::RobotRecorder recorder(answer);
  read_file(request.text(), recorder);
});

const Registration worlds("sdf world", [](Reader& request, Writer& answer) {
  builder_calls::WorldRecorder recorder(answer);
  read_world_file(request.text(), recorder);
});

}  // namespace
}  // namespace muro::sdf
