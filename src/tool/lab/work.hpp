// The work of a run, known before it begins: what a run may be, and how far a sweep is, on every machine alike.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "result.hpp"
#include "subject.hpp"

namespace isostep::tool::lab {

/// [body sub-steps] The most of a run that nobody asked about. soft_step takes 0.15 to 1.4 us of CPU time for one, so
/// that is some minutes at worst. The tower of the published tests that stands for ten minutes takes 74 million.
inline constexpr double kStandardLimit = 120e6;
/// [body sub-steps] Of a reference, for all runs of a scene are compared with it.
inline constexpr double kReferenceLimit = 10 * kStandardLimit;

/// Steps, times sub-steps and what a step has to do besides, times bodies and joints, times what a solver takes for one
/// of them beside soft_step. In trials worst_first takes 0.4 to 21 us, direct and admm 0.5 us to 1 ms: it depends on
/// how often an island must be factorised, which nobody knows beforehand.
double work_of(const Subject& subject, const LabPoint& point, int frames);

/// "too long: 130 million body sub-steps": why a run of more than the limit is left out.
std::string too_long(double work);

}  // namespace isostep::tool::lab
