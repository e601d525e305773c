// The report's data as tables for gnuplot, and what draws them.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "growth.hpp"
#include "matrix.hpp"
#include "plan.hpp"
#include "stage_costs.hpp"

namespace isostep::tool::lab {

/// scene title unit engine scalar solver substeps ms error lost: a line a run that came to its end, of scenes with a
/// view. An error below a millionth of its unit is written as that.
std::string accuracy_tsv(const std::vector<LabResult>& results);

std::string growth_tsv(const std::vector<GrowthSample>& samples);
std::string stages_tsv(const std::vector<StageCost>& costs);
/// Reads what stages_tsv wrote; empty for anything else.
std::vector<StageCost> stages_of(const std::string& tsv);

/// The matrix of survival as a picture that needs no script: a cell's number is effort_of.
std::string survival_svg(const Matrix& matrix);

}  // namespace isostep::tool::lab
