// Tolerances, read and held against runs.
// SPDX-License-Identifier: MIT
#include "tolerance.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

#include "tool/common/tool.hpp"

namespace isostep::tool::lab {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

bool is_length(Quantity quantity) {
  return quantity == Quantity::penetration || quantity == Quantity::joint || quantity == Quantity::deviation;
}
bool is_energy(Quantity quantity) { return quantity == Quantity::energy || quantity == Quantity::unrest; }

/// Reads one item after the other and knows where it is.
class Parser {
 public:
  explicit Parser(const std::string& text) : text_(text) {}

  Tolerance parse() {
    Tolerance tolerance;
    tolerance.text = text_;
    if (text_.find_first_of("=,") == std::string::npos && text_ != "stands") {
      const double length = number(0, text_, Quantity::penetration);
      tolerance.bounds = {{Quantity::penetration, length}, {Quantity::joint, length}};
      tolerance.stands = true;
      return tolerance;
    }
    for (std::size_t begin = 0; begin <= text_.size();) {
      const std::size_t end = std::min(text_.find(',', begin), text_.size());
      item(begin, std::string_view(text_).substr(begin, end - begin), tolerance);
      begin = end + 1;
    }
    return tolerance;
  }

 private:
  [[noreturn]] void fail(std::size_t place, const std::string& why) const {
    throw ToolError(exit_status::kUsage,
                    "--tolerance " + text_ + ": character " + std::to_string(place + 1) + ": " + why);
  }

  void item(std::size_t place, std::string_view item, Tolerance& tolerance) const {
    const std::size_t equals = item.find('=');
    const std::string name(item.substr(0, equals));
    if (name == "stands") {
      if (equals != std::string_view::npos) fail(place + equals, "stands has no value");
      if (tolerance.stands) fail(place, "stands comes twice");
      tolerance.stands = true;
      return;
    }
    const std::optional<Quantity> quantity = quantity_named(name);
    if (!quantity) fail(place, "expected penetration, joint, deviation, energy, unrest, figure or stands");
    if (equals == std::string_view::npos) fail(place + name.size(), "expected = and a number");
    for (const Bound& bound : tolerance.bounds) {
      if (bound.quantity == *quantity) fail(place, name + " comes twice");
    }
    tolerance.bounds.push_back({*quantity, number(place + equals + 1, item.substr(equals + 1), *quantity)});
  }
  static std::optional<Quantity> quantity_named(const std::string& name) {
    for (std::size_t i = 0; i < std::size(kQuantityNames); ++i) {
      if (name == kQuantityNames[i]) return static_cast<Quantity>(i);
    }
    return std::nullopt;
  }

  double number(std::size_t place, std::string_view item, Quantity quantity) const {
    double value = 0;
    const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), value);
    if (error != std::errc() || !std::isfinite(value)) fail(place, "expected a number");
    const auto unit = static_cast<std::size_t>(end - item.data());
    if (value < 0) fail(place, "a tolerance is not negative");
    return value * factor(place + unit, item.substr(unit), quantity);
  }
  double factor(std::size_t place, std::string_view unit, Quantity quantity) const {
    if (is_length(quantity)) {
      if (unit == "um") return 1e-6;
      if (unit == "mm") return 1e-3;
      if (unit == "cm") return 1e-2;
      if (unit == "m") return 1;
      fail(place, "expected a unit: um, mm, cm or m");
    }
    if (is_energy(quantity)) {
      if (unit.empty() || unit == "J/kg") return 1;
      fail(place, "expected J/kg or nothing");
    }
    if (!unit.empty()) fail(place, "a figure is in the trial's own unit: expected nothing more");
    return 1;
  }

  const std::string& text_;
};

bool fell(const LabResult& result) { return result.judged ? !result.survived : !result.stood; }

double quotient(const LabResult& result, const Bound& bound) {
  const double value = measured(result, bound.quantity);
  if (!std::isfinite(value)) return kInfinite;
  if (bound.quantity == Quantity::figure && !result.judged) return kInfinite;
  if (bound.quantity == Quantity::deviation && value < 0) return kInfinite;
  if (value <= 0) return 0;
  return value / bound.most;
}

}  // namespace

Tolerance parse_tolerance(const std::string& text) { return Parser(text).parse(); }

void require_judge(const Tolerance& tolerance, const Subject& subject) {
  for (const Bound& bound : tolerance.bounds) {
    if (bound.quantity == Quantity::figure && subject.trial == nullptr)
      throw ToolError(exit_status::kUsage, "--tolerance figure: " + subject.name + " is no trial and has no figure");
  }
}

double measured(const LabResult& result, Quantity quantity) {
  switch (quantity) {
    case Quantity::penetration: return result.penetration;
    case Quantity::joint: return result.joint_error;
    case Quantity::deviation: return result.deviation;
    case Quantity::energy: return result.energy_gain;
    case Quantity::unrest: return result.unrest;
    case Quantity::figure: return result.figure;
  }
  return 0;
}

std::string quantity_text(Quantity quantity, double value) {
  const bool length = is_length(quantity), metres = length && std::abs(value) >= 1;
  char text[48];
  std::snprintf(text, sizeof text, "%.3g%s", length && !metres ? 1000 * value : value,
                metres                ? " m"
                : length              ? " mm"
                : is_energy(quantity) ? " J/kg"
                                      : "");
  return text;
}

double excess_of(const LabResult& result, const Tolerance& tolerance) {
  if (result.state != kDone || result.faults > 0 || (tolerance.stands && fell(result))) return kInfinite;
  double worst = 0;
  for (const Bound& bound : tolerance.bounds) worst = std::max(worst, quotient(result, bound));
  return worst;
}

std::string miss_of(const LabResult& result, const Tolerance& tolerance) {
  if (result.state != kDone) return result.reason;
  if (result.faults > 0) return "numbers in range: " + std::to_string(result.faults) + " steps had to mend some";
  if (tolerance.stands && fell(result)) return result.judged ? "its bar" : "what should stand: it fell";
  const Bound* worst = nullptr;
  for (const Bound& bound : tolerance.bounds) {
    const double share = quotient(result, bound);
    if (share > 1 && (worst == nullptr || share > quotient(result, *worst))) worst = &bound;
  }
  if (worst == nullptr) return "";
  const std::string name = kQuantityNames[static_cast<std::size_t>(worst->quantity)];
  const double value = measured(result, worst->quantity);
  const std::string text = name + " = " + quantity_text(worst->quantity, worst->most);
  if (!std::isfinite(value)) return text + ": it is no number";
  if (worst->quantity == Quantity::deviation && value < 0) return text + ": there is no reference";
  if (worst->quantity == Quantity::figure && !result.judged) return text + ": the scene is no trial";
  return text + " by " + quantity_text(worst->quantity, value - worst->most);
}

}  // namespace isostep::tool::lab
