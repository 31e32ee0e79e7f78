// SPDX-License-Identifier: MIT
// Writes the images of cameras to files; see README.md.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "muro/base/whole_file.hpp"
#include "muro/ext/outputs.hpp"
#include "muro/plugin.hpp"
#include "plugins/common/image_file/png.hpp"

namespace {

using namespace muro;
namespace fs = std::filesystem;

constexpr std::string_view formats[] = {"png", "raw"};
constexpr Parameter parameters[] = {
    text("folder", "", "where to write; a relative path starts in the working directory").required(),
    texts("cameras", "names of sensors, \"rover_0/camera\"; default: all cameras"),
    text("format", "png", "png, or raw: the bytes of the properties as they are").one_of(formats),
};
constexpr PropertyUse reads[] = {
    {"camera.image", "of the cameras"}, {"camera.depth", "of the cameras"}, {"camera.labels", "of the cameras"}};
constexpr Description description{
    .id = "recorder.images",
    .kind = Kind::recorder,
    .version = "1.1.0",
    .summary = "Writes images, depths and labels of cameras to files, PNG or raw",
    .parameters = parameters,
    .reads = reads,
    .capabilities = deterministic | restorable,
};

constexpr double depth_resolution = 1e-3;  ///< m for each grey value
constexpr std::uint32_t no_object_grey = 65535;

class ImageRecorder final : public Algorithm {
 public:
  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    std::error_code code;
    const std::string folder(p.text("folder"));
    folder_ = fs::absolute(folder, code);
    if (code) throw Error("the folder " + folder + " cannot be made: the working directory is not there any more");
    raw_ = p.text("format") == "raw";
  }

  void connect_by_name(Connector& c) override {
    const auto names = c.parameters().texts("cameras");
    if (names.empty())
      for (std::uint32_t i = 0; i < c.object_count(); ++i) add_camera(c, ObjectId{i});
    for (const std::string_view name : names) {
      const ObjectId object = c.find_object(name);
      if (object == no_object || !add_camera(c, object))
        throw Error("there is no camera `" + std::string(name) +
                    "` that writes camera.image, camera.depth or camera.labels");
    }
    if (cameras_.empty()) throw Error("no sensor of the scenario writes camera.image, camera.depth or camera.labels");
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
      if (raw_)
        write_raw(camera, time);
      else
        write_pngs(camera, time);
    }
  }

 private:
  struct Camera {
    std::string file_prefix;
    std::uint32_t width = 0, height = 0;
    ArrayIn<std::uint8_t> image;
    ArrayIn<float> depth;
    ArrayIn<ObjectId> labels;
    std::vector<std::uint16_t> grey;
  };

  void write_pngs(Camera& camera, const std::string& time) const {
    using image_file::Format;
    if (camera.image) write_png(camera, time + ".png", Format::rgb8, (*camera.image).data());
    const auto write_grey = [&](const char* what, auto values, auto grey_of) {
      camera.grey.resize(values.size());
      for (std::size_t k = 0; k < values.size(); ++k) camera.grey[k] = grey_of(values[k]);
      write_png(camera, what + time + ".png", Format::grey16, camera.grey.data());
    };
    if (camera.depth)
      write_grey("_depth", *camera.depth, [](float depth) {
        const double value = double(depth) / depth_resolution;
        return value < no_object_grey ? std::uint16_t(std::lround(value)) : std::uint16_t(0);
      });
    if (camera.labels)
      write_grey("_labels", *camera.labels,
                 [](ObjectId label) { return std::uint16_t(std::min(index_of(label), no_object_grey)); });
  }

  void write_raw(const Camera& camera, const std::string& time) const {
    if (camera.image) write_bytes(camera, time + ".rgb8", std::as_bytes(*camera.image));
    if (camera.depth) write_bytes(camera, "_depth" + time + ".f32", std::as_bytes(*camera.depth));
    if (camera.labels) write_bytes(camera, "_labels" + time + ".u32", std::as_bytes(*camera.labels));
  }

  void write_bytes(const Camera& camera, const std::string& suffix, std::span<const std::byte> bytes) const {
    WholeFile file((folder_ / (camera.file_prefix + suffix)).string());
    file.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    file.publish();
  }

  bool add_camera(Connector& c, ObjectId object) {
    Camera camera;
    for (const FoundProperty& found : c.properties(object)) {
      const std::string_view name = found.key->name;
      if (name == keys::camera_image.name) camera.image = c.read_array(object, keys::camera_image);
      if (name == keys::camera_depth.name) camera.depth = c.read_array(object, keys::camera_depth);
      if (name == keys::camera_labels.name) camera.labels = c.read_array(object, keys::camera_labels);
    }
    if (!camera.image && !camera.depth && !camera.labels) return false;
    camera.file_prefix = c.object_name(object);
    for (char& letter : camera.file_prefix)
      if (letter == '/') letter = '_';
    camera.width = c.constant(object, keys::camera_width).value_or(0);
    camera.height = c.constant(object, keys::camera_height).value_or(0);
    if (Outputs* outputs = Outputs::of(c.host())) name_outputs(camera, *outputs);
    cameras_.push_back(std::move(camera));
    return true;
  }

  void name_outputs(const Camera& camera, Outputs& outputs) const {
    const auto name = [&](bool is_written, const char* what, const char* raw_ending) {
      const std::string begin = (folder_ / (camera.file_prefix + what)).string();
      if (is_written) outputs.series(begin, raw_ ? raw_ending : ".png");
    };
    name(bool(camera.image), "_", ".rgb8");
    name(bool(camera.depth), "_depth_", ".f32");
    name(bool(camera.labels), "_labels_", ".u32");
  }

  void write_png(const Camera& camera, const std::string& suffix, image_file::Format format, const void* pixels) const {
    image_file::write_png((folder_ / (camera.file_prefix + suffix)).string(), format, camera.width, camera.height,
                          pixels);
  }

  fs::path folder_;
  bool raw_ = false;
  std::vector<Camera> cameras_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<ImageRecorder>(description)};

}  // namespace

MURO_PLUGIN(.name = "recorder_images", .version = description.version, .licence = "MIT",
            .summary = "Pictures of cameras to files", .algorithms = algorithms)
