// SPDX-License-Identifier: MIT
// Scans of heightmaps, compared with closed forms and with a reference that tests every ray with every triangle.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <numbers>

#include "muro/toolkit/rotations.hpp"
#include "plugins/common/heightmap/solid.hpp"
#include "ray_caster.hpp"
#include "test_scene.hpp"

namespace muro::raycast {
namespace {

using std::numbers::pi;
using test::Dice;
using test::TestScene;

constexpr ObjectId land_object{1};

/// A scene of one heightmap.
class Land {
 public:
  /// `height`: m, at x, y (m).
  Land(std::uint32_t columns, std::uint32_t rows, const Vec3& size, const Pose& pose,
       const std::function<double(double, double)>& height)
      : pose_(pose) {
    shape_ = {.kind = ShapeKind::heightmap, .mesh = TextId(1), .size = size};
    std::vector<float> values(std::size_t(columns) * rows);
    const Heightmap grid{values, columns, rows, size};
    for (std::uint32_t row = 0; row < rows; ++row)
      for (std::uint32_t column = 0; column < columns; ++column) {
        const Vec3 at = grid.node(column, row);
        values[std::size_t(row) * columns + column] = float(height(at.x(), at.y()) / size.z());
      }
    file_ = heightmap::HeightmapFile::of(std::move(values), columns, rows);
    trees_.add(shape_, file_);
    scene_.add_scenery(shape_, pose);
    table_.build(scene_.index(), trees_);
  }
  Heightmap map() const { return file_.heightmap(shape_.size); }
  const Pose& pose() const { return pose_; }

  struct Scan {
    std::vector<double> ranges;
    std::vector<ObjectId> hits;
  };
  Scan scan(const Viewpoint& from, const RayPattern& pattern, lane::Isa isa = lane::best_isa()) const {
    Scan s{std::vector<double>(pattern.size()), std::vector<ObjectId>(pattern.size())};
    RayCaster().cast(scan_kernels_for(isa), table_, from, pattern, s.ranges, s.hits);
    return s;
  }
  /// Returns the range along a direction from a point, both in the map's frame.
  double range(const Vec3& from, const Vec3& direction, double max_range = 100) const {
    const Vec3 d = direction.normalized();
    const double angles[] = {0, 0};
    const Quat turn = Quat::FromTwoVectors(Vec3::UnitX(), d);
    const Scan s = scan({pose_ * Pose{from, turn}, max_range}, RayPattern(std::span<const double>(angles)));
    EXPECT_EQ(s.hits[0], s.ranges[0] < max_range ? land_object : no_object);
    return s.ranges[0];
  }

 private:
  Shape shape_;
  Pose pose_;
  heightmap::HeightmapFile file_;
  HeightTrees trees_;
  TestScene scene_;
  SceneTable table_;
};

std::vector<Vec3> directions_of(const RayPattern& pattern) {
  std::vector<Vec3> rays(pattern.size());
  for (const RayPacket& b : pattern.packets())
    for (std::uint32_t i = 0; i < b.count; ++i) rays[b.ray[i]] = Vec3(b.x[i], b.y[i], b.z[i]);
  return rays;
}

/// Returns the distance to the nearest of all triangles along a ray, in long double (Moeller and Trumbore 1997);
/// infinity if there is none. `crossing`: cosine between the ray and the normal of that triangle.
long double nearest_triangle(const mesh::Mesh& mesh, const Vec3& from, const Vec3& along, double& crossing) {
  using V = Eigen::Matrix<long double, 3, 1>;
  const V o = from.cast<long double>(), d = along.cast<long double>();
  long double nearest = std::numeric_limits<long double>::infinity();
  for (const mesh::Triangle& t : mesh.triangles) {
    const V a = mesh.vertices[t[0]].cast<long double>(), ab = mesh.vertices[t[1]].cast<long double>() - a,
            ac = mesh.vertices[t[2]].cast<long double>() - a, p = d.cross(ac);
    const long double determinant = ab.dot(p);
    if (determinant == 0) continue;
    const V s = o - a, q = s.cross(ab);
    const long double u = s.dot(p) / determinant, v = d.dot(q) / determinant, at = ac.dot(q) / determinant;
    if (u < 0 || v < 0 || u + v > 1 || at < 0 || at >= nearest) continue;
    nearest = at;
    crossing = std::abs(double(d.dot(ab.cross(ac).normalized())));
  }
  return nearest;
}

TEST(LaserHeightmap, TurnsByHalfCirclesLeaveNoRayThrough) {
  std::vector<Quat> turns;
  for (int axis = 0; axis < 4; ++axis)
    for (const double w : {1.0, -1.0}) {
      Quat turn(0, 0, 0, 0);
      turn.coeffs()[axis] = w;
      turns.push_back(turn);
    }
  for (const Quat& map : turns) {
    if ((map * Vec3::UnitZ()).z() < 0) continue;  // the floor would be above
    const Land land(9, 9, {8, 8, 1}, {Vec3::Zero(), map}, [](double, double) { return 0.0; });
    for (const Quat& device : turns)
      for (const double azimuth : {0.0, pi / 2, pi, -pi / 2})
        for (const double elevation : {-1.0, -0.5, 0.5, 1.0}) {
          const double angles[] = {azimuth, elevation};
          const Vec3 at(1.25, 0.3, 1);
          const Vec3 d = device * Vec3(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                       std::sin(elevation));
          const double down = d.z() < 0 ? -1 / d.z() : 100;
          const bool over = ((at + down * d).head<2>().array().abs() < 4).all();
          EXPECT_NEAR(land.scan({{at, device}, 100}, RayPattern(std::span<const double>(angles))).ranges[0],
                      over ? down : 100, 1e-9)
              << map.coeffs().transpose() << ", " << device.coeffs().transpose() << ", " << azimuth << " " << elevation;
        }
  }
}

TEST(LaserHeightmap, AgreesWithBruteForceFromEverywhere) {
  Dice dice(31);
  std::vector<RayPattern> patterns;
  patterns.emplace_back(Grid{.min_angle = -pi, .max_angle = pi, .columns = 90});
  patterns.emplace_back(
      Grid{.min_angle = -pi, .max_angle = pi, .columns = 40, .min_elevation = -1.2, .max_elevation = 0.6, .rows = 12});
  int hits = 0, rays = 0;
  for (int round = 0; round < 8; ++round) {
    const double roughness = round % 2 == 0 ? 1 : 0.2;
    const auto height = [&](double x, double y) {
      return 1.5 + std::sin(x) * std::cos(0.7 * y) + roughness * dice.between(-0.5, 0.5);
    };
    const Land land(std::uint32_t(dice.between(2, 40)), std::uint32_t(dice.between(2, 40)), {12, 9, 2}, dice.pose(20),
                    height);
    const mesh::Mesh solid = heightmap::solid_mesh_of(land.map());
    for (int place = 0; place < 6; ++place) {
      Vec3 at(dice.between(-9, 9), dice.between(-7, 7), dice.between(-3, 6));
      if (place < 4)  // just above the ground
        at = {dice.between(-5, 5), dice.between(-4, 4), 0}, at.z() = land.map().ground_at(at.x(), at.y())->height + 0.4;
      if (heightmap::contains(land.map(), at)) continue;
      const Viewpoint from{land.pose() * Pose{at, dice.rotation()}, 10};
      for (const RayPattern& pattern : patterns) {
        const Land::Scan found = land.scan(from, pattern);
        const std::vector<Vec3> directions = directions_of(pattern);
        for (std::size_t i = 0; i < directions.size(); ++i) {
          const Vec3 d = land.pose().orientation.inverse() * (from.device.orientation * directions[i]);
          double crossing = 1;
          const double expected = std::min(double(nearest_triangle(solid, at, d, crossing)), 10.0);
          EXPECT_NEAR(found.ranges[i], expected, 1e-10 / crossing) << "round " << round << " ray " << i;
          EXPECT_EQ(found.hits[i], expected < 10 ? land_object : no_object);
          hits += expected < 10;
          ++rays;
        }
      }
    }
  }
  EXPECT_GT(hits, rays / 3);
  EXPECT_LT(hits, rays * 9 / 10);
}

/// A slope, z = 6 + x / 4 - y / 8: exact in floats at the nodes.
Land slope(const Pose& pose = {}) {
  return Land(65, 33, {32, 32, 2}, pose, [](double x, double y) { return 6 + 0.25 * x - 0.125 * y; });
}

TEST(LaserHeightmap, GivesDistancesToAnInclinedPlaneInClosedForm) {
  Dice dice(32);
  for (const Pose& pose : {Pose{}, dice.pose(300)}) {
    const Land land = slope(pose);
    int hits = 0;
    for (int i = 0; i < 400; ++i) {
      const Vec3 from(dice.between(-12, 12), dice.between(-12, 12), 12 + dice.between(0, 4));
      const Vec3 d = Vec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-2, -0.5)).normalized();
      const double at = (6 + 0.25 * from.x() - 0.125 * from.y() - from.z()) / (d.z() - 0.25 * d.x() + 0.125 * d.y());
      const Vec3 point = from + at * d;
      if (!land.map().covers(point.x(), point.y()) || at < 0) continue;
      EXPECT_NEAR(land.range(from, d), at, 1e-11);
      ++hits;
    }
    EXPECT_GT(hits, 200);
  }
}

TEST(LaserHeightmap, LetsNoRayThroughItsSeams) {
  const Land land = slope();
  // rays straight down on nodes and on the three kinds of edges, and rays that descend along these edges
  constexpr double rim = 16 - 1e-9;  // a direction straight down has an error of 1e-16
  for (double column = -16; column <= 16; column += 0.5)
    for (const double row : {-16.0, -3.0, -2.5, 0.0, 0.5, 16.0}) {
      const double x = std::clamp(column, -rim, rim), y = std::clamp(row, -rim, rim);
      const double ground_height = 6 + 0.25 * x - 0.125 * y;
      EXPECT_NEAR(land.range({x, y, 20}, {0, 0, -1}), 20 - ground_height, 1e-12);
      if (column < 16) {
        EXPECT_NEAR(land.range({x + 0.25, y, 20}, {0, 0, -1}), 20 - ground_height - 0.0625, 1e-12);
      }
      if (std::abs(x) < 12 && std::abs(y) < 12) {
        for (const Vec3& along : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 1, 0), Vec3(1, -1, 0)}) {
          const Vec3 from = Vec3(x, y, ground_height + 1) - along;
          const double slope_along = 0.25 * along.x() - 0.125 * along.y();
          // the ray meets the ground at (x, y), after one more unit
          EXPECT_NEAR(land.range(from, along + Vec3(0, 0, -1)), (along + Vec3(0, 0, -1)).norm(), 1e-11)
              << x << ", " << y << ", " << slope_along;
        }
      }
    }
}

TEST(LaserHeightmap, FollowsAParaboloidAsNearlyAsItsGridDoes) {
  // z = (x^2 + y^2) / 16, nodes 1/8 m apart: between nodes the triangles are too high by at most 1/8^2 / 8 (1/8 + 1/8)
  const Land land(65, 65, {8, 8, 1}, {}, [](double x, double y) { return (x * x + y * y) / 16; });
  const double too_high = 1.0 / 64 / 8 / 4;
  Dice dice(33);
  for (int i = 0; i < 300; ++i) {
    const Vec3 from(dice.between(-2, 2), dice.between(-2, 2), dice.between(2, 3));
    const Vec3 d = Vec3(dice.between(-0.5, 0.5), dice.between(-0.5, 0.5), -1).normalized();
    const double a = d.head<2>().squaredNorm(), b = from.head<2>().dot(d.head<2>()) - 8 * d.z(),
                 c = from.head<2>().squaredNorm() - 16 * from.z();
    const double exact = a > 1e-12 ? (-b + std::sqrt(b * b - a * c)) / a : -c / (2 * b);
    const double found = land.range(from, d);
    EXPECT_LE(found, exact + 1e-12);
    EXPECT_GE(found, exact - 2 * too_high);
  }
}

TEST(LaserHeightmap, EndsAtItsRimInWallsDownToItsLowestPoint) {
  const Land land = slope();  // heights of 0 (-16, 16) to 12 (16, -16)
  EXPECT_NEAR(land.range({15.999999, 0, 20}, {0, 0, -1}), 10, 1e-6);
  EXPECT_EQ(land.range({16.000001, 0, 20}, {0, 0, -1}), 100) << "beyond the rim is nothing";
  EXPECT_NEAR(land.range({20, 0, 5}, {-1, 0, 0}), 4, 1e-12) << "from beside, below the rim, which is 10 m high here";
  EXPECT_NEAR(land.range({20, 0, 9.7}, {-1, 0.5, 0}), 4 * std::sqrt(1.25), 1e-12);
  EXPECT_NEAR(land.range({20, 0, 11}, {-1, 0, 0}), 100, 0) << "over the rim, and the ground falls away";
  EXPECT_EQ(land.range({20, 0, -0.001}, {-1, 0, 0}), 100) << "below the lowest point";
  EXPECT_NEAR(land.range({20, 0, -3}, {-1, 0, 0.5}), 6 * std::sqrt(1.25), 1e-11) << "up through the floor";
  EXPECT_EQ(land.range({20, 0, -3}, {-1, 0, -0.5}), 100);
  EXPECT_EQ(land.range({20, 0, 9}, {1, 0, 0}), 100) << "away from it";
  EXPECT_EQ(land.range({20, 0, 9}, {-1, 0, 0}, 3.9), 3.9) << "out of range";
}

TEST(LaserHeightmap, IsSolidBelowHoweverDeep) {
  Dice dice(34);
  for (const Pose& pose : {Pose{}, dice.pose(50)}) {
    const Land land = slope(pose);
    const RayPattern pattern(Grid{.min_angle = -pi, .max_angle = pi, .columns = 33});
    for (const double z : {5.9999, 3.0, 0.0, -1.0, -500.0}) {
      const Land::Scan s = land.scan({pose * Pose{{0, 0, z}, dice.rotation()}, 10, no_robot, 0.02}, pattern);
      for (const double range : s.ranges) EXPECT_EQ(range, 0.02) << z;
      for (const ObjectId hit : s.hits) EXPECT_EQ(hit, land_object);
    }
    const Land::Scan beside = land.scan({pose * Pose{{40, 0, -1}, dice.rotation()}, 10, no_robot, 0.02}, pattern);
    for (const double range : beside.ranges) EXPECT_EQ(range, 10);
  }
}

TEST(LaserHeightmap, OfNoHeightIsAPlate) {
  const Land land(9, 5, {4, 2, 1}, {}, [](double, double) { return 0.5; });
  EXPECT_NEAR(land.range({0.3, 0.2, 3.5}, {0, 0, -1}), 3, 1e-12);
  EXPECT_NEAR(land.range({-1, 0, 1.5}, {1, 0.5, -1}), 1.5, 1e-12);
  EXPECT_EQ(land.range({0, 0, 1}, {1, 0, 0}), 100);
}

TEST(LaserHeightmap, GivesTheSameBitsWithEveryInstructionSet) {
  Dice dice(35);
  const RayPattern pattern(
      Grid{.min_angle = -pi, .max_angle = pi, .columns = 90, .min_elevation = -0.7, .max_elevation = 0.3, .rows = 9});
  for (int round = 0; round < 10; ++round) {
    const Land land(70, 50, {30, 20, 3}, dice.pose(10), [&](double, double) { return dice.between(0, 3); });
    const Viewpoint from{land.pose() * Pose{{dice.between(-9, 9), dice.between(-9, 9), 3.5}, dice.rotation()}, 30};
    const Land::Scan base = land.scan(from, pattern, lane::Isa::base);
    for (const lane::Isa isa : {lane::Isa::avx2, lane::Isa::avx512}) {
      if (lane::best_isa() < isa) continue;
      const Land::Scan s = land.scan(from, pattern, isa);
      EXPECT_EQ(std::memcmp(base.ranges.data(), s.ranges.data(), s.ranges.size() * sizeof(double)), 0);
      EXPECT_EQ(base.hits, s.hits);
    }
  }
}

}  // namespace
}  // namespace muro::raycast
