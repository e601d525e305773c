// Ledger keeps what an event log told, by happening.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "isostep/session/observers/event_log.hpp"

namespace isostep {

template <class E> std::vector<Notice<E>> all_of(EventLog<E>& log) {
  std::vector<Notice<E>> notices;
  while (const auto notice = log.poll()) notices.push_back(*notice);
  return notices;
}

/// The life of each happening, and what was confirmed, from the notices alone.
template <class E> struct Ledger {
  std::map<std::uint32_t, std::string> lives;  // p, c, r in the order told
  std::vector<std::pair<Frame, E>> confirmed;
  std::size_t played = 0, taken_back = 0, moved = 0;
  std::map<std::uint32_t, Frame> seen;

  void take(EventLog<E>& log) {
    for (const Notice<E>& notice : all_of(log)) {
      std::string& life = lives[notice.happening];
      EXPECT_EQ(notice.first, life.empty());
      life += "pcr"[static_cast<int>(notice.kind)];
      played += notice.first;
      taken_back += notice.kind == NoticeKind::retracted;
      if (notice.first) seen[notice.happening] = notice.frame;
      if (notice.kind != NoticeKind::confirmed) continue;
      confirmed.push_back({notice.frame, notice.event});
      moved += notice.frame != seen[notice.happening];
    }
  }
  void expect_lives() const {
    for (const auto& [happening, life] : lives) {
      EXPECT_TRUE(life == "pc" || life == "pr" || life == "c") << happening << " was told as " << life;
    }
  }
};

}  // namespace isostep
