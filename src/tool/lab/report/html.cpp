// Text, numbers and tables as HTML and Markdown.
// SPDX-License-Identifier: MIT
#include "html.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace isostep::tool::lab {
namespace {

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

/// The width in Markdown's columns: bytes that begin a character.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\'': out += "&#39;"; break;
      default: out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

std::string short_number(double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  char text[32];
  std::snprintf(text, sizeof text,
                size != 0 && (size < 1e-3 || size >= 1e6) ? "%.1e"
                : size >= 100                             ? "%.0f"
                                                          : "%.3g",
                value);
  return text;
}

std::string inlined_svg(std::string_view file, const std::string& prefix) {
  const std::size_t start = file.find("<svg"), end = file.rfind("</svg>");
  if (start == std::string_view::npos || end == std::string_view::npos) return {};
  std::string text(file.substr(start, end + 6 - start));
  for (const char* quote : {"'", "\""}) {
    const std::string q = quote;
    replace_all(text, " id=" + q, " id=" + q + prefix);
    replace_all(text, "href=" + q + "#", "href=" + q + "#" + prefix);
  }
  replace_all(text, "url(#", "url(#" + prefix);
  return text;
}

std::string page_head(const std::string& title, const std::string& style) {
  return R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>)" +
         escaped(title) + R"(</title>
<style>
:root { color-scheme: light dark; --ink: #24292f; --muted: #57606a; --ground: #fff; --head: #f6f8fa; --line: #d0d7de; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e6edf3; --muted: #9da7b3; --ground: #0d1117; --head: #161b22; --line: #30363d; }
}
body { font: 15px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--ground);
  max-width: 1240px; margin: 0 auto; padding: 1rem; }
a { color: inherit; }
h1 { font-size: 1.7rem; } h2 { font-size: 1.25rem; margin-top: 2.5rem; }
p, figcaption { color: var(--muted); max-width: 50rem; }
p.lead { color: var(--ink); font-size: 1.1rem; }
figure { margin: 1rem 0; }
figure, .wide { overflow-x: auto; }
svg { display: block; width: 100%; min-width: 800px; height: auto; }
table { border-collapse: collapse; font-size: 13px; }
th, td { border: 1px solid var(--line); padding: 2px 7px; text-align: left; vertical-align: top; }
th { background: var(--head); }
)" + style +
         R"(</style>
</head>
<body>
)";
}

std::string html_section(const char* id, const std::string& title, const std::string& note,
                         const std::string& content) {
  return std::string("<section id=\"") + id + "\">\n<h2>" + title + "</h2>\n<p>" + note + "</p>\n" + content +
         "</section>\n";
}

std::string contents_of(const std::string& sections) {
  const std::string begin = "<section id=\"", middle = "\">\n<h2>", end = "</h2>";
  std::string links;
  for (std::size_t at = 0; (at = sections.find(begin, at)) != std::string::npos;) {
    const std::size_t id = at + begin.size(), id_end = sections.find(middle, id), title = id_end + middle.size();
    const std::size_t title_end = sections.find(end, title);
    links += (links.empty() ? "<a href=\"#" : " · <a href=\"#") + sections.substr(id, id_end - id) + "\">" +
             sections.substr(title, title_end - title) + "</a>";
    at = title_end;
  }
  return "<nav><p>" + links + "</p></nav>\n";
}

std::string svg_text(double x, double y, const std::string& words, const std::string& attributes) {
  char head[96];
  std::snprintf(head, sizeof head, "<text x=\"%.1f\" y=\"%.1f\" ", x, y);
  return head + attributes + ">" + escaped(words) + "</text>\n";
}

std::string html_table(const std::vector<std::vector<std::string>>& cells) {
  std::string text = "<div class=\"wide\"><table>\n";
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const char* kind = n == 0 ? "th" : "td";
    text += "<tr>";
    for (const std::string& cell : cells[n]) {
      text.append("<").append(kind).append(">").append(cell).append("</").append(kind).append(">");
    }
    text += "</tr>\n";
  }
  return text + "</table></div>\n";
}

std::string escaped_table(std::vector<std::vector<std::string>> cells) {
  for (auto& line : cells) {
    for (std::string& cell : line) cell = escaped(cell);
  }
  return html_table(cells);
}

std::string markdown_table(std::vector<std::vector<std::string>> cells) {
  std::vector<std::size_t> widths(cells.front().size(), 3);
  for (auto& line : cells) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      replace_all(line[i], "|", "\\|");
      widths[i] = std::max(widths[i], width_of(line[i]));
    }
  }
  std::string text;
  for (std::size_t n = 0; n < cells.size(); ++n) {
    for (std::size_t i = 0; i < widths.size(); ++i) {
      text.append("| ").append(cells[n][i]).append(widths[i] - width_of(cells[n][i]) + 1, ' ');
    }
    text += "|\n";
    if (n != 0) continue;
    for (const std::size_t width : widths) text.append("|").append(width + 2, '-');
    text += "|\n";
  }
  return text;
}

}  // namespace isostep::tool::lab
