// The walk over a table of fields.
// SPDX-License-Identifier: MIT
#include "isostep/state/field_table.hpp"

namespace isostep {
namespace {

void walk(const PathPart& path, const FieldType& type, std::uint32_t offset, const NumberSink& sink) {
  if (type.format.size != 0) {
    sink.number(sink.user, path, type.format, offset);
  } else if (type.element == nullptr) {
    for (std::uint32_t i = 0; i < type.count; ++i) {
      const FieldRow& row = type.rows[i];
      walk(PathPart{&path, row.name, 0}, *row.type, offset + row.offset, sink);
    }
  } else if (type.count == 1) {
    walk(path, *type.element, offset, sink);
  } else {
    for (std::uint32_t i = 0; i < type.count; ++i)
      walk(PathPart{&path, nullptr, i}, *type.element, offset + i * type.element->size, sink);
  }
}

}  // namespace

void each_number(const PathPart& path, const FieldType& type, const NumberSink& sink) { walk(path, type, 0, sink); }

std::uint64_t load_number(const std::uint8_t* at, std::uint32_t size) {
  std::uint64_t bits = 0;
  for (std::uint32_t i = 0; i < size; ++i) bits |= static_cast<std::uint64_t>(at[i]) << 8 * i;
  return bits;
}

}  // namespace isostep
