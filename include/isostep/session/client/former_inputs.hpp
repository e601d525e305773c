// FormerInputs: what a client had of the host before, until it has all that the next one took over.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/session/timeline/frame.hpp"
#include "isostep/session/timeline/input_stream.hpp"

namespace isostep {

/// Raft's log across a change of the leader. The client has acknowledged these inputs, so some may be final because of
/// it. It keeps them until the new host has told all that it took over, which includes the final ones; or until the
/// same host, after a snapshot, has told as much as before.
/// Input:   the streams, and in each the end of the host's word, as the client begins anew behind a host.
/// Output:  the same inputs after those that this host told, if it is lost before it told all.
class FormerInputs {
 public:
  bool are_kept() const { return place_ == Place::here; }
  /// Returns true if they are in the streams again, of which none counts as told by the host any more.
  bool are_back() const { return place_ == Place::in_streams; }
  void keep(const std::vector<InputStream>& streams, const Frame (&ends)[kMaxPlayers]) {
    streams_ = streams;
    for (std::size_t p = 0; p < streams.size(); ++p) streams_[p].truncate(ends[p]);
    place_ = Place::here;
  }
  Frame end() const {
    Frame end = 0;
    for (const InputStream& stream : streams_) end = stream.end() > end ? stream.end() : end;
    return end;
  }
  void are_given_back() { place_ = Place::in_streams; }
  void forget() { place_ = Place::nowhere; }
  const InputStream& of(int player) const { return streams_[static_cast<std::size_t>(player)]; }

 private:
  enum class Place : std::uint8_t { nowhere, here, in_streams };

  std::vector<InputStream> streams_;
  Place place_ = Place::nowhere;
};

}  // namespace isostep
