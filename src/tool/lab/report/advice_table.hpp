// The cheapest setting of each scene that holds its bars.
// SPDX-License-Identifier: MIT
#pragma once

#include "page.hpp"

namespace isostep::tool::lab {

/// A head, and a line a scene; plain text.
std::vector<std::vector<std::string>> advice_cells(const ReportData& data);

}  // namespace isostep::tool::lab
