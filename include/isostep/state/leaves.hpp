// Leaves one by one, by name: what looks at every number of a state or of a step's scratch.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "isostep/state/diff.hpp"
#include "isostep/state/value_text.hpp"

namespace isostep {

/// A leaf as text: "bodies[17].velocity.x<TAB>f32.24<TAB>0x3fc00000".
struct NamedLeaf {
  std::string path;
  LeafFormat format;
  std::uint64_t bits;
};
std::string leaf_line(const NamedLeaf& leaf);
/// False for anything else.
bool read_leaf_line(std::string_view line, NamedLeaf& leaf);

/// Is told of every leaf in turn.
struct LeafSink {
  void (*leaf)(void* user, const PathPart& path, LeafFormat format, std::uint64_t bits);
  void* user;
};

/// Two parts of what an engine has: what lasts, and what one stage of a step leaves for those that follow it.
enum class LeafPart : std::uint32_t { state, scratch };

/// What the leaves of an engine are reached by. `stage`: an index into its stages, or their count before the first.
struct LeafSource {
  void* engine;
  std::uint64_t (*state_hash)(const void* engine);
  void (*walk)(void* engine, LeafPart part, std::uint32_t stage, const LeafSink& sink);
};

/// All state, and of a step's scratch what one stage made: given to an observer for the length of its call.
/// Cost:  nothing until it is asked; a hash or a walk takes some 5 ns a leaf, a contact has up to two hundred.
/// Order: fixed, and of what contacts are worked on by lanes, by contact: a look does not depend on their number.
class StageView {
 public:
  StageView(const LeafSource& source, std::uint32_t stage);

  /// Of the state's hash and every leaf of the scratch; where there is none, the state's.
  std::uint64_t hash() const;
  /// The state's leaves in the order in which the state hash takes them, then the scratch's.
  void visit(const LeafSink& sink) const;

 private:
  friend class FaultDrill;  // of src/diagnostics
  LeafSource source_;
  std::uint32_t stage_;
};

}  // namespace isostep
