// SPDX-License-Identifier: MIT
#include "read.hpp"

#include "build.hpp"
#include "plugins/common/model_file/text_file.hpp"
#include "urdfdom_parse.hpp"

namespace muro::urdf {

namespace {

/// Checks the attributes of the <robot> element that urdfdom reads.
void check_robot(Element& robot, Problems& problems) {
  const Location location = location_of(robot);
  if (!robot.Attribute("name")) {
    problems.warning(location, "<robot> has no name; write <robot name=\"...\">");
    robot.SetAttribute("name", "robot");
  }
  const char* version = robot.Attribute("version");
  if (!version) return;
  if (std::string_view(version) != "1.0")
    problems.warning(location, concat("the file is of URDF version ", quote(version), " and is read as version 1.0"));
  robot.DeleteAttribute("version");
}

}  // namespace

void read_text(std::string bytes, const std::filesystem::path& folder, RobotBuilder& builder,
               const model_file::Packages& packages) {
  Problems problems = Problems::reported_to(builder);
  const auto [error, warning] = model_file::decode(bytes, "URDF", "robot");
  if (!warning.text.empty()) problems.warning(warning.location, warning.text);
  if (!error.text.empty()) return problems.error(error.location, error.text);
  Document document;
  if (!document.parse(std::move(bytes), problems)) return;
  Element& robot = document.robot();
  if (!take_macros(robot, problems)) return;

  // urdfdom stops at the first mistake or ignores it, and reports no lines. So the checks run before it, report all
  // mistakes, and leave a document that urdfdom accepts.
  ModelInfo info;
  check_robot(robot, problems);
  check_materials(robot, problems);
  check_links(robot, info, problems);
  check_joints(robot, info, problems);
  take_rotors(robot, info, problems);
  take_surfaces(robot, info, problems);
  take_gazebo(robot, info, problems);
  remove_others(robot);
  check_tree(robot, info, problems);
  check_mimics(info, problems);
  if (problems.found_error()) return;

  const auto model = parse_with_urdfdom(document.printed(), problems);
  if (model && !problems.found_error()) build(*model, info, {folder, packages}, builder, problems);
}

void read_file(const std::string& path, RobotBuilder& builder, const model_file::Packages& packages) {
  read_text(model_file::load_file(path, ".urdf"), std::filesystem::absolute(path).parent_path(), builder, packages);
}

}  // namespace muro::urdf
