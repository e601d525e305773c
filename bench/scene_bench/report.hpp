// Rows as a table for people, and as JSON.
// SPDX-License-Identifier: MIT
#pragma once

#include "race.hpp"
#include "rollback.hpp"

namespace isostep::bench {

/// Markdown, so that it can be pasted.
std::string heading();
/// The rows of one scene; ratios are against the peers among them.
std::string table_of(const std::vector<Row>& rows);

std::string json_of(const std::vector<Row>& rows, const std::vector<RollbackRow>& rollback, const RaceOptions& options);

}  // namespace isostep::bench
