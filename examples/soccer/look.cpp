// SPDX-License-Identifier: MIT
// Keeps the head of a humanoid on the ball, which it finds in the pictures of its camera alone, and tells where the
// ball is. Where it sees none, it looks around.
#include <cstdint>

#include "ball_finder.hpp"
#include "muro_controller.hpp"

namespace {

using namespace muro::controller;
using namespace soccer;

enum Input { image, fx, fy, cx, cy, camera_width, camera_height, orientation, head_position };
enum Output { head_target, ball };
enum Tunable { trunk_height, neck_x, neck_z, tilt_x, tilt_y, tilt_z, camera_x, camera_y, camera_z, ball_radius };

constexpr double gain = 0.7;                 // of the way to the ball in a step
constexpr double memory = 0.6;               // s: so long it waits for the ball where it was
constexpr double sweep = 1.2;                // rad: to each side, when it looks around
constexpr double sweep_period = 3;           // s
constexpr double down[] = {0.9, 0.25, 0.6};  // rad: tilts of the sweeps, far and near
constexpr double pi = 3.14159265358979323846;

class Look {
 public:
  static constexpr const char* name = "look";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Finds the ball by the camera and keeps the head on it";
  static constexpr muro_port inputs[] = {{"camera.image", "1", 0, MURO_PORT_TEXT | MURO_PORT_OPTIONAL},
                                         {"camera.fx", "px", 1, MURO_PORT_OPTIONAL},
                                         {"camera.fy", "px", 1, MURO_PORT_OPTIONAL},
                                         {"camera.cx", "px", 1, MURO_PORT_OPTIONAL},
                                         {"camera.cy", "px", 1, MURO_PORT_OPTIONAL},
                                         {"camera.width", "1", 1, MURO_PORT_OPTIONAL},
                                         {"camera.height", "1", 1, MURO_PORT_OPTIONAL},
                                         {"orientation", "1", 4, 0},
                                         {"joint.position", "rad", 2, 0}};
  static constexpr muro_port outputs[] = {{"joint.position.target", "rad", 2, 0},
                                          {"ball.seen", "1, m, m, s", 4, MURO_PORT_OWN}};
  static constexpr muro_tunable tunables[] = {
      {"trunk_height", "m", 0.27, 0.05, 3, "of the trunk's origin above the ground"},
      {"neck_x", "m", -0.001, -1, 1, "axis of the pan joint, from the trunk's origin"},
      {"neck_z", "m", 0.1365, -1, 2, "the same"},
      {"tilt_x", "m", 0.01, -1, 1, "axis of the tilt joint, from there"},
      {"tilt_y", "m", 0.019, -1, 1, "the same"},
      {"tilt_z", "m", 0.0285, -1, 1, "the same"},
      {"camera_x", "m", 0.01425, -1, 1, "the camera, from there"},
      {"camera_y", "m", -0.019, -1, 1, "the same"},
      {"camera_z", "m", 0.04975, -1, 1, "the same"},
      {"ball_radius", "m", 0.07, 0.01, 1, ""}};
  static constexpr std::size_t save_size = 4 * sizeof(double);

  explicit Look(const Setup& setup)
      : head_{{setup.tunable(neck_x), 0, setup.tunable(neck_z)},
              {setup.tunable(tilt_x), setup.tunable(tilt_y), setup.tunable(tilt_z)},
              {setup.tunable(camera_x), setup.tunable(camera_y), setup.tunable(camera_z)}},
        finder_(setup.tunable(ball_radius)) {}

  void step(const Step& now) {
    if (now.input(fx).empty()) return;  // it has no camera
    const auto joints = now.input(head_position);
    const auto target = now.output(head_target);
    const CameraView view({now.input(fx)[0], now.input(fy)[0], now.input(cx)[0], now.input(cy)[0]}, head_,
                          now.tunable(trunk_height), now.input(orientation), joints[0], joints[1]);
    const auto found = find(now, view);
    age_ = found ? 0 : age_ + now.period();
    if (found) {
      x_ = found->x, y_ = found->y;
      const auto p = view.pixel_of(*found);
      target[0] = joints[0] + gain * muro_atan2(view.lens().cx - p->u, view.lens().fx);
      target[1] = joints[1] + gain * muro_atan2(p->v - view.lens().cy, view.lens().fy);
    } else if (age_ > memory) {
      sweep_ += now.period() / sweep_period;
      target[0] = sweep * muro_sin(2 * pi * sweep_);
      target[1] = down[std::int64_t(sweep_) % 3];
    }
    const auto told = now.output(ball);
    told[0] = found ? 1 : 0, told[1] = x_, told[2] = y_, told[3] = age_;
  }

  void save(Saver& to) const { to.put(x_), to.put(y_), to.put(age_), to.put(sweep_); }
  void load(Loader& from) {
    x_ = from.get<double>(), y_ = from.get<double>(), age_ = from.get<double>(), sweep_ = from.get<double>();
  }

 private:
  std::optional<Vector> find(const Step& now, const CameraView& view) {
    const int width = int(now.input(camera_width)[0]), height = int(now.input(camera_height)[0]);
    const std::size_t bytes = 3 * std::size_t(width) * std::size_t(height);
    if (now.raw().input_sizes[image] < bytes) return std::nullopt;
    image_.set({reinterpret_cast<const std::uint8_t*>(now.raw().text_inputs[image]), bytes}, width, height);
    return finder_.find(image_, view);
  }

  Head head_;
  BallFinder finder_;
  Image image_;
  double x_ = 0, y_ = 0;  ///< m: where the ball was last seen, in the heading frame of then
  double age_ = 1e3;      ///< s: since then
  double sweep_ = 0;      ///< periods
};

}  // namespace

MURO_CONTROLLER(Look)
