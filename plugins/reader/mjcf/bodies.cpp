// SPDX-License-Identifier: MIT
#include "bodies.hpp"

#include <algorithm>
#include <cctype>

namespace muro::mjcf {

std::string Names::unique(std::string_view wanted, std::string_view suffix) {
  std::string name(wanted);
  for (char& c : name)
    if (c == '/' || c == ':' || std::isspace(static_cast<unsigned char>(c)) != 0) c = '_';
  while (!taken_.insert(name).second) name += suffix;
  return name;
}

std::vector<int> top_bodies(const mjModel& m) {
  std::vector<int> found;
  for (int b = 1; b < m.nbody; ++b)
    if (m.body_parentid[b] == 0) found.push_back(b);
  return found;
}

std::vector<int> subtree(const mjModel& m, int top) {
  std::vector<int> found;
  for (int b = top; b < m.nbody && m.body_rootid[b] == m.body_rootid[top]; ++b) found.push_back(b);
  return found;
}

bool can_move(const mjModel& m, int top) {
  const std::vector<int> bodies = subtree(m, top);
  return std::any_of(bodies.begin(), bodies.end(), [&m](int b) { return m.body_jntnum[b] > 0; });
}

bool is_free(const mjModel& m, int body) {
  return m.body_jntnum[body] == 1 && m.jnt_type[m.body_jntadr[body]] == mjJNT_FREE;
}

Pose pose_in_world(const mjModel& m, int body) {
  Pose pose;
  for (int b = body; b > 0; b = m.body_parentid[b]) pose = pose_of(m.body_pos + 3 * b, m.body_quat + 4 * b) * pose;
  return pose;
}

std::string body_name(const mjModel& m, int body) {
  const std::string name = name_of(m, m.name_bodyadr, body);
  return name.empty() ? "body_" + std::to_string(body) : name;
}

std::string joint_name(const mjModel& m, int joint) {
  const std::string name = name_of(m, m.name_jntadr, joint);
  return name.empty() ? body_name(m, m.jnt_bodyid[joint]) + "_joint" : name;
}

}  // namespace muro::mjcf
