// SPDX-License-Identifier: MIT
// A picture of a scenario at one time, or a film.
#include <fmt/format.h>

#include <charconv>

#include "core/instance.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/open.hpp"
#include "host/constants.hpp"
#include "host/false_colors.hpp"
#include "host/png.hpp"
#include "host/report.hpp"
#include "host/video.hpp"
#include "muro/toolkit/did_you_mean.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

constexpr const char* algorithm = "camera.opengl";
constexpr const char* eye = "muro.eye";

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
  throw SetupError("--size is `" + text + "` but must be WIDTHxHEIGHT, each from 1 to 8192 pixels, such as 1280x720");
}

Vec3 point_of(const char* option, const std::vector<double>& xyz) {
  const Vec3 p(xyz[0], xyz[1], xyz[2]);
  if (!p.allFinite()) throw SetupError(std::string(option) + " must be three finite numbers x,y,z in metres");
  return p;
}

/// At `from`, looking to `to`, upright.
Pose looking(const Vec3& from, const Vec3& to) {
  const Vec3 forward = to - from;
  if (forward.norm() < 1e-9) throw SetupError("--from and --to are the same point; the picture needs a direction");
  const double yaw = std::atan2(forward.y(), forward.x());
  return {from, from_rpy(0, -std::atan2(forward.z(), forward.head<2>().norm()), yaw)};
}

struct View {
  Pose pose;
  double distance = 0;  ///< m, to what it looks at
};

View view_of(const RenderOptions& options, Simulation& simulation) {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const RobotView* r : simulation.world().robots()) {
    const Vec3 at = constant(simulation.world(), r->base(), keys::initial_pose, Pose{}).position;
    low = low.cwiseMin(at), high = high.cwiseMax(at);
  }
  if (simulation.world().robots().empty()) low = high = Vec3::Zero();
  const Vec3 middle = 0.5 * (low + high);
  const double around = std::max(1.5, 0.5 * (high - low).norm());
  const Vec3 to = options.to.empty() ? middle : point_of("--to", options.to);
  const Vec3 from =
      options.from.empty() ? Vec3(to + 1.7 * around * Vec3(-0.75, -0.75, 0.7)) : point_of("--from", options.from);
  return {looking(from, to), (to - from).norm()};
}

void add_eye(const RenderOptions& options, Simulation& simulation) {
  const auto [width, height] = size_of(options.size);
  const View view = view_of(options, simulation);
  const ObjectId object = simulation.world().add_scenery(eye, view.pose, {});
  AlgorithmSetup setup;
  setup.name = "muro render";
  setup.use = algorithm;
  setup.rate = Rate(options.video.empty() ? 1e-6 : options.fps);
  setup.phase = std::llround(options.at * 1e9);
  setup.items = {{nullptr, object}};
  setup.parameters = {{"width", width},
                      {"height", height},
                      {"horizontal_fov", options.fov * M_PI / 180},
                      {"shadow_range", std::clamp(view.distance, 1.0, 1e4)},
                      {"device", options.device}};
  simulation.add(std::move(setup));
}

/// The sensor that has the picture.
ObjectId camera_of(const RenderOptions& options, Simulation& simulation) {
  std::vector<std::string> cameras;
  for (const auto& instance : simulation.instances())
    for (const Item& item : instance->setup().items)
      if (simulation.world().store().find(item.object, keys::camera_image.name))
        cameras.push_back(simulation.world().object_name(item.object));
  const std::string wanted = options.camera.empty() ? eye : options.camera;
  if (std::find(cameras.begin(), cameras.end(), wanted) != cameras.end()) return simulation.world().object(wanted);
  std::string listed;
  for (const std::string& name : cameras) listed += (listed.empty() ? "" : ", ") + name;
  throw SetupError("the scenario has no camera `" + wanted + "`" + did_you_mean(wanted, cameras) +
                   (listed.empty() ? "; no robot has one that writes camera.image" : "; there are: " + listed));
}

/// What the camera has written last, as colours.
std::vector<std::uint8_t> picture_of(const World& world, ObjectId camera, const std::string& shows) {
  if (shows == "depth") return colors_of(world.values(camera, keys::camera_depth));
  if (shows == "labels") return colors_of(world.values(camera, keys::camera_labels));
  const auto image = world.values(camera, keys::camera_image);
  return {image.begin(), image.end()};
}

}  // namespace

int render(const RenderOptions& options) {
  if (!options.camera.empty() && (!options.from.empty() || !options.to.empty()))
    throw SetupError(
        "--camera shows what a camera of a robot sees, --from and --to a view from outside; give one of both");
  if (options.out.empty() == options.video.empty())
    throw SetupError("give --out FILE.png for a picture, or --video FILE.mp4 for a film");
  if (options.video.empty() && !options.out.ends_with(".png"))
    throw SetupError("--out is `" + options.out + "` but must be a file NAME.png");
  Registry registry(Registry::search_path(options.scenario.plugin_path));
  const auto offers = registry.catalog();
  if (std::none_of(offers.begin(), offers.end(), [](const CatalogEntry& o) { return o.id == algorithm; }))
    throw SetupError(
        "a picture needs the plugin camera.opengl, which is not there; install libepoxy-dev and libegl-dev, "
        "and build muro again");
  const std::string& file = options.video.empty() ? options.out : options.video;
  check_writable(file);
  BuiltScenario built = open_scenario(options.scenario, registry, [&](Simulation& simulation) {
    if (options.camera.empty()) add_eye(options, simulation);
  });
  Simulation& simulation = *built.simulation;
  const ObjectId camera = camera_of(options, simulation);
  if (options.shows != "rgb" && !simulation.world().store().find(camera, "camera." + options.shows))
    throw SetupError("camera `" + (options.camera.empty() ? std::string("from outside") : options.camera) +
                     "` writes no camera." + options.shows + "; give a robot's camera `" + options.shows +
                     ": true`, and name it by --camera");
  const std::uint32_t width = constant(simulation.world(), camera, keys::camera_width, 0u);
  const std::uint32_t height = constant(simulation.world(), camera, keys::camera_height, 0u);
  const auto picture_at = [&](double time) {
    simulation.run_until(std::llround(time * 1e9) + 1);
    return picture_of(simulation.world(), camera, options.shows);
  };
  if (options.video.empty()) {
    write_file(file, png(width, height, picture_at(options.at)));
    fmt::print("{}: {} x {} pixels, {} at {:g} s\n", file, width, height, built.scenario.name, options.at);
    return 0;
  }
  const double until = options.until.value_or(built.scenario.duration);
  if (until <= options.at)
    throw SetupError(fmt::format("--until is {:g} s but must be later than --at, {:g} s", until, options.at));
  Video video(file, width, height, options.fps);
  const int frames = 1 + int((until - options.at) * options.fps + 1e-6);
  for (int k = 0; k < frames; ++k) video.add(picture_at(options.at + k / options.fps));
  video.close();
  fmt::print("{}: {} frames of {} x {} pixels, {} from {:g} to {:g} s\n", file, frames, width, height,
             built.scenario.name, options.at, until);
  return 0;
}

}  // namespace muro::host
