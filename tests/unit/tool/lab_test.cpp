// The laboratory's record and its file: numbers that come back, lines that were cut, results that stand for runs.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "lab_results.hpp"
#include "own_folder.hpp"
#include "tool/common/tool.hpp"
#include "tool/lab/store.hpp"

namespace isostep::tool::lab {
namespace lab_test {

// ---- the record

LabResult full_result() {
  LabResult r;
  r.point = {"a \"file\", of mine.json", "bullet", "q32.32", "direct", "particles", 120, 3};
  r.state = kLeftOut;
  r.reason = "line\nand, \"quote\"";
  r.frames = 7;
  r.ms = 0.1;
  r.ms_mean = 1.0 / 3;
  r.penetration = 5e-324;
  r.penetration_mean = 1.7976931348623157e308;
  r.joint_error = 0.2;
  r.energy_gain = -0.0;
  r.energy_loss = -3e-7;
  r.unrest = 2e-9;
  r.signorini = 1e-3;
  r.coulomb = 0;
  r.dissipation = 3e-5;
  r.deviation = 123456.789;
  r.faults = 2;
  r.judged = r.survived = true;
  r.figure = -1;
  r.outcome = {0.1, -2, 1e-30};
  r.stood = false;
  return r;
}

TEST(LabRecord, ReadsBackAsItWasWritten) {
  const LabResult written = full_result();
  const LabRecord read = from_line(to_line({written, "v1"}));
  EXPECT_EQ(read.version, "v1");
  EXPECT_EQ(read.result.point, written.point);
  EXPECT_EQ(read.result.state, written.state);
  EXPECT_EQ(read.result.reason, written.reason);
  EXPECT_EQ(read.result.frames, 7);
  for (const auto member :
       {&LabResult::ms, &LabResult::ms_mean, &LabResult::penetration, &LabResult::penetration_mean,
        &LabResult::joint_error, &LabResult::energy_gain, &LabResult::energy_loss, &LabResult::unrest,
        &LabResult::signorini, &LabResult::coulomb, &LabResult::dissipation, &LabResult::deviation, &LabResult::figure})
    EXPECT_EQ(read.result.*member, written.*member);
  EXPECT_EQ(read.result.faults, 2);
  EXPECT_TRUE(read.result.judged && read.result.survived);
  EXPECT_EQ(read.result.outcome, written.outcome);
  EXPECT_FALSE(read.result.stood);
}

TEST(LabRecord, IsOneLineWhateverItsTexts) { EXPECT_EQ(to_line({full_result(), "v"}).find('\n'), std::string::npos); }

TEST(LabRecord, WritesWhatIsNoNumberAsNull) {
  LabResult r = result("float", "pgs", 1, 1, std::numeric_limits<double>::infinity());
  const std::string line = to_line({r, "v"});
  EXPECT_NE(line.find("\"penetration\":null"), std::string::npos);
  EXPECT_TRUE(std::isnan(from_line(line).result.penetration));
}

TEST(LabRecord, RefusesLinesThatAreNone) {
  EXPECT_THROW(from_line("not json"), std::runtime_error);
  EXPECT_THROW(from_line("[1]"), std::runtime_error);
  EXPECT_THROW(from_line("{}"), std::runtime_error);
  std::string line = to_line({full_result(), "v"});
  line.replace(line.find("\"frames\":7"), 10, "\"frames\":\"7\"");
  EXPECT_THROW(from_line(line), std::runtime_error);
}

TEST(LabRecord, MakesATableWithQuotesWhereCommasAre) {
  const std::string csv = csv_of({full_result()});
  EXPECT_EQ(csv.find("scene,engine,scalar,solver,model,hz,substeps,state,reason,frames,ms,"), 0u);
  EXPECT_NE(csv.find("\n\"a \"\"file\"\", of mine.json\",bullet,q32.32,direct,particles,120,3,left_out,"),
            std::string::npos);
}

// ---- the store

class LabStore : public OwnFolder {
 protected:
  std::string kept() const { return path("results"); }
  std::string file() const { return kept() + "/" + kResultsFile; }
  void add_text(const std::string& text) const { std::ofstream(file(), std::ios::app | std::ios::binary) << text; }
};

TEST_F(LabStore, KnowsWhatAnEarlierOneKept) {
  const LabResult r = result("float", "pgs", 4, 0.5, 0.01);
  ResultStore(kept()).append({r, "v1"});
  const ResultStore store(kept());
  const LabResult* found = store.find(r.point, {"v1", 600});
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->penetration, 0.01);
  EXPECT_EQ(store.find(r.point, {"v2", 600}), nullptr) << "another version";
  EXPECT_EQ(store.find(r.point, {"v1", 60}), nullptr) << "another length";
  EXPECT_EQ(store.find(point("float", "pgs", 8), {"v1", 600}), nullptr) << "another point";
}

TEST_F(LabStore, TakesAwayALineThatWasCut) {
  const LabResult first = result("float", "pgs", 4, 0.5, 0.01), second = result("float", "pgs", 8, 1, 0.02);
  ResultStore(kept()).append({first, "v1"});
  add_text(to_line({second, "v1"}).substr(0, 40));
  {
    ResultStore store(kept());
    EXPECT_NE(store.find(first.point, {"v1", 600}), nullptr);
    EXPECT_EQ(store.find(second.point, {"v1", 600}), nullptr);
    store.append({second, "v1"});
  }
  EXPECT_EQ(read_records(file()).size(), 2u);
}

TEST_F(LabStore, TheLastOfOnePointCounts) {
  ResultStore store(kept());
  store.append({result("float", "pgs", 4, 0.5, 0.01), "v1"});
  store.append({result("float", "pgs", 8, 0.5, 0.01), "v1"});
  store.append({result("float", "pgs", 4, 0.5, 0.03), "v2"});
  const std::vector<LabRecord> records = read_records(file());
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[0].result.penetration, 0.03);
  EXPECT_EQ(records[0].version, "v2");
}

TEST_F(LabStore, NamesALineThatIsWrong) {
  ResultStore(kept()).append({result("float", "pgs", 4, 0.5, 0.01), "v1"});
  add_text("{}\n");
  try {
    ResultStore store(kept());
    FAIL();
  } catch (const ToolError& error) {
    EXPECT_EQ(error.status(), exit_status::kUsage);
    EXPECT_NE(std::string(error.what()).find("results.jsonl:2: scene is missing"), std::string::npos) << error.what();
  }
}

TEST_F(LabStore, ARunStandsForOneOfItsVersionAndLength) {
  LabResult r = result("float", "pgs", 4, 0.5, 0.01);
  EXPECT_TRUE(stands_for({r, "v"}, {"v", 600}));
  EXPECT_FALSE(stands_for({r, "v"}, {"w", 600}));
  EXPECT_FALSE(stands_for({r, "v"}, {"v", 601}));
  r.state = kRefused;
  EXPECT_TRUE(stands_for({r, "v"}, {"v", 601})) << "a longer one is refused too";
}

TEST_F(LabStore, WithoutADirectoryNothingIsKept) {
  ResultStore store("");
  store.append({result("float", "pgs", 4, 0.5, 0.01), "v1"});
  EXPECT_TRUE(store.path().empty());
}

}  // namespace lab_test
}  // namespace isostep::tool::lab
