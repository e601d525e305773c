// The spring experiment: verdicts at points where the answer is known in closed form, and its command.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "own_folder.hpp"
#include "tool/command_line.hpp"
#include "tool/common/tool.hpp"
#include "tool/lab/springs.hpp"

namespace isostep::tool::lab {
namespace lab_springs_test {

constexpr int kExplicit = 0, kSemiImplicit = 1, kVerlet = 2, kRk4 = 3, kImplicit = 4;

template <class S> class LabSprings : public testing::Test {
 protected:
  static SpringSample measure(SpringSystem system, int method, double stiffness) {
    return measure_springs(system, ScalarTraits<S>::kName, method, stiffness, 0);
  }
  static SpringSample oscillator(int method, double stiffness) {
    return measure(SpringSystem::oscillator, method, stiffness);
  }
};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(LabSprings, Scalars);

TYPED_TEST(LabSprings, SemiImplicitEulerAndVerletExplodeAboveFour) {
  for (const int method : {kSemiImplicit, kVerlet}) {
    for (const double stiffness : {0.01, 0.3, 1.0, 3.0, 3.9})
      EXPECT_NE(this->oscillator(method, stiffness).verdict, SpringVerdict::exploded) << stiffness;
    for (const double stiffness : {4.1, 10.0, 1e4})
      EXPECT_EQ(this->oscillator(method, stiffness).verdict, SpringVerdict::exploded) << stiffness;
  }
}

// What it keeps instead of the energy lets that rise to 1 / (1 - sqrt(k h^2 / m) / 2) of the start.
TYPED_TEST(LabSprings, SemiImplicitEulerIsStableWhileItsEnergyRisesByLessThanHalf) {
  EXPECT_EQ(this->oscillator(kSemiImplicit, 0.4).verdict, SpringVerdict::stable);
  EXPECT_EQ(this->oscillator(kSemiImplicit, 0.5).verdict, SpringVerdict::bounded);
}

// Each step of explicit Euler takes the energy times 1 + k h^2 / m, whatever the phase.
TYPED_TEST(LabSprings, ExplicitEulerNeverHoldsWhatNothingDamps) {
  double mean = 0;
  for (int step = 91; step <= 100; ++step) mean += std::pow(1.01, step) / 10;
  EXPECT_NEAR(this->oscillator(kExplicit, 0.01).energy, mean, 0.001 * mean);
  for (const double stiffness : {0.01, 0.1, 1.0, 1e4})
    EXPECT_EQ(this->oscillator(kExplicit, stiffness).verdict, SpringVerdict::exploded) << stiffness;
}

// The classical method's region of stability ends on the imaginary axis at sqrt(8).
TYPED_TEST(LabSprings, RungeKuttaExplodesAboveEight) {
  EXPECT_EQ(this->oscillator(kRk4, 7.8).verdict, SpringVerdict::stable);
  EXPECT_EQ(this->oscillator(kRk4, 8.2).verdict, SpringVerdict::exploded);
}

// Each step of implicit Euler divides the energy by 1 + k h^2 / m.
TYPED_TEST(LabSprings, ImplicitEulerLosesEnergyAtAnyStiffness) {
  double mean = 0;
  for (int step = 91; step <= 100; ++step) mean += std::pow(1.01, -step) / 10;
  EXPECT_NEAR(this->oscillator(kImplicit, 0.01).energy, mean, 0.001 * mean);
  for (const SpringSystem system : {SpringSystem::oscillator, SpringSystem::net}) {
    for (const double stiffness : {0.01, 1.0, 100.0, 1e4}) {
      const SpringSample sample = this->measure(system, kImplicit, stiffness);
      EXPECT_EQ(sample.verdict, SpringVerdict::stable) << stiffness;
      EXPECT_EQ(sample.amplitude, 1) << stiffness;
      EXPECT_LT(sample.energy, 0.5) << stiffness;
    }
  }
}

TYPED_TEST(LabSprings, TheExactSpringKeepsItsEnergyAtAnyStiffness) {
  for (const double stiffness : {0.01, 1.0, 4.1, 100.0, 1e4}) {
    const SpringSample sample = this->oscillator(kExactSpring, stiffness);
    EXPECT_EQ(sample.verdict, SpringVerdict::stable) << stiffness;
    EXPECT_NEAR(sample.energy, 1, 0.02) << stiffness;
  }
}

// The stiffest mode of the net: 2 (2 - 2 cos(8 pi / 9)).
TYPED_TEST(LabSprings, TheNetExplodesWhereItsStiffestModeReachesFour) {
  const double limit = 4 / (4 + 4 * std::cos(3.14159265358979323846 / 9));
  EXPECT_NE(this->measure(SpringSystem::net, kSemiImplicit, 0.97 * limit).verdict, SpringVerdict::exploded);
  EXPECT_EQ(this->measure(SpringSystem::net, kSemiImplicit, 1.05 * limit).verdict, SpringVerdict::exploded);
}

class LabSpringsCommand : public OwnFolder {};
TEST_F(LabSpringsCommand, PrintsJsonOfEverySampleAndLeavesTheTable) {
  const std::string out = path("results");
  const char* words[] = {"isostep", "lab", "springs", "--quick", "--json", "--out", out.c_str()};
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int status = run_command_line(7, words);
  std::fflush(stdout);
  const std::string printed = testing::internal::GetCapturedStdout();
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_EQ(status, 0);
  const std::size_t end = said.find("about 0 s left: net ");
  ASSERT_NE(end, std::string::npos) << said;
  EXPECT_EQ(std::count(said.begin() + static_cast<std::ptrdiff_t>(end), said.end(), '\n'), 2)
      << said;  // then drawn, or no gnuplot
  const auto json = nlohmann::json::parse(printed);
  std::size_t scalars = 0;
  any_scalar([&](auto) { return ++scalars, false; });
  EXPECT_EQ(json["samples"].size(), 2 * scalars * kSpringMethods * spring_stiffnesses(true).size());
  for (const auto& sample : json["samples"]) {
    EXPECT_TRUE(sample["energy"].is_number());
    EXPECT_GE(sample["amplitude"].get<double>(), 1);
  }
  std::ifstream table(out + "/springs.tsv");
  std::stringstream text;
  text << table.rdbuf();
  const std::string lines = text.str();
  EXPECT_EQ(static_cast<std::size_t>(std::count(lines.begin(), lines.end(), '\n')), 1 + json["samples"].size());
}

TEST_F(LabSpringsCommand, RefusesExperimentsThatDoNotExist) {
  for (const char* word : {"nonsense", "--help-me"}) {
    const char* words[] = {"isostep", "lab", word};
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_command_line(3, words), exit_status::kUsage);
    EXPECT_FALSE(testing::internal::GetCapturedStderr().empty());
  }
}

}  // namespace lab_springs_test
}  // namespace isostep::tool::lab
