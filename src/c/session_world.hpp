// SessionWorld: what a session does with a world, whatever the scalar of that is.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "include/isostep.h"
#include "isostep/session/timeline/frame.hpp"
#include "isostep/state/archive.hpp"
#include "isostep/state/replay_header.hpp"

namespace isostep::c {

/// A recording that observes a session's turns, and the file that it writes.
class FrameRecording {
 public:
  virtual ~FrameRecording() = default;
  virtual void before_step(Frame) = 0;
  virtual void after_step(Frame) = 0;
  virtual void rolled_back(Frame) = 0;
  virtual void restarted(Frame) = 0;
  virtual void confirmed(Frame, std::uint64_t hash) = 0;
  /// Puts all final frames so far into the file.
  virtual Result<void> flush() = 0;
  virtual Result<void> finish() = 0;
  const std::vector<std::uint8_t>& file() const { return file_; }
  /// The part of the file that was not shown before.
  Bytes show_news() {
    const Bytes news = Bytes(file_).subspan(shown_);
    shown_ = file_.size();
    return news;
  }

 protected:
  std::vector<std::uint8_t> file_;

 private:
  std::size_t shown_ = 0;  // [bytes]
};

class SessionWorld {
 public:
  /// A place for a saved state.
  struct Slot {
    virtual ~Slot() = default;
  };

  virtual ~SessionWorld() = default;
  virtual std::unique_ptr<Slot> make_slot() const = 0;
  virtual void save(Slot& to) const = 0;
  virtual bool load(const Slot& from) = 0;
  virtual std::uint64_t hash() const = 0;
  virtual void write_portable(Writer& writer) const = 0;
  virtual Result<void> read_portable(Reader& reader) = 0;
  virtual Result<ReplayHeader> identity(std::string_view name) const = 0;
  /// Returns true while its tape or its log records the world: one recording at a time.
  virtual bool is_recorded() const = 0;
  /// Records the world's commands. `kept`: frames that may be stepped before they are confirmed.
  virtual std::unique_ptr<FrameRecording> record(std::size_t kept, std::string_view scene) = 0;
  /// Returns false once the world's handle was destroyed; the session's own part of it lives until the session ends.
  virtual bool is_alive() const = 0;
};

/// Returns null where there is no such world.
std::unique_ptr<SessionWorld> session_world_of(iso_world* world);

}  // namespace isostep::c
