// The host counts votes, tells all how they stand, and does what passes.
// SPDX-License-Identifier: MIT
#include "isostep/session/host_core.hpp"

namespace isostep {
namespace {

constexpr Time kVoting = 20 * kSecond;  // [us] until a vote without a majority has failed
constexpr Time kTelling = kSecond / 4;  // [us] between words on how it stands: who changes its mind costs no more
constexpr Time kAgain = 30 * kSecond;   // [us] after it, until its proposer may ask for another

}  // namespace

std::uint32_t HostCore::present_players() const {
  std::uint32_t present = 0;
  for (int p = 0; p < players(); ++p) present |= (seats_[p].is_open ? 1u : 0u) << p;
  return present;
}

bool HostCore::propose(int player, const Proposal& proposal) {
  return is_local(player) && open_ballot(player, proposal);
}

bool HostCore::vote(int player, bool yes) {
  if (!is_local(player) || !ballot_.is_open()) return false;
  return count_votes({ballot_.number, yes ? 1u << player : 0, yes ? 0 : 1u << player}, hosted_);
}

bool HostCore::open_ballot(int player, const Proposal& proposal) {
  const bool is_free = !ballot_.is_open() && is_ballot_told_;
  if (!config_.votes || !started_ || !is_free || !proposal.is_sound()) return false;
  if (turn_at_ < may_propose_at_[player]) return false;
  const bool is_kick = proposal.kind == Proposal::Kind::kick;
  const std::uint32_t present = present_players();
  if (is_kick && !is_guests(static_cast<int>(proposal.subject))) return false;
  ballot_ = Ballot{};
  ballot_.number = ++ballots_;
  ballot_.proposal = proposal;
  ballot_.by = static_cast<std::uint8_t>(player);
  ballot_.voters = is_kick ? present & ~(1u << proposal.subject) : present;  // nobody judges itself
  ballot_.yes = ballot_.voters & 1u << player;
  ballot_until_ = turn_at_ + kVoting;
  ballot_changed();
  return true;
}

bool HostCore::count_votes(const Votes& votes, std::uint32_t of) {
  if (!ballot_.is_open() || votes.number != ballot_.number || ((votes.yes | votes.no) & ~of) != 0) return false;
  const std::uint32_t said = (votes.yes | votes.no) & ballot_.voters;
  if (said == 0) return false;
  const Ballot before = ballot_;
  ballot_.yes = (ballot_.yes & ~said) | (votes.yes & said);
  ballot_.no = (ballot_.no & ~said) | (votes.no & said);
  if (ballot_.yes != before.yes || ballot_.no != before.no) ballot_changed();
  return true;
}

void HostCore::ballot_changed() {
  if (ballot_.has_passed()) ballot_.outcome = Ballot::Outcome::passed;
  else if (ballot_.has_failed()) ballot_.outcome = Ballot::Outcome::failed;
  is_ballot_told_ = false;
  tell_ballot();
  if (ballot_.outcome == Ballot::Outcome::failed) may_propose_at_[ballot_.by] = turn_at_ + kAgain;
  if (ballot_.outcome == Ballot::Outcome::passed) carry_out(ballot_.proposal);
}

void HostCore::tend_ballot(Time now) {
  if (!is_ballot_told_ && (!ballot_.is_open() || now - ballot_told_at_ >= kTelling)) {
    for (Guest& guest : guests()) guest.must_tell_ballot = guest.stage == Guest::Stage::live;
    is_ballot_told_ = true;
    ballot_told_at_ = now;
  }
  if (!ballot_.is_open()) return;
  const std::uint32_t gone = ballot_.voters & ~present_players();
  const bool is_over = now >= ballot_until_;
  if (gone == 0 && !is_over) return;
  ballot_.voters &= ~gone;
  ballot_.yes &= ~gone;
  ballot_.no &= ~gone;
  if (is_over && !ballot_.has_passed()) ballot_.outcome = Ballot::Outcome::failed;
  ballot_changed();
}

void HostCore::carry_out(const Proposal& proposal) {
  Tempo tempo = latest_wish();
  tempo.by = ballot_.by;
  switch (proposal.kind) {
    case Proposal::Kind::pause: tempo.is_paused = true; break;
    case Proposal::Kind::unpause: tempo.is_paused = false; break;
    case Proposal::Kind::speed: tempo.speed = static_cast<std::uint8_t>(proposal.subject); break;
    case Proposal::Kind::kick: static_cast<void>(kick(static_cast<int>(proposal.subject), "voted out")); return;
    case Proposal::Kind::other: return;
  }
  if (!wish_tempo(tempo)) ++stats_.refused;
}

void HostCore::take_vote(Guest& guest, MessageKind kind, Bytes message) {
  bool good = false;
  if (kind == MessageKind::propose) {
    const Result<PlayersProposal> read = read_proposal(message);
    good = read && is_in_match(guest) && has(guest, read.value().player) &&
           open_ballot(read.value().player, read.value().proposal);
  } else if (const Result<Votes> votes = read_votes(message)) {
    good = count_votes(votes.value(), guest.players);
  }
  if (!good) ++stats_.refused;
}

}  // namespace isostep
