// SPDX-License-Identifier: MIT
// Place of a walker with known errors of its reckoning, which sees posts and lines with known errors.
#include "localisation.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <random>
#include <vector>

namespace soccer {
namespace {

using std::numbers::pi;

const Landmarks field;

/// Sights of a point with the errors of pictures: along the line of sight, and across it.
class Eye {
 public:
  explicit Eye(unsigned seed) : random_(seed) {}

  Point seen(const Point& own) {
    const double d = own.norm();
    const Point ray = (1 / d) * own, across{-ray.y, ray.x};
    return own + noise(0.02 + 0.01 * d * d) * ray + noise(0.01 * d) * across;
  }
  /// Returns posts within half an angle of view and `farthest` (m), the left one first.
  std::vector<Point> posts(const Place& me, double pan, double farthest = 6.5) {
    std::vector<Point> all;
    for (const Point& post : field.posts()) {
      const Point own = me.to_own(post);
      if (own.norm() < farthest && std::abs(wrapped(bearing(own) - pan)) < 0.45) all.push_back(own);
    }
    std::sort(all.begin(), all.end(), [](const Point& a, const Point& b) { return a.x * b.y - a.y * b.x < 0; });
    for (Point& p : all) p = seen(p);
    return all;
  }
  /// Returns points of lines in an angle of view, up to `farthest` (m) away.
  std::vector<Point> lines(const Place& me, double pan, double farthest = 3) {
    std::vector<Point> all;
    for (int i = 0; all.size() < 16 && i < 2000; ++i) {
      const double d = 0.4 + (farthest - 0.4) * uniform(), angle = pan + 0.45 * (2 * uniform() - 1);
      const Point own{d * muro_cos(angle), d * muro_sin(angle)}, at = me.to_world(own);
      if ((field.nearest_on_lines(at) - at).norm() < 0.1) all.push_back(seen(me.to_own(field.nearest_on_lines(at))));
    }
    return all;
  }
  double noise(double sigma) { return sigma * normal_(random_); }
  double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

struct Errors {
  double place = 0, yaw = 0;  ///< m, rad
};
Errors errors(const Localisation& l, const Place& truth) {
  return {(l.place().at - truth.at).norm(), std::abs(wrapped(l.place().yaw - truth.yaw))};
}

/// Walks between points of the field for 120 s; steps are 15 % longer than reckoned, the heading drifts by 0.02 rad/s.
/// `look`: called five times a second, with the time (s).
Errors walk(const std::function<void(double, const Place&, Localisation&)>& look) {
  Place truth{{-2, 1}, 0};
  Localisation l;
  l.start(truth);
  Errors worst;
  const std::vector<Point> way = {{1, 1.2}, {2.8, -0.5}, {0, -1.8}, {-2.5, 0}};
  std::size_t next = 0;
  for (int k = 0; k < 600; ++k) {
    const Point to = truth.to_own(way[next]);
    if (to.norm() < 0.2) next = (next + 1) % way.size();
    const double turn = 0.2 * std::clamp(bearing(to), -0.5, 0.5);
    const Point step{std::abs(turn) > 0.09 ? 0.005 : 0.03, 0};
    truth = {truth.to_world(step), wrapped(truth.yaw + turn)};
    l.move((1 / 1.15) * step, turn + 0.2 * 0.02);
    look(0.2 * k, truth, l);
    const Errors now = errors(l, truth);
    worst = {std::max(worst.place, now.place), std::max(worst.yaw, now.yaw)};
  }
  return worst;
}
/// Returns the pan (rad) of a head that follows a ball ahead, and glances up every 4.6 s.
double pan(double time) {
  const int glance = int(time / 4.6) % 3;
  return std::fmod(time, 4.6) > 0.4 ? 0 : 0.6 * (glance == 2 ? -1 : glance);
}

TEST(Localisation, DriftsWithoutSights) {
  const Errors worst = walk([](double, const Place&, Localisation&) {});
  EXPECT_GT(worst.place, 1);
  EXPECT_GT(worst.yaw, 2);
}

TEST(Localisation, KeepsItsPlaceByPostsSeenNowAndThen) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Eye eye(seed);
    const Errors worst = walk([&](double time, const Place& truth, Localisation& l) {
      if (std::lround(5 * time) % 8 == 0)  // every 1.6 s, all around
        for (const double to : {-2.4, -1.6, -0.8, 0.0, 0.8, 1.6, 2.4}) l.see_posts(eye.posts(truth, to));
    });
    EXPECT_LT(worst.place, 0.25) << seed;
    EXPECT_LT(worst.yaw, 0.1) << seed;
  }
}

TEST(Localisation, KeepsItsPlaceByLinesAheadAndPosts) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Eye eye(seed);
    const Errors worst = walk([&](double time, const Place& truth, Localisation& l) {
      l.see_posts(eye.posts(truth, pan(time)));
      l.see_lines(eye.lines(truth, pan(time)));
    });
    EXPECT_LT(worst.place, 0.25) << seed;
    EXPECT_LT(worst.yaw, 0.1) << seed;
  }
}

TEST(Localisation, CorrectsAHeadingThatIsOff) {
  Eye eye(3);
  const Place truth{{1.5, 0.4}, 0.2};
  Localisation l;
  l.start({truth.at, truth.yaw + 0.3}, 0.2, 0.3);
  for (int k = 0; k < 10; ++k) l.see_posts(eye.posts(truth, 0));
  EXPECT_LT(errors(l, truth).yaw, 0.05);
  EXPECT_LT(errors(l, truth).place, 0.15);

  l.start({truth.at, truth.yaw + 0.3}, 0.2, 0.3);
  for (int k = 0; k < 10; ++k) l.see_lines(eye.lines(truth, 0));
  EXPECT_LT(errors(l, truth).yaw, 0.05);
  EXPECT_LT(errors(l, truth).place, 0.15);
}

TEST(Localisation, FindsItselfAgainAfterAFall) {
  int found = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Eye eye(seed);
    const Place truth{{4 * eye.uniform() - 2, 3 * eye.uniform() - 1.5}, pi * (2 * eye.uniform() - 1)};
    Localisation l;
    l.start({truth.at + Point{eye.noise(0.3), eye.noise(0.3)}, truth.yaw + eye.noise(0.35)});
    l.fell();
    for (int k = 0; k < 15; ++k)
      for (const double to : {-1.2, -0.6, 0.0, 0.6, 1.2}) {
        l.see_posts(eye.posts(truth, to));
        l.see_lines(eye.lines(truth, to));
      }
    const Errors e = errors(l, truth);
    found += e.place < 0.2 && e.yaw < 0.1;
  }
  EXPECT_GE(found, 19) << "of 20";
}

TEST(Localisation, BelievesNothingThatDoesNotFit) {
  const Place truth{{1.5, 0.4}, 0.2};
  Localisation l;
  l.start(truth);
  EXPECT_FALSE(l.see_posts(std::array{Point{2, -1.2}})) << "no post is near to there";
  EXPECT_FALSE(l.see_posts(std::array{Point{2, 0.5}, Point{1, -1.2}}));
  EXPECT_EQ(errors(l, truth).place, 0);
  const Point post = truth.to_own(field.posts()[0]);
  EXPECT_TRUE(l.see_posts(std::array{post, Point{1, -1.2}})) << "one of two fits";
  EXPECT_LT(errors(l, truth).place, 0.02);
}

TEST(Localisation, DoesNotTakeOneEndOfTheFieldForTheOther) {
  Eye eye(1);
  const Place truth{{0.3, 0.2}, 0.1}, mirrored{{-0.3, -0.2}, 0.1 + pi};
  Localisation l;
  l.start(truth, 0.5, 0.5);
  l.see_posts(eye.posts(mirrored, 0));  // the same picture
  l.see_lines(eye.lines(mirrored, 0));
  EXPECT_LT(errors(l, truth).yaw, 0.5);
  l.start(truth, 1, 0.8);
  const Point post = truth.to_own(field.posts()[2]);  // the post behind it, reported as ahead
  l.see_posts(std::array{Point{-post.x, post.y}});
  EXPECT_LT(errors(l, truth).yaw, 0.8);
}

TEST(Localisation, KnowsHowFarItMayBeOff) {
  double sum = 0;
  int count = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Eye eye(seed);
    walk([&](double time, const Place& truth, Localisation& l) {
      l.see_posts(eye.posts(truth, pan(time)));
      l.see_lines(eye.lines(truth, pan(time)));
      const double e = errors(l, truth).place / l.sigma();
      sum += 0.5 * e * e, ++count;
    });
  }
  EXPECT_GT(sum / count, 0.03);
  EXPECT_LT(sum / count, 3);
}

TEST(Localisation, LinesAreThoseOfTheField) {
  const auto distance = [](double x, double y) { return (field.nearest_on_lines({x, y}) - Point{x, y}).norm(); };
  EXPECT_NEAR(distance(-4.475, 1), 0, 1e-12) << "goal line";
  EXPECT_NEAR(distance(1, -2.975), 0, 1e-12) << "touch line";
  EXPECT_NEAR(distance(0.45, 0.6), 0, 1e-12) << "circle";
  EXPECT_NEAR(distance(3.525, -1), 0, 1e-12) << "goal area";
  EXPECT_NEAR(distance(-2.525, 2), 0, 1e-12) << "penalty area";
  EXPECT_NEAR(distance(-3, 0.02), 0.02, 1e-12) << "penalty mark";
  EXPECT_NEAR(distance(1.7, 1), 0.825, 1e-12) << "to the penalty area";
}

}  // namespace
}  // namespace soccer
