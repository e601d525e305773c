// ReplayCore: plays the inputs of a recorded match, and holds every state hash against the recorded one.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/pace/frame_clock.hpp"
#include "isostep/session/peer/session_core.hpp"
#include "isostep/state/replay_format.hpp"

namespace isostep {

/// Writes the newest inputs as a frame of a match recording: nothing if none changed; else a mask of those that did,
/// and for each its size + 1 and its bytes, or 0 for an absent player.
void write_match_frame(std::span<const InputStream> inputs, std::vector<std::uint8_t>& out);
/// Appends such a frame to all players' inputs. Returns false for malformed bytes; some inputs may be appended then.
bool read_match_frame(Bytes bytes, std::span<InputStream> inputs);

class ReplayCore : public SessionCore {
 public:
  /// `file` must outlive the session. A fault in it is reported as an event, and ends the session.
  ReplayCore(const SessionConfig& config, const InputRules& rules, Bytes file);

  bool add_local_input(int, Bytes) override { return false; }
  bool wants_input(int) const override { return false; }
  Time wait(Time now) const override { return clock_.until_due(now); }
  void restored(bool ok) override;

 protected:
  void plan(Time now) override;
  void hash_known(Frame state, std::uint64_t hash) override;

 private:
  /// Opens the file. Returns false, and reports an event, if something is wrong with it.
  bool open_file();
  bool read_frame(Frame frame);
  void refuse_file(std::string_view key, std::string_view in_file, std::string_view here);

  FrameClock clock_;
  ReplayReader file_;
  std::vector<InputStream> streams_;
  Frame first_ = 0;  // number of the file's frame 0
  bool asked_start_ = false;
};

}  // namespace isostep
