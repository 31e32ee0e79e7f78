// SPDX-License-Identifier: MIT
#include "model.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <tuple>

namespace muro::scip2 {

std::int32_t Model::last_measurement_point() const {
  return std::max(last_step, std::min(2 * front_step, steps_per_turn - 1));
}

double Model::angle_of(std::int32_t step) const {
  return double(step - front_step) * (2 * std::numbers::pi / steps_per_turn);
}

std::int64_t Model::scan_period(std::int32_t percent_slower) const {
  return std::int64_t(60e9 * 100) / (std::int64_t(scan_rpm) * (100 - percent_slower));
}

Model urg_04lx() {
  Model m;
  m.name = "URG-04LX(Hokuyo Automatic Co.,Ltd.)";
  m.product = "SOKUIKI Sensor URG-04LX";
  m.firmware = "3.1.04(02/Aug./2007)";
  m.firmware_of_scip1 = "3.1.04,07/08/02";
  m.serial = "H0706400";
  return m;
}

Model utm_30lx() {
  Model m;
  m.name = "UTM-30LX(Hokuyo Automatic Co.,Ltd.)";
  m.product = "SOKUIKI Sensor TOP-URG UTM-30LX";
  m.firmware = "1.18.01(09/Jul./2010)";
  m.serial = "H1000484";
  m.min_distance = 23;
  m.max_distance = 60000;
  m.steps_per_turn = 1440;
  m.first_step = 0;
  m.last_step = 1080;
  m.front_step = 540;
  m.scan_rpm = 2400;
  m.start = Start::scip2;
  m.reply_time = ReplyTime::at_once;
  m.no_return_code = 1;
  m.too_near_code = 2;
  m.marks_edges = false;
  m.bit_rate_text = "USB Full Speed";
  m.has_motor_speed = false;
  m.has_high_sensitivity = true;
  m.has_malfunctions = true;
  m.has_restarts = true;
  return m;
}

Model ust_10lx() {
  Model m = utm_30lx();
  m.name = "UST-10LX";
  m.product = "UST-10LX";
  m.firmware = "1.0.0(01/Jan./2014)";
  m.serial = "H1400001";
  m.min_distance = 20;
  m.max_distance = 30000;
  m.no_return_code = 65533;
  m.bit_rate_text = "Ethernet 100[Mbps]";
  m.status_text = "sensor is working normally";
  m.has_bit_rate = false;
  m.has_high_sensitivity = m.has_malfunctions = false;
  m.has_states = true;
  return m;
}

Model model_of(std::string_view name) {
  return name == "utm-30lx" ? utm_30lx() : name == "ust-10lx" ? ust_10lx() : urg_04lx();
}

void apply_firmware(Model& urg) {
  int a = 0, b = 0, c = 0;
  std::sscanf(urg.firmware.c_str(), "%d.%d.%d", &a, &b, &c);
  const bool is_new = std::tuple(a, b, c) >= std::tuple(3, 3, 0);
  urg.has_high_sensitivity = urg.has_malfunctions = is_new;
}

}  // namespace muro::scip2
