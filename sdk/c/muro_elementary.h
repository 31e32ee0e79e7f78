/* SPDX-License-Identifier: MIT
 *
 * Elementary functions with equal bits on every machine, for control code. Those of <math.h> depend on the processor,
 * with fused multiply-add or without, and differ in the last bit. C11 and C++. Link muro::elementary, or -lsleef, and
 * compile with -ffp-contract=off, so that the compiler itself does not use fused multiply-add.
 *
 * They are those of SLEEF without fused multiply-add, at most 1 ulp from the true value, with the special values of C
 * (annex F); angles are in rad. Functions of <math.h> with exact results are equal everywhere by themselves and have
 * no namesake here: sqrt, fabs, floor, ceil, trunc, round, nearbyint, fmod, remainder, fmin, fmax, fma.
 * muro/base/elementary.hpp offers the same to plugins, bit for bit.
 */
#ifndef MURO_ELEMENTARY_H
#define MURO_ELEMENTARY_H

#ifdef __cplusplus
extern "C" {
#endif

#define MURO_BY_SLEEF(function) __asm__("Sleef_cinz_" #function "purec")

double muro_sin(double angle) MURO_BY_SLEEF(sind1_u10);
double muro_cos(double angle) MURO_BY_SLEEF(cosd1_u10);
double muro_tan(double angle) MURO_BY_SLEEF(tand1_u10);
double muro_asin(double x) MURO_BY_SLEEF(asind1_u10);
double muro_acos(double x) MURO_BY_SLEEF(acosd1_u10);
double muro_atan(double x) MURO_BY_SLEEF(atand1_u10);
double muro_atan2(double y, double x) MURO_BY_SLEEF(atan2d1_u10);
double muro_sinh(double x) MURO_BY_SLEEF(sinhd1_u10);
double muro_cosh(double x) MURO_BY_SLEEF(coshd1_u10);
double muro_tanh(double x) MURO_BY_SLEEF(tanhd1_u10);
/* infinite from 1.3e154 on: muro_asinh, muro_acosh; from 1e307 on: muro_log1p */
double muro_asinh(double x) MURO_BY_SLEEF(asinhd1_u10);
double muro_acosh(double x) MURO_BY_SLEEF(acoshd1_u10);
double muro_atanh(double x) MURO_BY_SLEEF(atanhd1_u10);
double muro_exp(double x) MURO_BY_SLEEF(expd1_u10);
double muro_exp2(double x) MURO_BY_SLEEF(exp2d1_u10);
double muro_expm1(double x) MURO_BY_SLEEF(expm1d1_u10);
double muro_log(double x) MURO_BY_SLEEF(logd1_u10);
double muro_log2(double x) MURO_BY_SLEEF(log2d1_u10);
double muro_log10(double x) MURO_BY_SLEEF(log10d1_u10);
double muro_log1p(double x) MURO_BY_SLEEF(log1pd1_u10);
double muro_pow(double base, double exponent) MURO_BY_SLEEF(powd1_u10);
double muro_cbrt(double x) MURO_BY_SLEEF(cbrtd1_u10);
double muro_hypot(double x, double y) MURO_BY_SLEEF(hypotd1_u05); /* sqrt(x^2 + y^2), without overflow */

typedef struct {
  double sine, cosine;
} muro_sine_and_cosine;
muro_sine_and_cosine muro_sincos_by_value(double angle) MURO_BY_SLEEF(sincosd1_u10);

/* Sine and cosine for little more than the cost of one. The last bit may differ from that of muro_sin and muro_cos. */
static inline void muro_sincos(double angle, double* sine, double* cosine) {
  const muro_sine_and_cosine both = muro_sincos_by_value(angle);
  *sine = both.sine;
  *cosine = both.cosine;
}

#undef MURO_BY_SLEEF

#ifdef __cplusplus
}
#endif

#endif
