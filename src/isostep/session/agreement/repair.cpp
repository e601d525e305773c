// The messages of inquiries and repairs.
// SPDX-License-Identifier: MIT
#include "isostep/session/agreement/repair.hpp"

#include "../protocol/message_format.hpp"
#include "isostep/session/agreement/verdict.hpp"

namespace isostep {
namespace {

constexpr std::uint8_t kHostOnWire = 0xff;

}  // namespace

void write_inquiry(Frame state, std::vector<std::uint8_t>& out) {
  begin_message(MessageKind::inquiry, out).write(state);
}

Result<Frame> read_inquiry(Bytes message) {
  Reader reader = after_kind(message);
  const Frame state = read_frame(reader);
  return finish_message(reader, "inquiry", state);
}

void write_statement(const Statement& statement, std::vector<std::uint8_t>& out) {
  Writer writer = begin_message(MessageKind::statement, out);
  writer.write(statement.frame);
  writer.write(statement.is_known);
  writer.write(statement.chain);
}

Result<Statement> read_statement(Bytes message) {
  Reader reader = after_kind(message);
  Statement statement;
  statement.frame = read_frame(reader);
  reader.read(statement.is_known);
  reader.read(statement.chain);
  return finish_message(reader, "statement", statement);
}

void write_statements(const Statements& statements, std::vector<std::uint8_t>& out) {
  Writer writer = begin_message(MessageKind::statements, out);
  writer.write(statements.frame);
  std::uint8_t count = 0;
  for (const Statements::One& one : statements.of) count = static_cast<std::uint8_t>(count + (one.is_asked ? 1 : 0));
  writer.write(count);
  for (std::size_t m = 0; m < kMachines; ++m) {
    const Statements::One& one = statements.of[m];
    if (!one.is_asked) continue;
    writer.write(m == kHostMachine ? kHostOnWire : static_cast<std::uint8_t>(m));
    writer.write(one.has_spoken);
    writer.write(one.chain);
  }
}

Result<Statements> read_statements(Bytes message) {
  Reader reader = after_kind(message);
  Statements statements;
  statements.frame = read_frame(reader);
  const std::uint8_t count = reader.read<std::uint8_t>();
  if (count > kMachines) reader.fail(ErrorCode::invalid, "more machines than there can be");
  for (std::uint8_t i = 0; i < count && reader.ok(); ++i) {
    const std::uint8_t on_wire = reader.read<std::uint8_t>();
    const std::size_t machine = on_wire == kHostOnWire ? kHostMachine : on_wire;
    if (machine >= kMachines || (on_wire == kHostMachine) || statements.of[machine].is_asked) {
      reader.fail(ErrorCode::invalid, "a machine that is none, or was there before");
      break;
    }
    Statements::One& one = statements.of[machine];
    one.is_asked = true;
    reader.read(one.has_spoken);
    reader.read(one.chain);
  }
  return finish_message(reader, "statements", statements);
}

void write_resync(std::vector<std::uint8_t>& out) { begin_message(MessageKind::resync, out); }

void write_offer(const RepairOffer& offer, std::vector<std::uint8_t>& out) {
  Writer writer = begin_message(MessageKind::offer, out);
  writer.write(offer.start.frame);
  writer.write(offer.start.chain);
  writer.write(offer.hash);
  writer.write(offer.snapshot_size);
}

Result<RepairOffer> read_offer(Bytes message) {
  Reader reader = after_kind(message);
  RepairOffer offer;
  offer.start.frame = read_frame(reader);
  reader.read(offer.start.chain);
  reader.read(offer.hash);
  reader.read(offer.snapshot_size);
  return finish_message(reader, "offer", offer);
}

void write_repaired(const Repaired& repaired, std::vector<std::uint8_t>& out) {
  Writer writer = begin_message(MessageKind::repaired, out);
  writer.write(repaired.player);
  writer.write(repaired.after);
}

Result<Repaired> read_repaired(Bytes message) {
  Reader reader = after_kind(message);
  Repaired repaired;
  reader.read(repaired.player);
  if (repaired.player >= kMaxPlayers && repaired.player != 0xff)
    reader.fail(ErrorCode::invalid, "a player out of range");
  repaired.after = read_frame(reader);
  return finish_message(reader, "repaired", repaired);
}

}  // namespace isostep
