// One run of the laboratory, and the reference that others are compared with.
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "result.hpp"
#include "scenes/sight.hpp"
#include "subject.hpp"

namespace isostep::tool::lab {

/// The most careful run of the scene: double, 64 sub-steps, and the direct solver where there are joints and nothing
/// that can touch, for there it is exact and contacts never leave it without an answer; else soft step.
struct Reference {
  LabPoint point;
  bool exists = false;                // it ran for the second without a fault
  scenes::Sight start, second;        // after 1 s, or at the end of a shorter run
  std::vector<std::size_t> standing;  // bodies that hardly move from their start up to the end
};

/// [m] root mean square over bodies that move; below 0 where there are not the same bodies.
double deviation_of(const scenes::Sight& a, const scenes::Sight& b);
/// All that hardly moves in the reference is still there in the end.
bool stands(const Subject& subject, const Reference& reference, const scenes::Sight& end);

/// It is called now and then: true, and the run ends as if it had never been.
using Cancel = std::function<bool()>;
struct Cancelled {};

LabPoint reference_point(const Subject& subject);
/// `frames` at the scene's own rate. Where they are too long (kReferenceLimit) it does without what stands at the end,
/// or without all. Throws Cancelled.
Reference reference_of(const Subject& subject, int frames, const Cancel& cancel);

/// `frames` at the point's rate. Throws Cancelled.
LabResult run_point(const Subject& subject, const LabPoint& point, const Reference& reference, int frames,
                    const Cancel& cancel);

}  // namespace isostep::tool::lab
