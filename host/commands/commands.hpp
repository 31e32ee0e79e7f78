// SPDX-License-Identifier: MIT
// The commands of the program `muro`. Each returns the exit code.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace muro::host {

/// Options of all commands that read a scenario.
struct ScenarioOptions {
  std::string file;
  std::vector<std::string> overrides;
  std::vector<std::string> plugin_path;
  std::optional<std::uint64_t> seed;
  bool strict = false;  ///< unsupported features of motions are errors
};

struct RunOptions {
  ScenarioOptions scenario;
  std::optional<double> duration;  ///< s
  bool include_end = false;        ///< also run what is due at the end
  std::string speed;               ///< "max", "real" or a factor; empty: max, or real with a view
  std::string threads;             ///< a number, "all", or empty: as the scenario says
  std::string report;              ///< file, or empty
  std::string timeline;            ///< file, or empty
  std::string record;              ///< file for all inputs from outside, or empty
  std::string replay;              ///< recording that replaces the inputs from outside, or empty
  double step_timeout = 0;         ///< s of wall-clock time after which a step counts as hanging; 0: never
  bool profile = false;
  bool verify_access = false;
  bool view = false;  ///< show a window
};

struct CheckOptions {
  ScenarioOptions scenario;
  bool levels = false;  ///< also the effect of every motion on the robots
  bool full = false;    ///< everything, even when it is longer than a screen
};

struct CompareOptions {
  ScenarioOptions scenario;
  std::vector<std::string> vary;     ///< "rovers.motion=point,simplified"
  std::string reference;             ///< one of the variations; empty: the last
  std::optional<double> duration;    ///< s
  std::string picture;               ///< file (SVG), or empty
  std::string table;                 ///< file (CSV), or empty
  std::vector<std::string> against;  ///< records of a real joint or laser, to compare with; may be empty
  std::string joint;                 ///< "robot/joint" of the records; empty: the only one
  std::string sensor;                ///< "robot/laser" of the records; empty: the only one
  bool known_map = false;            ///< the scene is the room in which the laser was recorded
};

struct IdentifyOptions {
  std::vector<std::string> records;
  std::string model = "m4";
  std::vector<std::string> fit;       ///< also searched for: "gain", "delay", "temperature"
  std::vector<std::string> validate;  ///< records that are left out, or one number: the part of them that is
  bool cross_validate = false;        ///< fit again without each P gain in turn
  std::optional<double> duty_gain, duty_limit;
  std::optional<double> p_gain, supply_voltage, mass, length, arm_mass, inertia;  ///< for all records
  std::uint64_t seed = 1;
  unsigned threads = 0;              ///< 0: all
  std::vector<std::string> reports;  ///< files: Markdown or JSON
  std::string plot;                  ///< file (SVG), or empty
  std::string fragment;              ///< file (YAML), or empty
};

struct RenderOptions {
  ScenarioOptions scenario;
  double at = 0;              ///< s
  std::string camera;         ///< camera of a robot: "rover/camera"; empty: a free camera
  std::vector<double> from;   ///< x, y, z (m); empty: a place that shows all robots
  std::vector<double> to;     ///< x, y, z (m); empty: the middle of the robots
  std::string shows = "rgb";  ///< for a robot's camera: "rgb", "depth" or "labels"
  double fov = 50;            ///< deg, horizontal, of the free camera
  std::string size = "1280x720";
  std::string device = "auto";
  std::string out;              ///< file (PNG), or empty
  std::string video;            ///< file of a video from `at` on, or empty
  std::optional<double> until;  ///< s; empty: to the end of the scenario
  double fps = 25;              ///< frames of the video per simulated second
};

struct AllanOptions {
  ScenarioOptions scenario;
  std::string sensor;              ///< "rover/imu", or "imu" when only one robot has it
  std::string reading;             ///< "angular_velocity"; empty: all readings that have errors
  std::optional<double> duration;  ///< s
  std::string picture;             ///< file (SVG), or empty
};

int run(const RunOptions& options);
int render(const RenderOptions& options);
int check(const CheckOptions& options);
int compare(const CompareOptions& options);
int identify(const IdentifyOptions& options);
int allan(const AllanOptions& options);
int describe(const ScenarioOptions& options, bool json);
enum class Format { plain, json, markdown };
int list_plugins(const std::vector<std::string>& plugin_path, Format format);
int list_properties(const std::vector<std::string>& plugin_path, Format format);
int plugin_info(const std::string& id, const std::vector<std::string>& plugin_path, bool json);

}  // namespace muro::host
