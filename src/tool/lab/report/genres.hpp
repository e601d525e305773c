// Settings for kinds of games, from the runs: the cheapest that hold the scenes and survive the trials of each.
// SPDX-License-Identifier: MIT
#pragma once

#include "page.hpp"

namespace isostep::tool::lab {

/// A head, and a line a kind of game; plain text. Kinds of which the plan has no scene are left out.
std::vector<std::vector<std::string>> genre_cells(const ReportData& data);

/// What a world's own settings hold and survive in each scalar, beside the best of the other engines.
std::string advice_sentence(const ReportData& data);

}  // namespace isostep::tool::lab
