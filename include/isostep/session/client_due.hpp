// DueMessages: an outbox of kinds of messages: which are due to a peer, each once.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/message.hpp"

namespace isostep {

/// In: a kind becomes due. Out: it is taken by who writes it, from what is so by then. Keeps: a bit a kind.
class DueMessages {
 public:
  void add(MessageKind kind) { kinds_ |= bit(kind); }
  void drop(MessageKind kind) { kinds_ &= ~bit(kind); }
  void set(MessageKind kind, bool is_due) { is_due ? add(kind) : drop(kind); }
  bool has(MessageKind kind) const { return (kinds_ & bit(kind)) != 0; }
  bool is_empty() const { return kinds_ == 0; }
  bool take(MessageKind kind) {
    const bool is_due = has(kind);
    drop(kind);
    return is_due;
  }

 private:
  static std::uint32_t bit(MessageKind kind) { return std::uint32_t{1} << static_cast<int>(kind); }

  std::uint32_t kinds_ = 0;
};

}  // namespace isostep
