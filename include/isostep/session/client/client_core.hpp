// ClientCore: a player or spectator of a host's match, from the first word to late joins and returns.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/client/callers.hpp"
#include "isostep/session/client/distance.hpp"
#include "isostep/session/client/host_search.hpp"
#include "isostep/session/client/repair.hpp"
#include "isostep/session/client/supporter.hpp"
#include "isostep/session/client/wishes.hpp"
#include "isostep/session/peer/datagrams.hpp"
#include "isostep/session/peer/peer_core.hpp"
#include "isostep/session/protocol/outbox.hpp"

namespace isostep {

/// Our own inputs are final when the host says it has them; the others' when they arrive. Cut off, the client keeps its
/// history, and greets again from its newest final state: if the host still has the inputs since, no snapshot travels.
/// In: the host's word, or that it is gone. Out: ours, to the host and to who connects to us. Keeps: the link, and the
/// parts below, each of which can be read alone.
class ClientCore : public PeerCore {
 public:
  ClientCore(const SessionConfig& config, const InputRules& rules);
  /// A host that the others have left behind.
  ClientCore(PeerCore&& host, Retreat&& retreat, Time now);

  void connected(PeerId host, Time now) override;
  void accepted(PeerId peer, Time now) override;
  void disconnected(PeerId peer, Time now) override;
  void receive(PeerId host, Channel channel, Bytes bytes, Time now) override;
  std::optional<Outgoing> poll_send(Time now) override;
  std::optional<Address> poll_connect() override { return search_.poll_connect(); }
  bool go_on(Time now) override;
  std::unique_ptr<SessionCore> succeed(Time now) override;
  void restored(bool ok) override;
  bool resync() override;
  std::uint32_t local_players() const override { return own_.players(); }
  MatchControl* control() override { return &wishes_; }
  std::uint64_t token() const override { return search_.token(); }
  SnapshotProgress snapshot_progress(PeerId) const override {
    return entry_.is_restoring() || repair_.receives() ? arrival_.progress() : SnapshotProgress{};
  }

 protected:
  bool is_local(int player) const override { return own_.is_open() && own_.has(player); }
  bool running() const override { return standing_ == Standing::runs && !repair_.restores(); }
  Frame window() const override { return own_.is_open() ? PeerCore::window() : 0; }
  Frame final_limit() const override;
  bool hurries(Time now) const override;
  void before_steps(Time now) override;
  void observe_delay() override;
  Frame early(int player) const override;
  void blocked(Time now) override;
  void hash_known(Frame state, std::uint64_t hash) override;

  bool is_host(PeerId peer) const { return host_.is_connected && host_.peer == peer; }
  /// We have the host's states, and go on from there.
  bool is_settled_in() const {
    return is_greeted() && has_start_ && !entry_.is_under_way() && !entry_.is_spoiled() && !repair_.is_under_way();
  }
  /// The match has begun; also while the host is away.
  bool has_begun() const { return standing_ == Standing::runs || current() > 0; }
  std::uint64_t match() const { return entry_.welcome().match; }
  std::uint32_t hosted() const { return entry_.welcome().hosted; }
  Frame told_final() const { return log_.told_final(); }

 protected:
  Datagrams datagrams_{config_, streams_, hashes_, clock_, stats_};

 private:
  /// What we are to the host to which we connected last.
  enum class Standing : std::uint8_t {
    unknown,
    greeted,  // it has welcomed us
    runs      // and the match runs
  };
  bool is_greeted() const { return standing_ != Standing::unknown; }

  // --- connection and beginning, in client_join.cpp ---
  /// `knocks`: it spoke until now, and may live.
  void lose(Time now, bool knocks);
  void leave_host();
  void fail(SessionEvent::Kind kind, SessionPhase phase);
  bool take_message(MessageKind kind, Bytes bytes, Time now);
  void take_welcome(const Welcome& welcome, Time now);
  void write_own_hello();
  void begin();

  // --- in the match, in client_core.cpp ---
  void take_packet(const Packet& packet, Time now);
  void take_inputs(const InputSlice& slice, Time now);
  bool write_to_host(Time now);
  PacketHeader header() const;
  /// To the host, of our players.
  SendEnds ends() const;
  /// Our seats: whether they may be open, and whether we say so.
  void tend_seats(Time now);

  // --- without a host, in client_failover.cpp ---
  /// For the match, or on the way to another host; false: it is none of these, or damaged.
  bool take_failover(MessageKind kind, Bytes bytes, Time now);
  bool take_support(Caller& caller, MessageKind kind, Bytes bytes, Time now);
  void take_call(PeerId peer, Channel channel, Bytes bytes, Time now);
  bool can_fail_over() const { return config_.migration > 0 && search_.can_begin(); }
  /// We could be the host: we have a state of the match, and ours are right.
  bool may_stand() const;
  void seek(Time now, bool knocks);
  void seek_on(Time now);
  void stop_seeking();
  void ask_next();
  void go_to(const Address& address, Time now);

  // --- among machines that differ, in client_resync.cpp ---
  bool take_repair(MessageKind kind, Bytes bytes);
  bool take_statements(const Statements& statements);
  bool take_offer(const RepairOffer& offer);
  /// Once a turn: hands over the state that has arrived, and lets the present go on while frames are stepped again.
  void tend_repair(Time now);
  void finish_repair(std::uint64_t hash);

  PeerLink host_;
  Standing standing_ = Standing::unknown;
  Outbox<MessageKind> due_;  // to the host, of those that no part writes
  Partings partings_;
  SnapshotArrival arrival_{portable_};
  Entry entry_{arrival_, false};
  OwnSeats own_{streams_, timeline_, host_};
  Wishes wishes_{own_, host_, ballot_};
  FollowerLog log_{streams_, timeline_, own_, entry_};
  Distance distance_{config_, host_, clock_};
  Repair repair_{arrival_, hashes_, catches_up_to_};
  HostSearch search_;
  Callers callers_{search_.roster(), search_.election(), partings_, streams_, timeline_, rules_, own_, log_};
  Supporter supporter_{search_.roster(), search_.election(), streams_, log_};
  bool is_too_far_ = false;    // no delay covers our line
  std::uint32_t figured_ = 0;  // players, a bit each, whose figures we know
};

}  // namespace isostep
