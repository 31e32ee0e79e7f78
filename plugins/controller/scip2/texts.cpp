// SPDX-License-Identifier: MIT
// The texts of VV, PP, II, and of V in SCIP 1.1.
#include <cmath>
#include <cstdio>

#include "device.hpp"
#include "fault.hpp"

namespace muro::scip2 {

namespace {

/// A short text without heap memory.
struct Text {
  char characters[96];
  template <class... Values>
  explicit Text(const char* format, Values... values) {
    std::snprintf(characters, sizeof characters, format, values...);
  }
  operator std::string_view() const { return characters; }
};

}  // namespace

void Device::write_version(ReplyWriter& r) const {
  r.keyed("VEND", model_.vendor);
  r.keyed("PROD", model_.product);
  r.keyed("FIRM", model_.firmware);
  r.keyed("PROT", "SCIP 2.0");
  r.keyed("SERI", model_.serial);
}

void Device::write_parameters(ReplyWriter& r) const {
  r.keyed("MODL", model_.name);
  r.keyed("DMIN", Text("%d", model_.min_distance));
  r.keyed("DMAX", Text("%d", model_.max_distance));
  r.keyed("ARES", Text("%d", model_.steps_per_turn));
  r.keyed("AMIN", Text("%d", model_.first_step));
  r.keyed("AMAX", Text("%d", model_.last_step));
  r.keyed("AFRT", Text("%d", model_.front_step));
  r.keyed("SCAN", Text("%d", model_.scan_rpm));
}

void Device::write_status(ReplyWriter& r, const State& s, std::int64_t now) const {
  r.keyed("MODL", model_.name);
  r.keyed("LASR", s.has_laser_on ? "ON" : "OFF");
  if (s.percent_slower == 0)
    r.keyed("SCSP", Text("Initial(%d[rpm])<-Default setting by user", model_.scan_rpm));
  else
    r.keyed("SCSP", Text("%02d%%Down(%d[rpm])", s.percent_slower, model_.scan_rpm * (100 - s.percent_slower) / 100));
  r.keyed("MESM", !s.has_laser_on ? "IDLE" : s.is_sensitive ? "Measuring by Sensitive Mode" : "CLASSIC");
  if (!model_.bit_rate_text.empty())
    r.keyed("SBPS", model_.bit_rate_text);
  else
    r.keyed("SBPS",
            Text(bit_rate_of(s) == first_bit_rate() ? "%u[bps]<-Default setting by user" : "%u[bps]", bit_rate_of(s)));
  r.keyed("TIME", Text("%06X", timestamp(s, now)));
  const bool has_failed = health_of(s.fault, s.fault_scans) == Health::failed;
  r.keyed("STAT", has_failed ? "Laser has trouble." : std::string_view(model_.status_text));
}

void Device::write_version_of_scip1(ReplyWriter& r) const {
  const int degrees = int(std::lround(360.0 * (model_.last_step - model_.first_step + 1) / model_.steps_per_turn));
  const int greatest = int(ReplyWriter::greatest(2));
  r.plain(Text("VEND:%s", model_.vendor.c_str()));
  r.plain(Text("PROD:%s", model_.product.c_str()));
  r.plain(Text("FIRM:%s(%d-%d[mm],%d[deg],%d-%d[step],%d[rpm])", model_.firmware_of_scip1.c_str(), model_.min_distance,
               model_.max_distance < greatest ? model_.max_distance : greatest, degrees, model_.first_step,
               model_.last_step, model_.scan_rpm));
  r.plain("PROT:00003,(SCIP 1.0)");
  r.plain(Text("SERI:%s", model_.serial.c_str()));
  r.plain(Text("STAT:%s", model_.status_text.c_str()));
}

}  // namespace muro::scip2
