// SPDX-License-Identifier: MIT
#include "tests/bench/baselines/scanners.hpp"
#include "tests/bench/baselines/team.hpp"

namespace muro::bench {

std::vector<Engine> baselines() {
  std::vector<Engine> all;
#ifdef MURO_BENCH_BULLET
  all.push_back({"Bullet, raycast vehicle", true, &bullet_raycast_vehicles});
#endif
#ifdef MURO_BENCH_ODE
  for (const int iterations : {4, 10})
    all.push_back({"ODE, one body, " + std::to_string(iterations) + " iterations",
                   true,
                   &ode_one_body_vehicles,
                   {.iterations = iterations}});
  for (const int iterations : {4, 10})
    all.push_back({"ODE, articulated, " + std::to_string(iterations) + " iterations",
                   false,
                   &ode_articulated_vehicles,
                   {.iterations = iterations}});
#endif
#ifdef MURO_BENCH_BULLET
  all.push_back({"Bullet, rigid bodies", false, &bullet_rigid_vehicles});
#endif
#ifdef MURO_BENCH_MUJOCO
  all.push_back({"MuJoCo", false, &mujoco_vehicles});
#endif
  return all;
}

std::vector<RayEngine> ray_baselines() {
  std::vector<RayEngine> all;
#ifdef MURO_BENCH_EMBREE
  for (const int width : {1, 8, 16})
    all.push_back(
        {"rtcIntersect" + std::to_string(width), true,
         [width](const City& c, const Pattern& p, double range) { return embree_scanners(c, p, range, width); }});
#endif
#ifdef MURO_BENCH_BULLET
  all.push_back({"Bullet", false, &bullet_scanners, 2e6});
#endif
  return all;
}

}  // namespace muro::bench
