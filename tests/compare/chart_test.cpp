// SPDX-License-Identifier: MIT
// The chart, read back from its text.
#include "host/tools/compare/chart.hpp"

#include <gtest/gtest.h>

#include <boost/property_tree/xml_parser.hpp>
#include <cmath>
#include <sstream>

namespace muro::host {
namespace {

using boost::property_tree::ptree;

ptree parsed(const Chart& chart) {
  std::istringstream text(svg(chart));
  ptree tree;
  boost::property_tree::read_xml(text, tree);  // throws if the text is not XML
  return tree.get_child("svg");
}

struct Place {
  double x, y;
};

std::vector<Place> circles(const ptree& svg) {
  std::vector<Place> all;
  for (const auto& [name, node] : svg)
    if (name == "circle") all.push_back({node.get<double>("<xmlattr>.cx"), node.get<double>("<xmlattr>.cy")});
  return all;
}

Place text_place(const ptree& svg, const std::string& what) {
  for (const auto& [name, node] : svg)
    if (name == "text" && node.data() == what)
      return {node.get<double>("<xmlattr>.x"), node.get<double>("<xmlattr>.y")};
  ADD_FAILURE() << "no text " << what;
  return {};
}

Chart chart_of(std::vector<Chart::Point> points) {
  return {"title", "subtitle", {"cost", "ms/s"}, {"deviation", "m"}, std::move(points), {}, {}};
}

TEST(Chart, EqualRatiosAreEquallyFarApart) {
  const auto all = circles(parsed(chart_of({{"a", 1, 0.001}, {"b", 10, 0.01}, {"c", 100, 0.1}})));
  ASSERT_EQ(all.size(), 3u);
  EXPECT_NEAR(all[1].x - all[0].x, all[2].x - all[1].x, 0.11);
  EXPECT_NEAR(all[1].y - all[0].y, all[2].y - all[1].y, 0.11);
  EXPECT_LT(all[2].y, all[0].y) << "more is higher";
}

TEST(Chart, TicksStandWhereTheirValuesAre) {
  const ptree svg = parsed(chart_of({{"a", 1, 0.001}, {"b", 100, 1}}));
  const auto all = circles(svg);
  EXPECT_NEAR(text_place(svg, "1").x, all[0].x, 60) << "one of the two axes";
  EXPECT_NEAR(text_place(svg, "100").x, all[1].x, 0.11);
  EXPECT_NEAR(text_place(svg, "0.001").y - 4.5, all[0].y, 0.11);
}

TEST(Chart, ZeroHasAPlaceBelowAllOthers) {
  const ptree svg = parsed(chart_of({{"a", 1, 1e-9}, {"reference", 100, 0}}));
  const auto all = circles(svg);
  EXPECT_GT(all[1].y, all[0].y + 20);
  EXPECT_NEAR(text_place(svg, "0").y - 4.5, all[1].y, 0.11);
}

/// Returns the left and right end of a text, for letters of a known width.
std::pair<double, double> ends(const ptree& svg, const std::string& what) {
  for (const auto& [name, node] : svg) {
    if (name != "text" || node.data() != what) continue;
    const std::string anchor = node.get<std::string>("<xmlattr>.text-anchor");
    const double x = node.get<double>("<xmlattr>.x"), w = 7.2 * double(what.size());
    const double begin = anchor == "start" ? x : (anchor == "end" ? x - w : x - w / 2);
    return {begin, begin + w};
  }
  return {};
}

TEST(Chart, LabelsOfNeighboursDoNotCoverEachOther) {
  std::vector<Chart::Point> points;
  for (int i = 0; i < 6; ++i) points.push_back({"motion_" + std::to_string(i), 1 + 0.01 * i, 1});
  points.push_back({"far", 1000, 100});
  const ptree svg = parsed(chart_of(points));
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const auto a = ends(svg, points[i].label), b = ends(svg, points[k].label);
      const double apart = std::abs(text_place(svg, points[i].label).y - text_place(svg, points[k].label).y);
      EXPECT_TRUE(apart >= 12.9 || a.second <= b.first || b.second <= a.first) << i << " and " << k;
    }
}

TEST(Chart, AMarkStandsAtItsValue) {
  Chart chart = chart_of({{"a", 1, 1}, {"b", 100, 1}});
  chart.marks = {{100, "limit"}, {1e6, "beyond"}};
  const ptree svg = parsed(chart);
  const std::vector<Place> all = circles(svg);
  EXPECT_NEAR(text_place(svg, "limit").x, all[1].x, 0.11);
  for (const auto& [name, node] : svg) EXPECT_NE(node.data(), "beyond");
}

TEST(Chart, NamesAreTextWhateverTheyHold) {
  Chart chart = chart_of({{"a<b & c>d", 1, 1}});
  text_place(parsed(chart), "a<b & c>d");
}

TEST(Chart, OneValueOrNoneIsAPictureToo) {
  EXPECT_EQ(circles(parsed(chart_of({}))).size(), 0u);
  const auto one = circles(parsed(chart_of({{"only", 0, 0}})));
  ASSERT_EQ(one.size(), 1u);
  EXPECT_TRUE(std::isfinite(one[0].x) && std::isfinite(one[0].y));
}

TEST(Chart, DrawsCurvesAndBandsWithinItsArea) {
  Chart chart;
  chart.x = {"time", "s"};
  chart.y = {"deviation", "m"};
  chart.curves.push_back({"", {{1, 1}, {10, 0.1}, {100, 0.01}}, 0});
  chart.curves.push_back({"guide", {{1, 1e-9}, {100, 0.1}}, 0, true});
  chart.bands.push_back({{1, 100}, {0.9, 0.009}, {1.1, 0.011}});
  const ptree svg = parsed(chart);
  std::vector<std::string> corners;
  double low = 0;
  for (const auto& [group, node] : svg)
    if (group == "g")
      for (const auto& [name, line] : node) {
        if (name == "polyline") corners.push_back(line.get<std::string>("<xmlattr>.points"));
        if (name == "polygon") low = line.count("<xmlattr>") > 0 ? 1 : 0;
      }
  ASSERT_EQ(corners.size(), 2U);
  EXPECT_EQ(low, 1) << "a band";
  std::istringstream in(corners[0]);
  std::vector<double> xs, ys;
  char comma = 0;
  for (double x = 0, y = 0; in >> x >> comma >> y;) xs.push_back(x), ys.push_back(y);
  ASSERT_EQ(xs.size(), 3U);
  EXPECT_NEAR(xs[1] - xs[0], xs[2] - xs[1], 0.2) << "logarithmic";
  EXPECT_NEAR(ys[1] - ys[0], ys[2] - ys[1], 0.2);
  EXPECT_GT(ys[2] - ys[0], 200) << "the guide, far below, does not choose the axis";
  text_place(svg, "guide");
}

}  // namespace
}  // namespace muro::host
