// The laboratory's results.
// SPDX-License-Identifier: MIT
#include "summary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "run_point.hpp"

namespace isostep::tool::lab {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> scalars_in(const std::vector<LabResult>& results) {
  std::vector<std::string> scalars;
  for (const LabResult& result : results) {
    if (std::find(scalars.begin(), scalars.end(), result.point.scalar) == scalars.end())
      scalars.push_back(result.point.scalar);
  }
  return scalars;
}

/// A column of the table: nothing where no run of the front has anything to show there.
struct Column {
  Quantity quantity;
  const char* title;
  double unit;
};
constexpr Column kColumns[] = {{Quantity::penetration, "overlap mm", 1e3}, {Quantity::joint, "joint mm", 1e3},
                               {Quantity::deviation, "dev. mm", 1e3},      {Quantity::energy, "gain J/kg", 1},
                               {Quantity::unrest, "unrest J/kg", 1},       {Quantity::figure, "figure", 1}};

std::vector<Column> columns_of(const std::vector<LabResult>& results, const std::vector<std::size_t>& rows) {
  std::vector<Column> columns;
  for (const Column& column : kColumns) {
    const bool shown = std::any_of(rows.begin(), rows.end(), [&](std::size_t i) {
      return column.quantity == Quantity::figure ? results[i].judged : measured(results[i], column.quantity) > 0;
    });
    if (shown) columns.push_back(column);
  }
  return columns;
}

template <class... Values> std::string formatted(const char* format, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::string row_of(const LabResult& result, const std::vector<Column>& columns, double excess, char mark) {
  const bool is_done = result.state == kDone;
  std::string row =
      formatted("%c %9s  %-7s %-12s %4d x %-5d %-10s", mark, is_done ? formatted("%.4g", result.ms).c_str() : "-",
                result.point.scalar.c_str(), result.point.solver.c_str(), result.point.substeps, result.point.hz,
                result.point.model.c_str());
  if (!is_done) return row + " " + result.state + ": " + result.reason + "\n";
  for (const Column& column : columns) row += formatted(" %11.3g", measured(result, column.quantity) * column.unit);
  return row + formatted(" %9.3g\n", excess);
}

/// The front, and the default wherever it lies.
std::string front_table(const Summary& summary, const std::vector<std::size_t>& front, const Advice& advice) {
  std::vector<std::size_t> rows = front;
  if (advice.own && std::find(front.begin(), front.end(), *advice.own) == front.end()) rows.push_back(*advice.own);
  std::stable_sort(rows.begin(), rows.end(),
                   [&](std::size_t a, std::size_t b) { return summary.results[a].ms < summary.results[b].ms; });
  const std::vector<Column> columns = columns_of(summary.results, rows);
  std::string text = formatted("  %9s  %-7s %-12s %4s x %-5s %-10s", "ms", "scalar", "solver", "sub", "Hz", "model");
  for (const Column& column : columns) text += formatted(" %11s", column.title);
  text += formatted(" %9s\n", "of tol.");
  for (const std::size_t i : rows) {
    const char mark = advice.best == i ? '*' : advice.own == i ? '=' : ' ';
    text += row_of(summary.results[i], columns, excess_of(summary.results[i], summary.tolerance), mark);
  }
  return text;
}

std::string counts_text(const Summary& summary, std::size_t front) {
  std::size_t done = 0, left_out = 0, refused = 0, failed = 0;
  for (const LabResult& result : summary.results) {
    if (result.state == kLeftOut) ++left_out;
    else if (result.state != kDone) ++refused;
    else if (std::isfinite(excess_of(result, summary.tolerance))) ++done;
    else ++failed;
  }
  std::string text = std::to_string(front) + " runs on the front of cost against error; beside them " +
                     std::to_string(done - front) + " done";
  if (failed > 0) text += ", " + std::to_string(failed) + " that fell or left the range";
  if (left_out > 0) text += ", " + std::to_string(left_out) + " left out as too long";
  if (refused > 0) text += ", " + std::to_string(refused) + " refused";
  return text;
}

Json json_of(const LabResult& result, const Tolerance& tolerance) {
  Json object = Json::parse(to_line({result, ""}));
  object.erase("version");
  const double excess = excess_of(result, tolerance);
  object["excess"] = std::isfinite(excess) ? Json(excess) : Json();
  return object;
}
Json json_of(const Advice& advice, const Summary& summary) {
  Json object = {{"holds", advice.holds}, {"text", advice.text}, {"setting", nullptr}, {"default", nullptr}};
  if (advice.best) object["setting"] = json_of(summary.results[*advice.best], summary.tolerance);
  if (advice.own) object["default"] = json_of(summary.results[*advice.own], summary.tolerance);
  return object;
}

}  // namespace

std::string table_of(const Summary& summary) {
  const std::vector<std::size_t> front = front_of(summary.results, summary.tolerance);
  const Advice advice = advise(summary.results, summary.tolerance, summary.own);
  std::string text = summary.subject.name + ", tolerance " + summary.tolerance.text + ", deviation after 1 s from " +
                     setting_text(reference_point(summary.subject)) + "\n";
  if (const scenes::Trial* trial = summary.subject.trial)
    text += std::string("a trial: ") + trial->description + "; figure: " + trial->measure + ", survived up to " +
            formatted("%.4g %s\n", trial->bar, trial->unit);
  for (const char* model : kModels) {
    const std::string& reason = refusal_of(summary.subject, model);
    if (!reason.empty()) text += std::string("no ") + model + ": " + reason + "\n";
  }
  text += front_table(summary, front, advice);
  return text + counts_text(summary, front.size()) + "\nadvice: " + advice.text + "\n";
}

std::string json_of(const Summary& summary) {
  Json models = Json::object(), scalars = Json::object();
  for (const char* model : kModels) {
    const std::string& reason = refusal_of(summary.subject, model);
    models[model] = reason.empty() ? Json(true) : Json(reason);
  }
  for (const std::string& scalar : scalars_in(summary.results))
    scalars[scalar] = json_of(advise(summary.results, summary.tolerance, summary.own, scalar), summary);
  Json object = {{"scene", summary.subject.name},
                 {"tolerance", summary.tolerance.text},
                 {"reference", setting_text(reference_point(summary.subject))},
                 {"models", models},
                 {"advice", json_of(advise(summary.results, summary.tolerance, summary.own), summary)},
                 {"advice_by_scalar", scalars}};
  Json front = Json::array(), results = Json::array();
  for (const std::size_t i : front_of(summary.results, summary.tolerance))
    front.push_back(json_of(summary.results[i], summary.tolerance));
  for (const LabResult& result : summary.results) results.push_back(json_of(result, summary.tolerance));
  object["front"] = front;
  object["results"] = results;
  return object.dump(1) + "\n";
}

}  // namespace isostep::tool::lab
