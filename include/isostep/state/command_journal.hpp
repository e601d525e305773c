// CommandJournal: appends what a world accepts to a command log. It is inside a world; a CommandRecorder is beside one.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/state/command_log.hpp"

namespace isostep {

/// Each world has one. It is no part of the state: it is not saved, loaded or hashed.
class CommandJournal {
 public:
  /// Appends commands to `log` from now on; null: to nothing.
  ISO_INLINE void record_to(std::vector<std::uint8_t>* log) { log_ = log; }
  ISO_INLINE bool records_to(const std::vector<std::uint8_t>* log) const { return log_ == log; }
  /// Records a command of a closed list.
  template <class List, class C> ISO_INLINE void record(const C& command) {
    if (log_ == nullptr) return;
    Writer writer(*log_);
    write_command<List>(writer, command);
  }
  ISO_INLINE void record_step() {
    if (log_ != nullptr) log_->push_back(kStepMarker);
  }
  /// Notes that the state was replaced by one to which the command log does not lead.
  ISO_INLINE void note_load() { ++loads_; }
  ISO_INLINE std::uint64_t loads() const { return loads_; }

 private:
  std::vector<std::uint8_t>* log_ = nullptr;
  std::uint64_t loads_ = 0;
};

}  // namespace isostep
