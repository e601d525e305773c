// Timeline: prediction, and the comparison with what was said later.
// SPDX-License-Identifier: MIT
#include "isostep/session/timeline/timeline.hpp"

#include <cstring>

namespace isostep {

Timeline::Timeline(int players, Frame kept, const InputRules& rules)
    : players_(players),
      kept_(kept),
      rules_(rules),
      cells_(static_cast<std::size_t>(kept) * static_cast<std::size_t>(players)),
      bytes_(cells_.size() * rules.cap) {}

void Timeline::restart(Frame current) {
  current_ = current;
  for (Frame& checked : checked_) checked = current;
}

Frame Timeline::first_wrong(const std::vector<InputStream>& streams) {
  Frame wrong = current_;
  for (int p = 0; p < players_; ++p) {
    const InputStream& stream = streams[static_cast<std::size_t>(p)];
    for (; checked_[p] < stream.end() && checked_[p] < current_; ++checked_[p]) {
      if (checked_[p] < wrong && !was_right(checked_[p], p, stream.at(checked_[p]))) wrong = checked_[p];
    }
  }
  return wrong;
}

void Timeline::recheck(int player, Frame end) {
  if (checked_[player] > end) checked_[player] = end;
}

void Timeline::step(const std::vector<InputStream>& streams) {
  for (int p = 0; p < players_; ++p) fill(current_, p, streams[static_cast<std::size_t>(p)]);
  ++current_;
}

void Timeline::step_again(Frame frame, const std::vector<InputStream>& streams) {
  for (; frame < current_; ++frame) {
    for (int p = 0; p < players_; ++p) fill(frame, p, streams[static_cast<std::size_t>(p)]);
  }
}

Timeline::Used Timeline::used(Frame frame, int player) const {
  const std::size_t i = index(frame, player);
  return {cells_[i].status, Bytes(bytes_).subspan(i * rules_.cap, cells_[i].size)};
}

void Timeline::fill(Frame frame, int player, const InputStream& stream) {
  const std::size_t i = index(frame, player);
  std::uint8_t* to = bytes_.data() + i * rules_.cap;
  const bool known = stream.contains(frame);
  const InputEntry entry = known ? stream.at(frame) : stream.last();
  std::size_t size = rules_.neutral_size;
  if (entry.absent && (known || stream.end() > stream.begin())) {
    std::memcpy(to, rules_.neutral, size);  // who is gone stays gone until something is heard
  } else if (known) {
    size = entry.bytes.size();
    if (size > 0) std::memcpy(to, entry.bytes.data(), size);
  } else {
    const Bytes last = entry.absent ? Bytes(rules_.neutral, rules_.neutral_size) : entry.bytes;
    size = rules_.predict(last, frame - stream.end() + 1, to);
  }
  const bool gone = entry.absent && (known || stream.end() > stream.begin());
  cells_[i].status = gone ? InputStatus::disconnected : known ? InputStatus::confirmed : InputStatus::predicted;
  cells_[i].size = static_cast<std::uint16_t>(size);
}

bool Timeline::was_right(Frame frame, int player, const InputEntry& entry) const {
  const Used was = used(frame, player);
  if (entry.absent || was.status == InputStatus::disconnected) {
    return entry.absent && was.status == InputStatus::disconnected;
  }
  return same_input({false, was.bytes}, entry);
}

}  // namespace isostep
