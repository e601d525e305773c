// Large orders: kilobytes that a player says now and then travel in pieces with the inputs of consecutive frames, and
// the game sees each whole, in one frame that is the same on all machines.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "isostep/session/session.hpp"
#include "isostep/session/timeline/input_codec.hpp"

namespace isostep {

inline constexpr std::size_t kLargeOrderCap = 16 << 10;  // [bytes] twice what an order to 1000 units takes

/// A piece of an order, or none. A gap in `sequence` is a piece that was lost with its frame; the rest is ignored.
struct OrderPiece {
  std::uint8_t sequence = 0;            // mod 256, of all pieces of this player so far, this one included
  std::uint16_t offset = 0, total = 0;  // [bytes] where in the order, and its size
  Bytes bytes;                          // none: the frame brings no piece
};

/// A player's input with a piece beside it. Pieces make inputs longer: 192 bytes a frame bring 8 KB in 43 frames.
template <class Small, std::size_t kPiece = 192> struct WithOrders {
  static_assert(kPiece > 0 && kPiece < 256, "a piece's size is one byte");
  /// [bytes] The longest order. Pieces are counted modulo 256, and an order has less than half of that.
  static constexpr std::size_t kOrderCap = kPiece * 120 < kLargeOrderCap ? kPiece * 120 : kLargeOrderCap;
  Small brief{};
  std::uint8_t sequence = 0, size = 0;
  std::uint16_t offset = 0, total = 0;
  std::uint8_t bytes[kPiece] = {};

  OrderPiece piece() const { return {sequence, offset, total, Bytes(bytes, size)}; }
  friend bool operator==(const WithOrders& a, const WithOrders& b) {
    return a.brief == b.brief && a.sequence == b.sequence && a.size == b.size && a.offset == b.offset &&
           a.total == b.total && std::memcmp(a.bytes, b.bytes, a.size) == 0;
  }
};

template <class Small, std::size_t kPiece> struct InputCodec<WithOrders<Small, kPiece>> {
  using Input = WithOrders<Small, kPiece>;
  static constexpr std::size_t kHead = 2, kPlace = 4;  // [bytes] sequence, size; offset, total
  static constexpr std::size_t kCap = kHead + kPlace + kPiece + InputCodec<Small>::kCap;

  static std::size_t encode(const Input& input, std::uint8_t* to) {
    std::uint8_t* at = to;
    *at++ = input.sequence;
    *at++ = input.size;
    if (input.size > 0) {
      store_le(at, input.offset);
      store_le(at + 2, input.total);
      std::memcpy(at + kPlace, input.bytes, input.size);
      at += kPlace + input.size;
    }
    return static_cast<std::size_t>(at - to) + InputCodec<Small>::encode(input.brief, at);
  }
  static bool decode(Bytes bytes, Input& input) {
    Input read;
    if (bytes.size() < kHead) return false;
    read.sequence = bytes[0];
    read.size = bytes[1];
    std::size_t at = kHead;
    if (read.size > 0) {
      if (read.size > kPiece || bytes.size() < kHead + kPlace + read.size) return false;
      read.offset = load_le<std::uint16_t>(bytes.data() + kHead);
      read.total = load_le<std::uint16_t>(bytes.data() + kHead + 2);
      // All but the last are full.
      const std::size_t left = read.total > read.offset ? read.total - read.offset : 0u;
      if (read.total > Input::kOrderCap || read.size != (left < kPiece ? left : kPiece)) return false;
      std::memcpy(read.bytes, bytes.data() + kHead + kPlace, read.size);
      at += kPlace + read.size;
    }
    if (!InputCodec<Small>::decode(bytes.subspan(at), read.brief)) return false;
    input = read;
    return true;
  }
  static std::uint64_t schema() {
    HashCombiner combiner;
    combiner.add(InputCodec<Small>::schema());
    combiner.add(kPiece);
    combiner.add(Input::kOrderCap);
    return combiner.value();
  }
};

/// Predicts the input without a piece.
template <class Predictor> struct PredictNoPiece {
  template <class Input> static Input predict(const Input& last, Frame ahead) {
    Input guess;
    guess.brief = Predictor::predict(last.brief, ahead);
    guess.sequence = last.sequence;
    return guess;
  }
};
template <class Small, std::size_t kPiece> struct DefaultPredictor<WithOrders<Small, kPiece>> {
  using Type = PredictNoPiece<typename DefaultPredictor<Small>::Type>;
};

/// Holds the orders in transit. It is a part of the game's state, as the user's part of a Composite or beside it.
/// Saving allocates when an order is longer than all before.
class OrderAssembly {
 public:
  /// Call it in `step`, once for every player. Returns the order that the input of this frame completes, valid until
  /// the next call, or nothing. An order with a missing frame, whose player was away or late, never completes.
  template <class Input> Bytes take(InputView<Input> inputs, std::size_t player) {
    return take(player, inputs.status(player) == InputStatus::disconnected, inputs[player].piece());
  }
  Bytes take(std::size_t player, bool is_absent, const OrderPiece& piece);
  /// The number of orders that were completed since the match began.
  std::uint32_t completed(int player) const { return parts_[player].completed; }

  struct Part {
    std::uint8_t sequence = 0;  // of the newest piece
    std::uint32_t completed = 0;
    std::uint16_t total = 0;          // [bytes] of the order that is under way
    std::vector<std::uint8_t> bytes;  // of it; fewer than `total`
  };
  struct Snapshot {
    Part parts[kMaxPlayers];
  };
  void save(Snapshot& to) const;
  void load(const Snapshot& from);
  std::uint64_t hash() const;
  void write_portable(Writer& writer) const;
  Result<void> read_portable(Reader& reader);

 private:
  Part parts_[kMaxPlayers];
  std::vector<std::uint8_t> whole_;  // the newest that was completed: output, no state
};

/// Sends the orders of a local player one after the other, each exactly once. An order that lost a piece with a frame
/// that the player missed is sent again. It is an observer of drive().
template <class Game, class Predictor = typename DefaultPredictor<typename Game::Input>::Type> class OrderSender {
 public:
  using Input = typename Game::Input;
  static constexpr std::size_t kMostWaiting = 16;  // orders: more are a player who says more than the line takes

  /// `session` and the game's `assembly` must outlive the sender. `player`: one of this machine's; -1: the first.
  OrderSender(const Session<Game, Predictor>& session, const OrderAssembly& assembly, int player = -1)
      : session_(session), assembly_(assembly), fixed_player_(player) {}

  /// Queues an order. Returns false if it is empty, longer than Input::kOrderCap, or if kMostWaiting wait.
  bool give(Bytes order) {
    if (order.empty() || order.size() > Input::kOrderCap || orders_.size() >= kMostWaiting) return false;
    orders_.emplace_back(order.begin(), order.end());
    return true;
  }
  /// The number of orders that are not completed everywhere yet.
  std::size_t waiting() const { return orders_.size(); }

  /// Puts the next piece into the input for the next add_local_input. Call it only if wants_input() is true.
  void fill(Input& input) {
    input.sequence = sequence_;
    input.size = 0;
    if (orders_.empty() || session_.phase() != SessionPhase::playing) return;
    const std::vector<std::uint8_t>& order = orders_.front();
    if (sent_ == order.size()) return;  // the next one when this is completed
    if (sent_ == 0) begin();
    const std::size_t left = order.size() - sent_;
    input.sequence = ++sequence_;
    input.size = static_cast<std::uint8_t>(left < sizeof input.bytes ? left : sizeof input.bytes);
    input.offset = static_cast<std::uint16_t>(sent_);
    input.total = static_cast<std::uint16_t>(order.size());
    std::memcpy(input.bytes, order.data() + sent_, input.size);
    sent_ += input.size;
  }

  void confirmed(Frame frame, std::uint64_t) {
    if (sent_ == 0 || frame < from_) return;
    if (player() != player_ || session_.status(frame, player_) == InputStatus::disconnected) {
      sent_ = 0;
      return;
    }
    const Input input = session_.input(frame, player_);
    const auto place = static_cast<std::int8_t>(static_cast<std::uint8_t>(input.sequence - first_));
    if (place < 0) return;  // from before
    if (place != arrived_ - (input.size == 0 ? 1 : 0)) {
      sent_ = 0;  // one in between was replaced
      return;
    }
    if (input.size == 0) return;
    ++arrived_;
    if (input.offset + input.size == input.total) complete();
  }
  /// Only the new state tells if the order in front was completed.
  void restarted(Frame) {
    const bool is_same = sent_ > 0 && player() == player_;
    if (is_same && assembly_.completed(player_) != completed_) complete();
    sent_ = 0;
  }

 private:
  int player() const { return fixed_player_ < 0 ? session_.local_player() : fixed_player_; }
  void begin() {
    player_ = player();
    from_ = session_.current();
    first_ = static_cast<std::uint8_t>(sequence_ + 1);
    arrived_ = 0;
    completed_ = assembly_.completed(player_);
  }
  void complete() {
    orders_.erase(orders_.begin());
    sent_ = 0;
  }

  const Session<Game, Predictor>& session_;
  const OrderAssembly& assembly_;
  const int fixed_player_;
  std::vector<std::vector<std::uint8_t>> orders_;
  std::uint8_t sequence_ = 0;  // of the newest piece
  // Of the order in front, while sent_ > 0:
  std::size_t sent_ = 0;  // [bytes]
  int player_ = -1;
  Frame from_ = 0;               // its pieces are of this frame or later
  std::uint8_t first_ = 0;       // sequence of its first piece
  int arrived_ = 0;              // pieces that are final
  std::uint32_t completed_ = 0;  // of our orders before it
};

}  // namespace isostep
