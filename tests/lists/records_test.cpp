// A kind of record is one file and one line: commands, their checks, hashes, logs, portable forms, scene files, the C
// interface and sub-steps find it in the list. What is missing does not compile. Tried on copies of the headers, with
// the compiler of this build.
// SPDX-License-Identifier: MIT
#include "lists/probe.hpp"

namespace isostep {
namespace {

constexpr char kProgram[] = "tests/lists/record_probe.cpp";
constexpr char kFile[] = "include/isostep/dynamics/records/probe.hpp";
constexpr char kList[] = "include/isostep/dynamics/records/record_list.hpp";

class RecordList : public ListProbe {
 protected:
  void add_to_list() {
    edit(kList, "  R(X, sensor_mount, SensorMount<S>, SensorMountId, S)",
         "  R(X, sensor_mount, SensorMount<S>, SensorMountId, S) R(X, probe, Probe<S>, ProbeId, S)");
  }
  void add_file() {
    copy("tests/lists/probe_record.hpp", kFile);
    edit(kList, "#include \"isostep/dynamics/records/one_way.hpp\"",
         "#include \"isostep/dynamics/records/one_way.hpp\"\n#include \"isostep/dynamics/records/probe.hpp\"");
  }
  std::string errors_of_store() {
    return errors_of("isostep/dynamics/records/record_store.hpp",
                     "constexpr auto kKinds = isostep::RecordStore<float>::kKinds;");
  }
};

TEST_F(RecordList, without_its_file_it_does_not_compile) {
  add_to_list();
  EXPECT_THAT(errors_of("isostep/dynamics/records/record_store.hpp"), HasSubstr("Probe"));
}

TEST_F(RecordList, without_fields_it_does_not_compile) {
  add_to_list();
  add_file();
  edit(kFile, "  ISO_FIELDS(body, volume)\n", "");
  EXPECT_THAT(errors_of("scenes/scene_records.cpp"), AllOf(HasSubstr("fields"), HasSubstr("Probe")));
}

TEST_F(RecordList, without_rules_it_does_not_compile) {
  add_to_list();
  add_file();
  edit(kFile, "struct RecordRules<Probe<S>>", "struct NoRules");
  EXPECT_THAT(errors_of("scenes/scene_records.cpp"), AllOf(HasSubstr("RecordRules"), HasSubstr("Probe")));
}

TEST_F(RecordList, without_a_word_of_what_it_does_it_does_not_compile) {
  add_to_list();
  add_file();
  EXPECT_EQ(errors_of_store(), "");
  edit(kFile, "  static constexpr Acts kActs = Acts::pushes;\n", "");
  EXPECT_THAT(errors_of_store(), AllOf(HasSubstr("kActs"), HasSubstr("Probe")));
}

TEST_F(RecordList, with_a_misspelt_act_it_does_not_compile) {
  add_to_list();
  add_file();
  edit(kFile, "static void act(", "static void acts(");
  EXPECT_THAT(errors_of_store(), HasSubstr("probe: its rules have other functions than their kActs says"));
}

TEST_F(RecordList, with_an_act_that_nothing_calls_it_does_not_compile) {
  add_to_list();
  add_file();
  edit(kFile, "Acts::pushes", "Acts::not_here");
  EXPECT_THAT(errors_of_store(), HasSubstr("probe: its rules have other functions than their kActs says"));
}

TEST_F(RecordList, with_its_file_it_works_everywhere) {
  copy_folder("src/c");
  add_to_list();
  add_file();
  EXPECT_EQ(
      output_of(kProgram),
      "add_probe.volume add_probe.body set_probe.body volume 3 hashed 1 played 1 portable 1 gone 1 rises 1 falls 1 "
      "scene {\"type\": \"probe\", \"body\": 0, \"volume\": 3} C probe\n");
}

}  // namespace
}  // namespace isostep
