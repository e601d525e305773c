// Which core a configuration asks for.
// SPDX-License-Identifier: MIT
#include "isostep/session/client_core.hpp"
#include "isostep/session/host_core.hpp"
#include "isostep/session/relay_core.hpp"
#include "isostep/session/replay_core.hpp"
#include "isostep/session/session.hpp"
#include "isostep/session/sync_test_core.hpp"

namespace isostep {
namespace {

/// Of a configuration that cannot be.
class RefusedCore : public SessionCore {
 public:
  RefusedCore(const InputRules& rules, const char* problem) : SessionCore(SessionConfig{}, rules) {
    phase_ = SessionPhase::refused;
    SessionEvent event{.kind = SessionEvent::Kind::refused};
    event.field = {"configuration", {}, problem};
    tell(event);
  }
  bool add_local_input(int, Bytes) override { return false; }
  bool wants_input(int) const override { return false; }
  Time wait(Time) const override { return kSecond; }

 protected:
  void plan(Time) override {}
  void hash_known(Frame, std::uint64_t) override {}
};

}  // namespace

std::unique_ptr<SessionCore> make_session_core(const SessionConfig& config, const InputRules& rules, Bytes recording) {
  if (const char* problem = problem_of(config)) return std::make_unique<RefusedCore>(rules, problem);
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
  if (config.host) return std::make_unique<HostCore>(whole, rules);
  if (config.relays) return std::make_unique<RelayCore>(whole, rules);
  return std::make_unique<ClientCore>(whole, rules);
}

}  // namespace isostep
