// SPDX-License-Identifier: MIT
#include "block_system.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace muro::penalty {

bool BlockFactor::compute(const Block& block) {
  for (int j = 0; j < 6; ++j) {
    double square = block(j, j);
    for (int k = 0; k < j; ++k) square -= lower_(j, k) * lower_(j, k);
    if (!(square > 0)) return false;
    const double inverse = inverses_[j] = 1 / std::sqrt(square);
    for (int i = j + 1; i < 6; ++i) {
      double sum = block(i, j);
      for (int k = 0; k < j; ++k) sum -= lower_(i, k) * lower_(j, k);
      lower_(i, j) = sum * inverse;
    }
  }
  return true;
}

BlockFactor::Vector BlockFactor::solve(Vector right) const {
  for (int j = 0; j < 6; ++j) {
    right[j] *= inverses_[j];
    for (int i = j + 1; i < 6; ++i) right[i] -= lower_(i, j) * right[j];
  }
  for (int j = 5; j >= 0; --j) {
    for (int i = j + 1; i < 6; ++i) right[j] -= lower_(i, j) * right[i];
    right[j] *= inverses_[j];
  }
  return right;
}

void BlockFactor::divide(Block& rows) const {
  for (int j = 0; j < 6; ++j) {
    for (int k = 0; k < j; ++k) rows.col(j) -= lower_(j, k) * rows.col(k);
    rows.col(j) *= inverses_[j];
  }
  for (int j = 5; j >= 0; --j) {
    for (int i = j + 1; i < 6; ++i) rows.col(j) -= lower_(i, j) * rows.col(i);
    rows.col(j) *= inverses_[j];
  }
}

void BlockSystem::start(std::uint32_t bodies) {
  diagonals_.resize(bodies);
  pivots_.resize(bodies);
  factors_.resize(bodies);
  for (std::vector<Vector>* v : {&residual_, &direction_, &image_, &preconditioned_}) v->resize(bodies);
  couplings_.clear();
  newest_.assign(bodies, no_coupling);
}

std::uint32_t BlockSystem::couple(std::uint32_t a, std::uint32_t b) {
  std::uint32_t& newest = newest_[std::min(a, b)];
  for (std::uint32_t k = newest; k != no_coupling; k = couplings_[k].before)
    if (couplings_[k].rows == std::min(a, b) && couplings_[k].columns == std::max(a, b)) return k;
  couplings_.push_back({std::min(a, b), std::max(a, b), newest, Block::Zero(), Block::Zero()});
  return newest = std::uint32_t(couplings_.size() - 1);
}

void BlockSystem::find_links() {
  const std::size_t bodies = diagonals_.size();
  first_link_.assign(bodies + 1, 0);
  for (const Coupling& c : couplings_) ++first_link_[c.rows + 1], ++first_link_[c.columns + 1];
  for (std::size_t i = 0; i < bodies; ++i) first_link_[i + 1] += first_link_[i];
  links_.resize(2 * couplings_.size());
  degree_.assign(bodies, 0);
  for (std::uint32_t k = 0; k < couplings_.size(); ++k) {
    const std::uint32_t a = couplings_[k].rows, b = couplings_[k].columns;
    links_[first_link_[a] + degree_[a]++] = {b, k};
    links_[first_link_[b] + degree_[b]++] = {a, k};
  }
}

/// Eliminates leaves first, repeatedly. If there is no leaf, eliminates the body with the fewest remaining neighbours.
void BlockSystem::find_order() {
  find_links();
  const auto bodies = std::uint32_t(diagonals_.size());
  constexpr std::uint32_t open = std::numeric_limits<std::uint32_t>::max();
  rank_.assign(bodies, open);
  order_.clear();
  const auto eliminate = [&](std::uint32_t body) {
    rank_[body] = std::uint32_t(order_.size());
    order_.push_back(body);
    for (const Link& l : links(body)) --degree_[l.body];
  };
  for (std::uint32_t next = 0; order_.size() < bodies;) {
    while (next < bodies && rank_[next] != open) ++next;
    std::uint32_t first = next;
    for (std::uint32_t i = next; i < bodies; ++i)
      if (rank_[i] == open && degree_[i] < degree_[first]) {
        first = i;
        if (degree_[i] <= 1) break;
      }
    std::size_t done = order_.size();
    eliminate(first);
    for (; done < order_.size(); ++done)  // a branch up to its end
      for (const Link& l : links(order_[done]))
        if (rank_[l.body] == open && degree_[l.body] <= 1) eliminate(l.body);
  }
  for (Coupling& c : couplings_)
    if (rank_[c.rows] < rank_[c.columns]) std::swap(c.rows, c.columns);
  set_zero();
}

void BlockSystem::set_zero() {
  for (Block& d : diagonals_) d.setZero();
  for (Coupling& c : couplings_) c.block.setZero();
}

std::uint32_t BlockSystem::coupling_of(std::uint32_t a, std::uint32_t b) const {
  for (const Link& l : links(a))
    if (l.body == b) return l.coupling;
  return no_coupling;
}

/// Computes L D L', only in the blocks that exist.
void BlockSystem::factorise() {
  std::copy(diagonals_.begin(), diagonals_.end(), pivots_.begin());
  for (Coupling& c : couplings_) c.factor = c.block;
  for (const std::uint32_t body : order_) {
    // without fill-in, too much may have been subtracted from it
    if (!factors_[body].compute(pivots_[body])) factors_[body].compute(diagonals_[body]);
    for (const Link& l : links(body)) {
      if (rank_[l.body] < rank_[body]) continue;
      const Block row = couplings_[l.coupling].factor;  // before it is divided
      Block divided = row;
      factors_[body].divide(divided);
      pivots_[l.body].noalias() -= divided.lazyProduct(row.transpose());
      for (const Link& m : links(body)) {
        if (rank_[m.body] <= rank_[l.body]) continue;
        const std::uint32_t both = coupling_of(l.body, m.body);
        // factors of later rows are not divided yet
        if (both != no_coupling)
          couplings_[both].factor.noalias() -= couplings_[m.coupling].factor.lazyProduct(divided.transpose());
      }
    }
    for (const Link& l : links(body))
      if (rank_[l.body] > rank_[body]) factors_[body].divide(couplings_[l.coupling].factor);
  }
}

void BlockSystem::precondition(std::span<const Vector> r, std::span<Vector> z) const {
  std::copy(r.begin(), r.end(), z.begin());
  for (const std::uint32_t body : order_)
    for (const Link& l : links(body))
      if (rank_[l.body] > rank_[body]) z[l.body].noalias() -= couplings_[l.coupling].factor * z[body];
  for (std::size_t i = order_.size(); i-- > 0;) {
    const std::uint32_t body = order_[i];
    Vector solved = factors_[body].solve(z[body]);
    for (const Link& l : links(body))
      if (rank_[l.body] > rank_[body]) solved.noalias() -= couplings_[l.coupling].factor.transpose() * z[l.body];
    z[body] = solved;
  }
}

void BlockSystem::multiply(std::span<const Vector> x, std::span<Vector> y) const {
  for (std::size_t i = 0; i < diagonals_.size(); ++i) y[i].noalias() = diagonals_[i] * x[i];
  for (const Coupling& c : couplings_) {
    y[c.rows].noalias() += c.block * x[c.columns];
    y[c.columns].noalias() += c.block.transpose() * x[c.rows];
  }
}

int BlockSystem::solve(std::span<const Vector> right, std::span<Vector> x, double tolerance) {
  constexpr int most_iterations = 200;
  const auto product = [](std::span<const Vector> a, std::span<const Vector> b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
    return sum;
  };
  factorise();
  multiply(x, image_);
  for (std::size_t i = 0; i < residual_.size(); ++i) residual_[i] = right[i] - image_[i];
  precondition(residual_, preconditioned_);
  std::copy(preconditioned_.begin(), preconditioned_.end(), direction_.begin());
  double size = product(residual_, preconditioned_);
  int iteration = 0;
  while (size > tolerance && iteration < most_iterations) {
    ++iteration;
    multiply(direction_, image_);
    const double step = size / product(direction_, image_);
    for (std::size_t i = 0; i < residual_.size(); ++i) {
      x[i] += step * direction_[i];
      residual_[i] -= step * image_[i];
    }
    precondition(residual_, preconditioned_);
    const double next = product(residual_, preconditioned_);
    for (std::size_t i = 0; i < residual_.size(); ++i) direction_[i] = preconditioned_[i] + next / size * direction_[i];
    size = next;
  }
  return iteration;
}

}  // namespace muro::penalty
