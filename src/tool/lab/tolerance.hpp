// A team's tolerance: what may be wrong in its scene, and by how much.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "result.hpp"
#include "subject.hpp"

namespace isostep::tool::lab {

enum class Quantity { penetration, joint, deviation, energy, unrest, figure };
inline constexpr const char* kQuantityNames[] = {"penetration", "joint", "deviation", "energy", "unrest", "figure"};

/// A bound of a quantity as LabResult has it: [m], [J/kg], or the trial's unit.
struct Bound {
  Quantity quantity;
  double most;
};
struct Tolerance {
  std::string text;  // as it was given
  std::vector<Bound> bounds;
  bool stands = false;  // trials are survived, and what stands in the reference stands
};
inline constexpr const char* kDefaultTolerance = "10mm";

/// "5mm": penetration and joint error, and it stands. Or a list, "penetration=2mm,joint=1mm,energy=0.1,stands": lengths
/// in um, mm, cm or m, energy (its largest gain) and unrest in J/kg, figure in the trial's unit. Throws ToolError 64,
/// which names the place.
Tolerance parse_tolerance(const std::string& text);
/// Throws ToolError 64 where the tolerance bounds a trial's figure and the scene is none.
void require_judge(const Tolerance& tolerance, const Subject& subject);

/// [1] the largest quotient of what is wrong by what may be: held up to 1. Infinite for a run that is not done, had
/// to mend numbers, fell, or was measured against no reference when it should.
double excess_of(const LabResult& result, const Tolerance& tolerance);
/// Returns what is worst: "joint = 1 mm by 3.2 mm", "the fall of what should stand"; empty when the tolerance is held.
std::string miss_of(const LabResult& result, const Tolerance& tolerance);

double measured(const LabResult& result, Quantity quantity);
/// "3.2 mm", "0.1 J/kg", "7".
std::string quantity_text(Quantity quantity, double value);

}  // namespace isostep::tool::lab
