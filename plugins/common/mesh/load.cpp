// SPDX-License-Identifier: MIT
// Meshes, read by the parser process.
#include <algorithm>
#include <filesystem>

#include "muro/algorithm.hpp"
#include "plugins/common/parser_process/ask.hpp"
#include "submesh.hpp"

namespace muro::mesh {
namespace {

namespace process = parser_process;

process::Answer ask(const char* service, const std::string& path, const Vec3& scale) {
  std::error_code code;
  const std::filesystem::path absolute = std::filesystem::absolute(path, code);
  process::Writer request;
  request.text(code ? path : absolute.string());
  request.value(scale);
  return process::ask(
      {.service = service,
       .subject = "mesh " + path,
       .needs = "libassimp-dev",
       .advice = "the file is probably damaged: write it anew with the program that made it, or convert "
                 "it to STL or OBJ"},
      request.bytes());
}

/// Reads the triangles of an answer. All their corners must be among `vertices`.
std::vector<Triangle> triangles_of(process::Reader& answer, std::size_t vertices) {
  std::vector<Triangle> triangles = answer.list<Triangle>();
  for (const Triangle& t : triangles)
    if (*std::max_element(t.begin(), t.end()) >= vertices)
      throw Error("a mesh of the parser process has corners that are no vertices");
  return triangles;
}

}  // namespace

Mesh load(const std::string& path, const Vec3& scale) {
  const process::Answer answer = ask("mesh", path, scale);
  process::Reader reader = answer.reader();
  Mesh mesh;
  mesh.vertices = reader.list<Vec3>();
  mesh.triangles = triangles_of(reader, mesh.vertices.size());
  return mesh;
}

std::vector<Submesh> load_submeshes(const std::string& path, const Vec3& scale) {
  const process::Answer answer = ask("submeshes", path, scale);
  process::Reader reader = answer.reader();
  std::vector<Submesh> parts;
  for (auto count = reader.value<std::uint64_t>(); count > 0; --count) {
    Submesh part;
    part.vertices = reader.list<TexturedVertex>();
    part.triangles = triangles_of(reader, part.vertices.size());
    part.color = reader.value<Eigen::Vector4d>();
    part.texture = reader.text();
    part.missing_texture = reader.text();
    part.texture_bytes = reader.list<std::uint8_t>();
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace muro::mesh
