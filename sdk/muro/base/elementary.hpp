// SPDX-License-Identifier: MIT
// Elementary functions with equal bits on every machine, at most 1 ulp from the true value.
//
// The C library chooses its functions by processor, with fused multiply-add or without, and the results differ in the
// last bit. Code that influences state therefore uses these functions, in set-up and in steps. They are the functions
// of SLEEF that give the same bits with and without fused multiply-add, for one number and for packs
// (muro/simd/trig.hpp). Functions of <cmath> with exact results are equal everywhere and are not repeated here: sqrt,
// fabs, floor, ceil, trunc, round, nearbyint, fmod, remainder, ldexp, frexp, nextafter, fma.
//
// Link muro::sdk, or -lsleef. Angles are in rad. Special values are those of C (annex F): NaN outside of the domain.
#pragma once

namespace muro::elementary {

struct SinCos {
  double sin, cos;
};

// Own declarations of functions that <sleef.h> declares too: that header takes long to compile because of its packs.
// Both may be included.
#define MURO_BY_SLEEF(function) __asm__("Sleef_cinz_" #function "purec")
#define MURO_PURE [[gnu::const, gnu::nothrow]]

MURO_PURE double sin(double angle) MURO_BY_SLEEF(sind1_u10);
MURO_PURE double cos(double angle) MURO_BY_SLEEF(cosd1_u10);
/// Sine and cosine for little more than the cost of one. The last bit may differ from that of `sin` and `cos`.
MURO_PURE SinCos sincos(double angle) MURO_BY_SLEEF(sincosd1_u10);
MURO_PURE double tan(double angle) MURO_BY_SLEEF(tand1_u10);
MURO_PURE double asin(double x) MURO_BY_SLEEF(asind1_u10);
MURO_PURE double acos(double x) MURO_BY_SLEEF(acosd1_u10);
MURO_PURE double atan(double x) MURO_BY_SLEEF(atand1_u10);
/// Angle from the x axis to (x, y), from -pi to pi.
MURO_PURE double atan2(double y, double x) MURO_BY_SLEEF(atan2d1_u10);
MURO_PURE double sinh(double x) MURO_BY_SLEEF(sinhd1_u10);
MURO_PURE double cosh(double x) MURO_BY_SLEEF(coshd1_u10);
MURO_PURE double tanh(double x) MURO_BY_SLEEF(tanhd1_u10);
// infinite from 1.3e154 on: asinh, acosh; from 1e307 on: log1p
MURO_PURE double asinh(double x) MURO_BY_SLEEF(asinhd1_u10);
MURO_PURE double acosh(double x) MURO_BY_SLEEF(acoshd1_u10);
MURO_PURE double atanh(double x) MURO_BY_SLEEF(atanhd1_u10);
MURO_PURE double exp(double x) MURO_BY_SLEEF(expd1_u10);
MURO_PURE double exp2(double x) MURO_BY_SLEEF(exp2d1_u10);
MURO_PURE double expm1(double x) MURO_BY_SLEEF(expm1d1_u10);
MURO_PURE double log(double x) MURO_BY_SLEEF(logd1_u10);
MURO_PURE double log2(double x) MURO_BY_SLEEF(log2d1_u10);
MURO_PURE double log10(double x) MURO_BY_SLEEF(log10d1_u10);
MURO_PURE double log1p(double x) MURO_BY_SLEEF(log1pd1_u10);
MURO_PURE double pow(double base, double exponent) MURO_BY_SLEEF(powd1_u10);
MURO_PURE double cbrt(double x) MURO_BY_SLEEF(cbrtd1_u10);
/// sqrt(x^2 + y^2), without overflow in between.
MURO_PURE double hypot(double x, double y) MURO_BY_SLEEF(hypotd1_u05);

#undef MURO_BY_SLEEF
#undef MURO_PURE

}  // namespace muro::elementary
