// SPDX-License-Identifier: MIT
// Reads a heightmap file as a model of one body that does not move.
#include "muro/heightmap.hpp"
#include "muro/plugin.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/heightmap/heightmap_file.hpp"

namespace {

using namespace muro;

constexpr std::string_view extensions[] = {".png", ".jpg", ".jpeg", ".tif", ".tiff",
                                           ".r32", ".f32", ".raw",  ".bin", ".hfield"};
constexpr ReaderDescription description{
    .id = "reader.heightmap",
    .version = "1.0.0",
    .summary = "Reads the file of a heightmap as ground with nodes 1 m apart",
    .extensions = extensions,
};

class HeightmapReader final : public ModelReader {
 public:
  void read(std::string_view path, RobotBuilder& builder) override {
    const heightmap::HeightmapFile file = heightmap::load(std::string(path));
    builder.base("body");
    const Shape shape{.kind = ShapeKind::heightmap,
                      .mesh = builder.intern(path),
                      .size = {double(file.columns - 1), double(file.rows - 1), 1}};
    builder.set_array(keys::collision_shapes, std::span(&shape, 1));
    builder.set_array(keys::visual_shapes, std::span(&shape, 1));
    builder.set_array(keys::heightmap_values, std::span<const float>(file.values));
    builder.set(keys::heightmap_columns, file.columns);
  }
};

constexpr abi::ReaderEntry readers[] = {model_reader<HeightmapReader>(description)};

}  // namespace

MURO_PLUGIN(.name = "reader_heightmap", .version = description.version, .licence = "MIT",
            .summary = "Heightmaps as models of the ground", .readers = readers)
