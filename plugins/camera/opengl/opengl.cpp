// SPDX-License-Identifier: MIT
// A pinhole camera by OpenGL (MuRoSimF, Section 4.2); see README.md.
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "muro/mounting.hpp"
#include "muro/plugin.hpp"
#include "plugins/render/depth_renderer.hpp"
#include "plugins/render/device.hpp"
#include "plugins/render/picture_renderer.hpp"

namespace {

using namespace muro;
using std::numbers::pi;

constexpr double chord = 1e-3;  ///< m: how far circles lie inside of themselves
constexpr Parameter parameters[] = {
    integer("width", 640, "pixels in a row").between(1, 8192),
    integer("height", 480, "rows of pixels").between(1, 8192),
    real("horizontal_fov", "rad", 1.047, "opening angle, with square pixels and the axis in the middle")
        .between(1e-3, 3.1),
    reals("intrinsics", "px", {}, "focal lengths fx, fy and the place cx, cy of the axis, instead of horizontal_fov"),
    real("near", "m", 0.02, "along the axis; nothing nearer is seen").between(1e-4, 1e3),
    real("far", "m", 1000, "along the axis; nothing farther is seen").between(1e-3, 1e6),
    boolean("rgb", true, "write camera.image"),
    boolean("depth", false, "write camera.depth"),
    boolean("labels", false, "write camera.labels"),
    boolean("shadows", true, "the sun throws shadows in camera.image"),
    real("shadow_range", "m", 25, "around what is in front, shadows reach so far; more is coarser").between(0.1, 1e4),
    boolean("see_self", true, "whether the robot that carries the camera is seen"),
    mounting_offset,
    mounting_rpy,
    render::device_parameter,
};
constexpr Use reads[] = {{"pose", "of the sensor's object and of all bodies that are seen"},
                         {"visual.shapes", "of all bodies; else collision.shapes"}};
constexpr Use writes[] = {
    {"camera.image", "rgb: true: sRGB, rows from the top"},
    {"camera.depth", "depth: true: along the axis, infinite where nothing is"},
    {"camera.labels", "labels: true: the object that each pixel shows"},
    {"camera.width", "constant"},
    {"camera.height", "constant"},
    {"camera.horizontal_fov", "constant"},
    mounting_writes,
};
constexpr Description description{
    .id = "camera.opengl",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary =
        "A pinhole camera: colours, depth and labels of what it sees, without display or GPU, with one where it is",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .promises = deterministic | batched | restorable,
};

render::Camera read_camera(const Parameters& p) {
  const auto width = std::uint32_t(p.integer("width")), height = std::uint32_t(p.integer("height"));
  render::Camera camera = render::Camera::of_fov(width, height, p.real("horizontal_fov"));
  if (p.given("intrinsics")) {
    if (p.given("horizontal_fov")) throw Error("intrinsics and horizontal_fov are both given; remove one of them");
    const std::span<const double> i = p.reals("intrinsics");
    if (i.size() != 4 || !(i[0] > 0) || !(i[1] > 0))
      throw Error("intrinsics has to be four numbers of pixels, fx, fy, cx, cy, the first two above 0");
    camera.fx = i[0], camera.fy = i[1], camera.cx = i[2], camera.cy = i[3];
  }
  camera.near = p.real("near");
  camera.far = p.real("far");
  if (camera.near >= camera.far)
    throw Error("near (" + std::to_string(camera.near) + " m) must be less than far (" + std::to_string(camera.far) +
                " m)");
  return camera;
}

class Camera final : public Algorithm {
 public:
  ~Camera() override {
    if (!context_) return;
    const render::Current current(*context_);
    forget();
  }

  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    camera_ = read_camera(p);
    mounting_ = mounting_of(p);
    light_.shadows = p.boolean("shadows");
    light_.shadow_range = p.real("shadow_range");
    device_ = render::device_of(p);
    const std::uint32_t pixels = camera_.width * camera_.height;
    for (const Item& item : c.items()) {
      const ObjectId sensor = item.object;
      c.set(sensor, keys::camera_width, camera_.width);
      c.set(sensor, keys::camera_height, camera_.height);
      c.set(sensor, keys::camera_horizontal_fov,
            std::atan(camera_.cx / camera_.fx) + std::atan((camera_.width - camera_.cx) / camera_.fx));
      c.set(sensor, keys::sensor_origin, mounting_);
      Device d;
      d.pose = c.read(sensor, keys::pose);
      if (p.boolean("rgb")) d.image = c.variable_array(sensor, keys::camera_image, 3 * pixels);
      if (p.boolean("depth")) d.depth = c.variable_array(sensor, keys::camera_depth, pixels);
      if (p.boolean("labels")) d.labels = c.variable_array(sensor, keys::camera_labels, pixels);
      if (item.robot && !p.boolean("see_self")) d.ignored_robot = std::int32_t(item.robot->number);
      devices_.push_back(d);
    }
    scene_.connect(c, render::Look::as_seen, chord);
    host_ = &c.host();
  }

  void start() override {
    if (context_) return;
    context_.emplace(device_);
    host_->log(LogLevel::info, "camera.opengl draws by " + context_->renderer());
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase whole[] = {{Phase::Over::whole}};
    return whole;
  }

  void step(const Step&, Range) override {
    const render::Current current(*context_);
    if (!stage_) stage_.emplace(scene_);
    stage_->place();
    for (const Device& d : devices_) take(d);
  }

 private:
  struct Device {
    In<Pose> pose;
    ArrayOut<std::uint8_t> image;
    ArrayOut<float> depth;
    ArrayOut<ObjectId> labels;
    std::int32_t ignored_robot = -1;
  };

  void take(const Device& d) {
    camera_.pose = *d.pose * mounting_;
    camera_.ignored_robot = d.ignored_robot;
    if (d.image) {
      if (!colors_) colors_.emplace(camera_.width, camera_.height);
      if (!pictures_) pictures_.emplace(*stage_);
      pictures_->draw(camera_, *colors_, light_);
      colors_->read(*d.image);
    }
    if (!d.depth && !d.labels) return;
    if (!distances_) distances_.emplace(camera_.width, camera_.height, true);
    if (!depths_) depths_.emplace(*stage_);
    distances_->begin();
    depths_->draw(camera_, *distances_);
    if (d.labels) {
      static_assert(sizeof(ObjectId) == sizeof(std::uint32_t));
      const std::span<ObjectId> labels = *d.labels;
      distances_->read(std::span(reinterpret_cast<std::uint32_t*>(labels.data()), labels.size()));
    }
    if (!d.depth) return;
    distances_->read(*d.depth);
    for (float& x : *d.depth) {
      const double distance = camera_.near / double(x);
      x = x > 0 && distance <= camera_.far ? float(distance) : std::numeric_limits<float>::infinity();
    }
  }

  void forget() {
    pictures_.reset();
    depths_.reset();
    stage_.reset();
    colors_.reset();
    distances_.reset();
  }

  std::vector<Device> devices_;
  render::Camera camera_;
  render::Daylight light_;
  render::Device device_ = render::Device::any;
  Pose mounting_;
  render::Scene scene_;
  Host* host_ = nullptr;
  std::optional<render::Context> context_;
  std::optional<render::Stage> stage_;
  std::optional<render::PictureRenderer> pictures_;
  std::optional<render::DepthRenderer> depths_;
  std::optional<render::ColorTarget> colors_;
  std::optional<render::DepthTarget> distances_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Camera>(description)};

}  // namespace

MURO_PLUGIN(.name = "camera_opengl", .version = "1.0.0", .licence = "MIT", .summary = "Camera by OpenGL",
            .algorithms = algorithms)
