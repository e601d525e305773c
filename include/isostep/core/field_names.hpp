// ISO_FIELDS: the one line by which a struct is saved, hashed, compared, described and sent.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/platform.hpp"

/// Names the members of a struct, all of them and in the order of their declaration. Defines
/// fields(visitor, self), which calls visitor("name", self.name) for each. At most 32.
#define ISO_FIELDS(...)                                                                                     \
  template <class Visitor, class Self>                                                                      \
  static ISO_INLINE constexpr void fields([[maybe_unused]] Visitor&& visit, [[maybe_unused]] Self&& self) { \
    __VA_OPT__(ISO_DETAIL_FIELDS_1(__VA_ARGS__))                                                            \
  }
#define ISO_DETAIL_FIELD(name) visit(#name, self.name);
#define ISO_DETAIL_FIELDS_1(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_2(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_2(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_3(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_3(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_4(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_4(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_5(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_5(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_6(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_6(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_7(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_7(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_8(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_8(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_9(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_9(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_10(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_10(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_11(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_11(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_12(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_12(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_13(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_13(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_14(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_14(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_15(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_15(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_16(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_16(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_17(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_17(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_18(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_18(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_19(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_19(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_20(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_20(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_21(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_21(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_22(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_22(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_23(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_23(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_24(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_24(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_25(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_25(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_26(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_26(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_27(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_27(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_28(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_28(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_29(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_29(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_30(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_30(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_31(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_31(name, ...) ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_DETAIL_FIELDS_32(__VA_ARGS__))
#define ISO_DETAIL_FIELDS_32(name, ...) \
  ISO_DETAIL_FIELD(name) __VA_OPT__(ISO_FIELDS_takes_at_most_32_names(__VA_ARGS__))
