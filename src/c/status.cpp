// The last refusal of each thread, in words.
// SPDX-License-Identifier: MIT
#include "status.hpp"

#include <cstring>
#include <string>

namespace isostep::c {
namespace {

/// A sentence of fixed size: text beyond it is cut.
struct Sentence {
  char text[512] = {};
  std::size_t length = 0;

  void clear() { text[length = 0] = '\0'; }
  void add(const char* part, std::size_t size) {
    const std::size_t room = sizeof text - 1 - length;
    if (size > room) size = room;
    if (size != 0) std::memcpy(text + length, part, size);
    text[length += size] = '\0';
  }
  void add(const char* part) { add(part, std::strlen(part)); }
};
thread_local Sentence last;
thread_local Refusal refusal;

void begin_sentence(const char* call, const char* what) {
  last.clear();
  if (call[0] != '\0') {
    last.add(call);
    last.add(": ");
  }
  if (what[0] == '\0') return;
  last.add(what);
  last.add(": ");
}

void note_refusal(void*, const FaultReport& report) {
  if (!refusal.happened) refusal = {true, report};
}

}  // namespace

iso_status refuse(iso_status status, const char* call, const char* what, const char* expected) {
  begin_sentence(call, what);
  last.add(iso_status_text(status));
  if (expected[0] == '\0') return status;
  last.add("; expected ");
  last.add(expected);
  return status;
}

iso_status refuse(const FaultReport& report) {
  return refuse(static_cast<iso_status>(report.fault), report.command, report.field, report.expected);
}

iso_status refuse(iso_status status, const char* call, const Error& error) {
  const auto place = error.place.view(), message = error.message.view();
  begin_sentence(call, "");
  if (!place.empty()) {
    last.add(place.data(), place.size());
    last.add(": ");
  }
  last.add(message.data(), message.size());
  return status;
}

const char* last_error() { return last.text; }

Refusal& refusal_here() { return refusal; }
FaultHandler refusal_handler() { return {note_refusal, nullptr}; }

iso_status copy_out(const char* call, const void* from, std::size_t need, void* to, std::size_t* size) {
  ISO_C_REQUIRE(call, size);
  const std::size_t room = *size;
  *size = need;
  if (room < need) return refuse(ISO_SMALL_BUFFER, call, "size");
  if (need == 0) return kOk;
  ISO_C_REQUIRE(call, to);
  std::memcpy(to, from, need);
  return kOk;
}
iso_status copy_text(const char* call, const char* text, char* to, std::size_t* size) {
  return copy_out(call, text, std::strlen(text) + 1, to, size);
}
void copy_member(char* to, std::size_t room, const char* from, std::size_t length) {
  if (length > room - 1) length = room - 1;
  if (length != 0) std::memcpy(to, from, length);
  std::memset(to + length, 0, room - length);
}

}  // namespace isostep::c
