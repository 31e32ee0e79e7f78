// SPDX-License-Identifier: MIT
// Service of the parser process for sdf.cpp: the calls that build a robot or a world. A request is the path of a file,
// and the number of packages that the user has named, each with its folder.
#include "plugins/common/parser_process/service.hpp"

#include "plugins/common/parser_process/builder_calls/record.hpp"
#include "read.hpp"

namespace muro::sdf {
namespace {

using parser_process::Reader;
using parser_process::Registration;
using parser_process::Writer;

model_file::Packages packages_of(Reader& request) {
  model_file::Packages packages;
  for (auto count = request.value<std::uint32_t>(); count > 0; --count) {
    std::string name = request.text();
    packages[std::move(name)] = request.text();
  }
  return packages;
}

const Registration models("sdf model", [](Reader& request, Writer& answer) {
  const std::string path = request.text();
  builder_calls::RobotRecorder recorder(answer);
  read_file(path, recorder, packages_of(request));
});

const Registration worlds("sdf world", [](Reader& request, Writer& answer) {
  const std::string path = request.text();
  builder_calls::WorldRecorder recorder(answer);
  read_world_file(path, recorder, packages_of(request));
});

}  // namespace
}  // namespace muro::sdf
