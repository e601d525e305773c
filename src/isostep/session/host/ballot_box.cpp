// The host opens votes, counts them, and says how they end.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/ballot_box.hpp"

namespace isostep {
namespace {

constexpr Time kVoting = 20 * kSecond;  // [us] until a vote without a majority has failed
constexpr Time kTelling = kSecond / 4;  // [us] between words on how it stands: who changes its mind costs no more
constexpr Time kAgain = 30 * kSecond;   // [us] after it, until its proposer may ask for another

}  // namespace

BallotBox::Effect BallotBox::open(int player, const Proposal& proposal, Time now) {
  const bool is_kick = proposal.kind == Proposal::Kind::kick;
  if (!config_.votes || ballot_.is_open() || !is_told_ || !proposal.is_sound()) return Effect::refused;
  if (now < may_propose_at_[player] || (is_kick && !seats_.is_guests(static_cast<int>(proposal.subject))))
    return Effect::refused;
  ballot_ = Ballot{};
  ballot_.number = ++ballots_;
  ballot_.proposal = proposal;
  ballot_.by = static_cast<std::uint8_t>(player);
  ballot_.voters = seats_.open() & ~(is_kick ? 1u << proposal.subject : 0);  // nobody judges itself
  ballot_.yes = ballot_.voters & 1u << player;
  until_ = now + kVoting;
  return changed(now);
}

BallotBox::Effect BallotBox::count(const Votes& votes, std::uint32_t players, Time now) {
  if (!ballot_.is_open() || votes.number != ballot_.number || ((votes.yes | votes.no) & ~players) != 0)
    return Effect::refused;
  const std::uint32_t said = (votes.yes | votes.no) & ballot_.voters;
  if (said == 0) return Effect::refused;
  const Ballot before = ballot_;
  ballot_.yes = (ballot_.yes & ~said) | (votes.yes & said);
  ballot_.no = (ballot_.no & ~said) | (votes.no & said);
  return ballot_.yes != before.yes || ballot_.no != before.no ? changed(now) : Effect::same;
}

BallotBox::Effect BallotBox::changed(Time now) {
  if (ballot_.has_passed()) ballot_.outcome = Ballot::Outcome::passed;
  else if (ballot_.has_failed()) ballot_.outcome = Ballot::Outcome::failed;
  is_told_ = false;
  if (ballot_.outcome == Ballot::Outcome::failed) may_propose_at_[ballot_.by] = now + kAgain;
  return Effect::changed;
}

bool BallotBox::must_tell(Time now) {
  if (is_told_ || (ballot_.is_open() && now - told_at_ < kTelling)) return false;
  is_told_ = true;
  told_at_ = now;
  return true;
}

BallotBox::Effect BallotBox::tend(Time now) {
  if (!ballot_.is_open()) return Effect::same;
  const std::uint32_t gone = ballot_.voters & ~seats_.open();
  const bool is_over = now >= until_;
  if (gone == 0 && !is_over) return Effect::same;
  ballot_.voters &= ~gone;
  ballot_.yes &= ~gone;
  ballot_.no &= ~gone;
  if (is_over && !ballot_.has_passed()) ballot_.outcome = Ballot::Outcome::failed;
  return changed(now);
}

}  // namespace isostep
