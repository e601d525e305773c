// `isostep diff --stages --prover-b`: the lines in which another program tells its fields and traces; programs that
// tell something else.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/state/fields.hpp"
#include "isostep/state/value_text.hpp"
#include "unit/tool/staged_recordings.hpp"

namespace isostep::test {
namespace other_prover_test {

TEST(FieldLines, ReadBackAsTheyWere) {
  const NamedField fields[] = {{"a", kFieldFormat<bool>, 1},
                               {"b[3].c", kFieldFormat<std::int32_t>, 0xfffffffeu},
                               {"tick", kFieldFormat<std::uint64_t>, 77},
                               {"x", kFieldFormat<float>, 0x3fc00000},
                               {"y", kFieldFormat<double>, 0x3ff8000000000000},
                               {"z", kFieldFormat<Q16_16>, 0xffff0000u},
                               {"w", kFieldFormat<Unit<Q32_32>>, 3}};
  for (const NamedField& field : fields) {
    NamedField read;
    ASSERT_TRUE(read_field_line(field_line(field), read)) << field_line(field);
    EXPECT_EQ(read.path, field.path);
    EXPECT_EQ(read.bits, field.bits);
    EXPECT_EQ(value_text(read.format, read.bits), value_text(field.format, field.bits));
  }
  EXPECT_EQ(field_line(fields[3]), "x\tf32.24\t0x3fc00000");
  NamedField read;
  for (const char* text :
       {"", "x", "x\tf32.24", "\tf32.24\t0x3fc00000", "x\tf32.24\t0x3fc0000", "x\tf33.24\t0x3fc00000",
        "x\tf32\t0x3fc00000", "x\tv32\t0x3fc00000", "x\tu32.1\t0x3fc00000", "x\tu32\t0x3fcG0000"}) {
    EXPECT_FALSE(read_field_line(text, read)) << text;
  }
}

#if defined(ISOSTEP_PROVER)
/// The programs themselves: this tool on one side, a prover with a fault on the other.
TEST_F(Recorded, AnotherProgramIsCompared) {
  const std::string prover = "'" ISOSTEP_PROVER "'";
  const std::string rigid = file("it's a replay", rigid_recording<Q32_32>(SolverName::direct, 8));
  const std::string particles = file("b", particle_recording<double>(2, 8));
  EXPECT_EQ(output(0, {"--prover-b", prover, rigid}), "the same: 8 frames, stage by stage\n");
  const struct {
    const std::string& file;
    const char *stage, *path, *apart;
  } faults[] = {{rigid, "colour_constraints", "islands[0].bodies[0]", "4 apart [body slot "},
                {rigid, "solve_substeps", "solver_velocity[3].angular.y", "4 lsb apart [body slot "},
                {particles, "solve_substeps", "rows[6].separation", "4 ulp apart [particle slot"},
                {particles, "commands", "velocity.y[7]", "4 ulp apart [particle slot 7]\n"}};
  for (const auto& fault : faults) {
    const std::string word = std::string("5:") + fault.stage + ":" + fault.path + ":2";
    const std::string out =
        output(1, {"--prover-a", prover, "--prover-b", prover + " --fault '" + word + "'", fault.file});
    EXPECT_EQ(out.rfind(std::string("frame 5, stage ") + fault.stage + "\n  " + fault.path + ": ", 0), 0u) << out;
    EXPECT_NE(out.find(fault.apart), std::string::npos) << out;
    EXPECT_NE(out.find("\n  1 of "), std::string::npos) << out;
  }
}
TEST_F(Recorded, AnotherProgramPlaysWhatIsCutOffAsFarAsItGoes) {
  std::vector<std::uint8_t> bytes = rigid_recording<float>(SolverName::soft_step, 4);
  bytes.resize(bytes.size() - 20);
  testing::internal::CaptureStderr();
  EXPECT_EQ(output(0, {"--prover-b", "'" ISOSTEP_PROVER "'", file("a", bytes)}),
            "the same: 4 frames, stage by stage\n");
  EXPECT_NE(testing::internal::GetCapturedStderr().find("a is cut off"), std::string::npos);
}
TEST_F(Recorded, AProgramThatIsNoProverIsRefused) {
  const std::string rigid = file("a", rigid_recording<float>(SolverName::soft_step, 2));
  testing::internal::CaptureStderr();
  output(70, {"--prover-b", "echo", rigid});
  output(70, {"--prover-b", "isostep-no-such-program 2>/dev/null", rigid});
  output(70, {"--prover-b", "'" ISOSTEP_PROVER "' --fault 1:prepare:tick:99", rigid});
  output(70, {"--prover-b", "exit 1 #", rigid});  // nothing of this is "different"
  output(70, {"--prover-b", "kill -9 $$ #", rigid});
  output(70, {"--prover-b", "true", rigid});
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("echo: not a prover's answer"), std::string::npos) << said;
  for (const char* end : {"true: says nothing\n", ": ended with exit status 127\n", ": ended with exit status 64\n",
                          ": ended with exit status 1\n", ": did not come to its end\n"})
    EXPECT_NE(said.find(end), std::string::npos) << end << said;
}
TEST_F(Recorded, ATraceThatNoRecordingHasIsRefused) {
  const std::string rigid = file("a", rigid_recording<float>(SolverName::soft_step, 4));
  const auto said_of = [&](int status, const std::string& lines) {
    testing::internal::CaptureStderr();
    output(status, {"--prover-b", "'" ISOSTEP_PROVER "'", "--prover-a", "printf '" + lines + "' #", rigid});
    return testing::internal::GetCapturedStderr();
  };
  std::string frames;
  for (const char* frame : {"0", "1", "2", "3"}) frames += std::string(frame) + " 1 commands 0\\n";
  for (const std::string& lines : std::vector<std::string>{
           frames + "4 1 commands 0\\n", "18446744073709551615 1 commands 0\\n", "0 1 commands 0\\n0 -1 prepare 0\\n",
           "1 1 commands 0\\n", "0 2 commands 0\\n", "0 1 prepare 0\\n", "0 1 commands 0\\n2 1 commands 0\\n",
           "0 1 commands 0\\n0 66 commands 0\\n", "0 1 commands 0\\n0 1 prepare 0\\n1 1 commands 0\\n",
           "0 1 commands 0x1\\n", "0 1 commands\\n", "0 1 commands 0 0\\n", "0 4294967297 commands 0\\n"}) {
    const std::string said = said_of(70, lines);
    EXPECT_NE(said.find("not a prover's answer"), std::string::npos) << lines << said;
  }
  const std::string unknown = said_of(70, "0 1 commands 0\\n0 1 find_piars 0\\n");
  EXPECT_NE(unknown.find("this build has no stage find_piars"), std::string::npos) << unknown;
}
#endif

}  // namespace other_prover_test
}  // namespace isostep::test
