// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "muro/connector.hpp"

namespace muro::control {

/// One input or output of one robot: the scalars of one or several properties, as contiguous doubles.
class Port {
 public:
  /// `handle` is what Connector::read_any or write_any returned for `property`. [setup]
  void add(const FoundProperty& property, void* handle);
  /// Looks up the addresses and lengths of arrays. [start]
  void resolve();

  /// Number of doubles; known once resolved.
  std::uint32_t size() const { return size_; }
  /// The scalars themselves when they are one segment of doubles, so that nothing is copied; else null.
  double* direct() const { return direct_; }

  void read(double* to) const;
  /// Rounds to whole numbers where the property holds such. False when a number does not fit into its property; `bad`
  /// is then its index, and those behind it are not written.
  bool write(const double* from, std::uint32_t& bad) const;

 private:
  struct Segment {  ///< contiguous scalars
    void* handle = nullptr;
    Multiplicity multiplicity = Multiplicity::single;
    Scalar scalar = Scalar::f64;
    std::uint32_t per_element = 1;
    void* data = nullptr;
    std::uint32_t count = 0;
  };

  std::vector<Segment> segments_;
  std::uint32_t size_ = 0;
  double* direct_ = nullptr;
};

}  // namespace muro::control
