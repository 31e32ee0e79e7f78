// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace muro::scip2 {

/// Protocol of a device after power-on.
enum class Start : std::uint8_t {
  scip1,   ///< only SCIP 1.1, until `SCIP2.0`
  scip2,   ///< SCIP 2.0; 1.1 does not exist
  either,  ///< both, until `SCIP2.0`
};

/// Times at which requests are answered.
enum class ReplyTime : std::uint8_t {
  at_once,
  with_scans,   ///< when the mirror passes step 0
  at_interval,  ///< at multiples of an interval since power-on
};

/// The properties of a device in the family: the entries of VV and PP, and its capabilities.
struct Model {
  std::string name;      ///< MODL: "URG-04LX(Hokuyo Automatic Co.,Ltd.)"
  std::string product;   ///< PROD
  std::string firmware;  ///< FIRM: "3.1.04(02/Aug./2007)"
  std::string serial;    ///< SERI
  std::string vendor = "Hokuyo Automatic Co.,Ltd.";
  std::string firmware_of_scip1;  ///< in the form of SCIP 1.1, without the measures in parentheses: "3.1.04,07/08/02"

  std::int32_t min_distance = 20;      ///< DMIN, mm
  std::int32_t max_distance = 5600;    ///< DMAX, mm
  std::int32_t steps_per_turn = 1024;  ///< ARES
  std::int32_t first_step = 44;        ///< AMIN
  std::int32_t last_step = 725;        ///< AMAX
  std::int32_t front_step = 384;       ///< AFRT
  std::int32_t scan_rpm = 600;         ///< SCAN

  Start start = Start::either;
  ReplyTime reply_time = ReplyTime::with_scans;
  std::int64_t reply_interval = 0;  ///< for ReplyTime::at_interval, ns

  std::uint32_t no_return_code = 0;  ///< reading of a step without return
  std::uint32_t too_near_code = 19;  ///< reading of a step with an object nearer than DMIN
  bool marks_edges = true;           ///< edge_code for the first and last step of a long run without return

  std::string bit_rate_text;  ///< SBPS of II; empty: the bit rate set by SS
  std::string status_text = "Sensor works well.";
  bool has_bit_rate = true;           ///< SS; if not: 04
  bool has_motor_speed = true;        ///< CR; if not: 04
  bool has_high_sensitivity = false;  ///< HS
  bool has_malfunctions = false;      ///< DB
  bool has_intensity = true;          ///< ME, GE
  bool has_multiecho = false;         ///< ND, NE, HD, HE
  bool has_restarts = false;          ///< RT and RB
  bool has_states = false;            ///< %ST and %SL

  std::uint32_t step_count() const { return std::uint32_t(last_step - first_step + 1); }
  /// Returns the last step that may be requested, as far from the front as step 0. Steps after AMAX have no readings.
  std::int32_t last_measurement_point() const;
  double angle_of(std::int32_t step) const;  ///< rad, counter-clockwise from the front
  /// Returns the time of a turn at `percent_slower` than SCAN, ns.
  std::int64_t scan_period(std::int32_t percent_slower = 0) const;
};

/// Code of a step at the edge of a run of steps without return.
inline constexpr std::uint32_t edge_code = 7;

Model urg_04lx();  ///< firmware 3.1.04
Model utm_30lx();
Model ust_10lx();
/// Returns the model of a name: "urg-04lx", "utm-30lx" or "ust-10lx".
Model model_of(std::string_view name);
/// Sets the commands that a firmware version of a URG-04LX has: HS and DB exist since 3.3.00.
void apply_firmware(Model& urg);

}  // namespace muro::scip2
