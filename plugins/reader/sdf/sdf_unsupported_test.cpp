// SPDX-License-Identifier: MIT
// Every unread element of a file is reported.
#include <gtest/gtest.h>

#include <tinyxml2.h>

#include <filesystem>
#include <set>

#include "reading_testing.hpp"
#include "schema.hpp"

namespace muro::sdf {
namespace {

/// Returns the reports on an element in a section of a file, from line 4 on.
Lines reports_of(const std::string& section, const std::string& element) {
  const std::string shape = "<geometry><sphere><radius>1</radius></sphere></geometry>";
  const auto in_link = [&](const std::string& more) {
    return model("<link name='a'>\n" + more + inertial() + "</link>");
  };
  const auto in_collision = [&](const std::string& more) {
    return in_link("<collision name='c'>" + more + shape + "</collision>");
  };
  const auto in_joint = [&](const std::string& more) {
    return model(link("a") + link("b") + "<joint name='j' type='revolute'><parent>a</parent><child>b</child>\n" + more +
                 "</joint>");
  };
  std::string file;
  if (section == "sdf")
    file = "<sdf version='1.9'>\n\n\n" + element + "<model name='m'>" + link("a") + "</model></sdf>";
  if (section == "model") file = model(link("a") + "\n" + element);
  if (section == "link") file = in_link(element);
  if (section == "inertial") {
    std::string with = inertial();
    with.insert(with.find("<inertia>"), element);
    file = model("<link name='a'>\n" + with + "</link>");
  }
  if (section == "collision") file = in_collision(element);
  if (section == "visual") file = in_link("<visual name='v'>" + element + shape + "</visual>");
  if (section == "geometry")
    file = in_link("<collision name='c'><geometry>" + element +
                   "<sphere><radius>1</radius></sphere></geometry></collision>");
  if (section == "mesh") return {};  // tested below: it needs a file
  if (section == "surface") file = in_collision("<surface>" + element + "</surface>");
  if (section == "bounce" || section == "friction" || section == "contact")
    file = in_collision("<surface><" + section + ">" + element + "</" + section + "></surface>");
  if (section == "ode friction")
    file = in_collision("<surface><friction><ode>" + element + "</ode></friction></surface>");
  if (section == "torsional")
    file = in_collision("<surface><friction><torsional>" + element + "</torsional></friction></surface>");
  if (section == "bullet friction")
    file = in_collision("<surface><friction><bullet>" + element + "</bullet></friction></surface>");
  if (section == "material")
    file = in_link("<visual name='v'><material>" + element + "</material>" + shape + "</visual>");
  if (section == "metal" || section == "specular")
    file = in_link("<visual name='v'><material><pbr><" + section + ">" + element + "</" + section +
                   "></pbr></material>" + shape + "</visual>");
  if (section == "joint") file = in_joint(element + axis("0 0 1"));
  if (section == "axis") file = in_joint(axis("0 0 1", element));
  if (section == "limit") file = in_joint(axis("0 0 1", "<limit>" + element + "</limit>"));
  if (section == "world" || section == "include") {
    file = "<sdf version='1.9'><world name='w'>\n\n\n" + element + "</world></sdf>";
    WorldModel world;
    read_world_text(file, "/nowhere", world);
    return lines_of(world.problems());
  }
  return robot_of(file).problems;
}

TEST(SdfUnsupported, ElementsAreReportedWithLineAndReason) {
  int count = 0;
  for (const SchemaElement& e : schema()) {
    if (e.type != ValueType::unsupported || e.parent == "mesh" || e.parent == "include" || e.parent == "heightmap" ||
        e.parent == "texture")
      continue;
    const std::string name(e.name), section(e.parent);
    const Lines lines = reports_of(section, "<" + name + " name='n' type='t'>7<deep/></" + name + ">");
    ASSERT_EQ(lines.size(), 1u) << name << " in " << section << "\n" << testing::PrintToString(lines);
    const std::string parent = section.substr(0, section.find(' ') == section.npos ? section.npos : section.find(' '));
    const std::string severity = e.severity == Severity::note ? "note" : "warning";
    EXPECT_TRUE(lines[0].starts_with(severity + " 4:")) << lines[0];
    EXPECT_NE(lines[0].find("<" + name + "> in <" + parent + "> is left out: " + std::string(e.reason)),
              std::string::npos)
        << lines[0];
    ++count;
  }
  EXPECT_GT(count, 80);
}

TEST(SdfUnsupported, ElementsWithTheSupportedValueAreNotReported) {
  for (const SchemaElement& e : schema()) {
    if (e.type != ValueType::unsupported || e.supported_value.empty() || e.parent == "heightmap") continue;
    const std::string name(e.name);
    EXPECT_EQ(reports_of(std::string(e.parent), "<" + name + ">" + std::string(e.supported_value) + "</" + name + ">"),
              Lines{})
        << name;
  }
  EXPECT_EQ(reports_of("link", "<self_collide>0</self_collide><gravity>1</gravity>"), Lines{});
}

/// Compares muro's schema with the one that is installed with libsdformat.
TEST(SdfUnsupported, ElementsOfTheInstalledSchemaAreAllKnown) {
  namespace fs = std::filesystem;
  const std::string root = "/usr/share/sdformat12";
  if (!fs::exists(root)) return;
  const std::map<std::string, std::string> files = {
      {"sdf", "root.sdf"},          {"world", "world.sdf"},         {"model", "model.sdf"},
      {"link", "link.sdf"},         {"collision", "collision.sdf"}, {"visual", "visual.sdf"},
      {"joint", "joint.sdf"},       {"geometry", "geometry.sdf"},   {"material", "material.sdf"},
      {"inertial", "inertial.sdf"}, {"surface", "surface.sdf"}};
  for (const char* version : {"1.4", "1.5", "1.6", "1.7", "1.8", "1.9"})
    for (const auto& entry : files) {
      const std::string &section = entry.first, file = root + "/" + version + "/" + entry.second;
      tinyxml2::XMLDocument schema;
      if (schema.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) continue;
      const auto check = [&](const char* name) {
        EXPECT_NE(find_in_schema(section, name), nullptr)
            << "<" << name << "> in <" << section << "> of SDFormat " << version;
      };
      for (const auto* e = schema.RootElement()->FirstChildElement("element"); e; e = e->NextSiblingElement("element"))
        if (e->Attribute("name")) check(e->Attribute("name"));
      for (const auto* e = schema.RootElement()->FirstChildElement("include"); e;
           e = e->NextSiblingElement("include")) {
        std::string name = fs::path(e->Attribute("filename")).stem();
        if (name.ends_with("_shape")) name.resize(name.size() - 6);
        check(name.c_str());
      }
    }
}

TEST(SdfUnsupported, UnknownElementsAreReportedWithTheNearest) {
  EXPECT_EQ(reports_of("link", "<inertail/>"),
            Lines{"warning 4:1 <inertail> in <link> is left out: SDFormat has no such "
                  "element there (did you mean `inertial`?)"});
  EXPECT_EQ(reports_of("link", "<mine:thing/>"),
            Lines{"note 4:1 <mine:thing> in <link> is left out: it is meant for another program"});
  EXPECT_EQ(reports_of("link", "<pose><x/></pose>"),
            Lines{"warning 4:7 <x> in <pose> is left out: SDFormat has no such element there"});
}

TEST(SdfUnsupported, AttributesAreReportedUnlessForOtherPrograms) {
  EXPECT_EQ(reports_of("link", "<pose relativ_to='x' gz:y='1'>0 0 0 0 0 0</pose>"),
            Lines{"warning 4:1 <pose> has the attribute `relativ_to`, which is not read"});
}

TEST(SdfUnsupported, TheSameElementInManyLinesIsOneMessage) {
  std::string inside = "<link name='a'>" + inertial();
  for (int i = 0; i < 10; ++i) inside += "\n<battery name='b'/>";
  EXPECT_EQ(
      robot_of(model(inside + "</link>")).problems,
      Lines{
          "warning 4:1 <battery> in <link> is left out (also in lines 5, 6, 7, 8, 9, 10, 11 and 2 more): there are no "
          "batteries"});
}

TEST(SdfUnsupported, ASecondElementOfAKindIsReported) {
  EXPECT_EQ(reports_of("link", "<pose>0 0 0 0 0 0</pose>\n<pose>1 0 0 0 0 0</pose>"),
            Lines{"warning 5:1 a second <pose> in one <link> is left out"});
}

TEST(SdfUnsupported, ShapesLeaveTheirCollisionOut) {
  EXPECT_EQ(
      reports_of("link",
                 "<collision name='c'><geometry><ellipsoid><radii>1 1 2</radii></ellipsoid></geometry></collision>"),
      (Lines{"lost collision 4:1 <collision name=`c`> is left out, as it has no shape that is read",
             "warning 4:31 <ellipsoid> in <geometry> is left out: shapes are box, sphere, cylinder, capsule, plane, "
             "mesh, heightmap"}));
}

TEST(SdfUnsupported, AMissingMeshIsLeftOutAndToldOnce) {
  const std::string mesh = "<geometry><mesh><uri>gone.stl</uri></mesh></geometry>",
                    collision =
                        "<collision name='c'>" + mesh + "</collision>\n<collision name='d'>" + mesh + "</collision>",
                    visual = "<visual name='v'>" + mesh + "</visual>";
  const std::string looked = "; looked for /nowhere/gone.stl; correct its path";
  EXPECT_EQ(reports_of("link", collision),
            Lines{"lost collision 4:37 mesh `gone.stl` (also in line 5) is not found and left "
                  "out, so that nothing touches the links there" +
                  looked});
  EXPECT_EQ(reports_of("link", visual), Lines{"warning 4:34 mesh `gone.stl` is not found and left out" + looked});
}

TEST(SdfUnsupported, OfAMeshAllSubmeshesAreUsed) {
  const test::ScratchFolder folder;
  folder.file("m.dae", "");
  const Robot robot = robot_of(model(link("a",
                                          "<collision "
                                          "name='c'><geometry>\n<mesh><uri>m.dae</uri><submesh><name>x</name></"
                                          "submesh></mesh></geometry></collision>")),
                               folder.path(""));
  ASSERT_EQ(robot.problems.size(), 1u);
  EXPECT_TRUE(
      robot.problems[0].starts_with("warning 4:23 <submesh> in <mesh> is left out: all of the file's mesh is used"));
}

}  // namespace
}  // namespace muro::sdf
