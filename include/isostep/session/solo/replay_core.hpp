// ReplayCore: plays the inputs of a recorded match, and holds every state hash against the recorded one.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/pace/frame_clock.hpp"
#include "isostep/session/peer/session_core.hpp"
#include "isostep/state/replay_format.hpp"

namespace isostep {

/// The newest frame of all players, as a match recording holds it after the frame before: nothing where no input
/// changed; else a mask of whose did, and of each of those its size and 1, or 0 for who is absent, and the bytes.
void write_match_frame(std::span<const InputStream> inputs, std::vector<std::uint8_t>& out);
/// Appends it to every player's inputs; false when the bytes are not such a frame: then some may be appended.
bool read_match_frame(Bytes bytes, std::span<InputStream> inputs);

class ReplayCore : public SessionCore {
 public:
  /// `file` must outlive the session. What is wrong with it is reported as an event; then the session is over.
  ReplayCore(const SessionConfig& config, const InputRules& rules, Bytes file);

  bool add_local_input(int, Bytes) override { return false; }
  bool wants_input(int) const override { return false; }
  Time wait(Time now) const override { return clock_.until_due(now); }
  void restored(bool ok) override;

 protected:
  void plan(Time now) override;
  void hash_known(Frame state, std::uint64_t hash) override;

 private:
  /// What is wrong with the file, as an event; false: something is.
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
