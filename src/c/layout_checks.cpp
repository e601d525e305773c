// The structs of isostep.h lie as convert.hpp writes them. A field that C++ has and the header has not, or that lies
// elsewhere, does not compile: bring the header up to date with the target isostep_interface_write.
// SPDX-License-Identifier: MIT
#include "layout/layout_checks.hpp"

#include <cstddef>

#include "include/isostep.h"
#include "layout/structs.hpp"

namespace isostep::c {

template <std::size_t N, class... Offsets>
constexpr bool same_offsets(const std::array<std::size_t, N>& here, Offsets... in_c) {
  if (sizeof...(in_c) != N) return false;
  const std::size_t all[] = {static_cast<std::size_t>(in_c)...};
  for (std::size_t i = 0; i < N; ++i) {
    if (all[i] != here[i]) return false;
  }
  return true;
}
template <class T, bool kSized> constexpr std::size_t size_here() {
  if constexpr (kSized) return sized_size<T>();
  else return extent_of<T>().size;
}

#define O(member) offsetof(InC, member)
#define ISO_CHECK(InCType, Type, kSized, ...)                                                                     \
  static_assert(                                                                                                  \
      [] {                                                                                                        \
        using InC = InCType;                                                                                      \
        return sizeof(InC) == size_here<Type, kSized>() && same_offsets(offsets_of<Type, kSized>(), __VA_ARGS__); \
      }(),                                                                                                        \
      #InCType " is not what the library takes it for: build isostep_interface_write");

#define ISO_COMMON(name, Type, kSized, ...) ISO_CHECK(iso_##name, Type, kSized, __VA_ARGS__)
ISO_C_COMMON_CHECKS(ISO_COMMON)
#define ISO_F32(name, kSized, ...) ISO_CHECK(iso_f32_##name, twin::name<float>, kSized, __VA_ARGS__)
#define ISO_F64(name, kSized, ...) ISO_CHECK(iso_f64_##name, twin::name<double>, kSized, __VA_ARGS__)
#define ISO_Q16(name, kSized, ...) ISO_CHECK(iso_q16_##name, twin::name<Q16_16>, kSized, __VA_ARGS__)
#define ISO_Q32(name, kSized, ...) ISO_CHECK(iso_q32_##name, twin::name<Q32_32>, kSized, __VA_ARGS__)
ISO_C_CHECKS(ISO_F32)
ISO_C_CHECKS(ISO_F64)
ISO_C_CHECKS(ISO_Q16)
ISO_C_CHECKS(ISO_Q32)

// Handles, ids and enumerators as the engine has them.
static_assert(sizeof(iso_body) == sizeof(BodyId) && sizeof(iso_status) == 4 && sizeof(iso_body_type) == 4);
static_assert(ISO_FAULT_CALLED_IN_STEP == static_cast<int>(Fault::called_in_step));
static_assert(ISO_JOINT_TYPE_SIX_AXIS == static_cast<int>(JointType::six_axis));
static_assert(ISO_SHAPE_TYPE_CONE == static_cast<int>(ShapeType::cone));

}  // namespace isostep::c
#undef ISO_F32
#undef ISO_F64
#undef ISO_Q16
#undef ISO_Q32
