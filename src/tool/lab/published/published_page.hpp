// The published tests as people read them: a page, a table in Markdown, and a picture.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scenes/published/published.hpp"
#include "tool/lab/result.hpp"

namespace isostep::tool::lab {

/// One page that needs nothing else: the picture, and a table a test with a line an engine.
std::string published_page(const std::vector<LabResult>& results);
/// Per test and step our figures, what they must be and what we aim at, the best other engine, and our place.
std::string published_summary(const std::vector<LabResult>& results);
/// Bands: a line an engine, a column a test; a mark at its error, beside it the CPU time of a simulated second.
std::string published_svg(std::span<const scenes::PublishedTest> tests, const std::vector<LabResult>& results);
/// The tests of the first publication, which come first.
std::span<const scenes::PublishedTest> tests_of_first_source();

}  // namespace isostep::tool::lab
