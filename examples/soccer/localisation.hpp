// SPDX-License-Identifier: MIT
// Place of a player on the field: dead reckoning, corrected by the posts of goals and the lines that it sees. An
// iterated extended Kalman filter of x, y and heading, in information form: each sight is a least-squares problem about
// the prior estimate. Lines are fitted as by Lauer, Lange and Riedmiller, "Calculating the perfect match: an efficient
// and accurate approach for robot self-localization" (RoboCup 2005), with weights that drop points that fit no line.
//
// A field looks the same from both ends. The filter follows one place from the start on. A sight that would move the
// place far away changes nothing. A sight that fits two places equally well changes nothing (posts), or widens the
// covariance (lines).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>

#include "../common/angle.hpp"
#include "../common/place.hpp"
#include "landmarks.hpp"
#include "least_squares.hpp"

namespace soccer {

using examples::Place;
using examples::wrapped;

class Localisation {
 public:
  explicit Localisation(const Landmarks& landmarks = {}) : landmarks_(landmarks) {}

  /// Begins at `place`, known to `sigma` (m) along x and y, and to `sigma_yaw` (rad).
  void start(const Place& place, double sigma = 0.1, double sigma_yaw = 0.05) {
    place_ = place;
    covariance_ = {};
    covariance_.xx = covariance_.yy = sigma * sigma, covariance_.zz = sigma_yaw * sigma_yaw;
    rejected_posts_ = rejected_lines_ = 0;
  }

  /// Predicts by dead reckoning: in `seconds` the player has gone `own_way` (m, forward and left, in its previous
  /// frame) and `turned` (rad).
  void move(const Point& own_way, double turned, double seconds = 0.2) {
    const Point before = place_.at;
    place_.at = place_.to_world(own_way);
    place_.yaw = wrapped(place_.yaw + turned);
    const double dx = -(place_.at.y - before.y), dy = place_.at.x - before.x;  // derivatives by the heading
    Symmetric3& c = covariance_;
    c.xx += 2 * dx * c.xz + dx * dx * c.zz, c.yy += 2 * dy * c.yz + dy * dy * c.zz;
    c.xy += dx * c.yz + dy * c.xz + dx * dy * c.zz;
    c.xz += dx * c.zz, c.yz += dy * c.zz;
    const double strayed = strays * own_way.norm() + rests * seconds;
    c.xx += strayed, c.yy += strayed;
    c.zz += drifts * seconds + twists * std::abs(turned);
    limit();
  }
  /// Widens the covariance after a fall by `distance` (m) and `turn` (rad): the player got up somewhere near.
  void fell(double distance = 0.5, double turn = 0.5) {
    covariance_.xx += distance * distance, covariance_.yy += distance * distance, covariance_.zz += turn * turn;
    limit();
  }

  /// Takes the feet of goal posts in its own frame (m). Returns whether they fit the field and were used.
  bool see_posts(std::span<const Point> posts) {
    if (posts.empty()) return false;
    return judge(posts.size() == 1 ? see_post(posts[0]) : see_pair(posts[0], posts[1]), rejected_posts_, 3, 0.4, 0.4);
  }
  /// Takes points on the middles of lines in its own frame (m). Give it neither lines nor posts while the player falls,
  /// lies or gets up: its camera is then not where look.cpp assumes it.
  bool see_lines(std::span<const Point> points) {
    if (points.size() < least_points) return false;
    return judge(fit_lines(points), rejected_lines_, 5, 0.2, 0.2);
  }

  const Place& place() const { return place_; }
  double sigma() const { return std::sqrt(0.5 * (covariance_.xx + covariance_.yy)); }  ///< m, along x and y
  double sigma_yaw() const { return std::sqrt(covariance_.zz); }                       ///< rad

 private:
  static constexpr double strays = 0.02;                   ///< m^2/m: 15 % in 1 m
  static constexpr double rests = 1e-4;                    ///< m^2/s
  static constexpr double drifts = 0.002;                  ///< rad^2/s: 0.02 rad/s for 5 s
  static constexpr double twists = 0.01;                   ///< rad^2/rad
  static constexpr double largest = 1, largest_yaw = 0.8;  ///< m, rad: standard deviations
  static constexpr std::size_t least_points = 6;
  static constexpr double least_fitting = 0.7;  ///< least share of the points of a sight that lie on lines
  static constexpr double distinct = 6;         ///< chi squared: margin to the second-best match that a match needs

  /// Errors (m) of points found by a camera at a walking player's height (look.cpp), by distance.
  static double range_sigma(double d) { return 0.03 + 0.02 * d * d; }
  static double side_sigma(double d) { return 0.02 + 0.02 * d; }

  /// A candidate place. `cost`: how little it fits the prior estimate and the sight (chi squared).
  struct Fit {
    Place place;
    Symmetric3 covariance;
    double cost = 1e9;
    double fitting = 0;  ///< number of points that lie on lines
  };
  enum Sight { used, unclear, misfit };
  struct Match {
    Point seen, landmark;  ///< m: in its own frame; on the field
  };

  /// `rejected`: number of sights of this kind in a row that do not fit. After `patience` of them the player may be
  /// elsewhere, up to `distance` (m) and `turn` (rad) away.
  bool judge(Sight sight, std::int64_t& rejected, std::int64_t patience, double distance, double turn) {
    if (sight == used) rejected = 0, keep_doubts();
    if (sight == misfit) ++rejected;
    if (rejected >= patience) rejected = 0, fell(distance, turn);
    return sight == used;
  }
  /// Keeps a least covariance: errors of a camera repeat in many pictures, so their mean is not exact.
  void keep_doubts() {
    constexpr double least = 0.03, least_yaw = 0.015;  // m, rad
    covariance_.xx = std::max(covariance_.xx, least * least), covariance_.yy = std::max(covariance_.yy, least * least);
    covariance_.zz = std::max(covariance_.zz, least_yaw * least_yaw);
  }
  void limit() {
    const auto bound = [](double& variance, double most) {
      const double s = variance > most * most ? most / std::sqrt(variance) : 1;
      variance *= s * s;
      return s;
    };
    Symmetric3& c = covariance_;
    const double sx = bound(c.xx, largest), sy = bound(c.yy, largest), sz = bound(c.zz, largest_yaw);
    c.xy *= sx * sy, c.xz *= sx * sz, c.yz *= sy * sz;
  }

  /// Returns the way from the prior place to another place.
  Vector3 difference(const Place& to) const {
    return {to.at.x - place_.at.x, to.at.y - place_.at.y, wrapped(to.yaw - place_.yaw)};
  }
  static Vector3 minus(const Vector3& v) { return {-v[0], -v[1], -v[2]}; }
  static Place moved(const Place& p, const Vector3& d) {
    return {{p.at.x + d[0], p.at.y + d[1]}, wrapped(p.yaw + d[2])};
  }

  Sight see_post(const Point& seen) {
    Fit best, second;
    for (const Point& post : landmarks_.posts()) rank(fit_posts(std::array{Match{seen, post}}), best, second);
    constexpr double gate = 11;  // chi squared of two degrees of freedom is above in 0.4 % of all sights
    return believe(best, second, gate);
  }
  Sight see_pair(const Point& left, const Point& right) {
    Fit best, second;
    const auto posts = landmarks_.posts();
    for (const Point& a : posts)
      for (const Point& b : posts)
        if ((a - b).norm() > 0) rank(fit_posts(std::array{Match{left, a}, Match{right, b}}), best, second);
    constexpr double gate = 15.5;  // four degrees of freedom
    const Sight both = believe(best, second, gate);
    if (both == used) return used;
    return see_post(left) == used || see_post(right) == used ? used : both;
  }
  static void rank(const Fit& fit, Fit& best, Fit& second) {
    if (fit.cost < best.cost) {
      second = best, best = fit;
    } else if (fit.cost < second.cost) {
      second = fit;
    }
  }
  Sight believe(const Fit& best, const Fit& second, double gate) {
    if (best.cost > gate) return misfit;
    if (second.cost < best.cost + distinct) return unclear;
    place_ = best.place, covariance_ = best.covariance;
    return used;
  }

  /// Returns the place that best fits the prior estimate and the posts matched with those of the field.
  Fit fit_posts(std::span<const Match> matches) const {
    constexpr int iterations = 4;
    const Symmetric3 known = covariance_.inverse();
    Fit fit{place_, {}, 0};
    for (int i = 0; i <= iterations; ++i) {
      const Vector3 gone = difference(fit.place);
      LeastSquares sum(known, minus(gone));
      fit.cost = known.square(gone);
      for (const Match& m : matches) fit.cost += add_post(m, fit.place, sum);
      if (i == iterations)
        fit.covariance = sum.covariance();
      else
        fit.place = moved(fit.place, sum.solution());
    }
    return fit;
  }
  /// Adds errors along the direction in which the post is seen, and across it. Returns chi squared.
  static double add_post(const Match& match, const Place& place, LeastSquares& sum) {
    const Point expected = place.to_own(match.landmark), off = match.seen - expected;
    const double distance = match.seen.norm(), c = muro_cos(place.yaw), s = muro_sin(place.yaw);
    const Point ray = (1 / std::max(distance, 0.01)) * match.seen, across{-ray.y, ray.x};
    double cost = 0;
    for (const auto& [axis, sigma] : {std::pair{ray, range_sigma(distance)}, std::pair{across, side_sigma(distance)}}) {
      const double residual = axis.x * off.x + axis.y * off.y, weight = 1 / (sigma * sigma);
      sum.add({-(c * axis.x - s * axis.y), -(s * axis.x + c * axis.y), axis.x * expected.y - axis.y * expected.x},
              residual, weight);
      cost += weight * residual * residual;
    }
    return cost;
  }

  /// Fits lines from several places when little is known; the resulting places make up one distribution.
  Sight fit_lines(std::span<const Point> points) {
    const bool is_sure = sigma() < 0.15 && sigma_yaw() < 0.12;  // m, rad: lines are not mistaken for each other
    const double reach = is_sure ? 0 : 1.3;
    std::array<Fit, 27> fits;
    std::size_t count = 0;
    double least = 1e9, fitting = 0;
    for (int k = 0; k < 27; ++k) {
      if (is_sure && k > 0) break;
      const double a = reach * (k % 3 == 2 ? -1 : k % 3), b = reach * (k / 3 % 3 == 2 ? -1 : k / 3 % 3),
                   c = reach * (k / 9 == 2 ? -1 : k / 9);
      const Fit fit = fit_lines_from(
          moved(place_, {a * std::sqrt(covariance_.xx), b * std::sqrt(covariance_.yy), c * std::sqrt(covariance_.zz)}),
          points);
      const auto known = std::span(fits).first(count);
      if (std::any_of(known.begin(), known.end(), [&](const Fit& other) { return are_alike(fit, other); })) continue;
      if (fit.cost < least) least = fit.cost, fitting = fit.fitting;
      fits[count++] = fit;
    }
    if (fitting < least_fitting * double(points.size())) return misfit;
    merge(std::span(fits).first(count), least);
    return used;
  }
  static bool are_alike(const Fit& a, const Fit& b) {
    return (a.place.at - b.place.at).norm() < 0.1 && std::abs(wrapped(a.place.yaw - b.place.yaw)) < 0.1;
  }
  /// Fits lines from one place. Points far from a line count at first, and then less and less.
  Fit fit_lines_from(const Place& from, std::span<const Point> points) const {
    constexpr double widths[] = {8, 8, 4, 4, 2, 2, 1, 1, 1};
    const Symmetric3 known = covariance_.inverse();
    Fit fit{from, {}, 0, 0};
    for (std::size_t i = 0; i < std::size(widths); ++i) {
      const Vector3 gone = difference(fit.place);
      LeastSquares sum(known, minus(gone));
      fit.cost = known.square(gone), fit.fitting = 0;
      for (const Point& p : points) add_line(p, widths[i], fit, sum);
      if (i + 1 == std::size(widths))
        fit.covariance = sum.covariance();
      else
        fit.place = moved(fit.place, sum.solution());
    }
    return fit;
  }
  /// Adds the distance from the nearest line, across it, by the error of Geman and McClure: a point farther away than
  /// `width` times the errors of points hardly counts. Errors of one picture are correlated: each point counts in part.
  void add_line(const Point& seen, double width, Fit& fit, LeastSquares& sum) const {
    constexpr double part = 0.3, painted = 0.03;  // m: half the width of a line, and more
    const Point at = fit.place.to_world(seen), off = landmarks_.nearest_on_lines(at) - at;
    const double distance = seen.norm(), e = off.norm();
    if (distance < 0.01) return;
    const Point arm = at - fit.place.at, across = e > 1e-6 ? (1 / e) * off : Point{};
    const double cosine = (across.x * arm.x + across.y * arm.y) / distance;  // to the direction of sight
    const double range = cosine * range_sigma(distance);
    const double side = std::sqrt(std::max(0.0, 1 - cosine * cosine)) * side_sigma(distance);
    const double variance = range * range + side * side;
    const double scale = width * width * (2 * variance + painted * painted);
    const double x = e * e / scale, robust = 1 / ((1 + x) * (1 + x));
    sum.add({across.x, across.y, across.y * arm.x - across.x * arm.y}, e, part * robust / variance);
    fit.cost += part * scale / variance * x / (1 + x);
    fit.fitting += x < 1.5 ? 1 : 0;
  }
  /// Sets mean and covariance of several distributions, each weighted by the likelihood of its cost.
  void merge(std::span<const Fit> fits, double least) {
    double all = 0;
    Vector3 mean{};
    for (const Fit& f : fits) {
      const Vector3 d = difference(f.place);
      const double w = muro_exp(-0.5 * (f.cost - least));
      all += w;
      for (std::size_t i = 0; i < 3; ++i) mean[i] += w * d[i];
    }
    for (double& m : mean) m /= all;
    Symmetric3 c;
    for (const Fit& f : fits) {
      const Vector3 d = difference(f.place);
      const double w = muro_exp(-0.5 * (f.cost - least)) / all, x = d[0] - mean[0], y = d[1] - mean[1],
                   z = d[2] - mean[2];
      const Symmetric3& p = f.covariance;
      c.xx += w * (p.xx + x * x), c.yy += w * (p.yy + y * y), c.zz += w * (p.zz + z * z);
      c.xy += w * (p.xy + x * y), c.xz += w * (p.xz + x * z), c.yz += w * (p.yz + y * z);
    }
    place_ = moved(place_, mean), covariance_ = c;
  }

  Landmarks landmarks_;
  Place place_;
  Symmetric3 covariance_;
  std::int64_t rejected_posts_ = 0, rejected_lines_ = 0;
};

}  // namespace soccer
