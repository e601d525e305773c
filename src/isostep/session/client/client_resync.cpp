// The client takes a state of the host's again.
// SPDX-License-Identifier: MIT
#include "isostep/session/client/client_core.hpp"

namespace isostep {

void ClientCore::tend_repair(Time now) {
  // Of who is not in the match nobody is asked, so the host's word on its states counts.
  if (config_.repair && !own_.is_open() && views_[kHostMachine].differs()) static_cast<void>(comparison_.resync());
  if (repair_.tend(streams_, current(), clock_, now)) restore(repair_.offer().start.frame);
}

void ClientCore::finish_repair(std::uint64_t hash) {
  if (!repair_.has_hash(hash)) {
    restored(false);
    return;
  }
  const HashReport& start = repair_.offer().start;
  hashes_.restart(start, hash);
  confirmed_state_ = start.frame;
  own_.is_repaired_at(start.frame);
  for (std::size_t machine = 0; machine < kMachines; ++machine) views_.was_repaired(machine, views_[machine].after);
  tell({.kind = SessionEvent::Kind::repaired,
        .player = static_cast<std::uint8_t>(own_.first()),
        .frame = repair_.after()});
}

}  // namespace isostep
