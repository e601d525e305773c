// InputStream's ring.
// SPDX-License-Identifier: MIT
#include "isostep/session/timeline/input_stream.hpp"

#include <cstring>

namespace isostep {
namespace {
constexpr std::uint16_t kAbsent = 0xffff;
}

InputStream::InputStream(Frame capacity, std::size_t input_cap)
    : capacity_(capacity),
      input_cap_(input_cap),
      sizes_(static_cast<std::size_t>(capacity), kAbsent),
      bytes_(static_cast<std::size_t>(capacity) * input_cap),
      repeats_(static_cast<std::size_t>(capacity), 0) {}

void InputStream::reset(Frame first) { begin_ = end_ = first; }

bool InputStream::replace(Frame frame, const InputEntry& entry) {
  if (entry.bytes.size() > input_cap_) return false;
  const std::size_t place = slot(frame);
  sizes_[place] = entry.absent ? kAbsent : static_cast<std::uint16_t>(entry.bytes.size());
  if (!entry.bytes.empty()) std::memcpy(&bytes_[place * input_cap_], entry.bytes.data(), entry.bytes.size());
  note_repeat(frame);
  if (frame + 1 < end_) note_repeat(frame + 1);
  return true;
}

void InputStream::note_repeat(Frame frame) {
  repeats_[slot(frame)] = frame > begin_ && same_input(at(frame), at(frame - 1)) ? 1 : 0;
}

bool InputStream::append(const InputEntry& entry) {
  if (!replace(end_, entry)) return false;
  ++end_;
  if (end_ - begin_ > capacity_) begin_ = end_ - capacity_;
  return true;
}

void InputStream::append_absent_until(Frame end) {
  while (end_ < end) append({true, {}});
}

void InputStream::truncate(Frame end) {
  if (end < end_) end_ = end < begin_ ? begin_ : end;
}

InputEntry InputStream::at(Frame frame) const {
  const std::size_t place = slot(frame);
  if (sizes_[place] == kAbsent) return {true, {}};
  return {false, Bytes(bytes_).subspan(place * input_cap_, sizes_[place])};
}

InputEntry InputStream::last() const { return end_ > begin_ ? at(end_ - 1) : InputEntry{true, {}}; }

}  // namespace isostep
