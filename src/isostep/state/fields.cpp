// Fields as hashes.
// SPDX-License-Identifier: MIT
#include "isostep/state/fields.hpp"

#include "isostep/state/hash.hpp"

namespace isostep {
namespace {

/// Bits of fields one after another, a stretch at a time.
class FieldHash {
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

StageView::StageView(const FieldSource& source, std::uint32_t stage) : source_(source), stage_(stage) {}

std::uint64_t StageView::hash() const {
  FieldHash scratch;
  const FieldSink sink = {
      [](void* user, const PathPart&, FieldFormat, std::uint64_t bits) { static_cast<FieldHash*>(user)->add(bits); },
      &scratch};
  source_.walk(source_.engine, FieldGroup::scratch, stage_, sink);
  const std::uint64_t state = source_.state_hash(source_.engine);
  if (!scratch.any()) return state;
  HashCombiner combiner;
  combiner.add(state);
  combiner.add(scratch.value());
  return combiner.value();
}

void StageView::visit(const FieldSink& sink) const {
  source_.walk(source_.engine, FieldGroup::state, stage_, sink);
  source_.walk(source_.engine, FieldGroup::scratch, stage_, sink);
}

}  // namespace isostep
