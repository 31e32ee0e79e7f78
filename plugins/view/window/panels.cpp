// SPDX-License-Identifier: MIT
#include "panels.hpp"

#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "property_scalars.hpp"

namespace muro::view {

namespace {

constexpr float margin = 8, bar_height = 62, side_width = 250, right_width = 380, cost_height = 190;

void place(float x, float y, float width, float height) {
  ImGui::SetNextWindowPos({x, y});
  ImGui::SetNextWindowSize({width, height});
}

constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse;

void text(std::string_view s) { ImGui::TextUnformatted(s.data(), s.data() + s.size()); }

}  // namespace

void Panels::connect(Connector& c) {
  for (const RobotView* robot : c.robots()) groups_.push_back({std::string(robot->name), {}});
  groups_.push_back({"scenery", {}});
  for (std::uint32_t i = 0; i < c.object_count(); ++i) {
    const RobotId robot = c.robot_of(ObjectId(i));
    groups_[robot != no_robot ? index_of(robot) : groups_.size() - 1].objects.push_back(ObjectId(i));
  }
}

void Panels::draw(Inspection& simulation, Pace& pace, OrbitCamera& camera, Overlay& overlay, double simulated,
                  double wall) {
  draw_controls(pace, camera, overlay, simulated, wall);
  draw_tree(simulation);
  draw_costs(simulation, simulated);
  if (selected != no_object) draw_properties(simulation);
}

void Panels::press(Key key, Pace& pace, OrbitCamera& camera) {
  if (ImGui::GetIO().WantTextInput) return;
  switch (key) {
    case Key::space:
      return pace.set_paused(!pace.paused());
    case Key::right:
      return pace.step();
    case Key::escape:
      selected = no_object;
      camera.mode = OrbitCamera::Mode::orbit;
      return;
    case Key::home:
      show_all_requested = true;
  }
}

std::array<double, 4> Panels::free_area(double width, double height) const {
  const double right = selected == no_object ? 0 : right_width + margin;
  return {side_width + margin, bar_height + margin, width - right, height - cost_height - margin};
}

void Panels::draw_controls(Pace& pace, OrbitCamera& camera, Overlay& overlay, double simulated, double wall) {
  if (wall - last_wall_ > 0.5) {
    factor_ = (simulated - last_simulated_) / (wall - last_wall_);
    last_simulated_ = simulated;
    last_wall_ = wall;
  }
  place(margin, margin, ImGui::GetIO().DisplaySize.x - 2 * margin, bar_height);
  ImGui::Begin("run", nullptr, fixed | ImGuiWindowFlags_NoTitleBar);
  if (ImGui::Button(pace.paused() ? "Play" : "Pause", {70, 0})) pace.set_paused(!pace.paused());
  ImGui::SameLine();
  if (ImGui::Button("Step", {60, 0})) pace.step();
  ImGui::SameLine();
  const double speeds[] = {0.1, 0.25, 0.5, 1, 2, 5, 10, 0};
  const char* const names[] = {"0.1 x", "0.25 x", "0.5 x", "1 x", "2 x", "5 x", "10 x", "as fast as it can"};
  const auto* const now = std::find(std::begin(speeds), std::end(speeds), pace.speed());
  char own[32];
  std::snprintf(own, sizeof own, "%g x", pace.speed());
  ImGui::SetNextItemWidth(150);
  if (ImGui::BeginCombo("speed", now != std::end(speeds) ? names[now - speeds] : own)) {
    for (std::size_t i = 0; i < std::size(speeds); ++i)
      if (ImGui::Selectable(names[i], speeds[i] == pace.speed())) pace.set_speed(speeds[i]);
    ImGui::EndCombo();
  }
  ImGui::SameLine();
  ImGui::Text("  t = %.3f s   %.2f x real time   %.0f frames/s", simulated, factor_, double(ImGui::GetIO().Framerate));

  int mode = int(camera.mode);
  const bool followed = selected != no_object;
  ImGui::RadioButton("orbit", &mode, 0);
  ImGui::SameLine();
  ImGui::RadioButton("follow", &mode, 1);
  ImGui::SameLine();
  ImGui::RadioButton("first person", &mode, 2);
  camera.mode = followed ? OrbitCamera::Mode(mode) : OrbitCamera::Mode::orbit;
  ImGui::SameLine();
  if (ImGui::Button("all")) show_all_requested = true;
  ImGui::SameLine(0, 30);
  ImGui::Checkbox("scans", &overlay.scans);
  ImGui::SameLine();
  ImGui::Checkbox("contacts", &overlay.contacts);
  ImGui::SameLine();
  ImGui::Checkbox("frames", &overlay.frames);
  if (!followed && mode != 0) {
    ImGui::SameLine();
    text("  select something first: click on it");
  }
  ImGui::End();
}

void Panels::draw_tree(Inspection& simulation) {
  const float top = bar_height + 2 * margin, height = ImGui::GetIO().DisplaySize.y - top - cost_height - 2 * margin;
  place(margin, top, side_width, height);
  ImGui::Begin("robots", nullptr, fixed);
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("##filter", "part of a name", filter_.data(), filter_.size());
  const std::string_view wanted(filter_.data());
  for (const Group& g : groups_) {
    const auto matches = [&](std::string_view name) { return name.find(wanted) != std::string_view::npos; };
    const bool any = matches(g.name) || std::any_of(g.objects.begin(), g.objects.end(), [&](ObjectId object) {
                       return matches(simulation.object_name(object));
                     });
    if (!any) continue;
    const bool holds = std::find(g.objects.begin(), g.objects.end(), selected) != g.objects.end();
    if (holds) ImGui::SetNextItemOpen(true, ImGuiCond_Once);
    if (!ImGui::TreeNodeEx(g.name.c_str(), holds ? ImGuiTreeNodeFlags_Selected : 0)) continue;
    for (const ObjectId object : g.objects) {
      std::string name(simulation.object_name(object));
      if (name.empty()) name = "world";
      if (!matches(name) && !matches(g.name)) continue;
      if (name.rfind(g.name + "/", 0) == 0) name.erase(0, g.name.size() + 1);
      ImGui::PushID(int(object));
      if (ImGui::Selectable(name.c_str(), object == selected)) selected = object;
      ImGui::PopID();
    }
    ImGui::TreePop();
  }
  ImGui::End();
}

void Panels::edit(Inspection& simulation, const LiveProperty& property) {
  const Scalars values(property);
  constexpr std::uint32_t most = 64;
  for (std::uint32_t i = 0; i < std::min(most, values.size()); ++i) {
    ImGui::PushID(int(i));
    double value = values.get(i);
    const std::string label = values.label(i);
    ImGui::SetNextItemWidth(130);
    const bool entered = ImGui::InputDouble(label.empty() ? "##value" : label.c_str(), &value, 0, 0, "%.9g",
                                            ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    ImGui::PopID();
    if (entered && property.is_variable) return edits.enter(simulation, selected, property, i, value);
  }
  if (values.size() > most) ImGui::Text("... %u in all", values.size());
}

void Panels::draw_properties(Inspection& simulation) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float top = bar_height + 2 * margin;
  place(size.x - right_width - margin, top, right_width, size.y - top - margin);
  ImGui::Begin(("properties of " + std::string(simulation.object_name(selected)) + "###properties").c_str(), nullptr,
               fixed);
  if (!edits.problem().empty()) ImGui::TextWrapped("%s", edits.problem().c_str());
  if (!ImGui::BeginTable("table", 2, ImGuiTableFlags_Resizable | ImGuiTableFlags_BordersInnerV)) return ImGui::End();
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed, 0.45F * right_width);
  for (const LiveProperty& p : simulation.properties(selected)) {
    const std::string name(p.key->name);
    ImGui::PushID(name.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const bool opened = ImGui::TreeNode("##open");
    ImGui::SameLine();
    if (p.is_variable)
      ImGui::TextColored({0.6F, 0.9F, 1, 1}, "%s", name.c_str());
    else
      text(name);
    if (ImGui::IsItemHovered()) {
      const std::string by = p.is_constant ? "constant" : "by " + std::string(p.written_by);
      ImGui::SetTooltip("%.*s\n%s%s", int(p.key->doc.size()), p.key->doc.data(), by.c_str(),
                        p.is_variable ? "; open it to edit" : "");
    }
    if (opened) {
      edit(simulation, p);
      ImGui::TreePop();
    }
    ImGui::TableNextColumn();
    const std::string value = summary_of(p, simulation), unit(p.key->unit);
    ImGui::Text("%s %s", value.c_str(), unit == "1" ? "" : unit.c_str());
    ImGui::PopID();
  }
  ImGui::EndTable();
  ImGui::End();
}

void Panels::draw_costs(Inspection& simulation, double simulated) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float width = selected == no_object ? size.x - 2 * margin : size.x - right_width - 3 * margin;
  place(margin, size.y - cost_height - margin, width, cost_height);
  ImGui::Begin("cost: ms of computing for each simulated second", nullptr, fixed);
  std::vector<LiveCost> costs(simulation.costs().begin(), simulation.costs().end());
  std::erase_if(costs, [](const LiveCost& c) { return c.runs_alone; });
  std::sort(costs.begin(), costs.end(), [](const LiveCost& a, const LiveCost& b) { return a.seconds > b.seconds; });
  const double most = costs.empty() ? 1 : std::max(costs.front().seconds, 1e-9);
  for (const LiveCost& c : costs) {
    char label[64];
    std::snprintf(label, sizeof label, "%.3f", simulated > 0 ? 1e3 * c.seconds / simulated : 0);
    ImGui::ProgressBar(float(c.seconds / most), {0.55F * width, 0}, label);
    ImGui::SameLine();
    text(c.name);
  }
  ImGui::End();
}

}  // namespace muro::view
