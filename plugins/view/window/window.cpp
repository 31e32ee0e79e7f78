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

#include "muro/plugin.hpp"
#include "muro/vocabulary.hpp"
#include "panels.hpp"
#include "plugins/common/image_file/png.hpp"
#include "plugins/common/render/depth_renderer.hpp"
#include "plugins/common/render/picture_renderer.hpp"
#include "screen.hpp"

namespace {

using namespace muro;
using view::Eye;

constexpr double chord = 1e-3;  ///< m: how far circles lie inside of themselves
constexpr double fov = 0.9;     ///< rad, up and down

constexpr Parameter parameters[] = {
    integer("width", 1280, "pixels of the window").between(320, 16384),
    integer("height", 800, "pixels of the window").between(240, 16384),
    integer("samples", 0, "a pixel: smooth edges; 0: four on a GPU, one where the processor draws").between(0, 16),
    boolean("scans", true, "draw what laser scanners measure"),
    boolean("contacts", true, "draw where robots touch something"),
    boolean("frames", false, "draw frames of robots"),
    boolean("panels", true, "whether there is anything beside the scene"),
    boolean("shadows", true, "the sun throws shadows; without them pictures are made faster"),
    real("pictures", "1/s", 60, "at most so many in a second of the wall clock").between(0.1, 1000),
    real("speed", "1", 1, "simulated seconds in a second; 0: as fast as possible").between(0, 1e6),
    boolean("paused", false, "whether the run begins paused"),
    text("follow", "", "object that is chosen and followed from the start, such as `robot` or `robot/link`"),
    reals("from", "m", {}, "where the eye is at the start; default: where all is seen"),
    reals("to", "m", {}, "what it looks at then"),
    text("picture", "",
         "PNG file that gets what the window shows last; a relative path starts in the working directory"),
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

class Window final : public Algorithm {
 public:
  ~Window() override {
    if (screen_) forget();
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
    if (!p.text("picture").empty()) picture_ = std::filesystem::absolute(std::string(p.text("picture"))).string();
    if (const std::string name(p.text("follow")); !name.empty()) {
      if (p.given("from")) throw Error("follow and from are both given: the eye is behind what it follows; remove one");
      choose(c, name);
    }
    if (p.given("from")) eye_.look_from(vector(p.reals("from")), vector(p.reals("to")));
    looks_at_all_ = !p.given("from") && panels_.chosen == no_object;
    simulation_ = Inspection::of(c.host());
    if (!simulation_) throw Error("this host does not show its simulation to windows");
    scene_.connect(c, render::Look::as_seen, chord);
    panels_.connect(c);
    for (const RobotView* robot : c.robots())
      for (const Link& f : robot->links) bodies_.push_back({c.read(f.object, keys::pose), f.object});
  }

  void connect_by_name(Connector& c) override {
    overlay_.connect(c);
    for (std::uint32_t i = 0; i < c.object_count(); ++i)
      if (c.robot_of(ObjectId(i)) >= 0)
        for (const FoundProperty& found : c.properties(ObjectId(i)))
          if (found.key->name == keys::ranges.name || found.key->name == keys::camera_width.name)
            bodies_.push_back({c.read(ObjectId(i), keys::pose), ObjectId(i)});
  }

  void restored() override {
    pace_.begin_anew();
    panels_.begin_anew();
  }

  void start() override {
    restored();
    if (!screen_) screen_.emplace("muro", size_[0], size_[1]);
    begun_ = Clock::now();
    next_frame_ = 0;
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase whole[] = {{Phase::IndexSpace::whole}};
    return whole;
  }

  /// Returns when the run may go on, and draws meanwhile; on time it draws only when the last picture is old enough.
  void step(const Step& step, Range) override {
    if (screen_->is_closed()) return;
    last_time_ = step.seconds();
    for (;;) {
      const double now = wall();
      const bool may_go_on = pace_.may_go_on(step.seconds(), now);
      if (now >= next_frame_) {
        draw(step.seconds());
        // Half of the time at most goes into pictures: where they take long, fewer are shown.
        next_frame_ = std::max(now + period_, wall() + (wall() - now));
        if (screen_->is_closed()) return simulation_->stop();
        if (!may_go_on && !simulation_->is_stopping()) continue;
      }
      if (may_go_on || simulation_->is_stopping()) return;
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
  }

  void finish() override {
    if (!screen_ || picture_.empty()) return;
    std::vector<std::uint8_t> picture;
    draw(last_time_, &picture);
    picture_file::write_png(picture_, picture_file::Format::rgb8, std::uint32_t(screen_->width()),
                            std::uint32_t(screen_->height()), picture.data());
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Body {
    In<Pose> pose;
    ObjectId object;
  };

  static Vec3 vector(std::span<const double> v) { return {v[0], v[1], v[2]}; }
  double wall() const { return std::chrono::duration<double>(Clock::now() - begun_).count(); }

  void choose(const Connector& c, const std::string& name) {
    for (const RobotView* robot : c.robots())
      if (robot->name == name) panels_.chosen = robot->base();
    if (panels_.chosen == no_object) panels_.chosen = c.find_object(name);
    if (panels_.chosen == no_object || c.robot_of(panels_.chosen) < 0)
      throw Error("follow names `" + name + "`, which is neither a robot nor a part of one");
    eye_.mode = Eye::Mode::follow;
    starts_behind_ = true;
  }

  const Pose* chosen_pose() const {
    for (const Body& b : bodies_)
      if (b.object == panels_.chosen) return b.pose.get();
    return nullptr;
  }

  void see_all() {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Body& b : bodies_) {
      low = low.cwiseMin(b.pose->position);
      high = high.cwiseMax(b.pose->position);
    }
    if (bodies_.empty()) low.setConstant(-3), high.setConstant(3);
    eye_.look_at_all(low, high);
  }

  render::Camera camera() const {
    render::Camera c;
    c.width = std::uint32_t(screen_->width());
    c.height = std::uint32_t(screen_->height());
    c.fx = c.fy = 0.5 * c.height / std::tan(0.5 * fov);
    using Area = std::array<double, 4>;
    const auto [left, top, right, bottom] =
        has_panels_ ? panels_.free_area(c.width, c.height) : Area{0, 0, double(c.width), double(c.height)};
    c.cx = 0.5 * (left + right);
    c.cy = 0.5 * (top + bottom);
    c.pose = eye_.pose();
    return c;
  }

  void draw(double simulated, std::vector<std::uint8_t>* picture = nullptr) {
    const view::Screen::Current current(*screen_);
    screen_->begin();
    if (!stage_) {
      stage_.emplace(scene_);
      renderer_.emplace(*stage_);
      labels_.emplace(*stage_);
      lines_.emplace();
    }
    if (looks_at_all_ || panels_.wants_all) see_all();
    looks_at_all_ = panels_.wants_all = false;
    for (const view::Key key : screen_->keys()) panels_.press(key, pace_, eye_);
    if (has_panels_) panels_.draw(*simulation_, pace_, eye_, overlay_, simulated, wall());
    move_eye();
    if (const Pose* target = chosen_pose()) {
      if (starts_behind_) eye_.look_from(*target * Vec3(-1.9, -0.25, 1.5), target->position);
      starts_behind_ = false;
      eye_.follow(*target);
    }
    if (!target_ || target_width_ != screen_->width() || target_height_ != screen_->height()) {
      target_width_ = screen_->width();
      target_height_ = screen_->height();
      const std::uint32_t samples = samples_ > 0 ? samples_ : screen_->is_software() ? 1 : 4;
      target_.emplace(std::uint32_t(target_width_), std::uint32_t(target_height_), samples);
    }
    stage_->place();
    const render::Camera c = camera();
    light_.shadow_range = std::clamp(eye_.distance(), 5.0, 60.0);
    renderer_->draw(c, *target_, light_);
    lines_->clear();
    overlay_.collect(*simulation_, panels_.chosen, *lines_);
    lines_->draw(c);
    target_->show();
    screen_->end(picture);
  }

  void move_eye() {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantCaptureMouse) return;
    const double height = screen_->height();
    if (ImGui::IsMouseDragging(ImGuiMouseButton_Left, 3))
      eye_.turn(double(io.MouseDelta.x), double(io.MouseDelta.y), height);
    if (ImGui::IsMouseDragging(ImGuiMouseButton_Right, 1) || ImGui::IsMouseDragging(ImGuiMouseButton_Middle, 1))
      eye_.shift(double(io.MouseDelta.x), double(io.MouseDelta.y), height, fov);
    if (io.MouseWheel != 0) eye_.zoom(double(io.MouseWheel));
    const bool dragged = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 3).x != 0 ||
                         ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 3).y != 0;
    if (ImGui::IsMouseReleased(ImGuiMouseButton_Left) && !dragged) pick(io.MousePos.x, io.MousePos.y);
  }

  /// What is seen at a pixel becomes what is chosen.
  void pick(float x, float y) {
    const render::Camera c = camera();
    if (x < 0 || y < 0 || x >= float(c.width) || y >= float(c.height)) return;
    const render::DepthTarget target(c.width, c.height, true);
    std::vector<std::uint32_t> labels(std::size_t(c.width) * c.height);
    stage_->place();
    target.begin();
    labels_->draw(c, target);
    target.read(std::span(labels));
    panels_.chosen = ObjectId(labels[std::size_t(y) * c.width + std::size_t(x)]);
  }

  void forget() {
    {
      const view::Screen::Current current(*screen_);
      target_.reset();
      lines_.reset();
      labels_.reset();
      renderer_.reset();
      stage_.reset();
    }
    screen_.reset();
  }

  std::array<int, 2> size_{};
  double period_ = 0;
  std::uint32_t samples_ = 0;
  view::Pace pace_{1, false};
  std::string picture_;
  Inspection* simulation_ = nullptr;
  render::Scene scene_;
  render::Daylight light_;
  std::vector<Body> bodies_;
  Eye eye_;
  view::Overlay overlay_;
  view::Panels panels_;
  bool has_panels_ = true;
  bool looks_at_all_ = true, starts_behind_ = false;
  Clock::time_point begun_;
  double next_frame_ = 0;  ///< s of the wall clock since the start
  double last_time_ = 0;   ///< s of simulated time

  std::optional<view::Screen> screen_;
  std::optional<render::Stage> stage_;
  std::optional<render::PictureRenderer> renderer_;
  std::optional<render::DepthRenderer> labels_;
  std::optional<render::Lines> lines_;
  std::optional<render::ColorTarget> target_;
  int target_width_ = 0, target_height_ = 0;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Window>(description)};

}  // namespace

MURO_PLUGIN(.name = "view_window", .version = "1.0.0", .licence = "MIT", .summary = "A window on the simulation",
            .algorithms = algorithms)
