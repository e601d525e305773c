// HTML, section by section.
// SPDX-License-Identifier: MIT
#include "page.hpp"

#include <algorithm>
#include <map>

#include "advice_table.hpp"
#include "engines.hpp"
#include "genres.hpp"
#include "html.hpp"
#include "scenes/trials/trial.hpp"
#include "tool/lab/sweep.hpp"

namespace isostep::tool::lab {
namespace {

constexpr char kMatrixStyle[] = R"(table.matrix td.cell { text-align: center; min-width: 1.6rem; padding: 2px 3px; }
table.matrix td:nth-child(2) { min-width: 13rem; }
table.matrix th.turned { writing-mode: vertical-rl; transform: rotate(180deg); font-weight: normal; }
td.survived { background: #009e73; color: #fff; } td.failed { background: #d55e00; color: #fff; }
td.open { background: #f0c75e; color: #24292f; } td.refused { background: #eaeef2; color: #57606a; }
)";

std::string picture(const std::string& svg, const std::string& prefix) {
  const std::string inlined = inlined_svg(svg, prefix);
  return inlined.empty() ? "<p>No picture: gnuplot was not there.</p>\n" : "<figure>" + inlined + "</figure>\n";
}

const scenes::Trial& trial_of(const std::string& name) {
  static const scenes::Trial unknown = {"", "", "", "", "", 0, nullptr, nullptr};
  const scenes::Trial* trial = scenes::find_trial(name);
  return trial == nullptr ? unknown : *trial;
}

std::string with_unit(double value, const scenes::Trial& trial) {
  return short_number(value) + (trial.unit[0] == '\0' ? "" : " ") + trial.unit;
}
std::string figure_text(const LabResult& result) { return with_unit(result.figure, trial_of(result.point.scene)); }

/// The text shown by hovering over a cell.
std::string hint_of(const MatrixCell& cell) {
  if (cell.fate == Fate::untried) return "not run";
  const LabResult& r = cell.result;
  const std::string who = r.point.engine == kOwnEngine
                              ? r.point.scalar + ", " + setting_of(r.point)
                              : full_name(engine_of(r.point.engine)) + (is_best(r.point.engine) ? ", at its best" : "");
  std::string text = who + ": " + kFateNames[static_cast<int>(cell.fate)];
  if (cell.fate == Fate::survived || cell.fate == Fate::failed) {
    text += ", " + figure_text(r) + " (bar " + with_unit(trial_of(r.point.scene).bar, trial_of(r.point.scene)) + "), " +
            short_number(r.ms) + " ms";
    if (r.faults > 0) text += ", numbers mended in " + std::to_string(r.faults) + " steps";
  }
  if (!r.reason.empty()) text += ": " + r.reason;
  return text;
}

std::string cell_html(const MatrixCell& cell) {
  constexpr const char* kClasses[] = {"untried", "survived", "failed", "open", "refused"};
  const int fate = static_cast<int>(cell.fate);
  return std::string("<td class=\"cell ") + kClasses[fate] + "\" title=\"" + escaped(hint_of(cell)) + "\">" +
         sign_of(cell) + "</td>";
}

std::string recommendation(const LabResult* result) {
  if (result == nullptr) return "none";
  return setting_of(result->point) + ": " + figure_text(*result) + ", " + short_number(result->ms) + " ms";
}

std::string matrix_head(const Matrix& matrix) {
  std::string groups = "<tr><th rowspan=\"2\">trial</th><th rowspan=\"2\">figure</th>", names = "<tr>";
  for (std::size_t i = 0; i < matrix.columns.size(); ++i) {
    const MatrixColumn& column = matrix.columns[i];
    names += "<th class=\"turned\">" + escaped(column.is_ours() ? column.solver : column.engine) + "</th>";
    if (i > 0 && matrix.columns[i - 1].scalar == column.scalar) continue;
    const auto same = [&](const MatrixColumn& c) { return c.scalar == column.scalar; };
    const auto count = std::count_if(matrix.columns.begin(), matrix.columns.end(), same);
    groups += "<th colspan=\"" + std::to_string(count) + "\">" +
              escaped(column.is_ours() ? column.scalar : "other engines") + "</th>";
  }
  return groups + "<th rowspan=\"2\">recommended, double</th><th rowspan=\"2\">recommended, q32.32</th></tr>\n" +
         names + "</tr>\n";
}

std::string matrix_html(const Matrix& matrix) {
  std::string text = "<div class=\"wide\"><table class=\"matrix\">\n" + matrix_head(matrix);
  for (std::size_t r = 0; r < matrix.rows.size(); ++r) {
    const scenes::Trial& trial = trial_of(matrix.rows[r].trial);
    text += "<tr><td title=\"" + escaped(trial.description) + "\">" + escaped(matrix.rows[r].trial) + "</td><td>" +
            escaped(std::string(trial.measure) + ", at most " + with_unit(trial.bar, trial)) + "</td>";
    for (std::size_t i = 0; i < matrix.columns.size(); ++i) {
      text += cell_html(matrix.rows[r].cells[i]);
    }
    for (const char* scalar : {"double", "q32.32"}) {
      text += "<td>" + escaped(recommendation(matrix.recommended(r, scalar))) + "</td>";
    }
    text += "</tr>\n";
  }
  return text + "</table></div>\n";
}

/// A line a stage, a column a scene and scalar.
std::string stage_table(const std::vector<StageCost>& costs) {
  std::vector<std::string> columns, stages;
  std::map<std::string, std::map<std::string, double>> times;
  const auto note = [](std::vector<std::string>& names, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const StageCost& cost : costs) {
    const std::string column = cost.scene + " " + cost.scalar;
    note(columns, column);
    note(stages, cost.stage);
    times[cost.stage][column] = cost.us;
  }
  if (columns.empty()) return {};
  std::vector<std::vector<std::string>> cells(1, {"µs a step"});
  cells[0].insert(cells[0].end(), columns.begin(), columns.end());
  for (const std::string& stage : stages) {
    std::vector<std::string> line = {stage};
    for (const std::string& column : columns) line.push_back(short_number(times[stage][column]));
    cells.push_back(std::move(line));
  }
  return escaped_table(std::move(cells));
}

/// "The default fails in double or q32.32: newtons_cradle."
std::string failures_of_default(const ReportData& data) {
  std::string names;
  for (const MatrixRow& row : data.matrix.rows) {
    const auto fails = [&](const char* scalar) {
      return fate_within(data.results, default_point(row.trial, scalar)) == Fate::failed;
    };
    if (fails("double") || fails("q32.32")) names += (names.empty() ? "" : ", ") + row.trial;
  }
  return "The default fails in double or q32.32: " + (names.empty() ? "none" : names) + ".";
}

/// "survived: havok, jolt +; failed: ode": a + needed its best settings.
std::string peer_verdicts(const Matrix& matrix, std::size_t row) {
  std::string text;
  for (const Fate fate : {Fate::survived, Fate::failed, Fate::open, Fate::refused}) {
    std::string names;
    for (std::size_t i = 0; i < matrix.columns.size(); ++i) {
      const MatrixCell& cell = matrix.rows[row].cells[i];
      if (matrix.columns[i].is_ours() || cell.fate != fate) continue;
      names += (names.empty() ? " " : ", ") + matrix.columns[i].engine + (sign_of(cell) == "+" ? " +" : "");
    }
    if (!names.empty())
      text += (text.empty() ? "" : "; ") + std::string(kFateNames[static_cast<int>(fate)]) + ":" + names;
  }
  return text.empty() ? "-" : text;
}

}  // namespace

std::string page_of(const ReportData& data) {
  std::string head = page_head("isostep: the laboratory", kMatrixStyle);
  head += "<h1>isostep: which settings a game needs</h1>\n<p class=\"lead\">" + escaped(advice_sentence(data)) +
          "</p>\n<p>isostep is a physics engine with four kinds of numbers and several solvers. Here it ran " +
          std::to_string(data.plan.scenes.size()) + " scenes and " + std::to_string(data.plan.trials.size()) +
          " trials, where methods are known to fail, beside other engines: " + std::to_string(data.results.size()) +
          " runs, one thread each." +
          (data.is_short ? " This is a short set: run without --short for all of it." : "") + "</p>\n";
  std::string text =
      html_section("games", "For your game",
                   "The setting that misses fewest scenes and trials of the line, of those the cheapest, and the CPU "
                   "time of 1/60 s of the first of them, at most 1/60 s. <em>But not</em> names what it misses. A "
                   "scene resembles a game, no more: try yours by <code>isostep lab your_scene.json</code>.",
                   escaped_table(genre_cells(data)));
  text += html_section("names", "Who is who", "Solvers and numbers of isostep, and the other engines.",
                       escaped_table(who_is_who(engines_in(data.results))));
  text += html_section(
      "advice", "For each scene",
      "Per scene and scalar the cheapest setting that holds its bars, and the one that reaches the aim. A bar is "
      "two errors: the largest that this project allows itself, and the aim, below which more accuracy does not "
      "matter. CPU time of a step of 1/60 s, one thread.",
      escaped_table(advice_cells(data)));
  text +=
      html_section("accuracy", "Speed against accuracy",
                   "A panel a scene. Across: CPU time of 1/60 s [ms]; up: the error in its title, in its unit; both "
                   "logarithmic, so left is faster and down is more accurate. A line a scalar and solver, over "
                   "sub-steps; letters are other engines.",
                   picture(data.accuracy, "a-"));
  text += html_section(
      "survival", "Where methods fail",
      "A number: survived with so many sub-steps, or from 120 on with so many steps a second. ✓ another engine "
      "survived "
      "by its defaults, + by its best settings only. × failed, … too long, – refused: the "
      "engine or the scalar cannot be told it. An empty cell: not run. Point at a cell for its figure. " +
          escaped(failures_of_default(data)),
      matrix_html(data.matrix));
  text +=
      html_section("growth", "Error growth",
                   "How far each scalar gets from the same method in double, with the same sub-steps: root mean square "
                   "over bodies of points half a metre from their centres [m], against time [s].",
                   picture(data.growth, "g-"));
  text += html_section("springs", "Stability of integrators",
                       "Stiff springs, every integrator of particles, every scalar: energy after 10 s, as a multiple "
                       "of that at the start, against stiffness k h²/m.",
                       picture(data.springs, "s-"));
  text += html_section("stages", "What each stage costs", "CPU time of a step's stages, by soft step at 8 sub-steps.",
                       picture(data.stage_chart, "c-") + stage_table(data.stages));
  return head + contents_of(text) + text + "</body>\n</html>\n";
}

std::string summary_of(const ReportData& data) {
  std::vector<std::vector<std::string>> cells = {{"trial", "figure", "bar", "double", "q32.32", "peers"}};
  int both = 0;
  for (std::size_t r = 0; r < data.matrix.rows.size(); ++r) {
    const scenes::Trial& trial = trial_of(data.matrix.rows[r].trial);
    const LabResult* in_double = data.matrix.recommended(r, "double");
    const LabResult* in_fixed = data.matrix.recommended(r, "q32.32");
    both += in_double != nullptr && in_fixed != nullptr ? 1 : 0;
    cells.push_back({data.matrix.rows[r].trial, trial.measure, with_unit(trial.bar, trial), recommendation(in_double),
                     recommendation(in_fixed), peer_verdicts(data.matrix, r)});
  }
  std::string text =
      "# The laboratory, in short\n\nWritten by `./isostep lab --all`. Per trial the cheapest setting "
      "that survives, its figure, and the CPU time of a step of 1/60 s.\nSurvived in double and q32.32: " +
      std::to_string(both) + " of " + std::to_string(data.matrix.rows.size()) + ". " + failures_of_default(data) +
      "\n\n" + markdown_table(cells) + "\nPer scene the cheapest setting that holds its bars:\n\n" +
      markdown_table(advice_cells(data));
  return text;
}

}  // namespace isostep::tool::lab
