// ClientCore: a player or spectator of a host's match, from the first word to late joins and returns.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/client/comparison.hpp"
#include "isostep/session/client/distance.hpp"
#include "isostep/session/client/failover.hpp"
#include "isostep/session/client/wishes.hpp"
#include "isostep/session/peer/datagrams.hpp"
#include "isostep/session/peer/peer_core.hpp"
#include "isostep/session/protocol/outbox.hpp"

namespace isostep {

/// Our own inputs are final when the host says that it has them; the others' when they arrive. A client that is cut off
/// keeps its history, and greets again from its newest final state: if the host still has the inputs since, it sends no
/// snapshot. In: the host's messages, or its loss. Out: ours, to the host and to machines that connect to us. Keeps:
/// the link, and the parts below, each of which can be read alone.
class ClientCore : public PeerCore {
 public:
  ClientCore(const SessionConfig& config, const InputRules& rules);
  /// Turns a host that the others have left behind into a client.
  ClientCore(PeerCore&& host, Retreat&& retreat, Time now);

  void connected(PeerId host, Time now) override;
  void accepted(PeerId peer, Time now) override;
  void disconnected(PeerId peer, Time now) override;
  void receive(PeerId host, Channel channel, Bytes bytes, Time now) override;
  std::optional<Outgoing> poll_send(Time now) override;
  std::optional<Address> poll_connect() override { return failover_.search().poll_connect(); }
  bool go_on(Time now) override { return failover_.go_on(may_stand(), now); }
  std::unique_ptr<SessionCore> succeed(Time now) override;
  void restored(bool ok) override;
  bool resync() override { return comparison_.resync(); }
  std::uint32_t local_players() const override { return own_.players(); }
  MatchControl* control() override { return &wishes_; }
  std::uint64_t token() const override { return failover_.search().token(); }
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
  /// Returns true if we have a state of the host's, and go on from there.
  bool is_settled_in() const {
    return is_greeted() && has_start_ && !entry_.is_under_way() && !entry_.is_spoiled() && !repair_.is_under_way();
  }
  /// Returns true if the match has begun, also while the host is away.
  bool has_begun() const { return standing_ == Standing::runs || current() > 0; }
  std::uint64_t match() const { return entry_.welcome().match; }
  std::uint32_t hosted() const { return entry_.welcome().hosted; }
  Frame told_final() const { return log_.told_final(); }

  Datagrams datagrams_{config_, streams_, hashes_, clock_, stats_};

 private:
  bool is_greeted() const { return standing_ != Standing::unknown; }

  // --- connection and beginning, in client_join.cpp ---
  /// We lost the host. `knocks`: it was heard until now, and may live.
  void lose(Time now, bool knocks);
  void leave_host();
  bool take_message(MessageKind kind, Bytes bytes, Time now);
  void take_welcome(const Welcome& welcome, Time now);
  void write_own_hello();
  void begin();
  /// Restores the state that has arrived.
  void restore(Frame frame);

  // --- in the match, in client_core.cpp ---
  void take_packet(const Packet& packet, Time now);
  void take_inputs(const InputSlice& slice, Time now);
  bool write_to_host(Time now);
  PacketHeader header() const;
  /// The ends of our players' inputs, which the host is sent.
  SendEnds ends() const;
  /// Checks if our players may play, and asks the host for it.
  void tend_seats(Time now);

  // --- without a host, in client_failover.cpp ---
  /// Returns true if we could be the host: we play, have a state of the match, and no majority finds it wrong.
  bool may_stand() const;

  // --- among machines that differ, in client_resync.cpp ---
  /// Once per turn: restores the state that has arrived, and moves the present on while frames are stepped again.
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
  ClientParts parts_{config_, rules_, streams_, timeline_, clock_, catches_up_to_, stats_,
                     events_, phase_, host_,    standing_, own_,   entry_,         partings_};
  Comparison comparison_{parts_, hashes_, views_, repair_};
  Failover failover_;
  bool is_too_far_ = false;    // no delay covers our line
  std::uint32_t figured_ = 0;  // players, a bit each, whose figures we know
};

}  // namespace isostep
