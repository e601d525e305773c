// Leaves one by one, by name: what looks at every number of a state or of a step's scratch, and may turn a bit of one.
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

/// Is asked of every leaf which bits it shall have from now on. Leaves that may not be written keep theirs.
struct LeafEditor {
  std::uint64_t (*leaf)(void* user, const PathPart& path, LeafFormat format, std::uint64_t bits);
  void* user;
};

/// Two parts of what an engine has: what lasts, and what one stage of a step leaves for those that follow it.
enum class LeafPart : std::uint32_t { state, scratch };

/// What the leaves of an engine are reached by. `stage`: an index into its stages, or their count before the first.
struct LeafSource {
  void* engine;
  std::uint64_t (*state_hash)(const void* engine);
  /// With a null sink every leaf is edited, else none.
  void (*walk)(void* engine, LeafPart part, std::uint32_t stage, const LeafSink* sink, const LeafEditor* editor);
};

/// All state, and of a step's scratch what one stage made: given to an observer for the length of its call.
/// Cost:  nothing until it is asked; a hash or a walk takes some 5 ns a leaf, a contact has up to two hundred.
/// Order: fixed, and of what contacts are worked on by lanes, by contact: a look does not depend on their number.
class StageView {
 public:
  StageView(const LeafSource& source, std::uint32_t stage);

  /// Of the state's hash and every leaf of the scratch; where there is none, the state's.
  std::uint64_t hash() const;
  /// The state's leaves in the order in which the root hash takes them, then the scratch's.
  void visit(const LeafSink& sink) const;

 private:
  friend class FaultDrill;
  LeafSource source_;
  std::uint32_t stage_;
};

/// A fault made on purpose: one bit of one leaf, after one stage. For tests of what finds faults: an index or a count
/// that is turned may lead the engine beyond its arrays.
class FaultDrill {
 public:
  FaultDrill(std::string_view path, std::uint32_t bit);
  /// False when no leaf has that path and bit, or none that may be written: what lies in an island asleep is not.
  bool strike(const StageView& view) const;

 private:
  std::string path_;
  std::uint32_t bit_;
};

}  // namespace isostep
