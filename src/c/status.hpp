// The end of calls of the C interface: a status, and for the thread that called a sentence.
// SPDX-License-Identifier: MIT
#pragma once

#include <new>

#include "include/isostep.h"
#include "isostep/core/fault.hpp"
#include "isostep/core/result.hpp"

namespace isostep::c {

inline constexpr iso_status kOk = ISO_OK;

/// Notes "call: what: the status in words; expected ..." for iso_last_error and returns the status. Texts may be empty.
iso_status refuse(iso_status status, const char* call, const char* what = "", const char* expected = "");
/// Tells why a world refused a call.
iso_status refuse(const FaultReport& report);
/// Tells why bytes or geometry were refused.
iso_status refuse(iso_status status, const char* call, const Error& error);
const char* last_error();

/// The first refusal of a world on this thread since `happened` was set to false. Worlds tell it by their fault
/// handler: queries that are accepted leave World::fault as it was.
struct Refusal {
  bool happened = false;
  FaultReport report;
};
Refusal& refusal_here();
FaultHandler refusal_handler();

/// Calls `work`, which returns a status; nothing is thrown across the interface.
template <class Work> iso_status guarded(const char* call, const Work& work) {
#if defined(__cpp_exceptions)
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return refuse(ISO_NO_MEMORY, call);
  }
#else
  (void)call;
  return work();
#endif
}

/// Refuses null, in a function that returns a status.
#define ISO_C_REQUIRE(call, pointer) \
  if ((pointer) == nullptr) return ::isostep::c::refuse(ISO_NULL, call, #pointer)

/// Copies bytes out. `size`: room in, need out. Nothing is copied into too little room.
iso_status copy_out(const char* call, const void* from, std::size_t need, void* to, std::size_t* size);
/// Copies a sentence out with the 0 that ends it.
iso_status copy_text(const char* call, const char* text, char* to, std::size_t* size);
/// Copies as much as a member has room for, with a 0 behind it.
void copy_member(char* to, std::size_t room, const char* from, std::size_t length);

}  // namespace isostep::c
