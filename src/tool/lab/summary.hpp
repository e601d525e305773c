// The output of `isostep lab SCENE`: a table of the front and a line of advice, or all of it as JSON.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "advice.hpp"
#include "result.hpp"
#include "subject.hpp"
#include "tolerance.hpp"

namespace isostep::tool::lab {

struct Summary {
  const Subject& subject;
  const std::vector<LabResult>& results;
  const Tolerance& tolerance;
  LabPoint own;  // see default_point
};
std::string table_of(const Summary& summary);
std::string json_of(const Summary& summary);

}  // namespace isostep::tool::lab
