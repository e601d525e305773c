// Inputs in bytes: what is written, what is refused, and that two layouts have two schemas.
// SPDX-License-Identifier: MIT
#include "isostep/session/timeline/input_codec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "isostep/scalar/scalar.hpp"

namespace isostep {
namespace input_codec_test {

using Buffer = std::vector<std::uint8_t>;

#define ISO_TEST_FIELDS(...) \
  template <class Visitor, class Self> static constexpr void fields(Visitor&& visit, Self&& self) { __VA_ARGS__ }

enum class Button : std::uint8_t { none, jump };

struct Pad {
  std::int8_t stick = 0;
  std::uint16_t aim = 0;
  Button button = Button::none;
  ISO_TEST_FIELDS(visit("stick", self.stick); visit("aim", self.aim); visit("button", self.button);)
  friend bool operator==(const Pad&, const Pad&) = default;
};
template <class S> struct Aim {
  S x = S(0), y = S(0);
  ISO_TEST_FIELDS(visit("x", self.x); visit("y", self.y);)
};
struct Strict {
  std::uint8_t value = 1;
  bool valid() const { return value > 0 && value < 10; }
  ISO_TEST_FIELDS(visit("value", self.value);)
  friend bool operator==(const Strict&, const Strict&) = default;
};
struct Order {
  std::uint16_t unit = 0;
  float where[2] = {};
  ISO_TEST_FIELDS(visit("unit", self.unit); visit("where", self.where);)
  friend bool operator==(const Order& a, const Order& b) {
    return a.unit == b.unit && a.where[0] == b.where[0] && a.where[1] == b.where[1];
  }
};

template <class Input> Buffer encode(const Input& input) {
  Buffer bytes(kInputCap);
  bytes.resize(InputCodec<Input>::encode(input, bytes.data()));
  return bytes;
}
template <class Input> bool decodes(const Buffer& bytes) {
  Input input{};
  return InputCodec<Input>::decode(bytes, input);
}

TEST(InputCodec, AStructIsItsFieldsInOrderLittleEndian) {
  const Pad pad{-2, 0x1234, Button::jump};
  EXPECT_EQ(encode(pad), (Buffer{0xfe, 0x34, 0x12, 1}));
  EXPECT_EQ(InputCodec<Pad>::kCap, 4u);
  Pad read;
  EXPECT_TRUE(InputCodec<Pad>::decode(encode(pad), read));
  EXPECT_EQ(read, pad);
}

TEST(InputCodec, AStructIsWholeAndNothingMore) {
  Buffer bytes = encode(Pad{});
  bytes.push_back(0);
  EXPECT_FALSE(decodes<Pad>(bytes));
  for (std::size_t size = 0; size < 4; ++size) EXPECT_FALSE(decodes<Pad>(Buffer(size)));
}

template <class S> void expect_refuses_what_is_no_number() {
  const S inf = std::numeric_limits<S>::infinity(), nan = std::numeric_limits<S>::quiet_NaN();
  EXPECT_TRUE(decodes<Aim<S>>(encode(Aim<S>{S(1), S(-2)})));
  EXPECT_TRUE(decodes<Aim<S>>(encode(Aim<S>{std::numeric_limits<S>::max(), std::numeric_limits<S>::denorm_min()})));
  for (const S bad : {inf, -inf, nan, -nan}) {
    EXPECT_FALSE(decodes<Aim<S>>(encode(Aim<S>{bad, S(0)})));
    EXPECT_FALSE(decodes<Aim<S>>(encode(Aim<S>{S(0), bad})));
  }
}
TEST(InputCodec, WhatIsNoFiniteNumberIsRefused) {
  expect_refuses_what_is_no_number<float>();
  expect_refuses_what_is_no_number<double>();
  Order order;
  order.where[1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(decodes<Order>(encode(order))) << "in an array too";
  CommandList<Order, 4> list;
  list.add({});
  list.add(order);
  EXPECT_FALSE((decodes<CommandList<Order, 4>>(encode(list)))) << "in a list too";
}

TEST(InputCodec, FixedPointHasNoBytesThatAreNoNumber) {
  const Aim<Q16_16> aim{Q16_16(1), Q16_16(-0.5)};
  EXPECT_EQ(encode(aim), (Buffer{0, 0, 1, 0, 0, 0x80, 0xff, 0xff}));
  EXPECT_TRUE(decodes<Aim<Q16_16>>(encode(aim)));
}

TEST(InputCodec, WhatTheGameItselfRefusesIsRefused) {
  for (int value = 0; value < 256; ++value) {
    EXPECT_EQ(decodes<Strict>(Buffer{static_cast<std::uint8_t>(value)}), value > 0 && value < 10) << value;
  }
  const Buffer list{2, 3, 10};
  EXPECT_FALSE((decodes<CommandList<Strict, 4>>(list)));
}

TEST(InputCodec, OnlyTheCommandsThatWereGivenTravel) {
  CommandList<Order, 3> list;
  EXPECT_EQ(encode(list), (Buffer{0}));
  EXPECT_TRUE(list.add({0x0102, {1, 0}}));
  EXPECT_EQ(encode(list), (Buffer{1, 2, 1, 0, 0, 0x80, 0x3f, 0, 0, 0, 0}));
  EXPECT_TRUE(list.add({}) && list.add({5, {0, 0}}));
  EXPECT_FALSE(list.add({}));
  EXPECT_EQ(encode(list).size(), (InputCodec<CommandList<Order, 3>>::kCap));
  CommandList<Order, 3> read;
  EXPECT_TRUE((InputCodec<CommandList<Order, 3>>::decode(encode(list), read)));
  EXPECT_EQ(read, list);
}

TEST(InputCodec, AListIsAsLongAsItSays) {
  using List = CommandList<Strict, 3>;
  EXPECT_TRUE(decodes<List>({3, 1, 2, 3}));
  EXPECT_FALSE(decodes<List>({4, 1, 2, 3, 4}));
  EXPECT_FALSE(decodes<List>({3, 1, 2}));
  EXPECT_FALSE(decodes<List>({1, 1, 2}));
  EXPECT_FALSE(decodes<List>({}));
  List kept;
  kept.add({7});
  EXPECT_FALSE(InputCodec<List>::decode(Buffer{2, 1}, kept));
  EXPECT_EQ(kept.count, 1) << "a refused read changes nothing";
}

TEST(InputCodec, WhatIsLeftBehindTheCountDoesNotTravel) {
  CommandList<Strict, 3> a, b;
  a.add({5});
  b.add({5});
  b.items[1] = {9};
  EXPECT_EQ(a, b);
  EXPECT_EQ(encode(a), encode(b));
}

struct Renamed {
  std::int8_t lever = 0;
  std::uint16_t aim = 0;
  Button button = Button::none;
  ISO_TEST_FIELDS(visit("lever", self.lever); visit("aim", self.aim); visit("button", self.button);)
};
struct Widened {
  std::int16_t stick = 0;
  std::uint16_t aim = 0;
  Button button = Button::none;
  ISO_TEST_FIELDS(visit("stick", self.stick); visit("aim", self.aim); visit("button", self.button);)
};
struct Unsigned {
  std::uint8_t stick = 0;
  std::uint16_t aim = 0;
  Button button = Button::none;
  ISO_TEST_FIELDS(visit("stick", self.stick); visit("aim", self.aim); visit("button", self.button);)
};
struct Reordered {
  std::int8_t stick = 0;
  std::uint16_t aim = 0;
  Button button = Button::none;
  ISO_TEST_FIELDS(visit("aim", self.aim); visit("stick", self.stick); visit("button", self.button);)
};
struct Shorter {
  std::int8_t stick = 0;
  std::uint16_t aim = 0;
  ISO_TEST_FIELDS(visit("stick", self.stick); visit("aim", self.aim);)
};
struct Split {  // the same letters, cut elsewhere
  std::int8_t stick = 0;
  std::uint16_t aim = 0;
  Button button = Button::none;
  ISO_TEST_FIELDS(visit("stic", self.stick); visit("kaim", self.aim); visit("button", self.button);)
};
template <std::size_t N> struct Many {
  std::int8_t stick[N] = {};
  ISO_TEST_FIELDS(visit("stick", self.stick);)
};
template <class T> struct One {
  T value{};
  ISO_TEST_FIELDS(visit("value", self.value);)
};
struct Twin {
  std::int8_t stick = 0;
  std::uint16_t aim = 0;
  Button button = Button::none;
  ISO_TEST_FIELDS(visit("stick", self.stick); visit("aim", self.aim); visit("button", self.button);)
};

TEST(InputCodec, TwoLayoutsHaveTwoSchemas) {
  const std::set<std::uint64_t> schemas{InputCodec<Pad>::schema(),
                                        InputCodec<Renamed>::schema(),
                                        InputCodec<Widened>::schema(),
                                        InputCodec<Unsigned>::schema(),
                                        InputCodec<Reordered>::schema(),
                                        InputCodec<Shorter>::schema(),
                                        InputCodec<Split>::schema(),
                                        InputCodec<Many<2>>::schema(),
                                        InputCodec<Many<3>>::schema(),
                                        InputCodec<One<float>>::schema(),
                                        InputCodec<One<Q16_16>>::schema(),
                                        InputCodec<One<std::uint32_t>>::schema(),
                                        InputCodec<One<double>>::schema(),
                                        InputCodec<One<Q32_32>>::schema(),
                                        InputCodec<CommandList<Pad, 2>>::schema(),
                                        InputCodec<CommandList<Pad, 3>>::schema(),
                                        InputCodec<CommandList<Widened, 3>>::schema()};
  EXPECT_EQ(schemas.size(), 17u);
  EXPECT_EQ(InputCodec<Pad>::schema(), InputCodec<Twin>::schema());
}

TEST(InputRules, CallTheCodecAndThePredictor) {
  const InputRules pads = input_rules<Pad>();
  EXPECT_EQ(pads.cap, 4u);
  EXPECT_EQ(Buffer(pads.neutral, pads.neutral + pads.neutral_size), (Buffer{0, 0, 0, 0}));
  EXPECT_TRUE(pads.valid(Buffer{1, 2, 3, 1}));
  EXPECT_FALSE(pads.valid(Buffer{1, 2, 3}));
  std::uint8_t guess[kInputCap];
  EXPECT_EQ(pads.predict(Buffer{1, 2, 3, 1}, 5, guess), 4u);
  EXPECT_EQ(Buffer(guess, guess + 4), (Buffer{1, 2, 3, 1})) << "a held stick stays held";

  const InputRules orders = input_rules<CommandList<Strict, 3>>();
  EXPECT_EQ(orders.predict(Buffer{2, 5, 6}, 1, guess), 1u);
  EXPECT_EQ(guess[0], 0) << "nobody gives an order twice";
  EXPECT_EQ(orders.neutral_size, 1u);
}

struct Climb {
  static Strict predict(const Strict& last, Frame ahead) { return {static_cast<std::uint8_t>(last.value + ahead)}; }
};
TEST(InputRules, APredictorOfTheGamesOwnKnowsHowFarItGuesses) {
  const InputRules rules = input_rules<Strict, Climb>();
  std::uint8_t guess[kInputCap];
  for (Frame ahead = 1; ahead < 5; ++ahead) {
    EXPECT_EQ(rules.predict(Buffer{3}, ahead, guess), 1u);
    EXPECT_EQ(guess[0], 3 + ahead);
  }
}

}  // namespace input_codec_test
}  // namespace isostep
