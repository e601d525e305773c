// Which core a configuration asks for.
// SPDX-License-Identifier: MIT
#include <bit>

#include "isostep/session/client/client_core.hpp"
#include "isostep/session/client/relay_core.hpp"
#include "isostep/session/host/host_core.hpp"
#include "isostep/session/session.hpp"
#include "isostep/session/solo/replay_core.hpp"
#include "isostep/session/solo/sync_test_core.hpp"

namespace isostep {
namespace {

/// Of a configuration that cannot be.
class RefusedCore : public SessionCore {
 public:
  RefusedCore(const InputRules& rules, const Refusal& field) : SessionCore(SessionConfig{}, rules) {
    phase_ = SessionPhase::refused;
    SessionEvent event{.kind = SessionEvent::Kind::refused};
    event.field = field;
    tell(event);
  }
  bool add_local_input(int, Bytes) override { return false; }
  bool wants_input(int) const override { return false; }
  Time wait(Time) const override { return kSecond; }

 protected:
  void plan(Time) override {}
  void hash_known(Frame, std::uint64_t) override {}
};

std::unique_ptr<SessionCore> resume(const SessionConfig& config, const InputRules& rules) {
  Result<SavedMatch> saved = read_saved_match(config.saved_match);
  const auto refused = [&](const Refusal& field) { return std::make_unique<RefusedCore>(rules, field); };
  if (!saved) {
    return refused({"saved_match", ShortText<kReplayValueCap>(saved.error().place.view()),
                    ShortText<kReplayValueCap>(saved.error().message.view())});
  }
  const HeaderMismatch mismatch = compare_headers(saved.value().identity, config.identity);
  if (!mismatch.key.empty()) return refused(mismatch);
  const bool is_whole = saved.value().players == config.players;
  if (!is_whole || std::popcount(saved.value().hosted) != config.local_players) {
    return refused({"saved_match", is_whole ? "local_players" : "players", "as many as in the match"});
  }
  SavedMatch match = saved.value();
  SessionConfig rest = config;
  rest.saved_match.clear();
  return std::make_unique<HostCore>(rest, rules, std::move(match));
}

}  // namespace

std::unique_ptr<SessionCore> make_session_core(const SessionConfig& config, const InputRules& rules, Bytes recording) {
  if (const char* problem = problem_of(config))
    return std::make_unique<RefusedCore>(rules, Refusal{"configuration", {}, problem});
  SessionConfig whole = config;
  ShortText<kReplayValueCap> schema, players;
  schema.append_hex(rules.schema);
  players.append_number(static_cast<std::uint64_t>(config.players));
  whole.identity.set("input_schema", schema.view(), true);
  ShortText<kReplayValueCap> hz;
  hz.append_number(static_cast<std::uint64_t>(config.hz));
  whole.identity.set("session_hz", hz.view(), true);
  whole.identity.set("players", players.view(), true);
  if (config.mode == SessionMode::sync_test) return std::make_unique<SyncTestCore>(whole, rules);
  if (config.mode == SessionMode::replay) return std::make_unique<ReplayCore>(whole, rules, recording);
  if (!config.saved_match.empty()) return resume(whole, rules);
  if (config.host) return std::make_unique<HostCore>(whole, rules);
  if (config.relays) return std::make_unique<RelayCore>(whole, rules);
  return std::make_unique<ClientCore>(whole, rules);
}

}  // namespace isostep
