// What the messages of the reliable channel have in common: the kind in front, and nothing behind the end.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/protocol/message.hpp"
#include "isostep/state/archive.hpp"

namespace isostep {

ISO_INLINE Writer begin_message(MessageKind kind, std::vector<std::uint8_t>& out) {
  out.clear();
  Writer writer(out);
  writer.write(static_cast<std::uint8_t>(kind));
  return writer;
}
ISO_INLINE Reader after_kind(Bytes message) { return Reader(message.subspan(message.empty() ? 0 : 1)); }

/// `value` when all was read, and nothing is left; else an error whose place is `what`.
template <class T> ISO_INLINE Result<T> finish_message(Reader& reader, const char* what, const T& value) {
  reader.expect_end();
  const Result<void> result = reader.result(what);
  if (!result) return result.error();
  return value;
}

ISO_INLINE Frame read_frame(Reader& reader) {
  const Frame frame = reader.read<Frame>();
  if (frame < 0 || frame > kLastFrame) reader.fail(ErrorCode::invalid, "a frame out of range");
  return frame;
}

}  // namespace isostep
