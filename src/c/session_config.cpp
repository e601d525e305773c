// The configuration of sessions in C.
// SPDX-License-Identifier: MIT
#include "session_config.hpp"

#include <cstring>

#include "isostep/core/version.hpp"
#include "isostep/session/preset.hpp"
#include "isostep/state/hash.hpp"
#include "session_handle.hpp"

namespace isostep::c {
namespace {

template <std::size_t N> bool ends(const char (&text)[N], std::size_t most) {
  const void* const end = std::memchr(text, 0, N);
  return end != nullptr && static_cast<std::size_t>(static_cast<const char*>(end) - text) <= most;
}

constexpr std::size_t kMostBlock = 256u << 20;  // [bytes] a state that is saved every frame is much smaller

/// The numbers that C and C++ have alike: an entry is a field that is copied as it is.
#define ISO_SESSION_FIELDS(X)                                                                                      \
  X(players)                                                                                                       \
  X(local_players)                                                                                                 \
  X(hz)                                                                                                            \
  X(window)                                                                                                        \
  X(delay)                                                                                                         \
  X(least_delay) X(most_delay) X(deadline) X(silence) X(patience) X(exclusion) X(kept) X(history) X(most_replayed) \
      X(max_peers) X(max_strangers) X(snapshot_cap) X(most_packets) X(broadcast_delay) X(seed) X(migration)        \
          X(reservation) X(token) X(seat)
#define ISO_SESSION_FLAGS(X) X(host) X(relays) X(repair) X(asks_admission) X(votes) X(players_set_tempo)

void from_session_config(const SessionConfig& from, iso_session_config& to) {
  to = {};
  to.size = sizeof to;
  to.mode = static_cast<std::uint32_t>(from.mode);
#define ISO_COPY(name) to.name = from.name;
  ISO_SESSION_FIELDS(ISO_COPY)
#undef ISO_COPY
#define ISO_COPY(name) to.name = from.name ? 1 : 0;
  ISO_SESSION_FLAGS(ISO_COPY)
#undef ISO_COPY
  to.input_least = to.input_cap = to.neutral_size = 1;
}

Problem problem_of_enums(const iso_session_config& config) {
  if (config.mode > ISO_REPLAY) return {ISO_BAD_ENUM, "mode: ISO_LOCKSTEP to ISO_REPLAY"};
  if (config.predictor > ISO_PREDICT_NEUTRAL) return {ISO_BAD_ENUM, "predictor: ISO_REPEAT_LAST, ISO_PREDICT_NEUTRAL"};
#define ISO_CHECK(name) \
  if (config.name > 1) return {ISO_BAD_ENUM, #name ": 0 or 1"};
  ISO_SESSION_FLAGS(ISO_CHECK)
#undef ISO_CHECK
  return {};
}

const char* problem_of_input(const iso_session_config& config) {
  if (config.input_cap < 1 || config.input_cap > ISO_INPUT_CAP) return "input_cap: 1 to 512 bytes";
  if (config.input_least > config.input_cap) return "input_least: 0 to input_cap";
  if (config.neutral_size < config.input_least || config.neutral_size > config.input_cap) {
    return "neutral_size: input_least to input_cap";
  }
  return nullptr;
}

const char* problem_of_texts(const iso_session_config& config) {
  ReplayHeader header;
  if (!ends(config.name, kReplayValueCap) || !header.set("scene", config.name, true)) {
    return "name: 1 to 128 characters of printable ASCII";
  }
  if (!ends(config.input_text, kReplayValueCap)) return "input_text: at most 128 characters";
  if (!ends(config.address, kAddressCap)) return "address: at most 64 characters";
  if (config.credential_size > kCredentialCap) return "credential_size: at most 256";
  return nullptr;
}

}  // namespace

Problem read_config(const iso_session_config* from, iso_session_config& to) {
  from_session_config({}, to);
  if (const iso_status status = take(from, to); status != ISO_OK) return {status, "what iso_session_config_init makes"};
  if (const Problem problem = problem_of_enums(to); problem.status != ISO_OK) return problem;
  const char* problem = problem_of_texts(to);
  if (problem == nullptr) problem = problem_of_input(to);
  if (problem == nullptr) problem = problem_of(to_session_config(to));
  return problem == nullptr ? Problem{} : Problem{ISO_REFUSED, problem};
}

Problem read_game(const iso_game* from, iso_game& to) {
  to = {};
  if (const iso_status status = take(from, to); status != ISO_OK) return {status, "what iso_game_init makes"};
  const bool has_own = to.save != nullptr;
  if ((to.load != nullptr) != has_own || (to.hash != nullptr) != has_own)
    return {ISO_NULL, "save, load, hash: together"};
  if ((to.write != nullptr) != (to.read != nullptr)) return {ISO_NULL, "write, read: together"};
  if (to.write != nullptr && !has_own) return {ISO_NULL, "write, read: of a game with save, load and hash"};
  if ((to.block != nullptr) != (to.block_size != 0)) return {ISO_NULL, "block, block_size: together"};
  if (to.block_size > kMostBlock) return {ISO_REFUSED, "block_size: at most 256 MB"};
  if (to.world == nullptr && to.block == nullptr && !has_own) return {ISO_NULL, "world, block or save: at least one"};
  return {};
}

SessionConfig to_session_config(const iso_session_config& from) {
  SessionConfig to;
  to.mode = static_cast<SessionMode>(from.mode);
#define ISO_COPY(name) to.name = from.name;
  ISO_SESSION_FIELDS(ISO_COPY)
#undef ISO_COPY
#define ISO_COPY(name) to.name = from.name != 0;
  ISO_SESSION_FLAGS(ISO_COPY)
#undef ISO_COPY
  to.address = Address(std::string_view(from.address));
  to.credential.assign(from.credential, from.credential + from.credential_size);
  return to;
}

Result<ReplayHeader> identity_of_game(const iso_game& game, const SessionWorld* world, const char* name) {
  if (world != nullptr) return world->identity(name);
  ReplayHeader header;
  const auto behaviour = ShortText<16>().append_hex(behaviour_version());
  const auto block = ShortText<20>().append_number(static_cast<std::uint64_t>(game.block_size));
  const bool ok = header.set("engine", kVersionText, false) && header.set("behaviour", behaviour.view(), true) &&
                  header.set("hash", kHashName, true) && header.set("scene", name, true) &&
                  header.set(kWorldKey, "none", true) && header.set("block", block.view(), true);
  if (!ok) return Error{ErrorCode::invalid, "1 to 128 characters of printable ASCII", "name"};
  return header;
}

}  // namespace isostep::c

using namespace isostep::c;

extern "C" {

iso_status iso_session_config_init_sized(iso_session_config* config, size_t size) {
  return guarded("session_config_init", [&] {
    iso_session_config defaults;
    from_session_config({}, defaults);
    return start_struct("session_config_init", defaults, config, size);
  });
}

iso_status iso_session_config_preset(iso_session_config* config, iso_genre genre, int32_t players) {
  if (const iso_status status = check_struct(config, ISO_C_CALL); status != ISO_OK) return status;
  if (genre > ISO_SANDBOX) return refuse(ISO_BAD_ENUM, ISO_C_CALL, "genre");
  return guarded(ISO_C_CALL, [&] {
    iso_session_config chosen;
    from_session_config(isostep::preset(static_cast<isostep::Genre>(genre), players), chosen);
    give(chosen, config);
    return ISO_OK;
  });
}

const char* iso_session_config_problem(const iso_session_config* config) {
  const char* text = "memory: enough for a configuration";
  const auto read = [&] {
    iso_session_config whole;
    const Problem problem = read_config(config, whole);
    text = problem.status == ISO_OK ? nullptr : problem.text;
    return ISO_OK;
  };
  static_cast<void>(guarded(ISO_C_CALL, read));
  return text;
}

iso_status iso_game_init_sized(iso_game* game, size_t size) { return start_struct("game_init", {}, game, size); }

uint64_t iso_hash_bytes(const void* bytes, size_t size) {
  return bytes == nullptr && size > 0 ? 0 : isostep::hash_bytes(bytes, size);
}
}
