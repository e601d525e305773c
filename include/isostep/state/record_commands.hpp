// The commands of records: every kind of them is added, set and removed in one way, and told its input.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/scalar/platform.hpp"

namespace isostep {

template <class Record> struct AddRecord {
  Record record;
  ISO_FIELDS(record)
};
template <class Record, class IdType> struct SetRecord {
  IdType id;
  Record record;
  ISO_FIELDS(id, record)
};
template <class Input, class IdType> struct SetInput {
  IdType id;
  Input input;
  ISO_FIELDS(id, input)
};
template <class IdType> struct RemoveRecord {
  IdType id;
  ISO_FIELDS(id)
};

}  // namespace isostep
