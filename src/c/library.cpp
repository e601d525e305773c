// Versions, names, texts and the self-check.
// SPDX-License-Identifier: MIT
#include "convert.hpp"
#include "isostep/core/scalars.hpp"
#include "isostep/core/version.hpp"
#include "isostep/replay/selfcheck.hpp"
#include "layout/abi.hpp"

using namespace isostep;
using namespace isostep::c;

uint32_t iso_abi_version(void) { return kAbiVersion; }
const char* iso_version(void) { return kVersionText; }
uint64_t iso_behaviour_version(void) { return behaviour_version(); }

const char* iso_status_text(iso_status status) {
  if (status > 0) {
    const auto fault = static_cast<std::uint32_t>(status);
    return fault < kFaults ? fault_text(static_cast<Fault>(fault)) : "unknown status";
  }
  switch (status) {
    case ISO_OK: return "success";
    case ISO_NULL: return "a pointer is null";
    case ISO_WRONG_SCALAR: return "the object is of another scalar";
    case ISO_NO_SCALAR: return "this library was built without the scalar";
    case ISO_SMALL_BUFFER: return "there is too little room";
    case ISO_WRONG_SIZE: return "a struct's size is none that this library knows";
    case ISO_CORRUPT: return "the data are not what they should be";
    case ISO_NO_MEMORY: return "there is no memory left";
    case ISO_BAD_ENUM: return "a number is no enumerator, or a truth value neither 0 nor 1";
    case ISO_NOT_ALIVE: return "the handle was destroyed, or is none of this kind";
    case ISO_CALLED_BACK: return "called from within a callback";
    case ISO_REFUSED: return "not done, for it is not sound, or not now";
    case ISO_UNFINISHED: return "not within a turn: iso_session_next has more";
    default: return "unknown status";
  }
}

const char* iso_last_error(void) { return last_error(); }

uint8_t iso_has_scalar(iso_scalar scalar) {
  bool has = false;
#define ISO_HAS(P, S) has = has || (scalar == static_cast<iso_scalar>(kScalarName<S>) && kIsBuilt<S>);
  ISO_C_FAMILIES(ISO_HAS)
#undef ISO_HAS
  return has ? 1 : 0;
}
const char* iso_scalar_name(iso_scalar scalar) {
#define ISO_NAME(P, S) \
  if (scalar == static_cast<iso_scalar>(kScalarName<S>)) return ScalarTraits<S>::kName;
  ISO_C_FAMILIES(ISO_NAME)
#undef ISO_NAME
  return nullptr;
}

iso_status iso_selfcheck(iso_selfcheck_result* out) {
  constexpr const char* kCall = "selfcheck";
  return guarded(kCall, [&] {
    ISO_C_REQUIRE(kCall, out);
    const SelfcheckResult result = isostep::detail::selfcheck(isostep::detail::selfcheck_recordings(), 0);
    CSelfcheckResult told;
    told.sound = result.sound();
    told.engine = result.engine;
    told.frames = result.frames();
    for (const SelfcheckPart& part : result.parts) {
      told.recordings += part.recordings;
      told.failed += part.failed;
    }
    const std::string text = describe(result);
    copy_member(told.text, sizeof told.text, text.data(), text.size());
    return put_sized(kCall, out, told);
  });
}
