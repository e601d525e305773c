// The parts of `verify` that need no simulation.
// SPDX-License-Identifier: MIT
#include "isostep/state/verify.hpp"

#include <cstring>

namespace isostep {
namespace {

std::string text_of(std::string_view what, const Error& error) {
  return std::string(what).append(error.message.view()).append(" (").append(error.place.view()).append(")");
}

std::string shown(std::string_view value) {
  if (value.empty()) return "missing";
  std::string quoted = "\"";
  quoted += value;
  return quoted += '"';
}

std::string hash_text(std::uint64_t hash) { return std::string(ShortText<16>().append_hex(hash).view()); }

}  // namespace

namespace detail {

VerifyResult verify_file(const ReplayReader& replay) {
  VerifyResult result{};
  result.offset = replay.place();
  if (replay.status() == ReplayStatus::corrupt) {
    result.outcome = VerifyOutcome::corrupt;
    result.error = replay.error();
  } else if (replay.status() == ReplayStatus::incompatible) {
    result.outcome = VerifyOutcome::incompatible;
    result.error = replay.error();
    result.mismatch.key = "format";
  }
  return result;
}

VerifyResult verify_end(const ReplayReader& replay, std::uint64_t compared) {
  VerifyResult result{};
  result.frames = compared;
  if (replay.status() == ReplayStatus::complete) return result;
  result.outcome = VerifyOutcome::truncated;
  result.frames = replay.frame_count();
  result.offset = replay.place();
  result.error = replay.error();
  return result;
}

VerifyResult too_short(const ReplayReader& replay) {
  VerifyResult result = verify_end(replay, replay.frame_count());
  if (result.outcome == VerifyOutcome::truncated) return result;
  result.outcome = VerifyOutcome::truncated;
  result.error = {ErrorCode::truncated, "the replay has no more frames", "span"};
  return result;
}

VerifyResult stopped(std::uint64_t frames) {
  VerifyResult result{};
  result.outcome = VerifyOutcome::stopped;
  result.frames = frames;
  return result;
}

VerifyResult diverged(VerifyResult::Where where, std::uint64_t frames, std::uint64_t expected, std::uint64_t actual) {
  VerifyResult result{};
  result.outcome = VerifyOutcome::diverged;
  result.where = where;
  result.frames = frames;
  result.expected = expected;
  result.actual = actual;
  return result;
}

VerifyResult corrupt(std::uint64_t frames, std::size_t offset, const Error& error) {
  VerifyResult result{};
  result.outcome = VerifyOutcome::corrupt;
  result.frames = frames;
  result.offset = offset;
  result.error = error;
  return result;
}

VerifyResult incompatible(const HeaderMismatch& mismatch) {
  VerifyResult result{};
  result.outcome = VerifyOutcome::incompatible;
  result.mismatch = mismatch;
  return result;
}

bool same_bytes(Bytes a, Bytes b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size()) == 0);
}

}  // namespace detail

int exit_code(VerifyOutcome outcome) { return static_cast<int>(outcome); }

std::string describe(const VerifyResult& result) {
  const std::string frames = std::to_string(result.frames);
  switch (result.outcome) {
    case VerifyOutcome::verified: return "VERIFIED " + frames + " frames";
    case VerifyOutcome::diverged: break;
    case VerifyOutcome::incompatible:
      if (!result.error.message.empty()) return text_of("INCOMPATIBLE: ", result.error);
      return "INCOMPATIBLE: " + std::string(result.mismatch.key.view()) + " is " +
             shown(result.mismatch.in_file.view()) + " in the replay, " + shown(result.mismatch.here.view()) + " here";
    case VerifyOutcome::truncated: return text_of("TRUNCATED at frame " + frames + ": ", result.error);
    case VerifyOutcome::corrupt:
      return text_of("CORRUPT at byte " + std::to_string(result.offset) + ": ", result.error);
    case VerifyOutcome::stopped: return "STOPPED before frame " + frames;
  }
  const char* where = result.where == VerifyResult::Where::start      ? "DIVERGED at the start"
                      : result.where == VerifyResult::Where::keyframe ? "DIVERGED at the keyframe before frame "
                                                                      : "DIVERGED at frame ";
  std::string text = where;
  if (result.where != VerifyResult::Where::start) text += frames;
  return text + ": " + hash_text(result.expected) + " in the replay, " + hash_text(result.actual) + " here";
}

}  // namespace isostep
