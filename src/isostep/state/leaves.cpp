// Leaves as hashes, and drills.
// SPDX-License-Identifier: MIT
#include "isostep/state/leaves.hpp"

#include "isostep/state/hash.hpp"

namespace isostep {
namespace {

/// Bits of leaves one after another, a stretch at a time.
class LeafHash {
 public:
  void add(std::uint64_t bits) {
    if (filled_ == sizeof words_) flush();
    store_le(words_ + filled_, bits);
    filled_ += sizeof bits;
    any_ = true;
  }
  bool any() const { return any_; }
  std::uint64_t value() {
    flush();
    return stream_.value();
  }

 private:
  void flush() {
    stream_.update(words_, filled_);
    filled_ = 0;
  }

  HashStream stream_;
  bool any_ = false;
  std::size_t filled_ = 0;
  std::uint8_t words_[1024];
};

}  // namespace

StageView::StageView(const LeafSource& source, std::uint32_t stage) : source_(source), stage_(stage) {}

std::uint64_t StageView::hash() const {
  LeafHash scratch;
  const LeafSink sink = {[](void* user, const PathPart&, LeafFormat, std::uint64_t bits) {
                           static_cast<LeafHash*>(user)->add(bits);
                         },
                         &scratch};
  source_.walk(source_.engine, LeafPart::scratch, stage_, &sink, nullptr);
  const std::uint64_t state = source_.state_hash(source_.engine);
  if (!scratch.any()) return state;
  HashCombiner root;
  root.add(state);
  root.add(scratch.value());
  return root.value();
}

void StageView::visit(const LeafSink& sink) const {
  source_.walk(source_.engine, LeafPart::state, stage_, &sink, nullptr);
  source_.walk(source_.engine, LeafPart::scratch, stage_, &sink, nullptr);
}

FaultDrill::FaultDrill(std::string_view path, std::uint32_t bit) : path_(path), bit_(bit) {}

bool FaultDrill::strike(const StageView& view) const {
  struct Search {
    const FaultDrill& drill;
    bool found = false;
  } search{*this};
  const LeafEditor editor = {[](void* user, const PathPart& path, LeafFormat format, std::uint64_t bits) {
                               Search& s = *static_cast<Search*>(user);
                               if (s.drill.bit_ >= 8 * format.size || path_text(path) != s.drill.path_) return bits;
                               s.found = true;
                               return bits ^ std::uint64_t{1} << s.drill.bit_;
                             },
                             &search};
  for (const LeafPart part : {LeafPart::state, LeafPart::scratch}) {
    view.source_.walk(view.source_.engine, part, view.stage_, nullptr, &editor);
  }
  return search.found;
}

}  // namespace isostep
