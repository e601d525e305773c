// Failover: a client without its host looks for the next one, supports it, or is elected.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/client/callers.hpp"
#include "isostep/session/client/client_parts.hpp"
#include "isostep/session/client/host_search.hpp"
#include "isostep/session/client/supporter.hpp"

namespace isostep {

/// In: the loss of the host, machines that connect to us, and what they, the host and candidates say. Out: the address
/// to connect to, and messages to all of these. Keeps: the search, the callers, and our support.
class Failover {
 public:
  Failover(const ClientParts& parts, FollowerLog& log, HostSearch&& search, std::vector<std::uint8_t>& scratch)
      : client_(parts), log_(log), scratch_(scratch), search_(std::move(search)) {}

  HostSearch& search() { return search_; }
  const HostSearch& search() const { return search_; }
  Callers& callers() { return callers_; }
  bool can_begin() const { return client_.config.migration > 0 && search_.can_begin(); }
  /// We are connected to another machine: drops what a candidate or a host was still to be told.
  void is_connected() {
    supporter_.answer_nothing();
    must_enroll_ = false;
  }
  /// `knocks`: the host was heard until now, and may live.
  void begin(Time now, bool knocks);
  /// Call it once per turn. `may_stand`: we could be the host.
  void tend(bool may_stand, Time now);
  /// Ends the search: another machine has welcomed us as its client.
  void end();
  /// See Session.
  bool go_on(bool may_stand, Time now);

  /// Takes a message of the host or a candidate. Returns false if it is of another kind, or damaged.
  bool receive(MessageKind kind, Bytes bytes, bool may_stand, Time now);
  /// Takes a message of a machine that connected to us.
  void receive_call(PeerId peer, Channel channel, Bytes bytes, Time now);
  std::optional<PeerId> write_next(std::vector<std::uint8_t>& message);

 private:
  void leave_host() { client_.partings.leave(client_.host, client_.is_greeted() || search_.is_under_way()); }
  void go_to(const Address& address, Time now);
  bool take_support(Caller& caller, MessageKind kind, Bytes bytes, Time now);
  bool take_known(const Caller& caller, const Packet& packet);

  ClientParts client_;
  FollowerLog& log_;
  std::vector<std::uint8_t>& scratch_;
  HostSearch search_;
  Callers callers_{search_.roster(), search_.election(), client_.partings, client_.streams,
                   client_.timeline, client_.rules,      client_.own,      log_};
  Supporter supporter_{search_.roster(), search_.election(), client_.streams, log_};
  bool must_enroll_ = false;  // the host is told which roster we have
};

}  // namespace isostep
