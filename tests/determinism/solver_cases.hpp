// Every scalar with every solver, as the cases of a typed test.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <tuple>
#include <utility>

#include "built.hpp"
#include "isostep/scalar/scalar.hpp"

namespace isostep::test {

template <std::size_t I>
using SolverCase =
    std::tuple<std::tuple_element_t<I / std::size(kBuiltSolvers), std::tuple<float, double, Q16_16, Q32_32>>,
               std::integral_constant<SolverName, kBuiltSolvers[I % std::size(kBuiltSolvers)]>>;
template <class Indices> struct SolverCasesOf;
template <std::size_t... I> struct SolverCasesOf<std::index_sequence<I...>> {
  using Type = ::testing::Types<SolverCase<I>...>;
};
struct SolverCaseNames {
  template <class Case> static std::string GetName(int) {
    std::string scalar = ScalarTraits<std::tuple_element_t<0, Case>>::kName;
    std::replace(scalar.begin(), scalar.end(), '.', '_');
    return scalar + "_" + kSolverNames[static_cast<std::size_t>(std::tuple_element_t<1, Case>::value)];
  }
};
using SolverCases = SolverCasesOf<std::make_index_sequence<4 * std::size(kBuiltSolvers)>>::Type;

}  // namespace isostep::test
