// SPDX-License-Identifier: MIT
// Service of the parser process for heightmap_file.cpp: the values of a heightmap.
#include "plugins/common/parser_process/service.hpp"

#include "heightmap_values.hpp"

namespace muro::heightmap {
namespace {

using parser_process::Reader;
using parser_process::Registration;
using parser_process::Writer;

const Registration heightmaps("heightmap", [](Reader& request, Writer& answer) {
  const HeightmapFile file = read_values(request.text());
  answer.value(file.columns);
  answer.value(file.rows);
  answer.list(std::span<const float>(file.values));
});

}  // namespace
}  // namespace muro::heightmap
