// The _init of every struct; the shapes of the numbers between C and C++.
// SPDX-License-Identifier: MIT
#include "convert.hpp"
#include "isostep/scalar/environment.hpp"

using namespace isostep;
using namespace isostep::c;

#define ISO_COMMON_INIT(name, Type)                                  \
  iso_status iso_##name##_init_sized(iso_##name* out, size_t size) { \
    return init_sized<Type>(#name "_init", out, size);               \
  }
ISO_C_COMMON_SIZED(ISO_COMMON_INIT)

namespace {
template <class T> iso_status init_plain(const char* call, void* out) {
  ISO_C_REQUIRE(call, out);
  put_plain(out, T{});
  return kOk;
}
}  // namespace

iso_status iso_filter_init(iso_filter* out) { return init_plain<Filter>("filter_init", out); }
iso_status iso_query_filter_init(iso_query_filter* out) { return init_plain<CQueryFilter>("query_filter_init", out); }

#define ISO_INIT(P, name, T)                                                     \
  iso_status iso_##P##_##name##_init_sized(iso_##P##_##name* out, size_t size) { \
    return init_sized<T>(#name "_init", out, size);                              \
  }
#define ISO_PLAIN_INIT(P, name, T) \
  iso_status iso_##P##_##name##_init(iso_##P##_##name* out) { return init_plain<T>(#name "_init", out); }

#define ISO_F32(name, Type, S) ISO_INIT(f32, name, Type)
#define ISO_F64(name, Type, S) ISO_INIT(f64, name, Type)
#define ISO_Q16(name, Type, S) ISO_INIT(q16, name, Type)
#define ISO_Q32(name, Type, S) ISO_INIT(q32, name, Type)
ISO_C_SIZED(ISO_F32, float)
ISO_C_SIZED(ISO_F64, double)
ISO_C_SIZED(ISO_Q16, Q16_16)
ISO_C_SIZED(ISO_Q32, Q32_32)
#define ISO_RECORD_INITS(P, S)                    \
  ISO_FOR_EACH_RECORD_WITH(ISO_RECORD_INIT, P, S) \
  ISO_FOR_EACH_INPUT_WITH(ISO_INPUT_INIT, P, S)   \
  ISO_FOR_EACH_RECORD_STATE_WITH(ISO_STATE_INIT, P, S)
#define ISO_RECORD_INIT(P, name, Type, Id, S) ISO_INIT(P, name, Type)
#define ISO_INPUT_INIT(P, name, Type, Id, S) ISO_INIT(P, name##_input, Type)
#define ISO_STATE_INIT(P, name, Type, Id, S) ISO_INIT(P, name##_state, Type)
ISO_C_FAMILIES(ISO_RECORD_INITS)

#define ISO_FAMILY(P, S)                   \
  ISO_PLAIN_INIT(P, material, Material<S>) \
  ISO_PLAIN_INIT(P, ragdoll_bone, RagdollBone<S>)
ISO_C_FAMILIES(ISO_FAMILY)

namespace {
/// Rounds to the nearest number, whatever the caller's float environment: languages without such numbers come through
/// here.
template <class S> S number_of(double value) {
  return isostep::pin_floats([&] { return from_double<S>(value); });
}
template <class S> double double_of(S value) {
  return isostep::pin_floats([&] { return to_double(value); });
}
}  // namespace
#define ISO_NUMBERS(P, S, N)                                                                     \
  N iso_##P##_from_double(double value) { return same_bits<N>(number_of<S>(value)); }            \
  double iso_##P##_to_double(N value) { return double_of(same_bits<S>(value)); }                 \
  N iso_##P##_unit_from_double(double value) { return same_bits<N>(number_of<Unit<S>>(value)); } \
  double iso_##P##_unit_to_double(N value) { return double_of(same_bits<Unit<S>>(value)); }
ISO_NUMBERS(f32, float, float)
ISO_NUMBERS(f64, double, double)
ISO_NUMBERS(q16, Q16_16, std::int32_t)
ISO_NUMBERS(q32, Q32_32, std::int64_t)
#undef ISO_FAMILY
#undef ISO_F32
#undef ISO_F64
#undef ISO_Q16
#undef ISO_Q32
