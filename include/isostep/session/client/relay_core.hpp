// RelayCore: a spectator that serves further ones, so that a host serves one for all, and that may show the match late.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/client/client_core.hpp"

namespace isostep {

/// To its host it is an ordinary spectator, to its leaves it is what the host is to
/// spectators: it passes on final inputs, its hash chain, and its own state for late
/// joiners. Relays may connect to relays. With a broadcast delay the relay itself steps
/// so much later, and sends only inputs that it has stepped or could have stepped.
class RelayCore : public ClientCore {
 public:
  RelayCore(const SessionConfig& config, const InputRules& rules);

  void connected(PeerId host, Time now) override;
  void accepted(PeerId peer, Time now) override;
  void disconnected(PeerId peer, Time now) override;
  void receive(PeerId peer, Channel channel, Bytes bytes, Time now) override;
  std::optional<Outgoing> poll_send(Time now) override;
  SnapshotProgress snapshot_progress(PeerId peer) const override;

 protected:
  Frame window() const override { return -config_.broadcast_delay; }
  void before_steps(Time now) override;
  void after_steps() override { serve_snapshots(); }
  void capture_lost() override;

 private:
  struct Leaf : PeerLink {
    enum class Stage : std::uint8_t { connected, applies, needs_snapshot, receives_snapshot, live, refused };
    Stage stage = Stage::connected;
    HashReport have;          // as it greets
    std::uint64_t match = 0;  // for which it was let in
    HashReport start;         // the state from which it goes on
    /// The leaf's next state is of this frame or later. Acknowledgements of inputs that it was sent before may still be
    /// under way, and must not count for inputs after that state.
    Frame state_from = 0;
    SnapshotTransfer transfer;
    Refusal refusal{};
    bool must_welcome = false, must_close = false;
    int figures_left = 0;      // players whose figures it is told next, one with each datagram
    bool wants_state = false;  // its own is wrong: see Session::resync
    Time state_at = 0;         // [us] it is sent another not before
    bool has_spoken = false;   // it says something that is for this match
    Time more_at = 0;          // [us] who does not acknowledge is sent nothing before
    Time had_all_at = 0;       // [us] when it lacked nothing, or came
  };
  Leaf* leaf_of(PeerId peer);
  void clear(Leaf& leaf);
  void greet(Leaf& leaf, Bytes message);
  void refuse_leaf(Leaf& leaf, std::string_view key, std::string_view theirs, std::string_view ours);
  void ask_for_state(Leaf& leaf);
  /// Returns true if our newest final state may be shown to leaves.
  bool may_show() const;
  void let_in(Leaf& leaf);
  void go_live(Leaf& leaf);
  void take_message(Leaf& leaf, Bytes message, Time now);
  void take_packet(Leaf& leaf, const Packet& packet, Time now);
  void tend(Leaf& leaf, Time now);
  void serve_snapshots();
  /// Returns true if the snapshot that we have can be sent to one more.
  bool may_share_snapshot() const;
  /// Moves what `capture` wrote out of portable(): it is for the leaves, not for us.
  void collect_snapshot();
  /// The ends of the inputs that a leaf is sent.
  SendEnds shown_ends() const;
  bool lacks_inputs(const Leaf& leaf) const;
  bool acknowledges(const Leaf& leaf, Time now) const;
  Frame most_frames(const Leaf& leaf, Time now) const;
  std::optional<Outgoing> next_message(Leaf& leaf, Time now);
  std::optional<Outgoing> next_piece(Leaf& leaf, Time now);
  std::optional<Outgoing> next_datagram(Leaf& leaf, Time now);
  Outgoing message_to(const Leaf& leaf);
  void write_welcome_of(Leaf& leaf);

  std::vector<Leaf> leaves_;
  std::size_t next_leaf_ = 0;
  // The one snapshot that is being sent; whoever needs another waits until nobody needs this one.
  HashReport snapshot_;
  std::uint64_t snapshot_hash_ = 0;
  std::vector<std::uint8_t> snapshot_bytes_;
  bool is_captured_ = false;  // in portable_, to be collected
  Time figures_at_ = 0;       // [us] when they are told again
};

}  // namespace isostep
