// A command that is added to the list alone does not compile, and the error names what is missing; with its record and
// its `execute` it can be called, is refused, recorded and played. Tried on copies of the headers, with the compiler of
// this build.
// SPDX-License-Identifier: MIT
#include "lists/probe.hpp"

namespace isostep {
namespace commands_test {

constexpr char kProgram[] = "tests/lists/command_probe.cpp";

class CommandList : public ListProbe {
 protected:
  void add_to_list() {
    edit("include/isostep/commands/command.hpp", "  X(remove_shape, RemoveShape, bool, S)",
         "  X(remove_shape, RemoveShape, bool, S) X(probe, Probe, bool, S)");
  }
  void add_record() {
    copy("tests/lists/probe_command.hpp", "include/isostep/world/probe_command.hpp");
    edit("include/isostep/commands/command.hpp", "#include \"isostep/store/definitions.hpp\"",
         "#include \"isostep/store/definitions.hpp\"\n#include \"isostep/world/probe_command.hpp\"");
  }
  void add_body() {
    edit("include/isostep/commands/execute_bodies.inl",
         "template <class S> bool CommandExecutor<S>::execute(const SetGravity<S>&",
         "template <class S> bool CommandExecutor<S>::execute(const Probe& command) {\n"
         "  if (command.tick < state_.tick) return faults_.refuse({Fault::bad_argument, \"\", \"tick\", \"no past "
         "one\"});\n"
         "  state_.tick = command.tick;\n  return true;\n}\n"
         "template <class S> bool CommandExecutor<S>::execute(const SetGravity<S>&");
  }
};

TEST_F(CommandList, without_its_record_it_does_not_compile) {
  add_to_list();
  EXPECT_THAT(errors_of("isostep/commands/command.hpp"), HasSubstr("Probe"));
}

TEST_F(CommandList, a_record_that_cannot_be_written_does_not_compile) {
  add_to_list();
  add_record();
  edit("include/isostep/world/probe_command.hpp", "  ISO_FIELDS(tick)\n", "");
  EXPECT_THAT(output_of(kProgram), HasSubstr("a command lacks `fields`, or `write` and `read`"));
}

TEST_F(CommandList, without_its_body_it_does_not_compile) {
  add_to_list();
  add_record();
  EXPECT_THAT(output_of(kProgram),
              AllOf(HasSubstr("explicit instantiation of"), HasSubstr("execute"), HasSubstr("Probe")));
}

TEST_F(CommandList, with_both_it_works) {
  add_to_list();
  add_record();
  add_body();
  EXPECT_EQ(output_of(kProgram), "taken 1 again 0 probe.tick bytes 2 number 2 played 1 tick 3\n");
}

}  // namespace commands_test
}  // namespace isostep
