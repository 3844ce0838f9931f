// Sine and cosine of degrees, correctly rounded: the same on every machine.
#pragma once

namespace csgrun {

/// Correctly rounded; exact at multiples of 30 and 45 where the value is a double
/// (sin 30 = 0.5, cos 90 = 0). NaN for non-finite arguments.
double sin_deg(double degrees);
double cos_deg(double degrees);
/// The quotient of the two: within two units in the last place, infinite at odd multiples of 90.
double tan_deg(double degrees);
/// Inverse functions in degrees, within four units in the last place, from +-*/ and square roots
/// only; a whole degree is returned where it maps back exactly (atan2: within 3e-14).
double asin_deg(double x);
double acos_deg(double x);
double atan_deg(double x);
double atan2_deg(double y, double x);

}  // namespace csgrun
