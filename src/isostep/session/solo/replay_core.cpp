// The replay of a match.
// SPDX-License-Identifier: MIT
#include "isostep/session/solo/replay_core.hpp"

#include "isostep/session/protocol/wire.hpp"

namespace isostep {

void write_match_frame(std::span<const InputStream> inputs, std::vector<std::uint8_t>& out) {
  std::uint32_t changed = 0;
  for (std::size_t p = 0; p < inputs.size(); ++p) {
    const InputStream& input = inputs[p];
    const bool is_first = input.end() - input.begin() < 2;
    changed |= (is_first || !input.repeats(input.end() - 1) ? 1u : 0u) << p;
  }
  std::uint8_t bytes[kMaxPlayers / 8 + kMaxPlayers * (kInputCap + 2)];
  WireWriter writer(bytes, sizeof bytes);
  for (std::size_t p = 0; p < inputs.size() && changed != 0; p += 8) {
    writer.byte(static_cast<std::uint8_t>(changed >> p));
  }
  for (std::size_t p = 0; p < inputs.size(); ++p) {
    if ((changed >> p & 1) == 0) continue;
    const InputEntry input = inputs[p].last();
    writer.number(input.absent ? 0 : static_cast<std::uint32_t>(input.bytes.size()) + 1);
    writer.raw(input.bytes);
  }
  out.assign(bytes, bytes + writer.size());
}

bool read_match_frame(Bytes bytes, std::span<InputStream> inputs) {
  WireReader reader(bytes);
  std::uint64_t changed = 0;
  for (std::size_t p = 0; p < inputs.size() && !bytes.empty(); p += 8) changed |= std::uint64_t{reader.byte()} << p;
  if (changed >> inputs.size() != 0) return false;
  for (std::size_t p = 0; p < inputs.size(); ++p) {
    InputStream& input = inputs[p];
    if ((changed >> p & 1) == 0) {
      if (input.end() == input.begin() || !input.append(input.last())) return false;
      continue;
    }
    const std::uint32_t size = reader.number();
    const Bytes said = size == 0 ? Bytes{} : reader.raw(size - 1);
    if (reader.failed() || !input.append({size == 0, said})) return false;
  }
  return reader.remaining() == 0;
}

ReplayCore::ReplayCore(const SessionConfig& config, const InputRules& rules, Bytes file)
    : SessionCore(config, rules),
      clock_(config.hz),
      file_(file),
      streams_(static_cast<std::size_t>(config.players), InputStream(config.kept, rules.cap)) {}

void ReplayCore::refuse_file(std::string_view key, std::string_view in_file, std::string_view here) {
  phase_ = SessionPhase::over;
  SessionEvent event{.kind = SessionEvent::Kind::refused};
  event.frame = current();
  event.field = {ShortText<kReplayKeyCap>(key), ShortText<kReplayValueCap>(in_file), ShortText<kReplayValueCap>(here)};
  tell(event);
}

bool ReplayCore::open_file() {
  if (!file_.has_header() || !file_.has_state()) {
    refuse_file("file", file_.error().message.view(), "a match recording");
    return false;
  }
  const HeaderMismatch mismatch = compare_headers(file_.header(), config_.identity);
  if (!mismatch.key.empty()) {
    refuse_file(mismatch.key.view(), mismatch.in_file.view(), mismatch.here.view());
    return false;
  }
  const ReplayField* first = file_.header().find(kFirstFrameKey);
  if (first == nullptr) return true;
  const Result<std::uint64_t> number = file_.header().number(kFirstFrameKey);
  constexpr std::uint64_t kLast = kLastFrame;
  if (!number || number.value() > kLast || file_.frame_count() > kLast - number.value()) {
    refuse_file(kFirstFrameKey, first->value.view(), "a number by which all frames are below 2^30");
    return false;
  }
  first_ = static_cast<Frame>(number.value());
  return true;
}

void ReplayCore::plan(Time now) {
  if (phase_ == SessionPhase::over) return;
  if (!asked_start_) {
    asked_start_ = true;
    if (!open_file()) return;
    portable_.assign(file_.state().begin(), file_.state().end());
    timeline_.restart(first_);
    for (InputStream& stream : streams_) stream.reset(first_);
    clock_.start(now);
    phase_ = SessionPhase::playing;
    act(RequestKind::restore, first_);
    act(RequestKind::save, first_);
    return;
  }
  if (!clock_.is_due(now)) return;
  if (static_cast<std::uint64_t>(current() - first_) >= file_.frame_count()) {
    if (file_.status() == ReplayStatus::complete) {
      phase_ = SessionPhase::over;
    } else {
      refuse_file("file", file_.error().message.view(), "a whole recording");
    }
    return;
  }
  if (!read_frame(current())) {
    refuse_file("file", "a frame that is none of this match", "inputs of every player");
    return;
  }
  timeline_.step(streams_);
  act(RequestKind::step, current() - 1);
  act(RequestKind::save, current());
  clock_.stepped(now);
}

bool ReplayCore::read_frame(Frame frame) {
  if (!read_match_frame(file_.frame(static_cast<std::uint64_t>(frame - first_)).input, streams_)) return false;
  for (const InputStream& stream : streams_) {
    if (!stream.last().absent && !rules_.valid(stream.last().bytes)) return false;
  }
  return true;
}

void ReplayCore::restored(bool ok) {
  if (!ok) refuse_file("file", "a first state that is none of this game", "its portable form");
}

void ReplayCore::hash_known(Frame state, std::uint64_t hash) {
  const std::uint64_t recorded =
      state == first_ ? file_.state_hash() : file_.frame(static_cast<std::uint64_t>(state - first_ - 1)).hash;
  if (hash != recorded) {
    SessionEvent event{.kind = SessionEvent::Kind::desync};
    event.frame = state;
    event.agreed = confirmed_state_;
    event.ours = hash;
    event.theirs = recorded;
    tell(event);
    phase_ = SessionPhase::over;
  }
  if (state > first_) confirm(state, hash);
  confirmed_state_ = state;
}

}  // namespace isostep
