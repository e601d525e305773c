// Guests: the host's connections, by PeerId, and whose turn it is to be sent something.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/session/host/guest.hpp"
#include "isostep/session/host/seat.hpp"

namespace isostep {

/// Iterates over the places that a connection ever had: few of many.
class Guests {
 public:
  explicit Guests(std::size_t most) : all_(most) {
    for (std::size_t i = 0; i < most; ++i) all_[i].peer = static_cast<PeerId>(i);
  }
  Guest* begin() { return all_.data(); }
  Guest* end() { return all_.data() + used_; }
  const Guest* begin() const { return all_.data(); }
  const Guest* end() const { return all_.data() + used_; }
  std::size_t size() const { return used_; }

  /// `place` is below size().
  Guest& operator[](std::size_t place) { return all_[place]; }
  const Guest& operator[](std::size_t place) const { return all_[place]; }
  /// Returns null if the peer has no connection.
  Guest* find(PeerId peer) { return peer < used_ && all_[peer].is_connected ? &all_[peer] : nullptr; }
  const Guest* find(PeerId peer) const { return peer < used_ && all_[peer].is_connected ? &all_[peer] : nullptr; }
  /// Returns null if nobody is there.
  Guest* on(const Seat& seat) { return seat.link < 0 ? nullptr : &all_[static_cast<std::size_t>(seat.link)]; }
  const Guest* on(const Seat& seat) const {
    return seat.link < 0 ? nullptr : &all_[static_cast<std::size_t>(seat.link)];
  }
  /// Returns null if the applicant is decided on, or gone.
  Guest* applicant(std::uint64_t number) {
    for (Guest& guest : *this) {
      if (guest.applies() && guest.applicant == number) return &guest;
    }
    return nullptr;
  }
  int spectators() const {
    int count = 0;
    for (const Guest& guest : *this) count += guest.is_served() && guest.player < 0 ? 1 : 0;
    return count;
  }
  /// Returns null if there are not so many places.
  Guest* place(PeerId peer) {
    if (peer >= all_.size()) return nullptr;
    if (used_ <= peer) used_ = peer + std::size_t{1};
    return &all_[peer];
  }
  Guest& next_in_turn() {
    Guest& guest = all_[next_];
    next_ = (next_ + 1) % used_;
    return guest;
  }
  /// Gives the guest the next turn again.
  void stay_with(const Guest& guest) { next_ = guest.peer; }

 private:
  std::vector<Guest> all_;
  std::size_t used_ = 0, next_ = 0;
};

}  // namespace isostep
