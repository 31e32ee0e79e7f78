// SPDX-License-Identifier: MIT
// A sparse symmetric positive definite system of linear equations in blocks of 6: one block for each rigid body, one
// coupling for each two bodies that touch.
//
// It is solved by conjugate gradients, preconditioned by an incomplete Cholesky factorisation in blocks without fill-in
// (Meijerink and van der Vorst, An iterative solution method for linear systems of which the coefficient matrix is a
// symmetric M-matrix, Math. Comp. 31, 1977). Bodies that touch only one other body are eliminated first. So the
// factorisation of a tree (a stack, a load on four wheels) is exact and one iteration is enough.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace muro::penalty {

/// Cholesky factor L L' of a symmetric positive definite block. (That of Eigen is made for large matrices.)
class BlockFactor {
 public:
  using Block = Eigen::Matrix<double, 6, 6>;
  using Vector = Eigen::Matrix<double, 6, 1>;

  /// Computes the factor from the lower triangle. Returns false if the block is not positive definite; then the factor
  /// is of no use.
  bool compute(const Block& block);
  /// Solves for one right side.
  Vector solve(Vector right) const;
  /// Replaces each row of `rows` by the solution for it as right side.
  void divide(Block& rows) const;

 private:
  Block lower_;      ///< below the diagonal
  Vector inverses_;  ///< of the elements of the diagonal
};

class BlockSystem {
 public:
  using Block = BlockFactor::Block;
  using Vector = BlockFactor::Vector;
  static constexpr std::uint32_t no_coupling = std::numeric_limits<std::uint32_t>::max();

  /// Starts a system without couplings.
  void start(std::uint32_t bodies);
  /// Returns the coupling of two bodies; the same one in each call for these bodies.
  std::uint32_t couple(std::uint32_t a, std::uint32_t b);
  /// Finds the order of elimination and sets all blocks to 0. Call it when all couplings are known.
  void find_order();
  void set_zero();

  Block& diagonal(std::uint32_t body) { return diagonals_[body]; }
  /// Adds the block in the rows of `a` and the columns of `b`; its transpose goes to the other side.
  void add(std::uint32_t coupling, std::uint32_t a, const Block& block) {
    if (couplings_[coupling].rows == a)
      couplings_[coupling].block += block;
    else
      couplings_[coupling].block += block.transpose();
  }

  /// Solves the system. `x`: in, a guess; out, the solution. Ends when the squared error of x, in the norm of the
  /// system, is about `tolerance`. Returns the number of iterations.
  int solve(std::span<const Vector> right, std::span<Vector> x, double tolerance);

 private:
  struct Coupling {
    std::uint32_t rows, columns;  ///< bodies; `columns` is eliminated first once the order is known
    std::uint32_t before;         ///< coupling of the same first body that was made before, or no_coupling
    Block block, factor;
  };
  /// Neighbour of a body, in `links_`, and their coupling.
  struct Link {
    std::uint32_t body, coupling;
  };
  std::span<const Link> links(std::uint32_t body) const {
    return {links_.data() + first_link_[body], links_.data() + first_link_[body + 1]};
  }
  std::uint32_t coupling_of(std::uint32_t a, std::uint32_t b) const;
  void find_links();
  void factorise();
  void precondition(std::span<const Vector> r, std::span<Vector> z) const;
  void multiply(std::span<const Vector> x, std::span<Vector> y) const;

  std::vector<Block> diagonals_, pivots_;
  std::vector<BlockFactor> factors_;
  std::vector<Coupling> couplings_;
  std::vector<Link> links_;
  std::vector<std::uint32_t> newest_;  ///< for each first body: its newest coupling
  std::vector<std::uint32_t> first_link_, order_, rank_, degree_;
  std::vector<Vector> residual_, direction_, image_, preconditioned_;
};

}  // namespace muro::penalty
