// SPDX-License-Identifier: MIT
// Panels beside the scene, and the actions of their buttons.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "edits.hpp"
#include "muro/ext/inspection.hpp"
#include "orbit_camera.hpp"
#include "overlay.hpp"
#include "pace.hpp"
#include "screen.hpp"

namespace muro::view {

class Panels {
 public:
  ObjectId selected = no_object;
  bool show_all_requested = false;  ///< the user wants all robots in view
  Edits edits;

  /// Remembers the tree of robots. [setup]
  void connect(Connector& c);
  /// Begins anew after a jump of simulated time.
  void begin_anew() { last_wall_ = last_simulated_ = 0; }
  /// Draws all panels and carries out what buttons and keys ask for. `simulated`, `wall`: s.
  void draw(Inspection& simulation, Pace& pace, OrbitCamera& camera, Overlay& overlay, double simulated, double wall);
  void press(Key key, Pace& pace, OrbitCamera& camera);
  /// Returns the area that panels do not cover: left, top, right, bottom, in pixels.
  std::array<double, 4> free_area(double width, double height) const;

 private:
  struct Group {
    std::string name;
    std::vector<ObjectId> objects;
  };

  void draw_controls(Pace& pace, OrbitCamera& camera, Overlay& overlay, double simulated, double wall);
  void draw_tree(Inspection& simulation);
  void draw_properties(Inspection& simulation);
  void draw_costs(Inspection& simulation, double simulated);
  void edit(Inspection& simulation, const LiveProperty& property);

  std::vector<Group> groups_;
  std::array<char, 64> filter_{};
  double last_simulated_ = 0, last_wall_ = 0, factor_ = 0;
};

}  // namespace muro::view
