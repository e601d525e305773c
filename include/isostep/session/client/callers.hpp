// Callers: machines that connect to a client because they have lost the host, and may make it the next.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "isostep/session/agreement/failover.hpp"
#include "isostep/session/client/follower_log.hpp"
#include "isostep/session/client/partings.hpp"

namespace isostep {

/// Raft's candidate. In: connections and hellos, inputs that others know, and their support. Out: their answers, which
/// are the host's address, or the roster and a request for support; and the streams with what they know. Keeps: the
/// connections, by PeerId, and how far the players' own machines have told us their inputs. A player's own machine
/// knows all inputs that the host can have of it, so its word counts more than another's. Not with a deadline: then the
/// host plays inputs that none of them said.
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
  /// Returns false if there is no room.
  bool accept(PeerId peer, Time now);
  void disconnected(PeerId peer) {
    if (peer < all_.size()) went(all_[peer]);
  }
  /// Returns null if the peer is not connected.
  Caller* find(PeerId peer) { return peer < all_.size() && all_[peer].is_connected ? &all_[peer] : nullptr; }
  bool take_hello(Caller& caller, Bytes bytes);
  /// The roster has changed: finds all callers in it anew.
  void has_new_roster();
  /// We are a candidate: asks all callers for their support.
  void call();
  /// Takes inputs that a caller knows. Returns false if they are invalid, or of frame `most` or later.
  bool take_known(const Caller& caller, const InputSlice& slice, Frame most);
  /// Takes a caller's support. Returns false if we lack inputs that it relies on.
  bool take_support(const Caller& caller, const Support& support);
  /// Redirects all callers but `from` to a better candidate: `from` has named it, and goes there itself.
  void send_on(const Caller& from, const Address& to);
  /// Call it once per turn. Returns how many silent callers it drops. `has_host`: others are sent on to our host.
  std::uint64_t tend(bool has_host, Time now);
  std::optional<PeerId> write_next(std::vector<std::uint8_t>& message);
  /// We are elected: forgets a supporter's inputs that only other machines have told.
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
