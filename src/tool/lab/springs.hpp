// The experiment on stiff springs: where each integrator stays stable, what becomes of the energy, what a step costs.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace isostep::tool::lab {

/// oscillator  one particle on a spring of rest length 0 that is anchored where it rests
/// net         8 by 8 particles, each joined to its four neighbours and the outer ones to a fixed frame by springs of
///             rest length 0, so that it is linear: one particle is pulled aside, which sets off every mode. Its
///             stiffest mode swings as a spring 4 + 4 cos(pi / 9) = 7.76 times as stiff would.
/// Neither damps. Both take 10 s in steps of 0.1 s, which have room for the whole sweep in every scalar.
enum class SpringSystem { oscillator, net };
inline constexpr const char* kSpringSystemNames[] = {"oscillator", "net"};

/// The integrators by their numbers, then the spring of type `stiff`, which takes its exact motion.
inline constexpr int kSpringMethods = 6;
inline constexpr int kExactSpring = 5;
const char* spring_method_name(int method);

/// stable    the energy never exceeds 3/2 of that at the start
/// bounded   it does, but does not keep growing
/// exploded  it keeps growing, exceeds a hundred times that at the start, or had to be cut to the scalar's limits
enum class SpringVerdict { stable, bounded, exploded };
inline constexpr const char* kSpringVerdictNames[] = {"stable", "bounded", "exploded"};

struct SpringSample {
  SpringSystem system;
  const char* scalar;
  int method;
  double stiffness;  // [1] k h^2 / m of one spring
  SpringVerdict verdict;
  double energy;     // [1] of the last second or of when it was cut, of that at the start
  double amplitude;  // [1] largest distance of a particle from where it rests, of the first
  double step_ns;    // CPU time, median of some runs
};

/// The values of k h^2 / m: 25 from 0.01 to 10^4, four a decade; quick: nine.
std::vector<double> spring_stiffnesses(bool quick);
/// One run, and `timings` more that are timed (0: step_ns is 0). `scalar` is of this build.
SpringSample measure_springs(SpringSystem system, const std::string& scalar, int method, double stiffness, int timings);

}  // namespace isostep::tool::lab
