// Tables of the published tests.
// SPDX-License-Identifier: MIT
#include "published_page.hpp"

#include <algorithm>

#include "standing.hpp"
#include "tool/lab/report/engines.hpp"
#include "tool/lab/report/html.hpp"

namespace isostep::tool::lab {
namespace {

using scenes::PublishedBar;
using scenes::PublishedTest;

bool is_double(const Standing& s) { return s.is_default && !s.is_articulation && s.scalar == "double"; }
bool is_fixed(const Standing& s) { return s.is_default && !s.is_articulation && s.scalar == "q32.32"; }
bool is_articulation(const Standing& s) { return s.is_default && s.is_articulation && s.scalar == "double"; }

const PublishedBar* bar_at(const PublishedTest& test, int hz) {
  const auto found =
      std::find_if(test.bars.begin(), test.bars.end(), [&](const PublishedBar& b) { return b.hz == hz; });
  return found == test.bars.end() ? nullptr : &*found;
}

std::string figure_of(const Standing& s) { return s.ended ? short_number(s.figure) : s.reason; }

/// The rates at which something of ours was run.
std::vector<int> rates_of(const PublishedTest& test, const std::vector<LabResult>& results) {
  std::vector<int> rates;
  for (const int hz : test.rates) {
    const std::vector<Standing> all = standings_of(test, hz, results);
    if (std::any_of(all.begin(), all.end(), [](const Standing& s) { return s.ours; })) rates.push_back(hz);
  }
  return rates;
}

/// A line an engine, a pair of columns a step: error and CPU time of a simulated second.
std::string table_of(const PublishedTest& test, const std::vector<LabResult>& results) {
  const std::vector<int> rates = rates_of(test, results);
  std::vector<std::vector<std::string>> cells(1, {"engine"});
  for (const int hz : rates) {
    cells[0].push_back("error, steps of " + step_text(hz));
    cells[0].push_back("ms a second");
  }
  const auto line_of = [&](const std::string& engine) -> std::vector<std::string>& {
    for (auto& line : cells) {
      if (line[0] == escaped(engine)) return line;
    }
    cells.push_back({escaped(engine)});
    cells.back().resize(cells[0].size());
    return cells.back();
  };
  for (std::size_t n = 0; n < rates.size(); ++n) {
    for (const Standing& s : standings_of(test, rates[n], results)) {
      std::vector<std::string>& line = line_of(s.engine);
      line[1 + 2 * n] = escaped(figure_of(s));
      line[2 + 2 * n] = s.published || !s.ended ? "" : short_number(1000 * s.seconds);
    }
  }
  return html_table(cells);
}

std::string heading_of(const PublishedTest& test) {
  std::string text = std::string(test.trial.description) + ". Error: " + test.trial.measure + " [" + test.trial.unit +
                     "]. " + test.source + " " + std::to_string(test.year) + ".";
  if (test.differs[0] != '\0') text += std::string(" Not as theirs: ") + test.differs + ".";
  return text;
}

const Standing* best_other(const std::vector<Standing>& standings) {
  const auto found = std::find_if(standings.begin(), standings.end(), [](const Standing& s) { return !s.ours; });
  return found == standings.end() || !found->ended ? nullptr : &*found;
}
const Standing* find(const std::vector<Standing>& standings, bool (*chosen)(const Standing&)) {
  const auto found = std::find_if(standings.begin(), standings.end(), chosen);
  return found == standings.end() ? nullptr : &*found;
}

/// Says how often a world's own settings are first, of the comparisons that they and another engine ended.
std::string places_sentence(const std::vector<LabResult>& results) {
  int all = 0, in_double = 0, in_fixed = 0;
  for (const PublishedTest& test : scenes::published_tests()) {
    for (const int hz : rates_of(test, results)) {
      const std::vector<Standing> standings = standings_of(test, hz, results);
      const Standing* const own = find(standings, is_double);
      if (own == nullptr || !own->ended || best_other(standings) == nullptr) continue;
      ++all;
      in_double += place_of(standings, is_double) == 1 ? 1 : 0;
      in_fixed += place_of(standings, is_fixed) == 1 ? 1 : 0;
    }
  }
  if (all == 0) return "No comparison: isostep by its own settings, or every other engine, has no figure here.";
  return "isostep ran " + std::to_string(all) +
         " comparisons, a test and a step each. By the settings of a world that asks for none it has the least error, "
         "alone or shared, in " +
         std::to_string(in_double) + " of them in double and in " + std::to_string(in_fixed) +
         " in fixed point (q32.32). In the others another engine is better.";
}

}  // namespace

std::string published_page(const std::vector<LabResult>& results) {
  std::string head = page_head("isostep: published comparisons", "svg { min-width: 1250px; }\n");
  head += "<h1>Published comparisons, repeated</h1>\n<p class=\"lead\">" + places_sentence(results) + "</p>\n";
  head +=
      "<p>Scenes and measures are the authors' or like theirs; each table says where not. Figures with a year are "
      "theirs. All other engines ran here, one thread each. Smaller errors are better. Times are of CPU for a "
      "simulated second; those of another year's machine are not compared, and runs that were kept are of another "
      "hour. An articulation is the same tree in joint coordinates; it has no contacts.</p>\n";
  const std::string figure = "<figure>" + published_svg(scenes::published_tests(), results) + "</figure>\n";
  std::string text =
      html_section("names", "Who is who",
                   "A name that ends in -best is the same engine with the settings that its documentation has for "
                   "precision.",
                   escaped_table(who_is_who(engines_in(results))));
  for (const PublishedTest& test : scenes::published_tests()) {
    text +=
        html_section(test.trial.name, escaped(test.trial.number), escaped(heading_of(test)), table_of(test, results));
  }
  return head + contents_of(text) + figure + text + "</body>\n</html>\n";
}

std::string published_summary(const std::vector<LabResult>& results) {
  std::vector<std::vector<std::string>> cells = {
      {"test", "step", "error", "must", "aim", "double", "q32.32", "articulation", "best other engine", "our place"}};
  for (const PublishedTest& test : scenes::published_tests()) {
    for (const int hz : rates_of(test, results)) {
      const std::vector<Standing> all = standings_of(test, hz, results);
      const PublishedBar* const bar = bar_at(test, hz);
      const Standing* const best = best_other(all);
      const auto figure = [&](bool (*chosen)(const Standing&)) {
        const Standing* const s = find(all, chosen);
        return s == nullptr ? std::string("-") : figure_of(*s);
      };
      const auto place = [&](bool (*chosen)(const Standing&)) {
        const int at = place_of(all, chosen);
        return at == 0 || best == nullptr ? std::string("-") : std::to_string(at);
      };
      cells.push_back({test.trial.number, step_text(hz), std::string(test.trial.measure) + " [" + test.trial.unit + "]",
                       bar == nullptr ? "" : short_number(bar->must), bar == nullptr ? "" : short_number(bar->aim),
                       figure(is_double), figure(is_fixed), figure(is_articulation),
                       best == nullptr ? "-" : best->engine + " " + short_number(best->figure),
                       place(is_double) + ", " + place(is_fixed)});
    }
  }
  return "# Published comparisons, in short\n\n"
         "Written by `./isostep lab --published`. Our figures are those of a world's own settings. *must* is the "
         "largest "
         "error that this project allows itself, *aim* the error below which more accuracy does not matter. Places in "
         "double and in q32.32 count rows: each setting of another engine and each published figure is a row, all of "
         "isostep is one, and equal errors share a place. An articulation has the same tree in joint coordinates, in "
         "double.\n\n" +
         markdown_table(cells);
}

}  // namespace isostep::tool::lab
