// SPDX-License-Identifier: MIT
// A picture of a scenario at one time, or a video.
#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <optional>

#include "core/instance.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/open.hpp"
#include "host/names.hpp"
#include "host/outputs/false_colors.hpp"
#include "host/outputs/free_camera.hpp"
#include "host/outputs/output_file.hpp"
#include "host/outputs/output_options.hpp"
#include "host/outputs/png.hpp"
#include "host/outputs/remove_outputs.hpp"
#include "host/outputs/video.hpp"
#include "host/process/interrupt.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

constexpr const char* camera_algorithm = "camera.opengl";
constexpr const char* free_camera_name = "muro.camera";

/// "1280x720"
std::pair<std::int64_t, std::int64_t> size_of(const std::string& text) {
  std::int64_t sides[2] = {};
  const char *at = text.data(), *end = at + text.size();
  const auto first = std::from_chars(at, end, sides[0]);
  if (first.ec == std::errc{} && first.ptr != end && *first.ptr == 'x') {
    const auto second = std::from_chars(first.ptr + 1, end, sides[1]);
    if (second.ec == std::errc{} && second.ptr == end && std::min(sides[0], sides[1]) >= 1 &&
        std::max(sides[0], sides[1]) <= 8192)
      return {sides[0], sides[1]};
  }
  throw SetupError(
      fmt::format("--size is `{}` but must be WIDTHxHEIGHT, each from 1 to 8192 pixels, such as 1280x720", text));
}

Vec3 point_of(const char* option, const std::vector<double>& xyz) {
  const Vec3 p(xyz[0], xyz[1], xyz[2]);
  if (!p.allFinite()) throw SetupError(std::string(option) + " must be three finite numbers x,y,z in metres");
  return p;
}

std::optional<Vec3> optional_point(const char* option, const std::vector<double>& xyz) {
  if (xyz.empty()) return {};
  return point_of(option, xyz);
}

FreeCamera add_free_camera(const RenderOptions& options, Simulation& simulation) {
  const auto [width, height] = size_of(options.size);
  FreeCamera camera(simulation, free_camera_name, optional_point("--from", options.from),
                    optional_point("--to", options.to));
  AlgorithmSetup setup;
  setup.name = "muro render";
  setup.use = camera_algorithm;
  setup.rate = Rate(options.video.empty() ? 1e-6 : options.fps);
  setup.phase = std::llround(options.at * 1e9);
  setup.items = {{nullptr, camera.object()}};
  setup.parameters = {{"width", width},
                      {"height", height},
                      {"horizontal_fov", options.fov * M_PI / 180},
                      {"shadow_range", std::clamp(camera.distance(), 1.0, 1e4)},
                      {"device", options.device}};
  simulation.add(std::move(setup));
  return camera;
}

/// Returns the sensor object that holds the picture.
ObjectId camera_of(const RenderOptions& options, Simulation& simulation) {
  std::vector<std::string> cameras;
  for (const auto& instance : simulation.instances())
    for (const Item& item : instance->setup().items)
      if (simulation.world().has(item.object, keys::camera_image.name))
        cameras.push_back(simulation.world().object_name(item.object));
  const std::string name = options.camera.empty() ? free_camera_name : options.camera;
  if (std::find(cameras.begin(), cameras.end(), name) != cameras.end()) return simulation.world().object(name);
  throw SetupError(
      fmt::format("the scenario has no camera `{}`{}", name,
                  cameras.empty() ? "; no robot has one that writes camera.image" : suggestion(name, cameras)));
}

/// Returns the latest output of the camera as colours.
std::vector<std::uint8_t> picture_of(const World& world, ObjectId camera, const std::string& shows) {
  if (shows == "depth") return colors_of(world.values(camera, keys::camera_depth));
  if (shows == "labels") return colors_of(world.values(camera, keys::camera_labels));
  const auto image = world.values(camera, keys::camera_image);
  return {image.begin(), image.end()};
}

void check_options(const RenderOptions& options, const Registry& registry) {
  if (!options.camera.empty() && (!options.from.empty() || !options.to.empty()))
    throw SetupError("--camera selects a camera of a robot, --from and --to place a free camera; give one of both");
  if (options.out.empty() == options.video.empty())
    throw SetupError("give --out FILE.png for a picture, or --video FILE.mp4 for a video");
  if (options.video.empty() && !options.out.ends_with(".png"))
    throw SetupError(fmt::format("--out is `{}` but must be a file NAME.png", options.out));
  if (!options.video.empty()) check_video_format(options.video);
  const auto& catalog = registry.catalog();
  if (std::none_of(catalog.begin(), catalog.end(), [](const CatalogEntry& e) { return e.id == camera_algorithm; }))
    throw SetupError(
        "a picture needs the plugin camera.opengl, which is not installed; install libepoxy-dev and libegl-dev, "
        "and build muro again");
}

/// Number of frames of a video from `begin` to `end` (s), both included.
std::int64_t frame_count(double begin, double end, double fps) {
  constexpr double most = 1e7;  // four days at 25 frames in a second
  const double frames = 1 + std::floor((end - begin) * fps + 1e-6);
  if (frames <= most) return std::int64_t(frames);
  throw SetupError(
      fmt::format("the video would have {:.3g} frames, and may have {:g}; give --until an earlier time, or --fps a "
                  "smaller number",
                  frames, most));
}

/// Thrown when the user has asked for the end: nothing is written.
struct Interrupted {};

/// Runs the scenario and takes pictures with one camera.
class Photographer {
 public:
  /// `free_camera`: null with a camera of a robot.
  Photographer(const RenderOptions& options, const BuiltScenario& built, FreeCamera* free_camera)
      : options_(options),
        built_(built),
        simulation_(*built.simulation),
        camera_(camera_of(options, simulation_)),
        free_camera_(free_camera) {
    const World& world = simulation_.world();
    if (options.shows != "rgb" && !world.has(camera_, "camera." + options.shows))
      throw SetupError(
          fmt::format("camera `{0}` writes no camera.{1}; give a robot's camera `{1}: true`, and name it by "
                      "--camera",
                      options.camera.empty() ? "from outside" : options.camera, options.shows));
    width_ = world.constant(camera_, keys::camera_width, 0u);
    height_ = world.constant(camera_, keys::camera_height, 0u);
  }

  void take_picture() {
    write_file(options_.out, png(width_, height_, picture_at(options_.at)));
    fmt::print("{}: {} x {} pixels, {} at {:g} s\n", options_.out, width_, height_, built_.scenario.name, options_.at);
  }

  void take_video() {
    const double until = options_.until.value_or(built_.scenario.duration);
    if (until <= options_.at)
      throw SetupError(fmt::format("--until is {:g} s but must be later than --at, {:g} s", until, options_.at));
    const std::int64_t frames = frame_count(options_.at, until, options_.fps);
    Video video(options_.video, width_, height_, options_.fps);
    for (std::int64_t k = 0; k < frames; ++k) video.add(picture_at(options_.at + double(k) / options_.fps));
    video.close();
    fmt::print("{}: {} frames of {} x {} pixels, {} from {:g} to {:g} s\n", options_.video, frames, width_, height_,
               built_.scenario.name, options_.at, until);
  }

 private:
  std::vector<std::uint8_t> picture_at(double time) {
    const std::int64_t instant = std::llround(time * 1e9);
    run_until(instant);
    if (free_camera_) free_camera_->look(time - last_time_);
    last_time_ = time;
    run_until(instant + 1);
    return picture_of(simulation_.world(), camera_, options_.shows);
  }

  void run_until(std::int64_t time) {
    simulation_.run_until(time, [] { return Interrupt::pending(); });
    if (Interrupt::pending()) throw Interrupted();
  }

  const RenderOptions& options_;
  const BuiltScenario& built_;
  Simulation& simulation_;
  ObjectId camera_;
  FreeCamera* free_camera_;
  double last_time_ = -std::numeric_limits<double>::infinity();  ///< s, time of the last picture
  std::uint32_t width_ = 0, height_ = 0;
};

}  // namespace

int render(const RenderOptions& options) {
  Registry registry(Registry::search_path(options.scenario.plugin_path));
  check_options(options, registry);
  Scenario scenario = open_file(options.scenario, registry);
  remove_outputs(scenario, registry);
  const Interrupt interrupt;
  std::optional<FreeCamera> free_camera;
  const BuiltScenario built = open_scenario(std::move(scenario), registry, [&](Simulation& simulation) {
    simulation.keep_inputs_closed();
    add_outputs(simulation, {{"--out", options.out}, {"--video", options.video}});
    if (options.camera.empty()) free_camera = add_free_camera(options, simulation);
  });
  Photographer photographer(options, built, free_camera ? &*free_camera : nullptr);
  try {
    if (options.video.empty())
      photographer.take_picture();
    else
      photographer.take_video();
  } catch (const Interrupted&) {
    return 130;
  } catch (const StepError&) {
    if (Interrupt::pending()) return 130;  // ffmpeg has failed, because Ctrl-C ends it too
    throw;
  }
  return 0;
}

}  // namespace muro::host
