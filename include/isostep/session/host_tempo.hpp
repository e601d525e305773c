// TempoDesk: the pauses and speeds that the host was asked for last, until they are announced.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/config.hpp"
#include "isostep/session/tempo.hpp"

namespace isostep {

class TempoDesk {
 public:
  explicit TempoDesk(const SessionConfig& config) : config_(config) {}
  /// False: the match cannot go so fast.
  bool wish(const Tempo& tempo) {
    // Peers count datagrams against their allowance: twice the match's rate goes through.
    const std::int64_t most = std::int64_t{config_.hz} * 2 * tempo.speed / Tempo::kNormal;
    if (!Tempo::is_speed(tempo.speed) || most > std::int64_t{config_.most_packets}) return false;
    wished_ = tempo;
    has_wish_ = true;
    return true;
  }
  /// A match that was saved goes on with this speed once it begins.
  void resume_with(std::uint8_t speed) { wished_.speed = speed; }
  void begin() { has_wish_ = wished_.speed != Tempo::kNormal; }
  /// What a further wish changes: the last one, or what was announced.
  const Tempo& latest(const Tempo& announced) const { return has_wish_ ? wished_ : announced; }
  /// To be announced now; null: nothing. One after the other: what was announced is in force first, here.
  const Tempo* next(const Tempo& announced, const Tempo& in_force) {
    if (!has_wish_ || announced.number != in_force.number) return nullptr;
    has_wish_ = false;
    return wished_.same_as(in_force) ? nullptr : &wished_;
  }

 private:
  const SessionConfig& config_;
  Tempo wished_;
  bool has_wish_ = false;
};

}  // namespace isostep
