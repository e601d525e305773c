// A solver that is added to the list alone does not compile; with its member in Solvers it does. Tried on copies of the
// headers, with the compiler of this build.
// SPDX-License-Identifier: MIT
#include "lists/probe.hpp"

namespace isostep {
namespace solvers_test {

class SolverList : public ListProbe {
 protected:
  void add_to_list() { edit("include/isostep/dynamics/solver_name.hpp", "X(admm)", "X(admm) X(probe)"); }
  void add_member() {
    edit("include/isostep/world/solvers.hpp", "IslandSolver<S> admm =",
         "IslandSolver<S> probe = IslandSolver<S>(IslandMethod::splitting);\n  IslandSolver<S> admm =");
  }
};

TEST_F(SolverList, without_its_member_it_does_not_compile) {
  add_to_list();
  EXPECT_THAT(errors_of("isostep/world/solvers.hpp"),
              AllOf(HasSubstr("a solver has no member in Solvers"), HasSubstr("probe")));
}

TEST_F(SolverList, with_its_member_the_world_and_scene_files_take_it) {
  add_to_list();
  add_member();
  EXPECT_EQ(errors_of("isostep/world/engine.hpp"), "");
  EXPECT_EQ(errors_of("scenes/scene_file.cpp"), "");
}

}  // namespace solvers_test
}  // namespace isostep
