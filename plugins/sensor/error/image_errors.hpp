// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "error_chain.hpp"
#include "muro/handles.hpp"

namespace muro {

/// The reading of an array of f32, such as the depth of a camera. Pixels that see nothing are infinite, and stay
/// infinite.
class ImageErrors {
 public:
  ImageErrors() = default;
  ImageErrors(ArrayIn<float> truth, ArrayOut<float> measured) : truth_(truth), measured_(measured) {}

  explicit operator bool() const { return bool(truth_); }

  void apply(const ErrorChain& chain, std::span<double> state, const ErrorChain::Sample& sample) const {
    thread_local std::vector<double> truth, measured;
    const std::span<const float> pixels = *truth_;
    truth.assign(pixels.begin(), pixels.end());
    measured.resize(pixels.size());
    chain.apply(truth, measured, state, sample);
    std::transform(measured.begin(), measured.end(), (*measured_).begin(), [](double x) { return float(x); });
  }

 private:
  ArrayIn<float> truth_;
  ArrayOut<float> measured_;
};

}  // namespace muro
