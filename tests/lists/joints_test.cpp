// A joint that is added to the list alone does not compile, and the errors name what is missing; with its own file it
// compiles and works. Follows "To add a joint" in include/isostep/dynamics/joints/README.md, on copies of the headers
// and with the compiler of this build.
// SPDX-License-Identifier: MIT
#include "lists/probe.hpp"

namespace isostep {
namespace joints_test {

class JointList : public ListProbe {
 protected:
  void add_to_list() {
    edit("include/isostep/dynamics/joints/joint_type.hpp", "X(six_axis, SixAxisJoint)",
         "X(six_axis, SixAxisJoint) X(probe, ProbeJoint)");
  }
  void add_file() {
    copy("tests/lists/probe_joint.hpp", "include/isostep/dynamics/joints/probe.hpp");
    edit("include/isostep/dynamics/joints/joint_kinds.hpp", "#include \"isostep/dynamics/joints/hinge.hpp\"",
         "#include \"isostep/dynamics/joints/hinge.hpp\"\n#include \"isostep/dynamics/joints/probe.hpp\"");
  }
};

TEST_F(JointList, without_its_file_it_does_not_compile) {
  add_to_list();
  EXPECT_THAT(errors_of("isostep/dynamics/joints/joint_kinds.hpp"), HasSubstr("ProbeJoint"));
}

TEST_F(JointList, a_member_that_its_file_lacks_is_named) {
  add_to_list();
  add_file();
  edit("include/isostep/dynamics/joints/probe.hpp", "> pull(const", "> strain(const");
  EXPECT_THAT(errors_of("isostep/dynamics/joints/joint_kinds.hpp"),
              AllOf(HasSubstr("a joint's file lacks a member"), HasSubstr("pull")));
}

TEST_F(JointList, with_its_file_solvers_checks_and_scene_files_take_it) {
  add_to_list();
  add_file();
  EXPECT_EQ(errors_of("isostep/dynamics/joints/joint_tree.inl"), "");
  EXPECT_EQ(errors_of("scenes/scene_writer.cpp"), "");
}

TEST_F(JointList, with_its_file_it_works) {
  add_to_list();
  add_file();
  // 10 m/s^2 sin 60 along the way; what is left of gravity is held.
  EXPECT_EQ(output_of("tests/lists/joint_probe.cpp"),
            "probe speed 0.00 -7.50 4.33 pull 0.018 off 0.000 taken 1 motor: of a probe kCollideConnected\n");
}

}  // namespace joints_test
}  // namespace isostep
