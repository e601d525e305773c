// TempoDesk: the pauses and speeds that the host was asked for last, until they are announced.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/config.hpp"
#include "isostep/session/pace/tempo.hpp"

namespace isostep {

/// In: wishes, each of which changes the one before. Out: the tempo to announce.
class TempoDesk {
 public:
  /// `announced`: the newest announced tempo.
  TempoDesk(const SessionConfig& config, const Tempo& announced) : config_(config), announced_(announced) {}
  /// Makes a saved match go on with this speed once it begins.
  void resume_with(std::uint8_t speed) { wished_.speed = speed; }
  void begin() { has_wish_ = wished_.speed != Tempo::kNormal; }
  bool wish_pause(bool is_paused, std::uint8_t by) {
    const Tempo& latest = has_wish_ ? wished_ : announced_;
    return wish(latest.speed, is_paused, by);
  }
  /// Returns false if the match cannot go so fast.
  bool wish_speed(int speed, std::uint8_t by) {
    const Tempo& latest = has_wish_ ? wished_ : announced_;
    return wish(speed, latest.is_paused, by);
  }
  /// Returns the tempo to announce now; null: none. The last announced one must first be in force here.
  const Tempo* next(const Tempo& in_force) {
    if (!has_wish_ || announced_.number != in_force.number) return nullptr;
    has_wish_ = false;
    return wished_.same_as(in_force) ? nullptr : &wished_;
  }

 private:
  bool wish(int speed, bool is_paused, std::uint8_t by) {
    // Peers count datagrams against their allowance: twice the match's rate goes through.
    const std::int64_t most = std::int64_t{config_.hz} * 2 * speed / Tempo::kNormal;
    if (!Tempo::is_speed(speed) || most > std::int64_t{config_.most_packets}) return false;
    wished_.speed = static_cast<std::uint8_t>(speed);
    wished_.is_paused = is_paused;
    wished_.by = by;
    has_wish_ = true;
    return true;
  }

  const SessionConfig& config_;
  const Tempo& announced_;
  Tempo wished_;
  bool has_wish_ = false;
};

}  // namespace isostep
