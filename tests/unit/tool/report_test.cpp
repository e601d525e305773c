// The figures of a run and the golden lists as text.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tool/goldens.hpp"
#include "tool/run_report.hpp"

namespace isostep::tool {
namespace {

TEST(StepTimes, AreByNearestRank) {
  std::vector<double> ms;
  for (int i = 200; i >= 1; --i) ms.push_back(i);
  const StepTimes times = summarise(ms);
  EXPECT_EQ(times.median, 100);
  EXPECT_EQ(times.p99, 198);
  EXPECT_EQ(times.max, 200);
  EXPECT_DOUBLE_EQ(times.mean, 100.5);
  EXPECT_EQ(times.median_settled, 50);  // the second half is 100 down to 1
}

TEST(StepTimes, OfOneStepOrNoneAreThatOrZero) {
  EXPECT_EQ(summarise({3}).p99, 3);
  EXPECT_EQ(summarise({3}).median_settled, 3);
  EXPECT_EQ(summarise({}).max, 0);
}

TEST(Goldens, ReadBackAsTheyWereWritten) {
  const std::vector<std::uint64_t> hashes = {0, 0xffffffffffffffffu, 0x0123456789abcdefu};
  EXPECT_EQ(hash_lines(hashes), "0 0000000000000000\n1 ffffffffffffffff\n2 0123456789abcdef\n");
  EXPECT_EQ(parse_hash_lines(hash_lines(hashes)), hashes);
  EXPECT_EQ(parse_hash_lines("0 0000000000000001\r\n"), std::vector<std::uint64_t>{1});
}

TEST(Goldens, AreRefusedInAnyOtherForm) {
  for (const char* text : {"0 0000000000000000", "1 0000000000000000\n", "0 000000000000000\n", "0  0000000000000000\n",
                           "0 000000000000000g\n", "0 0000000000000000 \n", "\n", "0 0x00000000000000\n"}) {
    EXPECT_FALSE(parse_hash_lines(text)) << text;
  }
}

TEST(Goldens, AreNamedBySceneAndScalar) {
  const std::optional<GoldenName> name = parse_golden_name("S1x5.q16.16.txt");
  ASSERT_TRUE(name);
  EXPECT_EQ(name->scene, "S1x5");
  EXPECT_EQ(name->scalar, "q16.16");
  EXPECT_EQ(golden_name("S1x5", "q16.16"), "S1x5.q16.16.txt");
  EXPECT_FALSE(parse_golden_name("S1x5.txt"));
  EXPECT_FALSE(parse_golden_name("S1x5.float.text"));
  EXPECT_FALSE(parse_golden_name("txt"));
}

}  // namespace
}  // namespace isostep::tool
