// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Functions that have the same bits on every processor and system. Those of `<cmath>` do not: each
/// C library rounds them in its own way, and glibc chooses among variants by the processor. These
/// use nothing but +, -, *, /, square roots and exact functions (floor, frexp, ldexp, fmod), which
/// IEEE 754 defines. Their errors were measured against the long doubles of x86-64, see
/// portable_math_test.cpp: below 1 ulp for sin, cos, exp, log and cbrt, 2 for log10, atan2 and
/// acos, 3 for tanh, and 5 for pow.
namespace wscvt::portable {

/// Angles in radians, of at most a million. Larger ones lose digits.
double sin(double angle);
double cos(double angle);

/// Result in radians, -pi to pi. atan2(0, 0) is 0.
double atan2(double y, double x);
/// Result in radians, 0 to pi; NaN outside of -1 to 1.
double acos(double x);

double exp(double x);
double tanh(double x);

/// NaN below 0, -infinity at 0.
double log(double x);
/// Exact at the powers of ten from 1e-22 to 1e22.
double log10(double x);
/// Absolute error below 1e-16, for -1 to 1.
double atanh(double x);

/// x to the power of y; NaN if x < 0 and y is not whole. Whole powers up to 32 are products, exact
/// if all of them are, as for 10^n up to 1e22.
double pow(double x, double y);
double cbrt(double x);

/// Length of (x, y). It overflows above 1e154.
double hypot(double x, double y);

}  // namespace wscvt::portable
