// Repair: a client in the match takes a state of the host's again, and steps from there to where it was.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/agreement/repair.hpp"
#include "isostep/session/agreement/verdict.hpp"
#include "isostep/session/client/snapshot_arrival.hpp"
#include "isostep/session/pace/frame_clock.hpp"
#include "isostep/session/protocol/message.hpp"
#include "isostep/session/protocol/outbox.hpp"
#include "isostep/session/timeline/hash_log.hpp"

namespace isostep {

/// In: the wish for a state, the host's offer, and its inquiries. Out: messages to the host, and when the game restores
/// the state. Keeps: the stage, the offer, and the present frame of the match. The client plays on in its own states
/// until all of the host's has arrived. From then on it steps the frames since as fast as it can, while its players'
/// inputs go on at the pace of the match: nobody else notices.
class Repair {
 public:
  /// `present`: the frame that would be next by now. If it is above the current one, frames are stepped again.
  Repair(SnapshotArrival& arrival, const HashLog& hashes, Frame& present)
      : arrival_(arrival), hashes_(hashes), present_(present) {}

  bool is_under_way() const { return stage_ != Stage::none; }
  /// Returns true if a repair is under way, or the frames since are still stepped.
  bool is_busy(Frame current) const { return is_under_way() || present_ > current; }
  bool receives() const { return stage_ == Stage::receives; }
  bool restores() const { return stage_ == Stage::restores; }
  bool awaits_offer() const { return stage_ == Stage::waits || receives(); }
  const RepairOffer& offer() const { return offer_; }
  /// The newest state that was final before the repair.
  Frame after() const { return after_; }

  void ask() { stage_ = Stage::asks; }
  void take(const RepairOffer& offer) {
    stage_ = Stage::receives;
    offer_ = offer;
    arrival_.begin(HashReport{}, offer.snapshot_size, 0);
  }
  /// The host has no such state.
  void is_refused() { stage_ = Stage::none; }
  /// Drops the repair: the client begins anew.
  void leave() {
    is_refused();
    offer_ = RepairOffer{};
    after_ = kNoFrame;
    present_ = 0;
    due_.drop(MessageKind::repaired);
  }
  /// Call it once per turn. Returns true if the game must restore the state of the offer.
  bool tend(const std::vector<InputStream>& streams, Frame current, FrameClock& clock, Time now) {
    for (; present_ > current && clock.is_due(now); ++present_) clock.stepped(now);
    if (receives() && arrival_.is_whole() && current >= offer_.start.frame) {
      stage_ = Stage::restores;
      for (const InputStream& stream : streams) {
        if (stream.begin() > offer_.start.frame) stage_ = Stage::asks;  // it was too long on its way: another
      }
      if (!restores()) return false;
      after_ = hashes_.settled().frame;
      present_ = current;
    }
    // Which it still is where the requests of the last turn were not carried out.
    return restores();
  }
  /// Takes the hash of the restored state. Returns false if it is not the host's.
  bool has_hash(std::uint64_t hash) {
    if (hash != offer_.hash) return false;
    stage_ = Stage::none;
    due_.add(MessageKind::repaired);
    return true;
  }
  /// The host asks for our hash chain of this state; kNoFrame: it asks for none.
  void inquire(Frame state) { inquired_ = state; }
  bool write_next(std::vector<std::uint8_t>& message) {
    if (inquired_ != kNoFrame && hashes_.settled().frame >= inquired_) {
      const bool is_known = hashes_.has_chain(inquired_);
      write_statement({inquired_, is_known, is_known ? hashes_.chain(inquired_) : 0}, message);
      inquired_ = kNoFrame;
    } else if (stage_ == Stage::asks && arrival_.is_told()) {  // else the host takes it for the former one
      stage_ = Stage::waits;
      write_resync(message);
    } else if (arrival_.is_told() && due_.take(MessageKind::repaired)) {  // first things first
      write_repaired({0xff, after_}, message);
    } else {
      return false;
    }
    return true;
  }

 private:
  enum class Stage : std::uint8_t {
    none,
    asks,      // must send the request
    waits,     // for the host's answer
    receives,  // the snapshot's pieces
    restores   // the game was given the state, and its hash is not known yet
  };

  SnapshotArrival& arrival_;
  const HashLog& hashes_;
  Stage stage_ = Stage::none;
  RepairOffer offer_;
  Frame& present_;
  Frame after_ = kNoFrame, inquired_ = kNoFrame;
  Outbox<MessageKind> due_;  // repaired
};

}  // namespace isostep
