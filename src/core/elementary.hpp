// SPDX-License-Identifier: BSD-3-Clause
// Elementary functions with the same bits on every machine. These functions are
// needed because sizes and shapes given as formulas determine meshes, and the functions of C libraries differ in the
// last bit between versions and processors.
#pragma once

/// The functions use only + - * /, sqrt, comparisons and the bits of a double, so their results do not depend on
/// compiler, optimisation or processor. Errors are below 0.52 units in the last place of the result. Special values
/// (infinities, NaN, zeros with their sign, the table of pow) are those of the C standard, annex F. The floating-point
/// flags are unspecified, and errno is not set. @pre the rounding mode is to nearest
namespace trime::elementary {

/// @brief Trigonometric functions. Any finite argument is reduced with as many bits of 2/pi as it needs.
double sin(double x);
double cos(double x);
double tan(double x);

double asin(double x);
double acos(double x);
double atan(double x);
double atan2(double y, double x);

double exp(double x);
double sinh(double x);
double cosh(double x);
double tanh(double x);

double log(double x); ///< natural logarithm
double log2(double x);
double log10(double x);
double asinh(double x);
double acosh(double x);
double atanh(double x);

/// @brief Returns x to the power y. Squares, 1/x and square roots are rounded to nearest.
double pow(double x, double y);

} // namespace trime::elementary
