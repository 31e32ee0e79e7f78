// SPDX-License-Identifier: MIT
// Meshes and pictures, read by the parser process as in every program. The libraries that decode them may fail there;
// the target requires only an answer or an error, in time.
#include "muro/algorithm.hpp"
#include "plugins/common/mesh/mesh.hpp"
#include "plugins/common/parser_process/ask.hpp"
#include "tests/fuzz/target.hpp"

namespace muro::fuzz {

namespace {

void refused(const Error& e) {
  require(std::string_view(e.what()).find("the program that reads such files") == std::string_view::npos, e.what());
  outcome(e.what());
}

}  // namespace

/// Reads a mesh. The first byte selects one of the documented formats.
void read_as_mesh(Bytes bytes) {
  if (bytes.empty()) return;
  constexpr const char* names[] = {"mesh.stl", "mesh.obj", "mesh.dae", "mesh.gltf", "mesh.glb"};
  const std::string file = file_with(bytes.subspan(1), names[bytes[0] % std::size(names)]);
  try {
    const mesh::Mesh mesh = mesh::load(file, Vec3::Ones());
    for (const auto& triangle : mesh.triangles)
      for (const auto corner : triangle) require(corner < mesh.vertices.size(), "a triangle has a corner too many");
    for (const auto& vertex : mesh.vertices) require(vertex.allFinite(), "a vertex is nowhere");
  } catch (const Error& e) {
    refused(e);
  }
}

void read_as_picture(Bytes bytes) {
  if (bytes.empty()) return;  // no bytes mean a picture from a file
  parser_process::Writer request;
  request.text("picture.png");
  request.list(bytes);
  try {
    const parser_process::Answer answer = parser_process::ask(
        {.service = "picture", .subject = "picture", .needs = "libstb-dev", .advice = "convert it"}, request.bytes());
    parser_process::Reader picture = answer.reader();
    const auto width = picture.value<std::uint32_t>(), height = picture.value<std::uint32_t>();
    require(picture.list<std::uint8_t>().size() == std::size_t(4) * width * height, "a picture lacks pixels");
  } catch (const Error& e) {
    refused(e);
  }
}

}  // namespace muro::fuzz
