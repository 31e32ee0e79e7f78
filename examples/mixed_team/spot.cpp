// SPDX-License-Identifier: MIT
// Finds targets in the pictures of a camera by their colour alone, and reports where around the robot they are.

#include "muro_controller.hpp"
#include "sight.hpp"
#include "spots.hpp"

namespace {

using namespace muro::controller;
using namespace mixed_team;

enum Input { image, fx, fy, cx, cy, width, height, orientation, gps_position };
enum Output { seen };
enum Tunable { hue, hue_tolerance, least_pixels, whole, base_height, target_height, camera_x, camera_z, camera_pitch };

class Spot {
 public:
  static constexpr const char* name = "spot";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Sees targets in pictures by their colour";
  static constexpr muro_port inputs[] = {
      {"camera.image", "1", 0, MURO_PORT_OPTIONAL},  {"camera.fx", "px", 1, MURO_PORT_OPTIONAL},
      {"camera.fy", "px", 1, MURO_PORT_OPTIONAL},    {"camera.cx", "px", 1, MURO_PORT_OPTIONAL},
      {"camera.cy", "px", 1, MURO_PORT_OPTIONAL},    {"camera.width", "1", 1, MURO_PORT_OPTIONAL},
      {"camera.height", "1", 1, MURO_PORT_OPTIONAL}, {"orientation", "1", 4, 0},
      {"gps.position", "m", 3, MURO_PORT_OPTIONAL}};
  static constexpr muro_port outputs[] = {{"spot.seen", "1, m, m, px", numbers_of_spots, MURO_PORT_OWN}};
  static constexpr muro_tunable tunables[] = {
      {"hue", "1", 0.07, 0, 1, "of targets: 0 red, 1/6 yellow, 1/3 green, 2/3 blue"},
      {"hue_tolerance", "1", 0.035, 0.001, 0.5, "how far a hue may be off"},
      {"least_pixels", "px", 6, 1, 1e6, "smaller spots of the colour are not believed"},
      {"whole", "1", 1, 0, 1,
       "1: spots that reach to the rim of the picture are left out, since their middle is not known"},
      {"base_height", "m", 0, 0, 100, "of the origin of the base above the ground; 0: as the receiver tells it"},
      {"target_height", "m", 0.25, 0, 10, "above the ground, of the middle of what is seen of a target"},
      {"camera_x", "m", 0, -10, 10, "the camera in the frame of the base"},
      {"camera_z", "m", 0, -10, 10, "the same"},
      {"camera_pitch", "rad", 1.5707963267948966, -1.6, 1.6,
       "of the camera, downwards; the default looks straight down"}};
  static constexpr std::size_t save_size = sizeof(double);

  explicit Spot(const Setup& setup) {
    if (setup.input_size(image) == 0)
      setup.log().warning("there is no camera, so it sees nothing: give it one, such as camera.opengl");
    if (setup.tunable(base_height) == 0 && setup.input_size(gps_position) == 0)
      throw std::invalid_argument("it does not know how high it is: give it a `sensor.gps`, or set `base_height`");
  }

  void step(const Step& now) {
    if (now.input(image).empty()) return;  // it has no camera
    const int columns = int(now.input(width)[0]), rows = int(now.input(height)[0]);
    const Camera camera{now.input(fx)[0],      now.input(fy)[0],      now.input(cx)[0],         now.input(cy)[0],
                        now.tunable(camera_x), now.tunable(camera_z), now.tunable(camera_pitch)};
    const double base = now.tunable(base_height) > 0 ? now.tunable(base_height) : now.input(gps_position)[2];
    const double below = base - now.tunable(target_height);
    const Hue color{now.tunable(hue), now.tunable(hue_tolerance)};
    const auto told = now.output(seen);
    std::fill(told.begin(), told.end(), 0.0);
    std::size_t used = 1;
    for (const Blob& blob : finder_.find(now.input(image), columns, rows, color, int(now.tunable(least_pixels)))) {
      if (used + numbers_of_spot > told.size()) break;
      if (blob.is_cut && now.tunable(whole) > 0) continue;
      const auto p = camera.place(blob.u, blob.v, below, now.input(orientation));
      if (p) told[used] = p->x, told[used + 1] = p->y, told[used + 2] = blob.pixels, used += numbers_of_spot;
    }
    told[0] = ++count_;
  }

  void save(Saver& to) const { to.put(count_); }
  void load(Loader& from) { count_ = from.get<double>(); }

 private:
  BlobFinder finder_;
  double count_ = 0;  // pictures
};

}  // namespace

MURO_CONTROLLER(Spot)
