// The texts of faults.
// SPDX-License-Identifier: MIT
#include "isostep/core/fault.hpp"

namespace isostep {

const char* fault_text(Fault fault) {
  switch (fault) {
    case Fault::none: return "no fault";
    case Fault::stale_id: return "the id names nothing any more";
    case Fault::not_finite: return "a number is not finite";
    case Fault::out_of_range: return "a number is beyond the scalar's limits";
    case Fault::bad_shape: return "the sizes, normals or parts make no shape";
    case Fault::bad_mass: return "not a valid mass or inertia";
    case Fault::bad_argument: return "not a valid value";
    case Fault::shape_in_use: return "something still names it";
    case Fault::not_dynamic: return "no force moves it";
    case Fault::null_id: return "the id is null: what should have given it was refused";
    case Fault::foreign_id: return "the id is another world's";
    case Fault::bad_snapshot: return "the snapshot is not of this world";
    case Fault::called_in_step: return "called while the world steps";
  }
  return "unknown fault";
}

std::string describe(const FaultReport& report) {
  std::string text;
  if (report.command[0] != '\0') text.append(report.command).append(": ");
  if (report.child != FaultReport::kNoChild) text.append("child ").append(std::to_string(report.child)).append(": ");
  if (report.field[0] != '\0') text.append(report.field).append(": ");
  text += fault_text(report.fault);
  if (report.expected[0] != '\0') text.append("; expected ").append(report.expected);
  return text;
}

}  // namespace isostep
