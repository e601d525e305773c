// LineMeter: what was lost, doubled and overtaken, counted by hand.
// SPDX-License-Identifier: MIT
#include "isostep/session/pace/line_meter.hpp"

#include <gtest/gtest.h>

namespace isostep {
namespace line_meter_test {

TEST(LineMeter, CountsWhatIsLostAcrossTheEndOfTheNumbers) {
  LineMeter meter;
  EXPECT_EQ(meter.loss(0), 0u);
  for (int i = 0; i < 1000; ++i) {
    if (i % 50 != 7) meter.arrived(static_cast<std::uint16_t>(65000 + i), static_cast<Time>(i) * 16667);
  }
  EXPECT_EQ(meter.loss(1000 * 16667), 20u);
}

TEST(LineMeter, TakesCopiesForOneAndWhatIsOvertakenForArrived) {
  LineMeter meter;
  for (int i = 0; i < 1000; i += 2) {
    for (const int number : {i + 1, i, i + 1, i}) meter.arrived(static_cast<std::uint16_t>(number), 0);
  }
  EXPECT_EQ(meter.loss(0), 0u);
  for (int i = 1000; i < 2000; i += 4) {
    meter.arrived(static_cast<std::uint16_t>(i), 0);
    meter.arrived(static_cast<std::uint16_t>(i), 0);
  }
  EXPECT_NEAR(meter.loss(0), 375, 2) << "copies do not hide what is lost";
}

TEST(LineMeter, ForgetsAfterAMinuteAndDoesNotBelieveJumps) {
  LineMeter meter;
  for (int i = 0; i < 600; ++i) meter.arrived(static_cast<std::uint16_t>(2 * i), kSecond);
  EXPECT_NEAR(meter.loss(kSecond), 500, 2);
  meter.arrived(20000, kSecond);
  EXPECT_NEAR(meter.loss(kSecond), 500, 2);
  for (int i = 0; i < 600; ++i) meter.arrived(static_cast<std::uint16_t>(30000 + i), 62 * kSecond);
  EXPECT_EQ(meter.loss(66 * kSecond), 0u);
}

TEST(LineMeter, SaysByHowMuchTheWaysOfDatagramsDiffer) {
  LineMeter meter;
  // Sent every 16 ms, by a clock that ends meanwhile; every second one comes 7 ms late.
  for (int i = 0; i < 5000; ++i) {
    const Time sent = static_cast<Time>(i) * 16000;
    meter.measured(static_cast<std::uint16_t>(40000 + sent / 1000), sent + 30000 + static_cast<Time>(i % 2) * 7000);
  }
  EXPECT_EQ(meter.jitter(4999 * 16000), 7000u);
  EXPECT_EQ(meter.jitter(200 * kSecond), 0u) << "nothing was heard for a minute";
}

}  // namespace line_meter_test
}  // namespace isostep
