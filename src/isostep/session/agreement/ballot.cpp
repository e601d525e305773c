// Votes as messages of the reliable channel.
// SPDX-License-Identifier: MIT
#include "isostep/session/agreement/ballot.hpp"

#include "../protocol/message_format.hpp"

namespace isostep {
namespace {

void put(Writer& writer, const Proposal& proposal) {
  writer.write(static_cast<std::uint8_t>(proposal.kind));
  writer.write(proposal.subject);
}
Proposal take(Reader& reader) {
  Proposal proposal;
  proposal.kind = static_cast<Proposal::Kind>(reader.read<std::uint8_t>());
  reader.read(proposal.subject);
  if (!proposal.is_sound()) reader.fail(ErrorCode::invalid, "a proposal that cannot be");
  return proposal;
}

}  // namespace

bool Proposal::is_sound() const {
  switch (kind) {
    case Kind::pause:
    case Kind::unpause: return subject == 0;
    case Kind::speed: return subject <= 0xff && Tempo::is_speed(static_cast<int>(subject));
    case Kind::kick: return subject < kMaxPlayers;
    case Kind::other: return true;
  }
  return false;
}

void write_proposal(const PlayersProposal& proposal, std::vector<std::uint8_t>& out) {
  Writer writer = begin_message(MessageKind::propose, out);
  writer.write(proposal.player);
  put(writer, proposal.proposal);
}

Result<PlayersProposal> read_proposal(Bytes message) {
  Reader reader = after_kind(message);
  PlayersProposal proposal;
  reader.read(proposal.player);
  if (proposal.player >= kMaxPlayers) reader.fail(ErrorCode::invalid, "no player");
  proposal.proposal = take(reader);
  return finish_message(reader, "proposal", proposal);
}

void write_votes(const Votes& votes, std::vector<std::uint8_t>& out) {
  Writer writer = begin_message(MessageKind::vote, out);
  writer.write(votes.number);
  writer.write(votes.yes);
  writer.write(votes.no);
}

Result<Votes> read_votes(Bytes message) {
  Reader reader = after_kind(message);
  Votes votes;
  reader.read(votes.number);
  reader.read(votes.yes);
  reader.read(votes.no);
  if ((votes.yes & votes.no) != 0) reader.fail(ErrorCode::invalid, "yes and no");
  return finish_message(reader, "votes", votes);
}

void write_ballot(const Ballot& ballot, std::vector<std::uint8_t>& out) {
  Writer writer = begin_message(MessageKind::ballot, out);
  writer.write(ballot.number);
  put(writer, ballot.proposal);
  writer.write(ballot.by);
  writer.write(ballot.voters);
  writer.write(ballot.yes);
  writer.write(ballot.no);
  writer.write(static_cast<std::uint8_t>(ballot.outcome));
}

Result<Ballot> read_ballot(Bytes message) {
  Reader reader = after_kind(message);
  Ballot ballot;
  reader.read(ballot.number);
  ballot.proposal = take(reader);
  reader.read(ballot.by);
  reader.read(ballot.voters);
  reader.read(ballot.yes);
  reader.read(ballot.no);
  const auto outcome = reader.read<std::uint8_t>();
  if (outcome > static_cast<std::uint8_t>(Ballot::Outcome::failed)) reader.fail(ErrorCode::invalid, "no outcome");
  ballot.outcome = static_cast<Ballot::Outcome>(outcome);
  if (ballot.number == 0 || ballot.by >= kMaxPlayers || (ballot.yes & ballot.no) != 0) {
    reader.fail(ErrorCode::invalid, "a vote that cannot be");
  }
  return finish_message(reader, "ballot", ballot);
}

}  // namespace isostep
