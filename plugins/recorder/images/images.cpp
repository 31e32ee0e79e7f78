// SPDX-License-Identifier: MIT
// Writes what cameras see to PNG files; see README.md.
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "muro/plugin.hpp"
#include "plugins/picture_file/png.hpp"

namespace {

using namespace muro;
namespace fs = std::filesystem;

constexpr Parameter parameters[] = {
    text("folder", "", "where to write; a relative path starts in the working directory").must_be_given(),
    texts("cameras", "names of sensors, \"rover_0/camera\"; default: all that write camera.image or camera.depth"),
};
constexpr Use reads[] = {{"camera.image", "of the cameras"}, {"camera.depth", "of the cameras"}};
constexpr Description description{
    .id = "recorder.images",
    .kind = Kind::recorder,
    .version = "1.0.0",
    .summary = "Writes pictures and depths of cameras to PNG files, one for each run",
    .parameters = parameters,
    .reads = reads,
    .promises = deterministic | restorable,
};

constexpr double depth_step = 1e-3;  ///< m: a grey value of depth

class ImageRecorder final : public Algorithm {
 public:
  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    folder_ = fs::absolute(std::string(p.text("folder")));
    const auto names = p.texts("cameras");
    if (names.empty())
      for (std::uint32_t i = 0; i < c.object_count(); ++i) add_camera(c, ObjectId{i});
    for (const std::string_view name : names) {
      const ObjectId object = c.find_object(name);
      if (object == no_object || !add_camera(c, object))
        throw Error("there is no camera `" + std::string(name) + "` that writes camera.image or camera.depth");
    }
    if (cameras_.empty()) throw Error("no sensor of the scenario writes camera.image or camera.depth");
  }

  void start() override {
    std::error_code code;
    fs::create_directories(folder_, code);
    if (code) throw Error("the folder `" + folder_.string() + "` cannot be made: " + code.message());
  }

  void step(const Step& step, Range) override {
    char time[32];
    std::snprintf(time, sizeof time, "_%012.6f", 1e-9 * double(step.time));
    for (Camera& camera : cameras_) {
      if (camera.image) write(camera, time + std::string(".png"), picture_file::Format::rgb8, (*camera.image).data());
      if (!camera.depth) continue;
      const std::span<const float> depth = *camera.depth;
      camera.grey.resize(depth.size());
      for (std::size_t k = 0; k < depth.size(); ++k) {
        const double value = double(depth[k]) / depth_step;
        camera.grey[k] = value < 65535 ? std::uint16_t(std::lround(value)) : 0;
      }
      write(camera, "_depth" + std::string(time) + ".png", picture_file::Format::grey16, camera.grey.data());
    }
  }

 private:
  struct Camera {
    std::string name;  ///< as in the names of its files
    std::uint32_t width = 0, height = 0;
    ArrayIn<std::uint8_t> image;
    ArrayIn<float> depth;
    std::vector<std::uint16_t> grey;
  };

  bool add_camera(Connector& c, ObjectId object) {
    Camera camera;
    for (const FoundProperty& found : c.properties(object)) {
      camera.image =
          found.key->name == keys::camera_image.name ? c.read_array(object, keys::camera_image) : camera.image;
      camera.depth =
          found.key->name == keys::camera_depth.name ? c.read_array(object, keys::camera_depth) : camera.depth;
    }
    if (!camera.image && !camera.depth) return false;
    camera.name = c.object_name(object);
    for (char& letter : camera.name)
      if (letter == '/') letter = '_';
    camera.width = c.constant(object, keys::camera_width).value_or(0);
    camera.height = c.constant(object, keys::camera_height).value_or(0);
    cameras_.push_back(std::move(camera));
    return true;
  }

  void write(const Camera& camera, const std::string& ending, picture_file::Format format, const void* pixels) const {
    picture_file::write_png((folder_ / (camera.name + ending)).string(), format, camera.width, camera.height, pixels);
  }

  fs::path folder_;
  std::vector<Camera> cameras_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<ImageRecorder>(description)};

}  // namespace

MURO_PLUGIN(.name = "recorder_images", .version = "1.0.0", .licence = "MIT", .summary = "Pictures of cameras to files",
            .algorithms = algorithms)
