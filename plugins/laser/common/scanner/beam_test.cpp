// SPDX-License-Identifier: MIT
#include "beam.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace muro::scanner {
namespace {

constexpr double nothing = 10;

/// Returns the ranges of the seven rays of a beam along x on the plane normal * p = distance.
std::vector<double> on_plane(const Beam& beam, const Vec3& normal, double distance) {
  std::vector<double> ranges;
  for (const Vec3& d : beam.widened({.directions = {Vec3::UnitX()}, .columns = 1}).directions)
    ranges.push_back(distance / normal.dot(d));
  return ranges;
}

TEST(ABeam, HasItsMiddleAndSixRaysAroundItInsideOfItsCone) {
  const Beam beam(0.01);
  const Vec3 along = Vec3(1, 2, -0.5).normalized();
  const RaySet wide = beam.widened({.directions = {along}, .columns = 1});
  ASSERT_EQ(wide.size(), Beam::rays);
  EXPECT_EQ(wide.directions[0], along);
  Vec3 mean = Vec3::Zero();
  for (std::uint32_t k = 1; k < Beam::rays; ++k) {
    EXPECT_NEAR(std::acos(along.dot(wide.directions[k])), 0.7359 * 0.005, 1e-6);
    mean += wide.directions[k] / 6;
  }
  EXPECT_NEAR((mean.normalized() - along).norm(), 0, 1e-12);
}

TEST(ABeam, ReadsAPlaneAcrossItAtItsDistance) {
  const Beam beam(0.002);
  EXPECT_NEAR(beam.read(on_plane(beam, Vec3::UnitX(), 3).data(), nothing).range, 3, 3e-6);
}

TEST(ABeam, TellsTheIncidenceOnAPlane) {
  for (const double divergence : {0.0, 0.001, 0.01})
    for (const double angle : {0.0, 0.2, 0.7, 1.2, 1.5})
      for (const double turn : {0.0, 0.4, 2.0}) {
        const Beam beam(divergence);
        const Vec3 normal(std::cos(angle), std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn));
        EXPECT_NEAR(beam.read(on_plane(beam, normal, 0.5).data(), 1e9).incidence, angle, 1e-5);
      }
}

TEST(ABeam, TellsTheIncidenceOfTheSurfaceInItsMiddleAtAnEdge) {
  const Beam beam(0.01);
  std::vector<double> near = on_plane(beam, Vec3(std::cos(0.5), std::sin(0.5), 0), 2);
  near[1] = near[2] = near[6] = 8;  // something far beside it
  EXPECT_NEAR(beam.read(near.data(), nothing).incidence, 0.5, 1e-5);
}

TEST(ABeam, MixesBothSidesOfAnEdgeByTheLightThatComesBack) {
  const Beam beam(0.01);
  const double ranges[] = {2, 2, 2, 2, 6, 6, 6};
  const double light = 4 / 4.0 + 3 / 36.0;
  EXPECT_NEAR(beam.read(ranges, nothing).range, (4 * 2 / 4.0 + 3 * 6 / 36.0) / light, 1e-12);
  EXPECT_EQ(beam.read(ranges, nothing).main_ray, 0u);
}

TEST(ABeam, ThatIsALineReadsItsMiddleAloneThoughItTellsItsIncidence) {
  const Beam line(0);
  const double ranges[] = {4, 2, 2, 2, 4, 4, 4};
  EXPECT_EQ(line.read(ranges, nothing).range, 4);
  const double past[] = {nothing, 2, 2, 2, 2, 2, 2};
  EXPECT_EQ(line.read(past, nothing).range, nothing);
}

TEST(ABeam, ReadsAnEdgeBeforeNothingAsTheEdge) {
  const Beam beam(0.01);
  const double ranges[] = {nothing, nothing, 4, nothing, nothing, nothing, nothing};
  EXPECT_NEAR(beam.read(ranges, nothing).range, 4, 1e-12);
  EXPECT_EQ(beam.read(ranges, nothing).main_ray, 2u);
  const double empty[] = {nothing, nothing, nothing, nothing, nothing, nothing, nothing};
  EXPECT_EQ(beam.read(empty, nothing).range, nothing);
}

}  // namespace
}  // namespace muro::scanner
