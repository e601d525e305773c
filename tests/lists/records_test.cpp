// A kind of record is one file, as the page of records has it, and one line: commands, their checks, hashes, logs,
// portable forms, scene files, the C interface and sub-steps find it in the list. What is missing does not compile.
// Tried on copies of the headers, with the compiler of this build.
// SPDX-License-Identifier: MIT
#include "lists/probe.hpp"

namespace isostep {
namespace records_test {

constexpr char kProgram[] = "tests/lists/record_probe.cpp";
constexpr char kFile[] = "include/isostep/dynamics/records/balloon.hpp";
constexpr char kPage[] = "include/isostep/dynamics/records/README.md";
constexpr char kList[] = "include/isostep/dynamics/records/record_list.hpp";

class RecordList : public ListProbe {
 protected:
  void add_to_list() {
    edit(kList, "  R(X, sensor_mount, SensorMount<S>, SensorMountId, S)",
         "  R(X, sensor_mount, SensorMount<S>, SensorMountId, S) R(X, balloon, Balloon<S>, BalloonId, S)");
  }
  void add_file() {
    copy_code(kPage, kFile);
    edit(kList, "#include \"isostep/dynamics/records/one_way.hpp\"",
         "#include \"isostep/dynamics/records/one_way.hpp\"\n#include \"isostep/dynamics/records/balloon.hpp\"");
  }
  std::string errors_of_store() {
    return errors_of("isostep/dynamics/records/record_store.hpp",
                     "constexpr auto kKinds = isostep::RecordStore<float>::kKinds;");
  }
};

TEST_F(RecordList, without_its_file_it_does_not_compile) {
  add_to_list();
  EXPECT_THAT(errors_of("isostep/dynamics/records/record_store.hpp"), HasSubstr("Balloon"));
}

TEST_F(RecordList, without_fields_it_does_not_compile) {
  add_to_list();
  add_file();
  edit(kFile, "  ISO_FIELDS(body, volume)\n", "");
  EXPECT_THAT(errors_of("scenes/scene_records.cpp"), AllOf(HasSubstr("fields"), HasSubstr("Balloon")));
}

TEST_F(RecordList, without_rules_it_does_not_compile) {
  add_to_list();
  add_file();
  edit(kFile, "struct RecordRules<Balloon<S>>", "struct NoRules");
  EXPECT_THAT(errors_of("scenes/scene_records.cpp"), AllOf(HasSubstr("RecordRules"), HasSubstr("Balloon")));
}

TEST_F(RecordList, without_a_word_of_what_it_does_it_does_not_compile) {
  add_to_list();
  add_file();
  EXPECT_EQ(errors_of_store(), "");
  edit(kFile, "  static constexpr Acts kActs = Acts::pushes;\n", "");
  EXPECT_THAT(errors_of_store(), AllOf(HasSubstr("kActs"), HasSubstr("Balloon")));
}

TEST_F(RecordList, with_a_misspelt_act_it_does_not_compile) {
  add_to_list();
  add_file();
  edit(kFile, "static void act(", "static void acts(");
  EXPECT_THAT(errors_of_store(), HasSubstr("balloon: its rules have other functions than their kActs says"));
}

TEST_F(RecordList, with_an_act_that_nothing_calls_it_does_not_compile) {
  add_to_list();
  add_file();
  edit(kFile, "Acts::pushes", "Acts::not_here");
  EXPECT_THAT(errors_of_store(), HasSubstr("balloon: its rules have other functions than their kActs says"));
}

// What a record holds or says alone, all at once: each refusal is an assertion of its own.
TEST_F(RecordList, with_members_and_rules_that_contradict_each_other_it_does_not_compile) {
  add_to_list();
  add_file();
  edit(kFile, "  S volume = S(0);", "  JointId joint = {};\n  ShapeId shape = {};\n  S volume = S(0);");
  edit(kFile, "ISO_FIELDS(body, volume)", "ISO_FIELDS(body, joint, shape, volume)");
  edit(kFile, "named_body<S>(b.body, MustBe::dynamic)", "NamedBodies<S>{{}, 0}");
  edit(kFile, "  static RecordKey key(const Balloon<S>& b) { return {b.body.slot}; }\n", "");
  EXPECT_THAT(errors_of_store(),
              AllOf(HasSubstr("balloon: bodies() of its rules has to name each BodyId in it"),
                    HasSubstr("balloon: joints() of its rules has to name each JointId in it"),
                    HasSubstr("balloon: it names something else than bodies and joints, and would outlive it"),
                    HasSubstr("balloon: its rules have only_one() or key() alone")));
}

TEST_F(RecordList, without_bodies_in_its_rules_it_does_not_compile) {
  add_to_list();
  add_file();
  edit(kFile, "NamedBodies<S> bodies(const Balloon<S>& b)", "NamedBodies<S> forgotten(const Balloon<S>& b)");
  const std::string errors = errors_of_store();
  EXPECT_THAT(errors, HasSubstr("balloon: bodies() of its rules has to name each BodyId in it"));
  EXPECT_THAT(errors, Not(HasSubstr("JointId in it"))) << "and nothing else is refused";
  EXPECT_THAT(errors, Not(HasSubstr("key() alone")));
}

TEST_F(RecordList, with_its_file_it_works_everywhere) {
  copy_folder("src/c");
  add_to_list();
  add_file();
  EXPECT_EQ(
      output_of(kProgram),
      "add_balloon.volume add_balloon.body set_balloon.body volume 3 hashed 1 played 1 portable 1 gone 1 rises 1 "
      "falls 1 scene {\"type\": \"balloon\", \"body\": 0, \"volume\": 3} C balloon\n");
}

}  // namespace records_test
}  // namespace isostep
