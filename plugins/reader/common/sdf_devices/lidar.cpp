// SPDX-License-Identifier: MIT
#include <cmath>

#include "noise.hpp"
#include "sensor.hpp"

namespace muro::sdf_devices {

namespace {

constexpr double most_rays = 1e6, most_rows = 4096, most_in_all = 1e7, farthest = 1e6;

/// The rays of a scan in one direction.
struct Sweep {
  long samples = 1;
  double min_angle = 0, max_angle = 0;  ///< rad
};

Sweep take_sweep(Fields& scan, const char* name, double most_samples, double most_angle) {
  Sweep sweep;
  Element* const e = scan.section(name);
  if (!e) return sweep;
  Fields fields(*e, scan.owner() + ", <" + name + ">", scan.messages());
  const double samples = fields.number("samples", 1, most_samples).value_or(1);
  const double resolution = fields.number("resolution", 1e-6, most_samples).value_or(1);
  sweep.samples = std::lround(std::clamp(samples * resolution, 1.0, most_samples));
  sweep.min_angle = fields.number("min_angle", -most_angle, most_angle).value_or(0);
  sweep.max_angle = fields.number("max_angle", -most_angle, most_angle).value_or(0);
  fields.list_unread("SDFormat has no such element there");
  return sweep;
}

}  // namespace

Subsystems read_lidar(SensorReading& s) {
  Element* device = nullptr;
  for (const char* const name : {"lidar", "ray", "laser"})
    if (!device) device = s.fields.section(name);
  if (!device) {
    s.fields.messages().problems.warning(
        s.location, s.fields.owner() + " is left out: it has no <ray> with a <scan> and a <range>");
    return {};
  }
  Fields fields(*device, s.fields.owner(), s.fields.messages());
  Subsystem made = s.begin(s.name, "laser.embree");
  if (Element* const e = fields.section("scan")) {
    Fields scan(*e, s.fields.owner(), s.fields.messages());
    Sweep across = take_sweep(scan, "horizontal", most_rays, 4 * M_PI);
    const Sweep up = take_sweep(scan, "vertical", most_rows, M_PI / 2);
    scan.list_unread("SDFormat has no such element there");
    if (double(across.samples) * double(up.samples) > most_in_all) {
      s.fields.messages().problems.warning(
          s.location, concat(s.fields.owner(), " is left out: a scan has ", across.samples, " x ", up.samples,
                             " rays; at most ", most_in_all, " are possible"));
      return {};
    }
    if (across.max_angle - across.min_angle > 2 * M_PI) across.max_angle = across.min_angle + 2 * M_PI;  // one turn
    made.add("rays", double(across.samples));
    made.add("min_angle", across.min_angle);
    made.add("max_angle", across.max_angle);
    if (up.samples > 1) made.add("rows", double(up.samples));
    if (up.min_angle != 0) made.add("min_elevation", up.min_angle);
    if (up.max_angle != 0) made.add("max_elevation", up.max_angle);
  }
  Noise noise = take_noise(fields, "gaussian");
  if (Element* const e = fields.section("range")) {
    Fields range(*e, s.fields.owner() + ", <range>", s.fields.messages());
    const double near = range.number("min", 0, farthest).value_or(0);
    const std::string far_text = e->FirstChildElement("max") ? text_of(*e->FirstChildElement("max")) : "";
    const bool endless = far_text.find("nf") != far_text.npos || far_text.find("NF") != far_text.npos;
    const double far = endless ? (range.text("max"), farthest) : range.number("max", 1e-6, farthest).value_or(10);
    if (near > 0) made.add("min_range", std::min(near, far));
    made.add("max_range", far);
    noise.precision = range.number("resolution", 0, farthest).value_or(0);
    range.list_unread("SDFormat has no such element there");
  }
  fields.skip({"visibility_mask"}, "all is shown to all");
  fields.list_unread("the scanner has no counterpart of it");
  Subsystems all{made};
  for (Subsystem& e : error_of(made, "_error", "ranges", {noise})) all.push_back(std::move(e));
  return all;
}

}  // namespace muro::sdf_devices
