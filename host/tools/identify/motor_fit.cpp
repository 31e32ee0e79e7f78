// SPDX-License-Identifier: MIT
#include "host/tools/identify/motor_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <atomic>
#include <limits>
#include <thread>

#include "core/error.hpp"
#include "host/tools/identify/search_space.hpp"

#ifdef MURO_HAS_NLOPT
#include <nlopt.hpp>
#endif

namespace muro::host {

namespace {

constexpr double coarse_step = 0.006, fine_step = 0.002;  // s
/// Evaluations of the objective for each parameter.
struct Effort {
  unsigned global, coarse, fine;  ///< of the random search; of Subplex in coarse and in fine steps
};
constexpr Effort whole_effort{500, 150, 100}, part_effort{150, 80, 30};
constexpr double huber = 0.01;  // rad: larger errors count by their size, smaller ones by their square

/// The minimized function.
class Objective {
 public:
  Objective(const std::vector<MotorRecord>& records, const SearchSpace& space, double longest_step)
      : records_(&records), space_(&space), longest_step_(longest_step) {
    for (const MotorRecord& r : records) prepared_.push_back(prepare(r, longest_step));
  }

  /// Mean pseudo-Huber error (rad) of the records, each with the same weight; infinite motion is a very large error.
  double operator()(const double* x) const {
    const MotorEstimate e = space_->estimate(x);
    double sum = 0;
    for (std::size_t i = 0; i < prepared_.size(); ++i) {
      PreparedRecord delayed;
      if (e.delay != 0) delayed = prepare((*records_)[i], longest_step_, e.delay);
      sum += error_of_record(e.delay != 0 ? delayed : prepared_[i], e);
    }
    return sum / double(prepared_.size());
  }

 private:
  static double error_of_record(const PreparedRecord& r, const MotorEstimate& e) {
    double sum = 0;
    for (const RecordSegment& s : r.segments)
      simulate(s, r, e, [&](double error, const RecordSegment::Interval&) {
        sum += std::sqrt(error * error + huber * huber) - huber;
      });
    const double mean = sum / double(std::max<std::size_t>(r.sample_count, 1));
    constexpr double far = 1e6;
    return std::isfinite(mean) ? std::min(mean, far) : far;
  }

  const std::vector<MotorRecord>* records_;
  const SearchSpace* space_;
  double longest_step_;
  std::vector<PreparedRecord> prepared_;
};

struct Candidate {
  std::vector<double> x;
  double error = std::numeric_limits<double>::infinity();
  std::uint64_t evaluations = 0;
};

#ifdef MURO_HAS_NLOPT

struct CountedObjective {
  const Objective& objective;
  std::uint64_t evaluations = 0;
};

double call(unsigned, const double* x, double*, void* counted) {
  auto& c = *static_cast<CountedObjective*>(counted);
  ++c.evaluations;
  return c.objective(x);
}

/// Improves `c` with an algorithm of NLopt within `evaluations`.
void improve(nlopt::algorithm algorithm, const Objective& objective, unsigned evaluations, double first_step,
             Candidate& c) {
  nlopt::opt search(algorithm, unsigned(c.x.size()));
  CountedObjective counted{objective};
  search.set_min_objective(call, &counted);
  search.set_lower_bounds(0);
  search.set_upper_bounds(1);
  search.set_maxeval(int(evaluations));
  search.set_xtol_abs(1e-7);
  if (first_step > 0) search.set_initial_step(first_step);
  std::vector<double> x = c.x;
  double error = c.error;
  try {
    search.optimize(x, error);
  } catch (const std::exception&) {  // the best point so far counts
    error = objective(x.data());
  }
  c.evaluations += counted.evaluations;
  if (error < c.error) c.x = x, c.error = error;
}

/// Runs global search number `number`, and refines its result.
Candidate search_from(unsigned number, const Objective& objective, const SearchSpace& space, const FitSettings& s,
                      unsigned global, unsigned local) {
  // NLopt's random numbers are those of the thread
  nlopt::srand(static_cast<unsigned long>(s.seed * 1000003 + number));
  Candidate c;
  c.x.assign(space.size(), 0.5);
  for (std::size_t i = 0; i < space.size(); ++i)
    if (space.parameters()[i].may_be_low) c.x[i] = 0.1;
  improve(nlopt::GN_CRS2_LM, objective, global, 0, c);
  improve(nlopt::LN_SBPLX, objective, local, 0.05, c);
  return c;
}

unsigned evaluations(unsigned wanted, unsigned for_each, const SearchSpace& space) {
  return wanted > 0 ? wanted : for_each * unsigned(space.size());
}

/// Runs all searches on `threads` threads; the result does not depend on their number.
std::vector<Candidate> search_everywhere(const Objective& objective, const SearchSpace& space, const FitSettings& s,
                                         const std::function<void(double)>& show) {
  const unsigned global = evaluations(s.global_evaluations, whole_effort.global, space);
  const unsigned local = evaluations(s.local_evaluations, whole_effort.coarse, space);
  std::vector<Candidate> candidates(s.starts);
  std::atomic<unsigned> next{0}, done{0};
  const auto work = [&] {
    for (unsigned k = next++; k < s.starts; k = next++) {
      candidates[k] = search_from(k, objective, space, s, global, local);
      ++done;
      if (show) show(0.8 * done / s.starts);
    }
  };
  std::vector<std::thread> threads;
  for (unsigned t = 1; t < std::min(std::max(s.threads, 1u), s.starts); ++t) threads.emplace_back(work);
  work();
  for (std::thread& t : threads) t.join();
  return candidates;
}

#endif

/// Sets all parts of the result that follow from `best`.
void take_result(const std::vector<MotorRecord>& records, const SearchSpace& space, const Candidate& best,
                 FitResult& result) {
  result.evaluations += best.evaluations;
  result.estimate = space.estimate(best.x.data());
  result.parameters = space.described(best.x.data());
  for (const MotorRecord& r : records)
    result.mean_error +=
        error_of(prepare(r, fine_step, result.estimate.delay), result.estimate).mean / double(records.size());
}

/// Finds how far each parameter may be changed, with all others adapted, until the RMS error is 1 % larger, from the
/// derivatives of the errors at the optimum. 0 for parameters at a bound.
void find_ranges(const std::vector<MotorRecord>& records, const SearchSpace& space, const Candidate& best,
                 FitResult& result) {
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < space.size(); ++i)
    if (!result.parameters[i].is_at_low && !result.parameters[i].is_at_high) free.push_back(i);
  const auto errors_at = [&](const std::vector<double>& x) {
    const MotorEstimate e = space.estimate(x.data());
    std::vector<double> errors;
    for (const MotorRecord& r : records) {
      const std::vector<double> more = residuals_of(prepare(r, fine_step, e.delay), r, e).errors;
      errors.insert(errors.end(), more.begin(), more.end());
    }
    return errors;
  };
  const std::vector<double> errors = errors_at(best.x);
  const auto rows = Eigen::Index(errors.size()), columns = Eigen::Index(free.size());
  if (columns == 0) return;
  const double squares = Eigen::Map<const Eigen::VectorXd>(errors.data(), rows).squaredNorm();
  Eigen::MatrixXd derivatives(rows, columns);
  constexpr double step = 1e-3;
  for (Eigen::Index k = 0; k < columns; ++k) {
    std::vector<double> up = best.x, down = best.x;
    double& high = up[free[std::size_t(k)]];
    double& low = down[free[std::size_t(k)]];
    high = std::min(high + step, 1.0), low = std::max(low - step, 0.0);
    const std::vector<double> above = errors_at(up), below = errors_at(down);
    for (Eigen::Index i = 0; i < rows; ++i)
      derivatives(i, k) = (above[std::size_t(i)] - below[std::size_t(i)]) / (high - low);
  }
  const Eigen::MatrixXd normal = derivatives.transpose() * derivatives;
  const Eigen::MatrixXd inverse = normal.completeOrthogonalDecomposition().pseudoInverse();
  for (Eigen::Index k = 0; k < columns; ++k) {
    const std::size_t i = free[std::size_t(k)];
    const double range = std::sqrt(std::max(inverse(k, k), 0.0) * 0.02 * squares);
    const double x = best.x[i];
    const double from = space.value(i, std::max(x - range, 0.0)), to = space.value(i, std::min(x + range, 1.0));
    result.parameters[i].deviation = 0.5 * (to - from);
  }
}

void warn_of_bounds(FitResult& result) {
  for (const FitParameter& p : result.parameters) {
    if (p.is_at_low && !p.may_be_low)
      result.warnings.push_back(
          fmt::format("{} is at the lower bound of the search, {:.4g} {}", p.name, p.low, p.unit));
    if (p.is_at_high)
      result.warnings.push_back(
          fmt::format("{} is at the upper bound of the search, {:.4g} {}", p.name, p.high, p.unit));
    const bool matters = p.name != "offset" && p.name != "delay" && p.name.find("stribeck") == std::string::npos;
    if (matters && p.value > 0 && !p.is_at_low && p.deviation > 0.3 * p.value)
      result.warnings.push_back(fmt::format(
          "{} is hardly told by these records: from {:.3g} to {:.3g} {} the error hardly changes, if the others change "
          "with it; records with the torque off while it moves, with more speed or with another load tell more",
          p.name, std::max(p.value - p.deviation, 0.0), p.value + p.deviation, p.unit));
  }
}

}  // namespace

#ifdef MURO_HAS_NLOPT

bool can_fit() { return true; }

FitResult fit_motor(const std::vector<MotorRecord>& records, const FitSettings& settings,
                    const std::function<void(double)>& show) {
  const SearchSpace space(records, settings);
  std::vector<Candidate> all = search_everywhere(Objective(records, space, coarse_step), space, settings, show);
  FitResult result;
  const Candidate* best = &all.front();
  for (const Candidate& c : all) {
    result.evaluations += c.evaluations;
    if (c.error < best->error) best = &c;
  }
  const Objective fine(records, space, fine_step);
  Candidate last = *best;
  last.evaluations = 0;
  last.error = fine(last.x.data());
  const unsigned local = evaluations(settings.local_evaluations, whole_effort.fine, space);
  improve(nlopt::LN_SBPLX, fine, local, 0.02, last);
  if (show) show(0.9);
  improve(nlopt::LN_SBPLX, fine, local, 0.005, last);
  take_result(records, space, last, result);
  find_ranges(records, space, last, result);
  warn_of_bounds(result);
  result.optima.push_back(result.parameters);
  for (const Candidate& c : all) result.optima.push_back(space.described(c.x.data()));
  if (show) show(1);
  return result;
}

FitResult refit_motor(const std::vector<MotorRecord>& records, const FitSettings& settings, const FitResult& whole) {
  const SearchSpace space(records, settings);
  const Objective coarse(records, space, coarse_step), fine(records, space, fine_step);
  const unsigned global = evaluations(settings.global_evaluations, part_effort.global, space);
  const unsigned local = evaluations(settings.local_evaluations, part_effort.coarse, space);
  Candidate near;
  for (const std::vector<FitParameter>& optimum : whole.optima) {
    Candidate c;
    c.x = space.coordinates(optimum);
    c.error = coarse(c.x.data());
    if (near.x.empty() || c.error < near.error) near = c;
  }
  improve(nlopt::LN_SBPLX, coarse, local, 0.05, near);
  // own search, so that parameters which these records do not determine are not taken only from the others
  const Candidate own = search_from(settings.starts, coarse, space, settings, global, local);
  Candidate best = own.error < near.error ? own : near;
  best.evaluations = own.evaluations + near.evaluations;
  best.error = fine(best.x.data());
  improve(nlopt::LN_SBPLX, fine, evaluations(settings.local_evaluations, part_effort.fine, space), 0.02, best);
  FitResult result;
  take_result(records, space, best, result);
  return result;
}

#else

bool can_fit() { return false; }

FitResult fit_motor(const std::vector<MotorRecord>&, const FitSettings&, const std::function<void(double)>&) {
  throw SetupError("this muro was built without NLopt, which the search needs (Debian: libnlopt-cxx-dev)");
}

FitResult refit_motor(const std::vector<MotorRecord>& records, const FitSettings& settings, const FitResult&) {
  return fit_motor(records, settings);
}

#endif

}  // namespace muro::host
