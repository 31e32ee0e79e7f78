// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "muro/parameter.hpp"

namespace muro {

inline constexpr std::string_view dropout_readings[] = {"value", "hold"};

/// Parameters of the errors of a reading, in the order in which they act. Parts have the same parameters.
inline constexpr Parameter error_parameters[] = {
    reals("bandwidth", "Hz", {}, "at which 1/sqrt(2) of the amplitude passes; 0: no low-pass").between(0, 1e9),
    integer("bandwidth_order", 1, "of the low-pass: 1, or 2 (Butterworth)").between(1, 2),
    reals("scale", "1", {}, "scale error: the reading is 1 + scale times as large").between(-10, 10),
    reals("scale_tolerance", "1", {}, "three standard deviations of a further scale error, drawn once a run")
        .between(0, 10),
    reals("misalignment", "1", {}, "of a vector: what x reads of y and z, y of x and z, z of x and y (six numbers)")
        .between(-10, 10),
    reals("cross_axis_tolerance", "1", {},
          "of a vector: three standard deviations of a further misalignment, drawn once a run; one number, or six")
        .between(0, 10),
    reals(
        "g_sensitivity", "as read by m/s^2", {},
        "of a vector: what it reads of the specific force `linear_acceleration` of the same object; one number, three "
        "of a diagonal, or nine, row by row")
        .between(-1e9, 1e9),
    reals("bias", "as read", {}, "added to every reading").between(-1e9, 1e9),
    reals("turn_on_bias_tolerance", "as read", {}, "three standard deviations of a further bias, drawn once a run")
        .between(0, 1e9),
    reals("random_walk", "as read by s sqrt(Hz)", {}, "density K of a bias that walks: its variance is K^2 t")
        .between(0, 1e9),
    reals("gauss_markov_sigma", "as read", {},
          "stationary standard deviation of a bias with the correlation exp(-lag / gauss_markov_time)")
        .between(0, 1e9),
    reals("gauss_markov_density", "as read by s sqrt(Hz)", {},
          "the same by the density K of the noise that drives it: gauss_markov_sigma is K sqrt(gauss_markov_time / 2)")
        .between(0, 1e9),
    real("gauss_markov_time", "s", 0, "correlation time; needed with the one or the other").between(0, 1e9),
    reals("bias_instability", "as read", {},
          "B of flicker noise: its Allan deviation is 0.664 B from flicker_from to flicker_to")
        .between(0, 1e9),
    real("flicker_from", "s", 1, "averaging time from which the Allan deviation of flicker is flat").between(1e-6, 1e9),
    real("flicker_to", "s", 1000, "averaging time up to which it is").between(1e-6, 1e9),
    reals("noise_density", "as read by sqrt(Hz)", {},
          "of white noise of a device that averages: a sample has the deviation N sqrt(rate)")
        .between(0, 1e9),
    reals("sigma", "as read", {}, "standard deviation of the noise of a sample, at any rate").between(0, 1e9),
    reals("sigma_relative", "1", {}, "standard deviation of further noise, in proportion to the reading")
        .between(0, 1e3),
    real("sigma_quadratic", "1 by as read", 0,
         "standard deviation of further noise, in proportion to the square of the reading: of depth by triangulation")
        .between(0, 1e3),
    real("pointing", "rad", 0,
         "standard deviation of a ray's direction: adds noise with the angle of incidence; needs laser.incidence")
        .between(0, 1),
    real("correlation", "1", 0, "of the noise of neighbours in an array").between(-1, 1),
    real("full_scale", "as read", 0, "the reading saturates at this and at its negative; 0: nowhere").between(0, 1e9),
    integer("bits", 0, "of the converter, from -full_scale to full_scale; 0: none").between(0, 48),
    reals("resolution", "as read", {}, "readings are multiples of this; 0: any value").between(0, 1e9),
    real("minimum", "as read", 0, "smallest reading; not given: laser.min_range, otherwise none"),
    real("maximum", "as read", 0, "largest reading; not given: laser.max_range, otherwise none"),
    real("delay", "s", 0, "by which the reading is late, at least; whole readings").between(0, 1e6),
    real("dropout", "1", 0, "probability that a reading is lost").between(0, 1),
    real("dropout_value", "as read", 0, "what a lost reading reads"),
    text("dropout_reads", "value", "what a lost reading reads: `value`: dropout_value, `hold`: what was read before")
        .one_of(dropout_readings),
};

}  // namespace muro
