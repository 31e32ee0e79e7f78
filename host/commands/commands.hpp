// SPDX-License-Identifier: MIT
// The commands of the program `muro`. Each returns the exit code.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace muro::host {

/// What all commands that read a scenario share.
struct ScenarioOptions {
  std::string file;
  std::vector<std::string> overrides;
  std::vector<std::string> plugin_path;
  std::optional<std::uint64_t> seed;
  bool strict = false;  ///< what a motion cannot do for its robot is an error
};

struct RunOptions {
  ScenarioOptions scenario;
  std::optional<double> duration;  ///< s
  std::string speed;               ///< "max", "real" or a factor; empty: max, or with a view real
  std::string threads;             ///< a number, "all", or empty: as the scenario says
  std::string report;              ///< file, or empty
  std::string timeline;            ///< file, or empty
  bool profile = false;
  bool verify_access = false;
  bool view = false;  ///< with a window
};

struct CompareOptions {
  ScenarioOptions scenario;
  std::vector<std::string> vary;   ///< "rovers.motion=point,simplified"
  std::string reference;           ///< one of the levels; empty: the last
  std::optional<double> duration;  ///< s
  std::string picture;             ///< file (SVG), or empty
  std::string table;               ///< file (CSV), or empty
};

struct RenderOptions {
  ScenarioOptions scenario;
  double at = 0;              ///< s
  std::string camera;         ///< "rover/camera": what this one sees; empty: a view from outside
  std::vector<double> from;   ///< x, y, z (m); empty: so that all robots are seen
  std::vector<double> to;     ///< x, y, z (m); empty: the middle of the robots
  std::string shows = "rgb";  ///< of a robot's camera: "rgb", "depth" or "labels"
  double fov = 50;            ///< deg, horizontal, of a view from outside
  std::string size = "1280x720";
  std::string device = "auto";
  std::string out;              ///< file (PNG), or empty
  std::string video;            ///< file of a film from `at` on, or empty
  std::optional<double> until;  ///< s; empty: as long as the scenario runs
  double fps = 25;              ///< frames of the film in a simulated second
};

int run(const RunOptions& options);
int render(const RenderOptions& options);
int check(const ScenarioOptions& options);
int compare(const CompareOptions& options);
int describe(const ScenarioOptions& options, bool json);
enum class ListForm { plain, json, markdown };
int list_plugins(const std::vector<std::string>& plugin_path, ListForm form);
int plugin_info(const std::string& id, const std::vector<std::string>& plugin_path, bool json);

}  // namespace muro::host
