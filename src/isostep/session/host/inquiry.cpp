// The host among machines that differ: it asks all of them, and tells everybody what was said.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/inquiry.hpp"

namespace isostep {
namespace {

/// [us] until who has not answered is counted as silent: a round trip of the longest lines, and some losses.
constexpr Time kAnswer = kSecond;
constexpr Time kBetweenInquiries = kSecond;  // [us] of liars that come and go

}  // namespace

bool Inquiry::tend(Guests& guests, std::uint64_t differing, const HashReport& own, Time now) {
  if (is_open_) {
    if (!is_complete() && now < until_) return false;
    close(guests);
    return true;
  }
  if (differing == 0) return false;
  std::uint64_t asked = 0;
  for (const Guest& guest : guests) {
    if (seats_.play(guest)) asked |= std::uint64_t{1} << guest.player;
  }
  differing &= asked;
  const bool is_new = (differing & ~differing_) != 0 || asked != asked_;
  if (differing == 0 || !is_new || now < next_) return false;
  differing_ = differing;
  asked_ = asked;
  open(guests, own, now);
  return false;
}

void Inquiry::open(Guests& guests, const HashReport& own, Time now) {
  is_open_ = true;
  until_ = now + kAnswer;
  next_ = now + kBetweenInquiries;
  // The chain of the newest state tells of all before it, and everybody who plays has it or soon will.
  statements_ = Statements{};
  statements_.frame = own.frame;
  statements_.of[kHostMachine] = {true, true, own.chain};
  for (Guest& guest : guests) {
    const bool is_asked = seats_.play(guest);
    guest.due.set(Due::inquiry, is_asked);
    if (is_asked) statements_.of[guest.player].is_asked = true;
  }
}

bool Inquiry::is_complete() const {
  for (int p = 0; p < static_cast<int>(kMaxPlayers); ++p) {
    const Statements::One& one = statements_.of[p];
    if (one.is_asked && !one.has_spoken && seats_[p].link >= 0) return false;
  }
  return true;
}

void Inquiry::close(Guests& guests) {
  is_open_ = false;
  const Statements::One* const said = statements_.of;
  for (std::size_t p = 0; p < kMaxPlayers; ++p) {
    if (said[p].has_spoken && said[p].chain != said[kHostMachine].chain) differing_ |= std::uint64_t{1} << p;
  }
  for (Guest& guest : guests) {
    guest.due.drop(Due::inquiry);
    guest.due.set(Due::statements, guest.is_live());
  }
}

bool Inquiry::take(int player, const Statement& statement, const HashReport& difference) {
  Statements::One& one = statements_.of[player];
  if (!is_open_ || statement.frame != statements_.frame || !one.is_asked || one.has_spoken) return false;
  if (!statement.is_known) {
    one = {};
    return true;
  }
  one.has_spoken = true;
  one.chain = statement.chain;
  // A chain that differed never comes to be the same again: of two words the one that gives it away counts.
  const bool denies = difference.frame != kNoFrame && one.chain == statements_.of[kHostMachine].chain;
  if (denies) one.chain = difference.chain;
  return true;
}

}  // namespace isostep
