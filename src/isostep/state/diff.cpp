// Differences as text.
// SPDX-License-Identifier: MIT
#include "isostep/state/diff.hpp"

#include <cstring>

namespace isostep {
namespace {

template <std::size_t N> void append_path(const PathPart& part, ShortText<N>& text) {
  if (part.outer != nullptr) append_path(*part.outer, text);
  if (part.name == nullptr) {
    text.append("[").append_number(part.index).append("]");
    return;
  }
  if (part.outer != nullptr) text.append(".");
  text.append(part.name);
}

const char* unit_of(FieldFormat format) {
  if (format.kind != FieldKind::scalar) return "";
  return format.scalar_id >> 16 == 1 ? "ulp" : "lsb";
}

}  // namespace

std::string path_text(const PathPart& path) {
  ShortText<160> text;
  append_path(path, text);
  return std::string(text.view());
}

std::string describe(const Difference& d) {
  std::string text(d.path.view());
  text.append(": ").append(d.a.view()).append(" | ").append(d.b.view());
  text.append(" (").append(d.bits_a.view()).append(" | ").append(d.bits_b.view()).append("), ");
  text.append(std::to_string(d.steps));
  if (*d.unit != '\0') text.append(" ").append(d.unit);
  return text.append(" apart");
}

DiffReport::DiffReport(std::size_t keep) : keep_(keep), count_(0) {}
DiffReport::~DiffReport() = default;

bool DiffReport::any() const { return count_ != 0; }
std::uint64_t DiffReport::count() const { return count_; }
const std::vector<Difference>& DiffReport::kept() const { return kept_; }

void DiffReport::add(const PathPart& path, FieldFormat format, std::uint64_t a, std::uint64_t b) {
  ++count_;
  if (kept_.size() >= keep_) return;
  const std::string text_a = value_text(format, a);
  const std::string text_b = value_text(format, b);
  const std::string bits_a = bits_text(format, a);
  const std::string bits_b = bits_text(format, b);
  Difference difference{{},
                        std::string_view(text_a),
                        std::string_view(text_b),
                        std::string_view(bits_a),
                        std::string_view(bits_b),
                        steps_between(format, a, b),
                        unit_of(format)};
  append_path(path, difference.path);
  kept_.push_back(difference);
}

void diff_bytes(const PathPart& path, const FieldType& type, const std::uint8_t* a, const std::uint8_t* b,
                DiffReport& report) {
  if (std::memcmp(a, b, type.size) == 0) return;
  struct Pair {
    const std::uint8_t *a, *b;
    DiffReport& report;
  } pair{a, b, report};
  const auto compare = [](void* user, const PathPart& number, FieldFormat format, std::uint32_t offset) {
    const Pair& both = *static_cast<const Pair*>(user);
    const std::uint64_t of_a = load_number(both.a + offset, format.size);
    const std::uint64_t of_b = load_number(both.b + offset, format.size);
    if (of_a != of_b) both.report.add(number, format, of_a, of_b);
  };
  each_number(path, type, {compare, &pair});
}

}  // namespace isostep
