// SPDX-License-Identifier: MIT
// Services of the parser process for load.cpp.
#include "plugins/common/parser_process/service.hpp"

#include "read_mesh.hpp"

namespace muro::mesh {
namespace {

using parser_process::Reader;
using parser_process::Registration;
using parser_process::Writer;

const Registration meshes("mesh", [](Reader& request, Writer& answer) {
  const std::string path = request.text();
  const Mesh mesh = read_mesh(path, request.value<Vec3>());
  answer.list(std::span(mesh.vertices));
  answer.list(std::span(mesh.triangles));
});

const Registration submeshes("submeshes", [](Reader& request, Writer& answer) {
  const std::string path = request.text();
  const std::vector<Submesh> parts = read_submeshes(path, request.value<Vec3>());
  answer.value(std::uint64_t(parts.size()));
  for (const Submesh& part : parts) {
    answer.list(std::span(part.vertices));
    answer.list(std::span(part.triangles));
    answer.value(part.color);
    answer.text(part.texture);
    answer.text(part.missing_texture);
    answer.list(std::span(part.texture_bytes));
  }
});

}  // namespace
}  // namespace muro::mesh
