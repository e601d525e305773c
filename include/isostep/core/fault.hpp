// Fault: why a world refused something; one list for all kinds of worlds.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// Identical on every peer.
enum class Fault : std::uint32_t {
  none,
  stale_id,       // the id names nothing any more
  not_finite,     // NaN or infinity where a number is expected
  out_of_range,   // beyond the scalar's limits
  bad_shape,      // sizes, normals or parts that make no shape
  bad_mass,       // a mass or inertia that is not valid: below 0, or beyond the scalar
  bad_argument,   // a flag, count, ratio or enumerator that is not valid
  shape_in_use,   // bodies still name the shape, or particles the material
  not_dynamic,    // forces on what no force moves
  null_id,        // the id was never given: what should have given it was refused, as a rule
  foreign_id,     // the id was given by a world with another Settings::id_space
  bad_snapshot,   // nothing was saved there, or by a world with other settings
  called_in_step  // an observer of stages called, while the world steps
};
inline constexpr std::uint32_t kFaults = 13;
const char* fault_text(Fault fault);

/// One refused call. Its texts are literals.
struct FaultReport {
  Fault fault = Fault::none;
  const char* command = "";   // apply_force
  const char* field = "";     // material.friction; empty: no field alone
  const char* expected = "";  // 0 to 16
  static constexpr std::uint32_t kNoChild = 0xffffffffu;
  std::uint32_t child = kNoChild;  // the part that the field is of, in a shape that is refused

  friend ISO_INLINE constexpr bool operator==(const FaultReport& report, Fault name) { return report.fault == name; }
  friend ISO_INLINE constexpr bool operator!=(const FaultReport& report, Fault name) { return report.fault != name; }
  friend ISO_INLINE constexpr bool operator==(const FaultReport& a, const FaultReport& b) {
    return a.fault == b.fault && std::string_view(a.command) == b.command && std::string_view(a.field) == b.field &&
           std::string_view(a.expected) == b.expected && a.child == b.child;
  }
};

/// A callback for every refused call, on the calling thread: a game writes its log there or stops its debugger. It
/// must not change the world; what it is refused itself calls no handler.
struct FaultHandler {
  void (*refused)(void* user, const FaultReport& report) = nullptr;
  void* user = nullptr;
};

/// "create_body: material.friction: a number is beyond the scalar's limits; expected 0 to 16", or
/// "add_shape: child 3: primitive.radius: the sizes, normals or parts make no shape; expected above 0"
std::string describe(const FaultReport& report);

}  // namespace isostep
