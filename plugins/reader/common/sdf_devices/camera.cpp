// SPDX-License-Identifier: MIT
#include <cmath>

#include "noise.hpp"
#include "sensor.hpp"

namespace muro::sdf_devices {

namespace {

void add_images(Subsystem& made, std::string_view type) {
  if (type.starts_with("depth")) {
    made.add_flag("rgb", false);
    made.add_flag("depth", true);
  } else if (type.starts_with("rgbd")) {
    made.add_flag("depth", true);
  } else if (type.starts_with("segmentation")) {
    made.add_flag("labels", true);
  }
}

void add_lens(Subsystem& made, Fields& camera) {
  Element* const e = camera.section("distortion");
  if (!e) return;
  Fields given(*e, camera.owner() + ", <distortion>", camera.messages());
  std::vector<double> lens;
  bool any = false;
  for (const char* const name : {"k1", "k2", "p1", "p2", "k3"}) {
    lens.push_back(given.number(name, -1e3, 1e3).value_or(0));
    any = any || lens.back() != 0;
  }
  const auto center = given.numbers("center", 2, -1e6, 1e6);
  if (center && ((*center)[0] != 0.5 || (*center)[1] != 0.5))
    camera.messages().left_out.add(Severity::warning, "<center> in <distortion>", "a lens is centred on the image",
                                   camera.messages().at(*e));
  given.list_unread("a lens has k1, k2, k3, p1, p2");
  if (any) made.add("distortion", lens);
}

std::optional<Subsystem> read_camera(SensorReading& s, Element& e, const std::string& name) {
  Fields camera(e, s.fields.owner(), s.fields.messages());
  const auto within = take_pose(camera);
  if (!within) return std::nullopt;
  Subsystem made = s.begin(name, "camera.opengl", *within);
  double width = 320, height = 240, near = 0.1, far = 100;  // defaults of camera.sdf
  if (Element* const image = camera.section("image")) {
    Fields fields(*image, camera.owner() + ", <image>", camera.messages());
    width = fields.number("width", 1, 8192).value_or(width);
    height = fields.number("height", 1, 8192).value_or(height);
    fields.skip({"format"}, "images are red, green and blue, 8 bits each");
    fields.list_unread("images have no counterpart of it");
  }
  made.add("width", std::floor(width));
  made.add("height", std::floor(height));
  if (const auto angle = camera.number("horizontal_fov", 0.001, 3.1)) made.add("horizontal_fov", *angle);
  if (Element* const clip = camera.section("clip")) {
    Fields fields(*clip, camera.owner() + ", <clip>", camera.messages());
    near = fields.number("near", 0.0001, 1000).value_or(near);
    far = fields.number("far", 0.001, 1e6).value_or(far);
    fields.list_unread("SDFormat has no such element there");
  }
  made.add("near", near);
  made.add("far", std::max(far, 1.001 * near));
  add_images(made, s.type);
  add_lens(made, camera);
  const Noise noise = take_noise(camera, "gaussian");
  if (noise.sigma > 0) made.add("noise", std::min(noise.sigma, 1.0));
  if (noise.mean != 0)
    camera.messages().left_out.add(Severity::warning, "<mean> of a camera's <noise>", "images have no bias",
                                   camera.messages().at(e));
  camera.skip({"save"}, "recorder.images writes pictures");
  camera.skip({"visibility_mask"}, "all is shown to all");
  camera.skip({"optical_frame_id", "camera_info_topic", "trigger_topic", "triggered"},
              "a scenario says who takes and sends images");
  camera.skip({"depth_camera"}, "depth is that along the axis, within `near` and `far`");
  camera.list_unread("cameras have no counterpart of it");
  return made;
}

}  // namespace

Subsystems read_cameras(SensorReading& s) {
  Subsystems all;
  const std::vector<Element*> cameras = s.fields.sections("camera");
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const std::string name = cameras.size() == 1 ? s.name : concat(s.name, "_", i);
    if (const auto made = read_camera(s, *cameras[i], name)) all.push_back(*made);
  }
  if (cameras.empty())
    s.fields.messages().problems.warning(s.location, s.fields.owner() + " is left out: it has no <camera>");
  return all;
}

}  // namespace muro::sdf_devices
