// SPDX-License-Identifier: MIT
// Parameters that all motions by multi-body engines share.
#pragma once

#include "plugins/motion/common/motion/forced_description.hpp"

namespace muro::multibody {

inline constexpr std::string_view joint_modes[] = {"auto", "velocity", "position", "effort", "passive"};
inline constexpr std::string_view base_modes[] = {"free", "fixed"};

// Parameters of each robot.
inline constexpr Parameter world_name = text("world", "", "robots that name the same world share it and meet in it");
inline constexpr Parameter base_mode =
    text("base", "free", "whether the base is fixed to the world").one_of(base_modes);
inline constexpr Parameter joint_mode =
    text("joints", "auto",
         "what joints follow that no list below names; auto: what an algorithm writes, position or velocity; a joint "
         "that none commands turns freely, beside others that are commanded")
        .one_of(joint_modes);
inline constexpr Parameter self_collision =
    boolean("self_collision", false, "whether links of the robot touch each other, but neighbours");

// Parameters of a world: equal for all of its robots.
inline constexpr Parameter mimic_gain =
    real("mimic_gain", "1/s", 100,
         "speed of a mimic joint beyond that of its leader by its distance to where it belongs")
        .between(1e-3, 1e6);
inline constexpr Parameter substeps =
    integer("substeps", 1, "steps of the engine in each step of the motion").between(1, 1000);

// Parameters of worlds whose engines support them.
inline constexpr std::string_view mesh_modes[] = {"convex", "exact"};
inline constexpr Parameter scenery_meshes =
    text("meshes", "convex", "meshes of scenery collide as their convex hulls or as they are").one_of(mesh_modes);
inline constexpr Parameter correcting_speed =
    real("correcting_speed", "m/s", 1, "bodies that overlap are parted no faster").between(0, 1e9);
inline constexpr Parameter bounce_speed =
    real("bounce_speed", "m/s", 0.02, "impacts slower than this do not rebound").between(0, 1e9);

inline constexpr std::string_view attitudes[] = {"engine", "exact"};
inline constexpr Parameter attitude =
    text("attitude", "engine", "who turns robots of one body: the engine, or the solution of Euler's equations")
        .one_of(attitudes);

/// Parameters of all engines, in the order in which they are shown.
inline constexpr Parameter parameters_of_robots[] = {world_name, base_mode, joint_mode, self_collision};
inline constexpr Parameter parameters_of_worlds[] = {mimic_gain, substeps};
inline constexpr auto common_parameters =
    joined(parameters_of_robots, drive_parameters, watch_parameters, parameters_of_worlds);

/// Whether robots of one world may have different values of this parameter.
inline bool is_of_robot(std::string_view parameter) {
  for (const Parameter& p : joined(parameters_of_robots, drive_parameters, watch_parameters))
    if (p.name == parameter) return true;
  return false;
}

}  // namespace muro::multibody
