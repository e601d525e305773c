// A client that would follow its host: what its supporters tell it.
// SPDX-License-Identifier: MIT
#include "isostep/session/client_candidacy.hpp"

namespace isostep {

bool Candidacy::take(const InputSlice& slice, std::uint32_t its_players, Frame most) {
  if (slice.player >= streams_.size()) return false;
  InputStream& stream = streams_[slice.player];
  if (slice.first > stream.end()) return true;  // what is missing before it did not arrive: see Supporter
  const bool is_own = own_.is_open() && own_.has(slice.player);
  const bool is_its = owns_inputs() && (its_players >> slice.player & 1) != 0;
  Frame& told = told_[slice.player];
  SliceReader reader(slice);
  InputEntry entry;
  for (Frame frame = slice.first; reader.next(entry); ++frame) {
    if (frame >= most || (!entry.absent && !rules_.valid(entry.bytes))) return false;
    // Others know better than we where the host went on without us.
    const bool is_next = is_own && own_.is_open() && frame == own_.accepted(slice.player);
    if (is_next && (!owns_inputs() || entry.absent)) own_.take(slice.player, entry);
    if (is_own && own_.is_open()) continue;
    if (frame == stream.end()) {
      stream.append(entry);
    } else if (is_its && frame >= log_.noted_end(slice.player) && stream.contains(frame)) {
      stream.replace(frame, entry);
      timeline_.recheck(slice.player, frame);
    }
    if (is_its && frame >= told) told = frame + 1;
  }
  return !reader.failed();
}

void Candidacy::forget_untold(std::uint32_t players) {
  if (!owns_inputs()) return;
  for (std::size_t p = 0; p < streams_.size(); ++p) {
    if ((players >> p & 1) == 0 || streams_[p].end() <= told_[p]) continue;
    streams_[p].truncate(told_[p]);
    timeline_.recheck(static_cast<int>(p), told_[p]);
  }
}

}  // namespace isostep
