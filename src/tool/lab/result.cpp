// Results as JSON Lines and CSV.
// SPDX-License-Identifier: MIT
#include "result.hpp"

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "isostep/dynamics/solver_name.hpp"
#include "tool/common/files.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool::lab {
namespace {

using Json = nlohmann::ordered_json;

/// visit(name, member) for everything but the version, in the order in which it is written.
template <class Result, class Visit> void each_field(Result& result, Visit&& visit) {
  visit("scene", result.point.scene);
  visit("engine", result.point.engine);
  visit("scalar", result.point.scalar);
  visit("solver", result.point.solver);
  visit("model", result.point.model);
  visit("hz", result.point.hz);
  visit("substeps", result.point.substeps);
  visit("state", result.state);
  visit("reason", result.reason);
  visit("frames", result.frames);
  visit("ms", result.ms);
  visit("ms_mean", result.ms_mean);
  visit("penetration", result.penetration);
  visit("penetration_mean", result.penetration_mean);
  visit("joint_error", result.joint_error);
  visit("energy_gain", result.energy_gain);
  visit("energy_loss", result.energy_loss);
  visit("unrest", result.unrest);
  visit("signorini", result.signorini);
  visit("coulomb", result.coulomb);
  visit("dissipation", result.dissipation);
  visit("deviation", result.deviation);
  visit("faults", result.faults);
  visit("judged", result.judged);
  visit("survived", result.survived);
  visit("figure", result.figure);
  visit("outcome", result.outcome);
  visit("stood", result.stood);
}

const Json& at(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) throw std::runtime_error(std::string(key) + " is missing");
  return *found;
}
void read(const Json& object, const char* key, std::string& value) {
  const Json& node = at(object, key);
  if (!node.is_string()) throw std::runtime_error(std::string(key) + " is no text");
  value = node.get<std::string>();
}
void read(const Json& object, const char* key, bool& value) {
  const Json& node = at(object, key);
  if (!node.is_boolean()) throw std::runtime_error(std::string(key) + " is neither true nor false");
  value = node.get<bool>();
}
void read(const Json& object, const char* key, int& value) {
  const Json& node = at(object, key);
  if (!node.is_number_integer()) throw std::runtime_error(std::string(key) + " is no whole number");
  value = node.get<int>();
}
void read(const Json& object, const char* key, double& value) {
  const Json& node = at(object, key);
  if (!node.is_number() && !node.is_null()) throw std::runtime_error(std::string(key) + " is no number");
  value = node.is_null() ? std::numeric_limits<double>::quiet_NaN() : node.get<double>();
}
void read(const Json& object, const char* key, std::vector<double>& values) {
  const Json& node = at(object, key);
  if (!node.is_array()) throw std::runtime_error(std::string(key) + " is no list");
  for (const Json& item : node) {
    if (!item.is_number() && !item.is_null()) throw std::runtime_error(std::string(key) + " holds what is no number");
    values.push_back(item.is_null() ? std::numeric_limits<double>::quiet_NaN() : item.get<double>());
  }
}

/// The text as JSON writes it, which quotes text; commas and quotes in text are doubled the way CSV wants.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}
template <class T> std::string cell(const T& value) { return Json(value).dump(); }
std::string cell(const std::vector<double>& values) { return cell(Json(values).dump()); }

}  // namespace

bool counts_passes(const LabPoint& point) {
  const std::optional<SolverName> solver = solver_named(point.solver);
  return solver && isostep::counts_passes(*solver);
}

std::string name_of(const LabPoint& point) {
  const std::string method = point.engine == kOwnEngine ? point.scalar + " " + point.solver : point.engine;
  return point.scene + " " + method + " " + std::to_string(point.substeps) + "x" + std::to_string(point.hz) + " " +
         point.model;
}

std::string to_line(const LabRecord& record) {
  Json object;
  each_field(record.result, [&](const char* name, const auto& value) { object[name] = value; });
  object["version"] = record.version;
  return object.dump(-1, ' ', false, Json::error_handler_t::replace);
}

LabRecord from_line(std::string_view line) {
  const Json object = Json::parse(line.begin(), line.end(), nullptr, false);
  if (!object.is_object()) throw std::runtime_error("is no JSON object");
  LabRecord record;
  each_field(record.result, [&](const char* name, auto& value) { read(object, name, value); });
  read(object, "version", record.version);
  return record;
}

std::vector<LabRecord> read_records(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return {};
  const std::vector<std::uint8_t> bytes = read_file(path);
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::vector<LabRecord> records;
  std::map<std::string, std::size_t> places;
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) break;
    try {
      LabRecord record = from_line(text.substr(0, end));
      const auto [place, is_new] = places.emplace(name_of(record.result.point), records.size());
      if (is_new) records.push_back(std::move(record));
      else records[place->second] = std::move(record);
    } catch (const std::runtime_error& wrong) {
      throw ToolError(exit_status::kUsage, path + ":" + std::to_string(line) + ": " + wrong.what() +
                                               "; without that line its run is done again");
    }
    text.remove_prefix(end + 1);
  }
  return records;
}

std::string csv_of(const std::vector<LabResult>& results) {
  std::string text;
  const LabResult none;
  each_field(none, [&](const char* name, const auto&) {
    if (!text.empty()) text += ',';
    text += name;
  });
  text += "\n";
  for (const LabResult& result : results) {
    std::string line;
    each_field(result, [&](const char* name, const auto& value) {
      if (std::string_view(name) != "scene") line += ',';
      line += cell(value);
    });
    text += line + "\n";
  }
  return text;
}

}  // namespace isostep::tool::lab
