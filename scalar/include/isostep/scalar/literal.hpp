// Literal: a constant written in source before the scalar that will hold it is known.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>

#include "isostep/scalar/scalar.hpp"

namespace isostep {

/// Box{{0.5, 0.5, 0.5}} names no scalar; the world that takes it does. Only compile-time constants become Literals, so
/// no computed double slips into a fixed-point world this way.
struct Literal {
  double value;
  consteval Literal(double v) : value(v) {}
  template <std::integral I> consteval Literal(I v) : value(static_cast<double>(v)) {}
};

/// Shapes name the types of their numbers by their scalar; with literals all of them are Literal.
template <> struct ScalarTraits<Literal> { using Unit = Literal; };

template <class S> ISO_INLINE constexpr S from_literal(Literal literal) { return from_double<S>(literal.value); }

}  // namespace isostep
