// SPDX-License-Identifier: MIT
// A sparse symmetric positive definite system of linear equations in blocks of 6: one block a rigid body, one coupling
// for two bodies that touch.
//
// It is solved by conjugate gradients, preconditioned by an incomplete Cholesky factorisation in blocks that fills
// nothing in (Meijerink and van der Vorst, An iterative solution method for linear systems of which the coefficient
// matrix is a symmetric M-matrix, Math. Comp. 31, 1977). Bodies that touch nothing but one more are eliminated first,
// so that the factorisation of a tree (a stack, a load on four wheels) is exact and one iteration is enough.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace muro::penalty {

/// L L' of a symmetric positive definite block. (That of Eigen is made for large matrices.)
class BlockFactor {
 public:
  using Block = Eigen::Matrix<double, 6, 6>;
  using Vector = Eigen::Matrix<double, 6, 1>;

  /// From the lower triangle. Returns false, and is of no use, where the block is not positive definite.
  bool compute(const Block& block);
  /// Solves for one right side.
  Vector solve(Vector right) const;
  /// Of each row of `rows` the solution for it as right side.
  void divide(Block& rows) const;

 private:
  Block lower_;      ///< below the diagonal
  Vector inverses_;  ///< of the diagonal
};

class BlockSystem {
 public:
  using Block = BlockFactor::Block;
  using Vector = BlockFactor::Vector;
  static constexpr std::uint32_t no_coupling = std::numeric_limits<std::uint32_t>::max();

  /// Starts a system without couplings.
  void start(std::uint32_t bodies);
  /// The coupling of two bodies; the same one whenever it is asked for.
  std::uint32_t couple(std::uint32_t a, std::uint32_t b);
  /// Call it when all couplings are known. All blocks are 0 then.
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

  /// x: in, a guess; out, the solution. Ends when the error of x in the norm of the system, squared, is about
  /// `tolerance`. Returns the number of iterations.
  int solve(std::span<const Vector> right, std::span<Vector> x, double tolerance);

 private:
  struct Coupling {
    std::uint32_t rows, columns;  ///< bodies; `columns` is eliminated first once the order is known
    std::uint32_t before;         ///< coupling of the same first body that was made before, or no_coupling
    Block block, factor;
  };
  /// Of one body, in `links_`.
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
  std::vector<std::uint32_t> newest_;  ///< by first body: its newest coupling
  std::vector<std::uint32_t> first_link_, order_, rank_, degree_;
  std::vector<Vector> residual_, direction_, image_, preconditioned_;
};

}  // namespace muro::penalty
