// The advice of a sweep: the front of cost against error, and the cheapest setting that holds a tolerance.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "result.hpp"
#include "tolerance.hpp"

namespace isostep::tool::lab {

/// Places of the runs that no other one equals or beats in both `ms` and excess_of, being better in one: cheapest
/// first, and so the most wrong first. Runs of infinite excess are not among them; of equals the first is.
std::vector<std::size_t> front_of(const std::vector<LabResult>& results, const Tolerance& tolerance);

struct Advice {
  std::optional<std::size_t> best;  // the cheapest run that holds, else the one that comes closest
  std::optional<std::size_t> own;   // the scene's own setting in that scalar
  bool holds = false;
  std::string text;  // one line
};
/// Advises from the runs of one scene in one scalar, or in all of them when `scalar` is empty. `own` is the scene's
/// setting, whatever its scalar: see default_point.
Advice advise(const std::vector<LabResult>& results, const Tolerance& tolerance, const LabPoint& own,
              const std::string& scalar = "");

/// "q32.32, direct, 2 sub-steps at 60 Hz, as spheres".
std::string setting_text(const LabPoint& point);

}  // namespace isostep::tool::lab
