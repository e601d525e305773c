// MethodSystem<N>: the system of one island, by one of the methods that solve islands.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>

#include "isostep/dynamics/solvers/admm.hpp"
#include "isostep/dynamics/solvers/avbd.hpp"
#include "isostep/dynamics/solvers/pivoting.hpp"

namespace isostep {

/// The method that solves an island.
enum class IslandMethod : std::uint32_t {
  pivoting,  // pivoting.hpp
  descent,   // avbd.hpp
  splitting  // admm.hpp
};

/// The rows of an island, by `->`, and the calls in which methods differ: island_system.hpp says what each does.
template <class N> class MethodSystem {
 public:
  /// Chooses the method. The system of another one is lost.
  void choose(IslandMethod method) {
    if (system_.index() == static_cast<std::size_t>(method)) return;
    if (method == IslandMethod::pivoting) system_.template emplace<0>();
    if (method == IslandMethod::descent) system_.template emplace<1>();
    if (method == IslandMethod::splitting) system_.template emplace<2>();
  }
  ISO_INLINE IslandSystem<N>& operator*() {
    return with(system_, [](auto& system) -> IslandSystem<N>& { return system; });
  }
  ISO_INLINE const IslandSystem<N>& operator*() const {
    return with(system_, [](const auto& system) -> const IslandSystem<N>& { return system; });
  }
  ISO_INLINE IslandSystem<N>* operator->() { return &**this; }
  ISO_INLINE const IslandSystem<N>* operator->() const { return &**this; }

  void tie(std::uint32_t body_count, std::uint64_t most_work) {
    with(system_, [&](auto& system) { system.tie(body_count, most_work); });
  }
  void assemble() {
    with(system_, [](auto& system) { system.assemble(); });
  }
  bool solve(bool firm, std::uint64_t most_work) {
    return with(system_, [&](auto& system) { return system.solve(firm, most_work); });
  }
  std::uint64_t least_work() const {
    return with(system_, [](const auto& system) { return system.least_work(); });
  }
  /// Returns true if u is W^T x, and not only near it.
  bool moves_by_answers() const { return system_.index() != static_cast<std::size_t>(IslandMethod::descent); }

 private:
  template <class Systems, class Act> static ISO_INLINE decltype(auto) with(Systems& systems, const Act& act) {
    if (auto* descent = std::get_if<1>(&systems)) return act(*descent);
    if (auto* splitting = std::get_if<2>(&systems)) return act(*splitting);
    return act(*std::get_if<0>(&systems));
  }

  std::variant<PivotingSystem<N>, AvbdSystem<N>, AdmmSystem<N>> system_;
};

}  // namespace isostep
