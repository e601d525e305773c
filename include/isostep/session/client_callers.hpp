// Callers: machines that connect to a client because they have lost the host.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "isostep/session/client_log.hpp"
#include "isostep/session/client_partings.hpp"
#include "isostep/session/failover.hpp"

namespace isostep {

/// In: connections and hellos. Out: what they are told: where the host is, or as a candidate's word the roster and the
/// request for support. Keeps: the connections, by PeerId.
class Callers {
 public:
  Callers(const Roster& roster, Election& election, Partings& partings)
      : roster_(roster), election_(election), partings_(partings) {}

  static constexpr Time kGreeting = 2 * kSecond;  // [us] from the connection to the hello, as at a host

  void make_room(std::size_t most) { all_.resize(most); }
  /// False: there is no room.
  bool accept(PeerId peer, Time now);
  void disconnected(PeerId peer) {
    if (peer < all_.size()) went(all_[peer]);
  }
  /// Null: nobody is connected.
  Caller* find(PeerId peer) { return peer < all_.size() && all_[peer].is_connected ? &all_[peer] : nullptr; }
  bool take_hello(Caller& caller, Bytes bytes);
  /// Their places are others.
  void has_new_roster();
  /// We are a candidate.
  void ask_all();
  /// Another is the better candidate, as this one says, who goes there itself.
  void send_on(const Caller& from, const Address& to);
  /// Once a turn: how many have said nothing, and go. `has_host`: the match goes on where we are.
  std::uint64_t tend(bool has_host, Time now);
  std::optional<PeerId> write_next(const FollowerLog& log, std::vector<std::uint8_t>& message);
  /// Players of machines whose support has made us the host, a bit each.
  std::uint32_t players_of_supporters() const;
  std::vector<Caller>&& hand_over() { return std::move(all_); }

 private:
  void went(Caller& caller);
  /// Finds the caller in the roster, and whether it has a vote.
  void recognise(Caller& caller, const Hello& hello);
  void write_call(const FollowerLog& log, std::vector<std::uint8_t>& message) const;

  const Roster& roster_;
  Election& election_;
  Partings& partings_;
  Address better_;
  std::vector<Caller> all_;
};

}  // namespace isostep
