// The roster: majorities, and its place among the messages.
// SPDX-License-Identifier: MIT
#include "isostep/session/agreement/roster.hpp"

#include "isostep/session/config.hpp"
#include "isostep/session/protocol/message.hpp"
#include "isostep/session/protocol/siphash.hpp"
#include "isostep/state/archive.hpp"

namespace isostep {
namespace {

constexpr std::uint8_t kIsIn = 1, kWasIn = 2;

}  // namespace

std::uint64_t proof_of(std::uint64_t token) {
  constexpr std::uint8_t kText[] = {'p', 'l', 'a', 'y', 'e', 'r'};
  return siphash_2_4({token, 0}, kText);
}

int Roster::machine_of(std::uint64_t token) const { return token == 0 ? -1 : machine_of_proof(proof_of(token)); }

int Roster::voter_of(std::uint64_t token, std::uint64_t life) const {
  const int machine = machine_of(token);
  return machine >= 0 && life != 0 && machines[machine].life == life ? machine : -1;
}

std::uint64_t Roster::voters() const {
  std::uint64_t all = 0;
  for (int m = 0; m < count; ++m) {
    if (machines[m].is_in || machines[m].was_in) all |= std::uint64_t{1} << m;
  }
  return all;
}

bool Roster::is_quorum(std::uint64_t group, std::uint64_t over) const {
  return is_majority(group) || (group != 0 && version > 0 && (voters() & ~(group | over)) == 0);
}

int Roster::machine_of_proof(std::uint64_t proof) const {
  int found = -1;
  for (int m = 0; m < count; ++m) {
    if (machines[m].proof == proof) found = m;
  }
  return found;
}

int Roster::machine_with(int player) const {
  for (int m = 0; m < count; ++m) {
    if (player >= 0 && (machines[m].players >> player & 1) != 0) return m;
  }
  return -1;
}

bool Roster::is_of(int players) const {
  for (int m = 0; m < count; ++m) {
    if (std::uint64_t{machines[m].players} >> players != 0) return false;
  }
  return true;
}

int Roster::count_in() const {
  int in = 0;
  for (int m = 0; m < count; ++m) in += machines[m].is_in ? 1 : 0;
  return in;
}

bool Roster::is_majority(std::uint64_t group) const {
  const auto has_most = [&](bool Machine::*counts, std::uint8_t decides) {
    int all = 0, here = 0;
    for (int m = 0; m < count; ++m) {
      if (!(machines[m].*counts)) continue;
      ++all;
      here += static_cast<int>(group >> m & 1);
    }
    const bool has_cast = decides < count && (group >> decides & 1) != 0 && machines[decides].*counts;
    return 2 * here > all || (2 * here == all && has_cast);
  };
  return count > 0 && has_most(&Machine::is_in, casting) && has_most(&Machine::was_in, was_casting);
}

namespace {
/// All but the seals.
void write_content(const Roster& roster, Writer& writer) {
  writer.write(roster.term);
  writer.write(roster.version);
  const MatchSettings& settings = roster.settings;
  writer.write(settings.deadline);
  for (const Time time : {settings.silence, settings.patience, settings.exclusion, settings.reservation}) {
    writer.write(time);
  }
  for (const bool is_set : {settings.asks_admission, settings.votes, settings.players_set_tempo, settings.repair}) {
    writer.write(is_set);
  }
  for (const std::uint8_t place : {roster.host, roster.casting, roster.was_casting, roster.count}) writer.write(place);
  for (int m = 0; m < roster.count; ++m) {
    const Roster::Machine& machine = roster.machines[m];
    writer.write(machine.players);
    writer.write(machine.proof);
    writer.write(machine.life);
    writer.write(static_cast<std::uint8_t>((machine.is_in ? kIsIn : 0) | (machine.was_in ? kWasIn : 0)));
    writer.write_text(machine.address.view());
  }
}
}  // namespace

std::uint64_t seal_of(const Roster& roster, std::uint64_t token, std::vector<std::uint8_t>& scratch) {
  scratch.clear();
  Writer writer(scratch);
  write_content(roster, writer);
  return siphash_2_4({token, 1}, scratch);  // 1: unlike what proof_of shows to all
}

bool is_sealed_for(const Roster& roster, std::uint64_t token, std::vector<std::uint8_t>& scratch) {
  const int machine = roster.machine_of(token);
  return machine >= 0 && roster.machines[machine].seal == seal_of(roster, token, scratch);
}

void write_roster(const Roster& roster, std::vector<std::uint8_t>& out) {
  out.clear();
  Writer writer(out);
  writer.write(static_cast<std::uint8_t>(MessageKind::roster));
  write_content(roster, writer);
  for (int m = 0; m < roster.count; ++m) writer.write(roster.machines[m].seal);
}

Result<Roster> read_roster(Bytes message) {
  Reader reader(message.subspan(message.empty() ? 0 : 1));
  Roster roster;
  reader.read(roster.term);
  reader.read(roster.version);
  MatchSettings& settings = roster.settings;
  reader.read(settings.deadline);
  for (Time* time : {&settings.silence, &settings.patience, &settings.exclusion, &settings.reservation}) {
    reader.read(*time);
  }
  for (bool* is_set : {&settings.asks_admission, &settings.votes, &settings.players_set_tempo, &settings.repair}) {
    reader.read(*is_set);
  }
  if (settings.deadline < 0 || settings.deadline > kMostDeadline) {
    reader.fail(ErrorCode::invalid, "a deadline out of range");
  }
  for (std::uint8_t* place : {&roster.host, &roster.casting, &roster.was_casting, &roster.count}) reader.read(*place);
  const bool was_there = roster.was_casting < roster.count || roster.was_casting == Roster::kNoCasting;
  const bool are_there = roster.host < roster.count && roster.casting < roster.count && was_there;
  if (roster.count > kMaxPlayers + 1 || !are_there || roster.version == 0 || roster.term == 0) {
    reader.fail(ErrorCode::invalid, "machines out of range");
  }
  std::uint32_t seen = 0;
  for (int m = 0; m < roster.count && reader.ok(); ++m) {
    Roster::Machine& machine = roster.machines[m];
    reader.read(machine.players);
    reader.read(machine.proof);
    reader.read(machine.life);
    const auto flags = reader.read<std::uint8_t>();
    machine.address = read_address(reader);
    const bool is_known = flags <= (kIsIn | kWasIn);
    const bool has_own = (machine.players & seen) == 0;
    if (!is_known || !has_own) reader.fail(ErrorCode::invalid, "a machine that cannot be");
    seen |= machine.players;
    machine.is_in = (flags & kIsIn) != 0;
    machine.was_in = (flags & kWasIn) != 0;
  }
  for (int m = 0; m < roster.count && reader.ok(); ++m) reader.read(roster.machines[m].seal);
  reader.expect_end();
  const Result<void> result = reader.result("roster");
  if (!result) return result.error();
  return roster;
}

}  // namespace isostep
