// SPDX-License-Identifier: MIT
// A pinhole camera by OpenGL (MuRoSimF, Section 4.2); see README.md.
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "film.hpp"
#include "muro/plugin.hpp"
#include "muro/toolkit/mounting.hpp"
#include "plugins/common/render/depth_renderer.hpp"
#include "plugins/common/render/device.hpp"
#include "plugins/common/render/picture_renderer.hpp"

namespace {

using namespace muro;
using std::numbers::pi;

constexpr double chord = 1e-3;  ///< m: how far circles lie inside of themselves
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
    real("blur", "px", 0, "standard deviation of the spot that a point becomes").between(0, 50),
    real("exposure", "1", 0, "stops: light times 2^exposure").between(-20, 20),
    real("vignetting", "1", 0, "how much of the law of cos^4 dims the picture off its axis").between(0, 1),
    real("noise", "1", 0, "standard deviation of each value of camera.image, in terms of the greatest").between(0, 1),
    real("shot_noise", "1", 0, "standard deviation of white light; it falls with the root of the light").between(0, 1),
    real("rolling_shutter", "s", 0, "from the first row to the last, which is taken now; 0: all at once")
        .between(0, 10),
    integer("shutter_slices", 16, "parts of a picture by a rolling shutter, each taken at once").between(1, 4096),
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
        "A pinhole camera: colours, depth and labels of what it sees, without display or GPU, with one where it is",
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
    throw Error("near (" + std::to_string(camera.near) + " m) must be less than far (" + std::to_string(camera.far) +
                " m)");
  return camera;
}

camera::Distortion read_lens(const Parameters& p) {
  const std::span<const double> k = p.reals("distortion");
  for (const double x : k)
    if (!std::isfinite(x)) throw Error("distortion has a number that is not finite");
  return {k[0], k[1], k[2], k[3], k[4]};
}

camera::FilmSettings read_film(const Parameters& p) {
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
    forget();
  }

  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    seen_ = read_camera(p);
    mounting_ = mounting_of(p);
    light_.shadows = p.boolean("shadows");
    light_.shadow_range = p.real("shadow_range");
    device_ = render::device_of(p);
    shutter_ = p.real("rolling_shutter");
    slices_ = shutter_ > 0 ? std::min(std::uint32_t(p.integer("shutter_slices")), seen_.height) : 1;
    drawn_ = seen_;
    if (const camera::Distortion lens = read_lens(p); !lens.is_none()) {
      lens_ = camera::LensMap::of(seen_, lens, 8192);
      drawn_ = lens_->pinhole;
    }
    if (const camera::FilmSettings film = read_film(p); !film.does_nothing() || lens_) film_.emplace(seen_, film);
    for (std::uint32_t i = 0; i < c.items().size(); ++i) bind(c, i);
    scene_.connect(c, render::Look::as_seen, chord);
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
    if (!stage_) stage_.emplace(scene_);
    stage_->place();
    for (const Device& d : devices_) {
      if (d.image) take_picture(d, Random(step.seed, d.random_key, step.index));
      if (d.depth || d.labels) take_distances(d);
    }
  }

 private:
  struct Device {
    In<Pose> pose;
    In<Twist> twist;  ///< of a rolling shutter
    ArrayOut<std::uint8_t> image;
    ArrayOut<float> depth;
    ArrayOut<ObjectId> labels;
    std::int32_t ignored_robot = -1;
    std::uint64_t random_key = 0;
  };
  /// Rows that are exposed together, of what is drawn.
  struct Slice {
    std::uint32_t top = 0, rows = 0;
    render::Camera camera;
  };

  void bind(Connector& c, std::uint32_t i) {
    const Parameters& p = c.parameters();
    const Item& item = c.items()[i];
    const ObjectId sensor = item.object;
    const std::uint32_t pixels = seen_.width * seen_.height;
    c.set(sensor, keys::camera_width, seen_.width);
    c.set(sensor, keys::camera_height, seen_.height);
    c.set(sensor, keys::camera_horizontal_fov,
          std::atan(seen_.cx / seen_.fx) + std::atan((seen_.width - seen_.cx) / seen_.fx));
    c.set(sensor, keys::camera_fx, seen_.fx);
    c.set(sensor, keys::camera_fy, seen_.fy);
    c.set(sensor, keys::camera_cx, seen_.cx);
    c.set(sensor, keys::camera_cy, seen_.cy);
    c.set(sensor, keys::sensor_origin, mounting_);
    Device d;
    d.pose = c.read(sensor, keys::pose);
    if (shutter_ > 0) d.twist = c.read(sensor, keys::twist);
    if (p.boolean("rgb")) d.image = c.variable_array(sensor, keys::camera_image, 3 * pixels);
    if (p.boolean("depth")) d.depth = c.variable_array(sensor, keys::camera_depth, pixels);
    if (p.boolean("labels")) d.labels = c.variable_array(sensor, keys::camera_labels, pixels);
    if (item.robot && !p.boolean("see_self")) d.ignored_robot = std::int32_t(item.robot->number);
    d.random_key = fnv1a(c.object_name(sensor), c.random_key(i));
    devices_.push_back(d);
  }

  /// Where the link is `seconds` after now, with the twist that it has.
  static Pose moved(const Pose& pose, const Twist& twist, double seconds) {
    const Quat back = pose.orientation.conjugate();
    const Vec3 turn = seconds * Vec3(back * twist.angular), way = seconds * Vec3(back * twist.linear);
    return pose * Pose{screw_integral(turn) * way, rotation_of(turn)};
  }

  Slice slice_of(const Device& d, std::uint32_t number) const {
    const std::uint32_t each = (drawn_.height + slices_ - 1) / slices_;
    Slice s;
    s.top = std::min(number * each, drawn_.height);
    s.rows = std::min(each, drawn_.height - s.top);
    s.camera = drawn_;
    s.camera.height = each;
    s.camera.cy -= s.top;
    s.camera.ignored_robot = d.ignored_robot;
    Pose link = *d.pose;
    if (d.twist) link = moved(link, *d.twist, -shutter_ * (1 - (s.top + 0.5 * s.rows) / drawn_.height));
    s.camera.pose = link * mounting_;
    return s;
  }

  void take_picture(const Device& d, const Random& random) {
    if (!pictures_) pictures_.emplace(*stage_);
    if (!colors_) colors_.emplace(drawn_.width, slice_of(d, 0).camera.height);
    const bool direct = !film_;
    raw_.resize(direct ? 0 : std::size_t(3) * drawn_.width * drawn_.height);
    const std::span<std::uint8_t> rows = direct ? *d.image : std::span(raw_);
    for (std::uint32_t k = 0; k < slices_; ++k) {
      const Slice s = slice_of(d, k);
      if (s.rows == 0) continue;
      pictures_->draw(s.camera, *colors_, light_);
      const std::size_t row = std::size_t(3) * drawn_.width;
      colors_->read(rows.subspan(s.top * row, s.rows * row));
    }
    if (direct) return;
    if (lens_)
      film_->expose(raw_, *lens_);
    else
      film_->expose(raw_);
    film_->develop(random, *d.image);
  }

  void take_distances(const Device& d) {
    if (!depths_) depths_.emplace(*stage_);
    const std::uint32_t each = slice_of(d, 0).camera.height;
    if (!distances_) distances_.emplace(drawn_.width, each * slices_, true);
    distances_->begin();
    for (std::uint32_t k = 0; k < slices_; ++k)
      if (const Slice s = slice_of(d, k); s.rows > 0) depths_->draw(s.camera, *distances_, s.top);
    const std::size_t pixels = std::size_t(drawn_.width) * drawn_.height;
    if (d.labels) {
      static_assert(sizeof(ObjectId) == sizeof(std::uint32_t));
      drawn_labels_.resize(pixels);
      distances_->read(std::span(drawn_labels_));
      const std::span<ObjectId> labels = *d.labels;
      for (std::size_t i = 0; i < labels.size(); ++i) {
        const std::size_t from = pixel_of(i);
        labels[i] = from < pixels ? ObjectId(drawn_labels_[from]) : no_object;
      }
    }
    if (!d.depth) return;
    inverse_.resize(pixels);
    distances_->read(std::span(inverse_));
    const std::span<float> depth = *d.depth;
    for (std::size_t i = 0; i < depth.size(); ++i) {
      const std::size_t from = pixel_of(i);
      const double x = from < pixels ? double(inverse_[from]) : 0, distance = x > 0 ? seen_.near / x : 0;
      depth[i] = x > 0 && distance <= seen_.far ? float(distance) : std::numeric_limits<float>::infinity();
    }
  }

  /// The pixel that was drawn for one that is seen: through a lens, the nearest; past the end where there is none.
  std::size_t pixel_of(std::size_t seen) const {
    if (!lens_) return seen;
    const camera::LensMap::Place& at = lens_->places[seen];
    if (at.column < 0) return std::numeric_limits<std::size_t>::max();
    return std::size_t(std::lround(at.row)) * drawn_.width + std::size_t(std::lround(at.column));
  }

  void forget() {
    pictures_.reset();
    depths_.reset();
    stage_.reset();
    colors_.reset();
    distances_.reset();
  }

  std::vector<Device> devices_;
  render::Camera seen_, drawn_;  ///< the picture, and what is drawn for it: larger where there is a lens
  std::optional<camera::LensMap> lens_;
  std::optional<camera::Film> film_;
  double shutter_ = 0;  ///< s, from the first row to the last
  std::uint32_t slices_ = 1;
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
  std::vector<std::uint8_t> raw_;
  std::vector<float> inverse_;
  std::vector<std::uint32_t> drawn_labels_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Camera>(description)};

}  // namespace

MURO_PLUGIN(.name = "camera_opengl", .version = "1.1.0", .licence = "MIT", .summary = "Camera by OpenGL",
            .algorithms = algorithms)
