// The messages of inquiries and repairs.
// SPDX-License-Identifier: MIT
#include "isostep/session/repair.hpp"

#include "isostep/session/message.hpp"
#include "isostep/session/verdict.hpp"
#include "isostep/state/archive.hpp"

namespace isostep {
namespace {

constexpr std::uint8_t kHostOnWire = 0xff;

Writer begin(MessageKind kind, std::vector<std::uint8_t>& out) {
  out.clear();
  Writer writer(out);
  writer.write(static_cast<std::uint8_t>(kind));
  return writer;
}
Reader after_kind(Bytes message) { return Reader(message.subspan(message.empty() ? 0 : 1)); }

Frame read_state(Reader& reader) {
  const Frame state = reader.read<Frame>();
  if (state < 0 || state > kLastFrame) reader.fail(ErrorCode::invalid, "a frame out of range");
  return state;
}

template <class T> Result<T> finish(Reader& reader, const char* what, const T& value) {
  reader.expect_end();
  const Result<void> result = reader.result(what);
  if (!result) return result.error();
  return value;
}

}  // namespace

void write_inquiry(Frame state, std::vector<std::uint8_t>& out) { begin(MessageKind::inquiry, out).write(state); }

Result<Frame> read_inquiry(Bytes message) {
  Reader reader = after_kind(message);
  const Frame state = read_state(reader);
  return finish(reader, "inquiry", state);
}

void write_statement(const Statement& statement, std::vector<std::uint8_t>& out) {
  Writer writer = begin(MessageKind::statement, out);
  writer.write(statement.frame);
  writer.write(statement.is_known);
  writer.write(statement.chain);
}

Result<Statement> read_statement(Bytes message) {
  Reader reader = after_kind(message);
  Statement statement;
  statement.frame = read_state(reader);
  reader.read(statement.is_known);
  reader.read(statement.chain);
  return finish(reader, "statement", statement);
}

void write_statements(const Statements& statements, std::vector<std::uint8_t>& out) {
  Writer writer = begin(MessageKind::statements, out);
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
  statements.frame = read_state(reader);
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
  return finish(reader, "statements", statements);
}

void write_resync(std::vector<std::uint8_t>& out) { begin(MessageKind::resync, out); }

void write_offer(const RepairOffer& offer, std::vector<std::uint8_t>& out) {
  Writer writer = begin(MessageKind::offer, out);
  writer.write(offer.start.frame);
  writer.write(offer.start.chain);
  writer.write(offer.hash);
  writer.write(offer.snapshot_size);
}

Result<RepairOffer> read_offer(Bytes message) {
  Reader reader = after_kind(message);
  RepairOffer offer;
  offer.start.frame = read_state(reader);
  reader.read(offer.start.chain);
  reader.read(offer.hash);
  reader.read(offer.snapshot_size);
  return finish(reader, "offer", offer);
}

void write_repaired(const Repaired& repaired, std::vector<std::uint8_t>& out) {
  Writer writer = begin(MessageKind::repaired, out);
  writer.write(repaired.player);
  writer.write(repaired.after);
}

Result<Repaired> read_repaired(Bytes message) {
  Reader reader = after_kind(message);
  Repaired repaired;
  reader.read(repaired.player);
  if (repaired.player >= kMaxPlayers && repaired.player != 0xff)
    reader.fail(ErrorCode::invalid, "a player out of range");
  repaired.after = read_state(reader);
  return finish(reader, "repaired", repaired);
}

}  // namespace isostep
