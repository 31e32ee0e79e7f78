// SPDX-License-Identifier: MIT
// A window on the running simulation; see README.md.
#include <imgui.h>

#include <chrono>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <thread>

#include "body_poses.hpp"
#include "muro/base/elementary.hpp"
#include "muro/ext/outputs.hpp"
#include "muro/ext/run_control.hpp"
#include "muro/plugin.hpp"
#include "muro/vocabulary.hpp"
#include "panels.hpp"
#include "plugins/common/image_file/png.hpp"
#include "plugins/common/render/color_renderer.hpp"
#include "plugins/common/render/depth_renderer.hpp"
#include "screen.hpp"
#include "team.hpp"

namespace {

using namespace muro;
using view::OrbitCamera;

constexpr double tolerance = 1e-3;  ///< m: greatest distance of the polygons from their circles
constexpr double fov = 0.9;         ///< rad, vertical

constexpr Parameter parameters[] = {
    integer("width", 1280, "pixels of the window").between(320, 16384),
    integer("height", 800, "pixels of the window").between(240, 16384),
    integer("samples", 0, "samples for each pixel (smooth edges); 0: four on a GPU, one where the processor draws")
        .between(0, 16),
    boolean("scans", true, "draw what laser scanners measure"),
    boolean("contacts", true, "draw where robots touch something"),
    boolean("frames", false, "draw the frames of robots"),
    boolean("panels", true, "show panels beside the scene"),
    boolean("shadows", true, "the sun casts shadows; drawing without them is faster"),
    real("pictures", "1/s", 60, "greatest number of frames in a second of the wall clock").between(0.1, 1000),
    real("speed", "1", 1, "simulated seconds in a second; 0: as fast as possible").between(0, 1e6),
    boolean("paused", false, "whether the run begins paused"),
    text("follow", "", "object that is selected and followed from the start, such as `robot` or `robot/link`"),
    reals("from", "m", {}, "where the camera is at the start; default: where all is seen"),
    reals("to", "m", {}, "what it looks at then"),
    text("picture", "", "PNG file for the last image of the window; a relative path starts in the working directory"),
};
constexpr PropertyUse reads[] = {{"pose", "of all bodies that are seen"}, {"*", "all properties, to show them"}};
constexpr Description description{
    .id = "view.window",
    .kind = Kind::view,
    .version = "1.0.0",
    .summary = "A window on the running simulation: scene, robots, properties, costs; play, pause, step, speed",
    .parameters = parameters,
    .reads = reads,
    .capabilities = restorable | runs_alone,
};

class Window final : public Algorithm, private PauseAttendant {
 public:
  ~Window() override {
    if (screen_) release();
  }

  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    for (const char* name : {"from", "to"})
      if (p.given(name) && p.reals(name).size() != 3)
        throw Error(std::string(name) + " has to be three numbers, x, y, z in metres");
    if (p.given("from") != p.given("to")) throw Error("from and to go together; give both or none");
    size_ = {int(p.integer("width")), int(p.integer("height"))};
    overlay_.scans = p.boolean("scans");
    overlay_.contacts = p.boolean("contacts");
    overlay_.frames = p.boolean("frames");
    has_panels_ = p.boolean("panels");
    light_.shadows = p.boolean("shadows");
    samples_ = std::uint32_t(p.integer("samples"));
    period_ = 1 / p.real("pictures");
    pace_ = {p.real("speed"), p.boolean("paused")};
    host_ = &c.host();
    if (!p.text("picture").empty()) {
      picture_ = std::filesystem::absolute(std::string(p.text("picture"))).string();
      if (Outputs* outputs = Outputs::of(c.host())) outputs->file(picture_);
    }
    if (const std::string name(p.text("follow")); !name.empty()) {
      if (p.given("from"))
        throw Error("follow and from are both given: the camera is behind what it follows; remove one");
      select(c, name);
    }
    if (p.given("from")) orbit_camera_.look_from(vector(p.reals("from")), vector(p.reals("to")));
    shows_all_ = !p.given("from") && panels_.selected == no_object;
    simulation_ = Inspection::of(c.host());
    control_ = RunControl::of(c.host());
    if (!simulation_ || !control_) throw Error("this host does not show its simulation to windows");
    panels_.edits.connect(*control_);
    scene_.connect(c, render::ShapeSource::visual, tolerance);
    panels_.connect(c);
    bodies_.connect_links(c);
  }

  void connect_by_name(Connector& c) override {
    overlay_.connect_by_name(c);
    bodies_.connect_sensors(c);
    team_.connect(c, bodies_);
  }

  void* find_extension(const ExtensionId& id) override {
    return id == PauseAttendant::id() ? static_cast<PauseAttendant*>(this) : nullptr;
  }

  void restored() override {
    pace_.begin_anew();
    panels_.begin_anew();
  }

  void start() override {
    restored();
    if (!screen_) screen_.emplace("muro", size_[0], size_[1]);
    start_time_ = Clock::now();
    next_frame_ = 0;
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase whole[] = {{Phase::IndexSpace::whole}};
    return whole;
  }

  /// Draws until the run may go on, then returns. When the run may go on at once, it draws only if the last frame is
  /// old enough. The host holds a paused run.
  void step(const Step& step, Range) override {
    last_time_ = step.seconds();
    if (screen_->is_lost() || screen_->is_closed()) return;
    if (has_paused_) pace_.set_paused(false);  // another client has let the run go on
    has_paused_ = false;
    for (;;) {
      const double now = wall_time();
      const bool may_go_on = pace_.may_go_on(step.seconds(), now);
      if (now >= next_frame_ && !show_frame(now)) return;
      if (may_go_on || simulation_->is_stopping()) return;
      if (pace_.paused()) {
        has_paused_ = true;
        return control_->set_paused(true);
      }
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
  }

  void finish() override {
    if (!screen_ || picture_.empty()) return;
    std::vector<std::uint8_t> picture;
    if (!screen_->is_lost()) draw(last_time_, &picture);
    if (screen_->is_lost())
      throw Error("the picture " + picture_ + " cannot be written: the display of the window is gone");
    image_file::write_png(picture_, image_file::Format::rgb8, std::uint32_t(screen_->width()),
                          std::uint32_t(screen_->height()), picture.data());
  }

 private:
  using Clock = std::chrono::steady_clock;

  static Vec3 vector(std::span<const double> v) { return {v[0], v[1], v[2]}; }
  /// Draws while the run is paused, whoever paused it.
  void attend() noexcept override {
    try {
      const double now = wall_time();
      const bool is_there = !screen_->is_lost() && !screen_->is_closed() && (now < next_frame_ || show_frame(now));
      if (!has_paused_ || (is_there && pace_.paused() && !pace_.take_step())) return;
      has_paused_ = false;
      control_->set_paused(false);
    } catch (const std::exception& e) {
      host_->log(LogLevel::error, e.what());
      simulation_->stop();
    }
  }

  /// Returns false when the window is lost, or closed, which ends the run.
  bool show_frame(double now) {
    draw(last_time_);
    if (screen_->is_lost()) {
      host_->log(LogLevel::warning, "the display of the window is gone; the run goes on without it");
      return false;
    }
    // Drawing takes at most half of the time: when a frame takes long, fewer frames are shown.
    next_frame_ = std::max(now + period_, wall_time() + (wall_time() - now));
    if (screen_->is_closed()) simulation_->stop();
    return !screen_->is_closed();
  }

  double wall_time() const { return std::chrono::duration<double>(Clock::now() - start_time_).count(); }

  void select(const Connector& c, const std::string& name) {
    for (const RobotView* robot : c.robots())
      if (robot->name == name) panels_.selected = robot->base();
    if (panels_.selected == no_object) panels_.selected = c.find_object(name);
    if (panels_.selected == no_object || c.robot_of(panels_.selected) == no_robot)
      throw Error("follow names `" + name + "`, which is neither a robot nor a part of one");
    orbit_camera_.mode = OrbitCamera::Mode::follow;
    starts_behind_target_ = true;
  }

  void show_all() {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const view::BodyPoses::Body& b : bodies_.all()) {
      low = low.cwiseMin(b.pose->position);
      high = high.cwiseMax(b.pose->position);
    }
    if (bodies_.all().empty()) low.setConstant(-3), high.setConstant(3);
    orbit_camera_.show_box(low, high);
    follows_team_ = !team_.empty();
    keeps_distance_ = false;
    if (follows_team_) approach_team(1);
  }

  void approach_team(double part) {
    constexpr double least_radius = 1;  // m
    const view::Team::Ball ball = team_.bounds();
    orbit_camera_.approach(ball.middle, std::max(least_radius, ball.radius), part, keeps_distance_);
  }

  /// Follows the robots that move, until the user shifts the view or changes the mode of the camera. Follows in
  /// simulated time, so that the view rests while the run is paused.
  void follow_team(double simulated) {
    constexpr double slowness = 0.5;  // s
    const double dt = std::max(0.0, simulated - followed_until_);
    followed_until_ = simulated;
    if (orbit_camera_.mode != OrbitCamera::Mode::orbit) follows_team_ = false;
    if (follows_team_) approach_team(1 - elementary::exp(-dt / slowness));
  }

  render::Camera camera() const {
    render::Camera c;
    c.width = std::uint32_t(screen_->width());
    c.height = std::uint32_t(screen_->height());
    c.fx = c.fy = 0.5 * c.height / elementary::tan(0.5 * fov);
    using Area = std::array<double, 4>;
    const auto [left, top, right, bottom] =
        has_panels_ ? panels_.free_area(c.width, c.height) : Area{0, 0, double(c.width), double(c.height)};
    c.cx = 0.5 * (left + right);
    c.cy = 0.5 * (top + bottom);
    c.pose = orbit_camera_.pose();
    return c;
  }

  void draw(double simulated, std::vector<std::uint8_t>* picture = nullptr) {
    const view::Screen::Current current(*screen_);
    screen_->begin();
    if (screen_->is_lost()) return;
    if (!gpu_scene_) {
      gpu_scene_.emplace(scene_);
      renderer_.emplace(*gpu_scene_);
      label_renderer_.emplace(*gpu_scene_);
      lines_.emplace();
    }
    if (shows_all_ || panels_.show_all_requested) show_all();
    shows_all_ = panels_.show_all_requested = false;
    follow_team(simulated);
    for (const view::Key key : screen_->keys()) panels_.press(key, pace_, orbit_camera_);
    if (has_panels_) panels_.draw(*simulation_, pace_, orbit_camera_, overlay_, simulated, wall_time());
    move_camera();
    if (const Pose* target = bodies_.find(panels_.selected)) {
      if (starts_behind_target_) orbit_camera_.look_from(*target * Vec3(-1.9, -0.25, 1.5), target->position);
      starts_behind_target_ = false;
      orbit_camera_.follow(*target);
    }
    if (!target_ || target_width_ != screen_->width() || target_height_ != screen_->height()) {
      target_width_ = screen_->width();
      target_height_ = screen_->height();
      const std::uint32_t samples = samples_ > 0 ? samples_ : screen_->is_software() ? 1 : 4;
      target_.emplace(std::uint32_t(target_width_), std::uint32_t(target_height_), samples);
      if (target_->samples() < samples && !fewer_samples_told_)
        host_->log(LogLevel::warning, "samples is " + std::to_string(samples) +
                                          ", but this driver of OpenGL has at most " +
                                          std::to_string(target_->samples()) + " for each pixel, which are taken");
      fewer_samples_told_ = true;
    }
    gpu_scene_->update();
    const render::Camera c = camera();
    light_.shadow_range = std::clamp(orbit_camera_.distance(), 5.0, 60.0);
    renderer_->draw(c, *target_, light_);
    lines_->clear();
    overlay_.collect(*simulation_, bodies_, panels_.selected, *lines_);
    lines_->draw(c);
    target_->show();
    screen_->end(picture);
  }

  void move_camera() {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantCaptureMouse) return;
    const double height = screen_->height();
    if (ImGui::IsMouseDragging(ImGuiMouseButton_Left, 3))
      orbit_camera_.rotate(double(io.MouseDelta.x), double(io.MouseDelta.y), height);
    if (ImGui::IsMouseDragging(ImGuiMouseButton_Right, 1) || ImGui::IsMouseDragging(ImGuiMouseButton_Middle, 1)) {
      orbit_camera_.shift(double(io.MouseDelta.x), double(io.MouseDelta.y), height, fov);
      follows_team_ = false;
    }
    if (io.MouseWheel != 0) {
      orbit_camera_.zoom(double(io.MouseWheel));
      keeps_distance_ = true;
    }
    const bool dragged = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 3).x != 0 ||
                         ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 3).y != 0;
    if (ImGui::IsMouseReleased(ImGuiMouseButton_Left) && !dragged) pick(io.MousePos.x, io.MousePos.y);
  }

  /// Selects the object that is visible at a pixel.
  void pick(float x, float y) {
    const render::Camera c = camera();
    if (x < 0 || y < 0 || x >= float(c.width) || y >= float(c.height)) return;
    const render::DepthTarget target(c.width, c.height, true);
    std::vector<std::uint32_t> labels(std::size_t(c.width) * c.height);
    gpu_scene_->update();
    target.begin();
    label_renderer_->draw(c, target);
    target.read(std::span(labels));
    panels_.selected = ObjectId(labels[std::size_t(y) * c.width + std::size_t(x)]);
  }

  void release() {
    {
      const view::Screen::Current current(*screen_);
      target_.reset();
      lines_.reset();
      label_renderer_.reset();
      renderer_.reset();
      gpu_scene_.reset();
    }
    screen_.reset();
  }

  std::array<int, 2> size_{};
  double period_ = 0;
  std::uint32_t samples_ = 0;
  bool fewer_samples_told_ = false;
  view::Pace pace_{1, false};
  std::string picture_;
  Host* host_ = nullptr;
  Inspection* simulation_ = nullptr;
  RunControl* control_ = nullptr;
  bool has_paused_ = false;  ///< the user has paused the run
  render::Scene scene_;
  render::Daylight light_;
  view::BodyPoses bodies_;
  OrbitCamera orbit_camera_;
  view::Overlay overlay_;
  view::Panels panels_;
  bool has_panels_ = true;
  bool shows_all_ = true, starts_behind_target_ = false;
  view::Team team_;
  bool follows_team_ = false;    ///< the camera stays with the robots that move
  bool keeps_distance_ = false;  ///< the user has chosen the distance
  double followed_until_ = 0;    ///< s of simulated time
  Clock::time_point start_time_;
  double next_frame_ = 0;  ///< s of the wall clock since the start
  double last_time_ = 0;   ///< s of simulated time

  std::optional<view::Screen> screen_;
  std::optional<render::GpuScene> gpu_scene_;
  std::optional<render::ColorRenderer> renderer_;
  std::optional<render::DepthRenderer> label_renderer_;
  std::optional<render::DebugLines> lines_;
  std::optional<render::ColorTarget> target_;
  int target_width_ = 0, target_height_ = 0;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Window>(description)};

}  // namespace

MURO_PLUGIN(.name = "view_window", .version = description.version, .licence = "MIT",
            .summary = "A window on the simulation", .algorithms = algorithms)
