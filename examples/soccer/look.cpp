// SPDX-License-Identifier: MIT
// The eyes of a humanoid: finds the ball, the posts of goals, lines and other players in the pictures of its camera
// alone, reports where they are, and turns the head.
#include <cstdint>

#include "ball_finder.hpp"
#include "gaze.hpp"
#include "line_finder.hpp"
#include "muro_controller.hpp"
#include "player_finder.hpp"
#include "post_finder.hpp"

namespace {

using namespace muro::controller;
using namespace soccer;

enum Input { image, fx, fy, cx, cy, camera_width, camera_height, orientation, head_position };
enum Output { head_target, ball, goal, players, lines };
enum Tunable {
  trunk_height,
  neck_x,
  neck_z,
  tilt_x,
  tilt_y,
  tilt_z,
  camera_x,
  camera_y,
  camera_z,
  ball_radius,
  post_radius
};

class Look {
 public:
  static constexpr const char* name = "look";
  static constexpr const char* version = "2.0.0";
  static constexpr const char* summary =
      "Finds ball, goals, lines and players by the camera and keeps the head on the ball";
  static constexpr muro_port inputs[] = {{"camera.image", "1", 0, MURO_PORT_TEXT | MURO_PORT_OPTIONAL},
                                         {"camera.fx", "px", 1, MURO_PORT_OPTIONAL},
                                         {"camera.fy", "px", 1, MURO_PORT_OPTIONAL},
                                         {"camera.cx", "px", 1, MURO_PORT_OPTIONAL},
                                         {"camera.cy", "px", 1, MURO_PORT_OPTIONAL},
                                         {"camera.width", "1", 1, MURO_PORT_OPTIONAL},
                                         {"camera.height", "1", 1, MURO_PORT_OPTIONAL},
                                         {"orientation", "1", 4, 0},
                                         {"joint.position", "rad", 2, 0}};
  static constexpr std::uint32_t most_posts = 2, most_players = 4, most_points = LineFinder::most;
  static constexpr muro_port outputs[] = {{"joint.position.target", "rad", 2, 0},
                                          {"ball.seen", "1, m, m, s", 4, MURO_PORT_OWN},
                                          {"goal.seen", "1, m, m", 1 + 2 * most_posts, MURO_PORT_OWN},
                                          {"players.seen", "1, m, m, 1", 1 + 3 * most_players, MURO_PORT_OWN},
                                          {"lines.seen", "1, m, m", 1 + 2 * most_points, MURO_PORT_OWN}};
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
      {"ball_radius", "m", 0.07, 0.01, 1, ""},
      {"post_radius", "m", 0.05, 0.01, 1, "of the posts of goals"}};

  explicit Look(const Setup& setup)
      : head_{{setup.tunable(neck_x), 0, setup.tunable(neck_z)},
              {setup.tunable(tilt_x), setup.tunable(tilt_y), setup.tunable(tilt_z)},
              {setup.tunable(camera_x), setup.tunable(camera_y), setup.tunable(camera_z)}},
        ball_finder_(setup.tunable(ball_radius)),
        post_finder_(setup.tunable(post_radius)) {}

  void step(const Step& now) {
    if (now.input(fx).empty() || !take_picture(now)) return;  // it has no camera
    const auto joints = now.input(head_position);
    const CameraView view({now.input(fx)[0], now.input(fy)[0], now.input(cx)[0], now.input(cy)[0]}, head_,
                          now.tunable(trunk_height), now.input(orientation), joints[0], joints[1]);
    const auto found = ball_finder_.find(image_, view);
    tell_ball(found, now);
    if (view.is_upright()) {
      const PlayerFinder::Players others = player_finder_.find(image_, view, found);
      tell(others, now.output(players));
      tell(post_finder_.find(image_, view).all(), now.output(goal));
      tell(line_finder_.find(image_, view, found, others.all()).all(), now.output(lines));
    } else {
      for (const Output o : {players, goal, lines}) tell(std::span<const Vector>(), now.output(o));
    }
    turn_head(found, view, now);
  }

  void save(Saver& to) const { to.put(memory_); }
  void load(Loader& from) { memory_ = from.get<Memory>(); }

 private:
  struct Memory {
    Gaze gaze;
    double x = 0, y = 0;  ///< m: where the ball was last seen, in the heading frame of that time
    double age = 1e3;     ///< s: since then
  };

 public:
  static constexpr std::size_t save_size = sizeof(Memory);

 private:
  bool take_picture(const Step& now) {
    const int width = int(now.input(camera_width)[0]), height = int(now.input(camera_height)[0]);
    const std::size_t bytes = 3 * std::size_t(width) * std::size_t(height);
    if (now.raw().input_sizes[image] < bytes) return false;
    image_.set({reinterpret_cast<const std::uint8_t*>(now.raw().text_inputs[image]), bytes}, width, height);
    return true;
  }
  void tell_ball(const std::optional<Vector>& found, const Step& now) {
    memory_.age = found ? 0 : memory_.age + now.period();
    if (found) memory_.x = found->x, memory_.y = found->y;
    const auto told = now.output(ball);
    told[0] = found ? 1 : 0, told[1] = memory_.x, told[2] = memory_.y, told[3] = memory_.age;
  }
  /// Writes the number of points and their places; zeros after them.
  static void tell(std::span<const Vector> points, std::span<double> told) {
    std::fill(told.begin(), told.end(), 0.0);
    told[0] = double(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) told[1 + 2 * i] = points[i].x, told[2 + 2 * i] = points[i].y;
  }
  static void tell(const PlayerFinder::Players& seen, std::span<double> told) {
    std::fill(told.begin(), told.end(), 0.0);
    told[0] = double(seen.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const auto one = told.subspan(1 + 3 * i, 3);
      one[0] = seen[i].feet.x, one[1] = seen[i].feet.y, one[2] = double(seen[i].team);
    }
  }
  void turn_head(const std::optional<Vector>& found, const CameraView& view, const Step& now) {
    const auto joints = now.input(head_position);
    const auto target = now.output(head_target);
    const auto pixel = found ? view.pixel_of(*found) : std::nullopt;
    const Neck neck = pixel ? memory_.gaze.follow({joints[0], joints[1]}, *pixel, view.lens(),
                                                  std::sqrt(found->x * found->x + found->y * found->y), now.period())
                            : memory_.gaze.search(now.period());
    target[0] = neck.pan, target[1] = neck.tilt;
  }

  Head head_;
  BallFinder ball_finder_;
  PostFinder post_finder_;
  PlayerFinder player_finder_;
  LineFinder line_finder_;
  Image image_;
  Memory memory_;
};

}  // namespace

MURO_CONTROLLER(Look)
