// The commands of records: every kind of them is added, set and removed in one way, and told its input.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/platform.hpp"

namespace isostep {

template <class Record> struct AddRecord {
  Record record;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("record", self.record);
  }
};
template <class Record, class IdType> struct SetRecord {
  IdType id;
  Record record;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("id", self.id);
    visit("record", self.record);
  }
};
template <class Input, class IdType> struct SetInput {
  IdType id;
  Input input;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("id", self.id);
    visit("input", self.input);
  }
};
template <class IdType> struct RemoveRecord {
  IdType id;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("id", self.id);
  }
};

}  // namespace isostep
