// The figures of a run and the golden lists as text.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "tool/common/hash_lines.hpp"
#include "tool/verify/goldens.hpp"
#include "tool/run/run_report.hpp"

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
