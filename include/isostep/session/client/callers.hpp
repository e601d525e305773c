// Callers: machines that connect to a client because they have lost the host, and may make it the next.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "isostep/session/agreement/failover.hpp"
#include "isostep/session/client/follower_log.hpp"
#include "isostep/session/client/partings.hpp"

namespace isostep {

/// Raft's candidate. In: connections and hellos, inputs that others know, and their support. Out: what they are told:
/// where the host is, or the roster and the request for support; and the streams, with what they know. Keeps: the
/// connections, by PeerId, and how far the players' own machines have told us their inputs: such a machine knows all
/// that the host can have had of it, and its word counts more than another's; but with a deadline the host plays what
/// none of them said.
class Callers {
 public:
  Callers(const Roster& roster, Election& election, Partings& partings, std::vector<InputStream>& streams,
          Timeline& timeline, const InputRules& rules, OwnSeats& own, FollowerLog& log)
      : roster_(roster),
        election_(election),
        partings_(partings),
        streams_(streams),
        timeline_(timeline),
        rules_(rules),
        own_(own),
        log_(log) {}

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
  /// We are a candidate: all are asked for their support.
  void call();
  /// False: it cannot be, as no input from frame `most` on can.
  bool take_known(const Caller& caller, const InputSlice& slice, Frame most);
  /// False: we have not all inputs that it counts on.
  bool take_support(const Caller& caller, const Support& support);
  /// Another is the better candidate, as this one says, who goes there itself.
  void send_on(const Caller& from, const Address& to);
  /// Once a turn: how many have said nothing, and go. `has_host`: the match goes on where we are.
  std::uint64_t tend(bool has_host, Time now);
  std::optional<PeerId> write_next(std::vector<std::uint8_t>& message);
  /// We are elected: inputs of players whose machines support us, and which only others know.
  void forget_untold();
  std::vector<Caller>&& hand_over() { return std::move(all_); }

 private:
  void went(Caller& caller);
  /// Finds the caller in the roster, and whether it has a vote.
  void recognise(Caller& caller, const Hello& hello);
  void write_call(std::vector<std::uint8_t>& message) const;
  bool owns_inputs() const { return roster_.settings.deadline == 0; }

  const Roster& roster_;
  Election& election_;
  Partings& partings_;
  std::vector<InputStream>& streams_;
  Timeline& timeline_;
  const InputRules& rules_;
  OwnSeats& own_;
  FollowerLog& log_;
  Frame told_[kMaxPlayers] = {};
  Address better_;
  std::vector<Caller> all_;
};

}  // namespace isostep
