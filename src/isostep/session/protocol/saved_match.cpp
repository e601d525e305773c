// A saved match as bytes.
// SPDX-License-Identifier: MIT
#include "isostep/session/protocol/saved_match.hpp"

#include "isostep/state/archive.hpp"
#include "isostep/state/hash.hpp"
#include "isostep/state/replay_format.hpp"

namespace isostep {
namespace {

constexpr std::uint32_t kMagic = 0x4d4f5349;              // "ISOM"
constexpr std::uint32_t kStateCap = 1u << 30;             // [bytes] of a state
constexpr std::size_t kChecksum = sizeof(std::uint64_t);  // [bytes]

Error fault(ErrorCode code, const char* message, const char* place) { return {code, message, place}; }

/// What is read must make a match that could be.
Result<void> check(const SavedMatch& match) {
  if (match.start.frame < 0 || match.start.frame > kLastFrame)
    return fault(ErrorCode::invalid, "out of range", "frame");
  if (match.players < 1 || match.players > kMaxPlayers) return fault(ErrorCode::invalid, "1 to 32", "players");
  if (std::uint64_t{match.hosted} >> match.players != 0) return fault(ErrorCode::invalid, "no such player", "hosted");
  if (!Tempo::is_speed(match.speed)) return fault(ErrorCode::invalid, "4 to 16", "speed");
  if (match.term == 0 || match.term == ~std::uint32_t{0}) return fault(ErrorCode::invalid, "out of range", "term");
  for (int p = 0; p < match.players; ++p) {
    if ((match.hosted >> p & 1) != 0 && match.proofs[p] != 0) {
      return fault(ErrorCode::invalid, "a seat of the host's, and of a client's", "seats");
    }
  }
  return {};
}

}  // namespace

void write_saved_match(const SavedMatch& match, std::vector<std::uint8_t>& out) {
  std::vector<std::uint8_t> identity;
  write_replay_header(match.identity, identity);
  out.clear();
  Writer writer(out);
  writer.write(kMagic);
  writer.write(kSavedMatchVersion);
  writer.write_bytes(identity);
  writer.write(match.start.frame);
  writer.write(match.start.chain);
  writer.write(match.hash);
  writer.write(match.hosted);
  writer.write(match.speed);
  writer.write(match.term);
  writer.write(match.players);
  for (int p = 0; p < match.players; ++p) writer.write(match.proofs[p]);
  writer.write_bytes(match.state);
  const std::uint64_t checksum = hash_bytes(out.data(), out.size());
  writer.write(checksum);
}

Result<SavedMatch> read_saved_match(Bytes bytes) {
  Reader head(bytes);
  const auto magic = head.read<std::uint32_t>();
  const auto version = head.read<std::uint16_t>();
  if (!head.ok() || magic != kMagic) return fault(ErrorCode::corrupt, "no saved match", "magic");
  if (version != kSavedMatchVersion) return fault(ErrorCode::incompatible, "of another version", "version");
  if (bytes.size() < kChecksum) return fault(ErrorCode::truncated, "ends early", "checksum");
  const Bytes body = bytes.first(bytes.size() - kChecksum);
  Reader tail(bytes.subspan(body.size()));
  if (tail.read<std::uint64_t>() != hash_bytes(body.data(), body.size())) {
    return fault(ErrorCode::corrupt, "the bytes are not those that were written", "checksum");
  }
  Reader reader(body.subspan(sizeof kMagic + sizeof kSavedMatchVersion));
  SavedMatch match;
  const Bytes identity = reader.read_bytes(kReplayHeadCap);
  reader.read(match.start.frame);
  reader.read(match.start.chain);
  reader.read(match.hash);
  reader.read(match.hosted);
  reader.read(match.speed);
  reader.read(match.term);
  reader.read(match.players);
  for (std::size_t p = 0; p < match.players && p < kMaxPlayers; ++p) reader.read(match.proofs[p]);
  const Bytes state = reader.read_bytes(kStateCap);
  reader.expect_end();
  if (const Result<void> whole = reader.result("saved match"); !whole) return whole.error();
  const Result<ReplayHeader> header = read_replay_header(identity);
  if (!header) return header.error();
  if (const Result<void> sound = check(match); !sound) return sound.error();
  match.identity = header.value();
  match.state.assign(state.begin(), state.end());
  return match;
}

}  // namespace isostep
