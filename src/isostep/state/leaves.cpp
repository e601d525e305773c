// Leaves as hashes.
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
  const LeafSink sink = {
      [](void* user, const PathPart&, LeafFormat, std::uint64_t bits) { static_cast<LeafHash*>(user)->add(bits); },
      &scratch};
  source_.walk(source_.engine, LeafPart::scratch, stage_, sink);
  const std::uint64_t state = source_.state_hash(source_.engine);
  if (!scratch.any()) return state;
  HashCombiner combiner;
  combiner.add(state);
  combiner.add(scratch.value());
  return combiner.value();
}

void StageView::visit(const LeafSink& sink) const {
  source_.walk(source_.engine, LeafPart::state, stage_, sink);
  source_.walk(source_.engine, LeafPart::scratch, stage_, sink);
}

}  // namespace isostep
