// The figures of a run, hashes and goldens as text.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <regex>

#include "tool/common/hash_lines.hpp"
#include "tool/run/run_report.hpp"
#include "tool/verify/goldens.hpp"

namespace isostep::tool {
namespace report_test {

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

class TrialReports : public testing::Test {
 protected:
  static constexpr scenes::Trial kTrial = {"name", "5", "what", "peak stretch of a link", "%", 5, nullptr, nullptr};
  static std::string last_line(const RunReport& report) {
    const std::string text = table_of(report);
    return text.substr(text.rfind('\n', text.size() - 2) + 1);
  }
  RunReport report_of(scenes::Verdict verdict, bool over) {
    RunReport report;
    report.trial = TrialReport{&kTrial, verdict, over};
    return report;
  }
};

TEST_F(TrialReports, AreALineForPeople) {
  EXPECT_EQ(last_line(report_of({true, 3.25}, true)),
            "trial 5       peak stretch of a link 3.25 %, bar 5 %: survived\n");
  EXPECT_EQ(last_line(report_of({false, 7}, true)), "trial 5       peak stretch of a link 7 %, bar 5 %: failed\n");
  EXPECT_EQ(last_line(report_of({true, 1}, false)), "trial 5       peak stretch of a link 1 %, bar 5 %: not over\n");
  EXPECT_EQ(last_line(RunReport{}).substr(0, 6), "faults");
}

TEST_F(TrialReports, AreAnObjectForPrograms) {
  const auto trial = [](const RunReport& report) {
    return nlohmann::ordered_json::parse(json_of(report))["trial"].dump();
  };
  const std::string head = R"({"number":"5","measure":"peak stretch of a link","unit":"%","bar":5.0,)";
  EXPECT_EQ(trial(report_of({true, 3.25}, true)), head + R"("figure":3.25,"survived":true})");
  EXPECT_EQ(trial(report_of({true, 3.25}, false)), head + R"("figure":3.25,"survived":null})");
  EXPECT_EQ(trial(report_of({false, std::numeric_limits<double>::infinity()}, true)),
            head + R"("figure":null,"survived":false})");
  EXPECT_FALSE(nlohmann::ordered_json::parse(json_of(RunReport{})).contains("trial"));
}

TEST(HashLines, AreANumberAndAHashEach) {
  const std::vector<std::uint64_t> hashes = {0, 0xffffffffffffffffu, 0x0123456789abcdefu};
  EXPECT_EQ(hash_lines(hashes), "0 0000000000000000\n1 ffffffffffffffff\n2 0123456789abcdef\n");
}

/// 130 frames, whose hashes are their numbers.
Golden counted_golden() {
  std::vector<std::uint64_t> hashes(130);
  for (std::size_t i = 0; i < hashes.size(); ++i) hashes[i] = i;
  return golden_of("S1x5", "q16.16", hashes);
}

TEST(Goldens, HoldEverySixtiethHashAndTheLast) {
  const Golden golden = counted_golden();
  EXPECT_EQ(golden.marks, (std::vector<std::uint64_t>{59, 119, 129}));
  EXPECT_EQ(frame_of_mark(golden, 1), 119u);
  EXPECT_EQ(frame_of_mark(golden, 2), 129u);
  EXPECT_EQ(golden_of("S1", "float", {7}).marks, std::vector<std::uint64_t>{7});
  EXPECT_EQ(golden_of("S1", "float", std::vector<std::uint64_t>(60, 7)).marks, std::vector<std::uint64_t>{7});
}

TEST(Goldens, HaveADigestOfEveryFrame) {
  std::vector<std::uint64_t> hashes(130, 1);
  const std::uint64_t digest = golden_of("S1", "float", hashes).digest;
  hashes[70] = 2;
  EXPECT_NE(golden_of("S1", "float", hashes).digest, digest);
}

TEST(Goldens, ReadBackAsTheyWereWritten) {
  const Golden golden = counted_golden();
  const std::string line = text_of(golden);
  EXPECT_TRUE(std::regex_match(
      line, std::regex("S1x5 q16\\.16 130 [0-9a-f]{16} 000000000000003b 0000000000000077 0000000000000081")))
      << line;
  const std::optional<Golden> back = parse_golden(line);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->scene, "S1x5");
  EXPECT_EQ(back->scalar, "q16.16");
  EXPECT_EQ(back->frames, 130u);
  EXPECT_EQ(back->digest, golden.digest);
  EXPECT_EQ(back->marks, golden.marks);
}

TEST(Goldens, AreRefusedInAnyOtherForm) {
  const std::string hash = " 0123456789abcdef";
  EXPECT_TRUE(parse_golden("S1 float 60" + hash + hash));
  for (const std::string& line :
       {std::string(), std::string("S1"), "S1 float" + hash + hash, "S1 float 61" + hash + hash, "S1 float 0" + hash,
        "S1 float 60" + hash, "S1 float 60" + hash + hash + hash, "S1 float 60" + hash + hash + " ",
        "S1  float 60" + hash + hash, "S1 float 060" + hash + hash, "S1 float -60" + hash + hash,
        "S1 float 60" + hash + " 123456789abcdef", "S1 float 60" + hash + " 0123456789ABCDEF"}) {
    EXPECT_FALSE(parse_golden(line)) << line;
  }
}

TEST(Goldens, AreLinesOfAFile) {
  EXPECT_EQ(golden_lines("a\r\nb\n\nc"), (std::vector<std::string_view>{"a", "b", "", "c"}));
  EXPECT_TRUE(golden_lines("").empty());
}

}  // namespace report_test
}  // namespace isostep::tool
