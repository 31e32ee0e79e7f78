// SPDX-License-Identifier: MIT
// A pinhole camera that renders with OpenGL (MuRoSimF, Section 4.2); see README.md.
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "image_pipeline.hpp"
#include "muro/base/elementary.hpp"
#include "muro/base/number_text.hpp"
#include "muro/plugin.hpp"
#include "muro/toolkit/mounting.hpp"
#include "muro/toolkit/rotations.hpp"
#include "plugins/common/link_motion/constant_twist.hpp"
#include "plugins/common/render/color_renderer.hpp"
#include "plugins/common/render/depth_renderer.hpp"
#include "plugins/common/render/device.hpp"

namespace {

using namespace muro;
using std::numbers::pi;

constexpr double tolerance = 1e-3;  ///< m, largest error of the polygons that represent circles
constexpr double no_distortion[] = {0, 0, 0, 0, 0};
constexpr Parameter parameters[] = {
    integer("width", 640, "pixels in a row").between(1, 8192),
    integer("height", 480, "rows of pixels").between(1, 8192),
    real("horizontal_fov", "rad", 1.047, "opening angle, with square pixels and the axis in the middle")
        .between(1e-3, 3.1),
    reals("intrinsics", "px", {}, "focal lengths fx, fy and the place cx, cy of the axis, instead of horizontal_fov"),
    real("near", "m", 0.02, "along the axis; nothing nearer is seen").between(1e-4, 1e3),
    real("far", "m", 1000, "along the axis; nothing farther is seen").between(1e-3, 1e6),
    reals("distortion", "1", no_distortion, "of the lens: k1, k2, p1, p2, k3 of Brown and Conrady (plumb_bob)")
        .of_length(5),
    real("blur", "px", 0, "standard deviation of the Gaussian that blurs the image").between(0, 50),
    real("exposure", "1", 0, "stops: light times 2^exposure").between(-20, 20),
    real("vignetting", "1", 0, "strength of the cos^4 law, which darkens the image off its axis").between(0, 1),
    real("noise", "1", 0, "standard deviation of each value of camera.image; 1: the greatest value").between(0, 1),
    real("shot_noise", "1", 0, "standard deviation for white; proportional to the square root of the light")
        .between(0, 1),
    real("rolling_shutter", "s", 0, "from the first row to the last, which is taken now; 0: all rows at one instant")
        .between(0, 10),
    integer("shutter_slices", 16, "parts of an image by a rolling shutter, each taken at one instant").between(1, 4096),
    boolean("rgb", true, "write camera.image"),
    boolean("depth", false, "write camera.depth"),
    boolean("labels", false, "write camera.labels"),
    boolean("shadows", true, "the sun casts shadows in camera.image"),
    real("shadow_range", "m", 25, "around what is in front, within which shadows are drawn; more is coarser")
        .between(0.1, 1e4),
    boolean("see_self", true, "whether the robot that carries the camera is seen"),
    mounting_offset,
    mounting_rpy,
    render::device_parameter,
};
constexpr PropertyUse reads[] = {{"pose", "of the sensor's object and of all bodies that are seen"},
                                 {"twist", "of the sensor's object: rolling_shutter"},
                                 {"visual.shapes", "of all bodies; else collision.shapes"}};
constexpr PropertyUse writes[] = {
    {"camera.image", "rgb: true: sRGB, rows from the top"},
    {"camera.depth", "depth: true: along the axis, infinite where nothing is"},
    {"camera.labels", "labels: true: the object that each pixel shows"},
    {"camera.width", "constant"},
    {"camera.height", "constant"},
    {"camera.horizontal_fov", "constant"},
    {"camera.fx", "constant, as fy, cx, cy"},
    {"camera.fy", "constant"},
    {"camera.cx", "constant"},
    {"camera.cy", "constant"},
    mounting_writes,
};
constexpr Description description{
    .id = "camera.opengl",
    .kind = Kind::sensor,
    .version = "1.1.0",
    .summary =
        "A pinhole camera: colours, depth and labels; needs no display and no GPU, and uses a GPU where there is one",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | restorable,
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
    throw Error("near (" + number_text(camera.near) + " m) must be less than far (" + number_text(camera.far) + " m)");
  return camera;
}

camera::Distortion read_lens(const Parameters& p) {
  const std::span<const double> k = p.reals("distortion");
  for (const double x : k)
    if (!std::isfinite(x)) throw Error("distortion has a number that is not finite");
  return {k[0], k[1], k[2], k[3], k[4]};
}

camera::ImageSettings read_image_settings(const Parameters& p) {
  return {.exposure = p.real("exposure"),
          .vignetting = p.real("vignetting"),
          .blur = p.real("blur"),
          .noise = p.real("noise"),
          .shot_noise = p.real("shot_noise")};
}

class Camera final : public Algorithm {
 public:
  ~Camera() override {
    if (!context_) return;
    const render::Current current(*context_);
    release();
  }

  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    camera_ = read_camera(p);
    mounting_ = mounting_of(p);
    light_.shadows = p.boolean("shadows");
    light_.shadow_range = p.real("shadow_range");
    device_ = render::device_of(p);
    shutter_ = p.real("rolling_shutter");
    slices_ = shutter_ > 0 ? std::min(std::uint32_t(p.integer("shutter_slices")), camera_.height) : 1;
    drawn_camera_ = camera_;
    if (const camera::Distortion lens = read_lens(p); !lens.is_none()) {
      lens_ = camera::LensMap::of(camera_, lens, 8192);
      drawn_camera_ = lens_->pinhole;
    }
    const camera::ImageSettings settings = read_image_settings(p);
    if (!settings.is_identity() || lens_) pipeline_.emplace(camera_, settings);
    for (std::uint32_t i = 0; i < c.items().size(); ++i) bind(c, i);
    scene_.connect(c, render::ShapeSource::visual, tolerance);
    host_ = &c.host();
  }

  void start() override {
    if (context_) return;
    context_.emplace(device_);
    host_->log(LogLevel::info, "camera.opengl draws by " + context_->renderer());
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase whole[] = {{Phase::IndexSpace::whole}};
    return whole;
  }

  void step(const Step& step, Range) override {
    const render::Current current(*context_);
    if (!gpu_scene_) gpu_scene_.emplace(scene_);
    gpu_scene_->update();
    for (const Device& d : devices_) {
      if (d.image) draw_color(d, Random(step.seed, d.random_key, step.index));
      if (d.depth || d.labels) draw_depth(d);
    }
  }

 private:
  struct Device {
    In<Pose> pose;
    In<Twist> twist;  ///< unset without a rolling shutter
    ArrayOut<std::uint8_t> image;
    ArrayOut<float> depth;
    ArrayOut<ObjectId> labels;
    RobotId ignored_robot = no_robot;
    std::uint64_t random_key = 0;
  };
  /// Rows of the drawn image that are exposed together.
  struct Slice {
    std::uint32_t top = 0, rows = 0;
    render::Camera camera;
  };

  void bind(Connector& c, std::uint32_t i) {
    const Parameters& p = c.parameters();
    const Item& item = c.items()[i];
    const ObjectId sensor = item.object;
    const std::uint32_t pixels = camera_.width * camera_.height;
    c.set(sensor, keys::camera_width, camera_.width);
    c.set(sensor, keys::camera_height, camera_.height);
    c.set(sensor, keys::camera_horizontal_fov,
          elementary::atan(camera_.cx / camera_.fx) + elementary::atan((camera_.width - camera_.cx) / camera_.fx));
    c.set(sensor, keys::camera_fx, camera_.fx);
    c.set(sensor, keys::camera_fy, camera_.fy);
    c.set(sensor, keys::camera_cx, camera_.cx);
    c.set(sensor, keys::camera_cy, camera_.cy);
    c.set(sensor, keys::sensor_origin, mounting_);
    Device d;
    d.pose = c.read(sensor, keys::pose);
    if (shutter_ > 0) d.twist = c.read(sensor, keys::twist);
    if (p.boolean("rgb")) d.image = c.variable_array(sensor, keys::camera_image, 3 * pixels);
    if (p.boolean("depth")) d.depth = c.variable_array(sensor, keys::camera_depth, pixels);
    if (p.boolean("labels")) d.labels = c.variable_array(sensor, keys::camera_labels, pixels);
    if (item.robot && !p.boolean("see_self")) d.ignored_robot = item.robot->id;
    d.random_key = fnv1a(c.object_name(sensor), c.random_key(i));
    devices_.push_back(d);
  }

  /// Returns the pose of the link after `seconds` with its present twist.
  static Pose predicted(const Pose& pose, const Twist& twist, double seconds) {
    const Quat to_link = pose.orientation.conjugate();
    return constant_twist::advanced(pose, seconds * Vec3(to_link * twist.angular),
                                    seconds * Vec3(to_link * twist.linear));
  }

  Slice slice_of(const Device& d, std::uint32_t number) const {
    const std::uint32_t slice_height = (drawn_camera_.height + slices_ - 1) / slices_;
    Slice s;
    s.top = std::min(number * slice_height, drawn_camera_.height);
    s.rows = std::min(slice_height, drawn_camera_.height - s.top);
    s.camera = drawn_camera_;
    s.camera.height = slice_height;
    s.camera.cy -= s.top;
    s.camera.ignored_robot = d.ignored_robot;
    Pose link = *d.pose;
    if (d.twist) link = predicted(link, *d.twist, -shutter_ * (1 - (s.top + 0.5 * s.rows) / drawn_camera_.height));
    s.camera.pose = link * mounting_;
    return s;
  }

  void draw_color(const Device& d, const Random& random) {
    if (!color_renderer_) color_renderer_.emplace(*gpu_scene_);
    if (!color_target_) color_target_.emplace(drawn_camera_.width, slice_of(d, 0).camera.height);
    const bool is_direct = !pipeline_;
    drawn_image_.resize(is_direct ? 0 : std::size_t(3) * drawn_camera_.width * drawn_camera_.height);
    const std::span<std::uint8_t> rows = is_direct ? *d.image : std::span(drawn_image_);
    for (std::uint32_t k = 0; k < slices_; ++k) {
      const Slice s = slice_of(d, k);
      if (s.rows == 0) continue;
      color_renderer_->draw(s.camera, *color_target_, light_);
      const std::size_t row = std::size_t(3) * drawn_camera_.width;
      color_target_->read(rows.subspan(s.top * row, s.rows * row));
    }
    if (is_direct) return;
    if (lens_)
      pipeline_->load(drawn_image_, *lens_);
    else
      pipeline_->load(drawn_image_);
    pipeline_->process(random, *d.image);
  }

  void draw_depth(const Device& d) {
    if (!depth_renderer_) depth_renderer_.emplace(*gpu_scene_);
    const std::uint32_t slice_height = slice_of(d, 0).camera.height;
    if (!depth_target_) depth_target_.emplace(drawn_camera_.width, slice_height * slices_, true);
    depth_target_->begin();
    for (std::uint32_t k = 0; k < slices_; ++k)
      if (const Slice s = slice_of(d, k); s.rows > 0) depth_renderer_->draw(s.camera, *depth_target_, s.top);
    const std::size_t pixels = std::size_t(drawn_camera_.width) * drawn_camera_.height;
    if (d.labels) {
      static_assert(sizeof(ObjectId) == sizeof(std::uint32_t));
      drawn_labels_.resize(pixels);
      depth_target_->read(std::span(drawn_labels_));
      const std::span<ObjectId> labels = *d.labels;
      for (std::size_t i = 0; i < labels.size(); ++i) {
        const std::size_t from = drawn_pixel_of(i);
        labels[i] = from < pixels ? ObjectId(drawn_labels_[from]) : no_object;
      }
    }
    if (!d.depth) return;
    inverse_.resize(pixels);
    depth_target_->read(std::span(inverse_));
    const std::span<float> depth = *d.depth;
    for (std::size_t i = 0; i < depth.size(); ++i) {
      const std::size_t from = drawn_pixel_of(i);
      const double x = from < pixels ? double(inverse_[from]) : 0, distance = x > 0 ? camera_.near / x : 0;
      depth[i] = x > 0 && distance <= camera_.far ? float(distance) : std::numeric_limits<float>::infinity();
    }
  }

  /// Returns the pixel of the drawn image for a pixel of the camera: through a lens the nearest one, or a number past
  /// the end if there is none.
  std::size_t drawn_pixel_of(std::size_t pixel) const {
    if (!lens_) return pixel;
    const camera::LensMap::Position& at = lens_->positions[pixel];
    if (at.column < 0) return std::numeric_limits<std::size_t>::max();
    return std::size_t(std::lround(at.row)) * drawn_camera_.width + std::size_t(std::lround(at.column));
  }

  void release() {
    color_renderer_.reset();
    depth_renderer_.reset();
    gpu_scene_.reset();
    color_target_.reset();
    depth_target_.reset();
  }

  std::vector<Device> devices_;
  render::Camera camera_, drawn_camera_;  ///< with a lens the drawn image is larger
  std::optional<camera::LensMap> lens_;
  std::optional<camera::ImagePipeline> pipeline_;
  double shutter_ = 0;  ///< s, from the first row to the last
  std::uint32_t slices_ = 1;
  render::Daylight light_;
  render::Device device_ = render::Device::any;
  Pose mounting_;
  render::Scene scene_;
  Host* host_ = nullptr;
  std::optional<render::Context> context_;
  std::optional<render::GpuScene> gpu_scene_;
  std::optional<render::ColorRenderer> color_renderer_;
  std::optional<render::DepthRenderer> depth_renderer_;
  std::optional<render::ColorTarget> color_target_;
  std::optional<render::DepthTarget> depth_target_;
  std::vector<std::uint8_t> drawn_image_;
  std::vector<float> inverse_;
  std::vector<std::uint32_t> drawn_labels_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Camera>(description)};

}  // namespace

MURO_PLUGIN(.name = "camera_opengl", .version = description.version, .licence = "MIT", .summary = "Camera by OpenGL",
            .algorithms = algorithms)
