// Text into HTML and SVG, safely, and numbers as people read them.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace isostep::tool::lab {

/// & < > " ' become entities; control characters become spaces.
std::string escaped(std::string_view text);

/// Three digits: "0.00123", "12.3", "1240", "1.2e-09"; "-" for what is no number.
std::string short_number(double value);

/// An SVG file as part of a page: no XML head, and every id with `prefix` before it, so that two of them may stand in
/// one page.
std::string inlined_svg(std::string_view file, const std::string& prefix);

/// A page's beginning as far as its body, with a style for all reports and `style` of its own.
std::string page_head(const std::string& title, const std::string& style);
/// A section of a page; all but the id is HTML already.
std::string html_section(const char* id, const std::string& title, const std::string& note, const std::string& content);

/// A line of links to sections, by their titles.
std::string contents_of(const std::string& sections);

/// A line of text in an SVG.
std::string svg_text(double x, double y, const std::string& words, const std::string& attributes);

/// The first line is the head. Cells are HTML already.
std::string html_table(const std::vector<std::vector<std::string>>& cells);
/// Returns the same for cells that are plain text.
std::string escaped_table(std::vector<std::vector<std::string>> cells);
/// The table in Markdown: columns as wide as they must be. Cells are plain text; a bar in them is escaped.
std::string markdown_table(std::vector<std::vector<std::string>> cells);

}  // namespace isostep::tool::lab
