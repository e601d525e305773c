// isostep_prover about: what was built, how, and where it runs; a name and a value a line.
// SPDX-License-Identifier: MIT
#include <bit>
#include <cfloat>

#include "commands.hpp"
#include "isostep/core/scalar_names.hpp"
#include "isostep/core/short_text.hpp"
#include "isostep/core/simd_choice.hpp"
#include "isostep/core/version.hpp"
#include "isostep/replay/selfcheck.hpp"
#include "isostep/replay/world_kinds.hpp"
#include "isostep/scalar/environment.hpp"
#include "streams.hpp"

namespace isostep::prover {
namespace {

void say(std::string_view name, std::string_view value) {
  print(std::string(name).append("\t").append(value.empty() ? "-" : value).append("\n"));
}

class List {
 public:
  void add(std::string_view word) { text_.append(text_.empty() ? "" : " ").append(word); }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

struct Macro {
  std::string_view name, expanded;  // to its own name where it is not defined
};
#define ISO_EXPANDED(macro) #macro
#define ISO_ROW(macro) \
  Macro { #macro, ISO_EXPANDED(macro) }
constexpr Macro kMacros[] = {
    ISO_ROW(__OPTIMIZE__),      ISO_ROW(__OPTIMIZE_SIZE__), ISO_ROW(NDEBUG),
    ISO_ROW(__SSE2_MATH__),     ISO_ROW(__AVX2__),          ISO_ROW(__AVX512F__),
    ISO_ROW(__FMA__),           ISO_ROW(__FP_FAST_FMA),     ISO_ROW(__ARM_NEON),
    ISO_ROW(__wasm_simd128__),  ISO_ROW(__CHAR_UNSIGNED__), ISO_ROW(__SIZEOF_INT128__),
    ISO_ROW(ISOSTEP_NO_INT128),
};
#undef ISO_ROW
#undef ISO_EXPANDED

/// The flags by the macros of this program: the library's are the same where one configuration builds both.
std::string flags() {
  List list;
  for (const Macro& macro : kMacros) {
    if (macro.expanded != macro.name) list.add(macro.name);
  }
  return list.text();
}

std::string deviations() {
  const std::uint32_t found = probe_environment() | probe_environment_here();
  return found == 0 ? "as IEEE 754 has it" : "NOT as IEEE 754 has it: " + deviation_names(found);
}

/// That some world of this build steps with.
std::string lanes() {
  List list;
  for (std::uint32_t i = 1; i < kSimds; ++i) {
    const bool here =
        any_world([&](auto tag) { return typename decltype(tag)::Type().use_simd(static_cast<Simd>(i)); });
    if (here) list.add(kSimdNames[i]);
  }
  return list.text();
}

}  // namespace

int command_about(const Request&) {
  say("version", kVersionText);
  say("behaviour", ShortText<16>().append_hex(behaviour_version()).view());
  say("compiler", compiler_name());
  say("architecture", architecture_name());
  say("endianness", std::endian::native == std::endian::little ? "little" : "big");
  say("pointer_bits", std::to_string(8 * sizeof(void*)));
  say("flt_eval_method", std::to_string(FLT_EVAL_METHOD));
  say("flags", flags());
  say("arithmetic", deviations());
  say("lanes", lanes());
  say("scalars", joined_scalar_names(" "));
  return exit_status::kOk;
}

}  // namespace isostep::prover
