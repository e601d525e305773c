// Fields one by one, by name: what looks at every number of a state or of a step's scratch.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "isostep/state/diff.hpp"
#include "isostep/state/value_text.hpp"

namespace isostep {

/// A field as text: "bodies[17].velocity.x<TAB>f32.24<TAB>0x3fc00000".
struct NamedField {
  std::string path;
  FieldFormat format;
  std::uint64_t bits;
};
std::string field_line(const NamedField& field);
/// Reads a field's line. Returns false for anything else.
bool read_field_line(std::string_view line, NamedField& field);

/// Called for every field in turn.
struct FieldSink {
  void (*field)(void* user, const PathPart& path, FieldFormat format, std::uint64_t bits);
  void* user;
};

/// Two groups of the fields of an engine: what lasts, and what one stage of a step leaves for those that follow it.
enum class FieldGroup : std::uint32_t { state, scratch };

/// Access to the fields of an engine. `stage`: an index into its stages, or their count before the first.
struct FieldSource {
  void* engine;
  std::uint64_t (*state_hash)(const void* engine);
  void (*walk)(void* engine, FieldGroup group, std::uint32_t stage, const FieldSink& sink);
};

/// All state, and what one stage left in the scratch of a step. An observer gets it for the length of its call.
/// Cost:  nothing until it is called; a hash or a walk takes some 5 ns a field, a contact has up to two hundred.
/// Order: fixed. What lanes work on is visited by contact, so it does not depend on the number of lanes.
class StageView {
 public:
  StageView(const FieldSource& source, std::uint32_t stage);

  /// Returns the hash of the state's hash and every field of the scratch; without scratch the state's hash.
  std::uint64_t hash() const;
  /// Visits the state's fields in the order in which the state hash takes them, then the scratch's.
  void visit(const FieldSink& sink) const;

 private:
  friend class FaultInjection;  // of src/diagnostics
  FieldSource source_;
  std::uint32_t stage_;
};

}  // namespace isostep
