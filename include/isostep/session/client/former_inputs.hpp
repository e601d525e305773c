// FormerInputs: what a client had of the host before, until it has all that the next one took over.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/session/timeline/frame.hpp"
#include "isostep/session/timeline/input_stream.hpp"

namespace isostep {

/// Raft's log across a change of the leader. A client has acknowledged these inputs, so some may be final by its word:
/// it keeps them until the new host has told it all that it took over, which the final ones are among; or the same one,
/// from a snapshot on, as much as before.
/// Input:   the streams and where in each the host's word ends, as the client begins anew behind a host.
/// Output:  the same inputs behind what that host told, when it is lost before it told all.
class FormerInputs {
 public:
  bool are_kept() const { return place_ == Place::here; }
  /// They are among the inputs of the host, of which none counts as told any more.
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
