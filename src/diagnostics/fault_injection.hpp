// A fault made on purpose: one bit of one field is turned after one stage.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "diagnostics/field_editor.hpp"

namespace isostep {

/// It tests what finds faults: an index or a count that is turned may lead the engine beyond its arrays.
class FaultInjection {
 public:
  FaultInjection(std::string_view path, std::uint32_t bit);
  /// Injects the fault. Returns false when no field has that path and bit, or none that may be written: what lies in an
  /// island asleep is not. `edit`: of the engine that the view is of.
  bool inject(const StageView& view, EditFields edit) const;

 private:
  std::string path_;
  std::uint32_t bit_;
};

}  // namespace isostep
