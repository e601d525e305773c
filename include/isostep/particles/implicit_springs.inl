// Bodies of ImplicitSprings.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/implicit_springs.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

template <class S>
bool ImplicitSprings<S>::solve(const std::vector<Spring<S>>& springs, const Axes<S>& position,
                               Axes<Velocity<S>>& velocity, const Axes<S>& acceleration,
                               const std::vector<InverseMass<S>>& inverse_mass, std::int32_t rate) {
  ISO_ASSERT(rate > 0);
  list_unknowns(springs, inverse_mass);
  const bool solved = unknowns_.empty() || solve_system(springs, position, velocity, acceleration, inverse_mass, rate);
  const Value hz = System::value(rate);
  for (std::size_t i = 0; i < inverse_mass.size(); ++i) {
    if (inverse_mass[i] == InverseMass<S>(0) || (solved && number_of_[i] != kNoParticle)) continue;
    velocity.x[i] = System::add(velocity.x[i], step_of(acceleration.x[i], hz));
    velocity.y[i] = System::add(velocity.y[i], step_of(acceleration.y[i], hz));
    velocity.z[i] = System::add(velocity.z[i], step_of(acceleration.z[i], hz));
  }
  return solved;
}

template <class S>
bool ImplicitSprings<S>::solve_system(const std::vector<Spring<S>>& springs, const Axes<S>& position,
                                      Axes<Velocity<S>>& velocity, const Axes<S>& acceleration,
                                      const std::vector<InverseMass<S>>& inverse_mass, std::int32_t rate) {
  analyse();
  weigh(springs, position, inverse_mass, rate);
  choose_exponents();
  if (loss_ > SparseCholesky<Number>::kMostLoss) return false;
  fill_matrix();
  if (!system_.factorise()) return false;
  const int right_exponent = fill_right(velocity, acceleration, rate);
  int exponent = 0;
  if (!system_.solve(right_, right_exponent, loss_, answer_, exponent)) return false;
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    const std::uint32_t slot = unknowns_[i];
    const int own = exponent + top_exponent_ - exponent_[i];
    velocity.x[slot] = System::add(velocity.x[slot], System::value(answer_[i].x, own));
    velocity.y[slot] = System::add(velocity.y[slot], System::value(answer_[i].y, own));
    velocity.z[slot] = System::add(velocity.z[slot], System::value(answer_[i].z, own));
  }
  return true;
}

template <class S>
void ImplicitSprings<S>::list_unknowns(const std::vector<Spring<S>>& springs,
                                       const std::vector<InverseMass<S>>& inverse_mass) {
  edges_.clear();
  number_of_.assign(inverse_mass.size(), kNoParticle);
  const auto moves = [&](ParticleId id) ISO_INLINE_LAMBDA {
    return id && id.slot < inverse_mass.size() && inverse_mass[id.slot] != InverseMass<S>(0);
  };
  for (std::uint32_t i = 0; i < springs.size(); ++i) {
    const Spring<S>& spring = springs[i];
    if (!spring.a || spring.type == SpringType::stiff) continue;
    if (spring.a.slot >= inverse_mass.size() || (spring.b && spring.b.slot >= inverse_mass.size())) continue;
    if (spring.b && spring.a.slot == spring.b.slot) continue;
    const std::uint32_t a = moves(spring.a) ? spring.a.slot : kNoParticle;
    const std::uint32_t b = moves(spring.b) ? spring.b.slot : kNoParticle;
    if (a == kNoParticle && b == kNoParticle) continue;
    edges_.push_back({i, a, b});
    if (a != kNoParticle) number_of_[a] = 0;
    if (b != kNoParticle) number_of_[b] = 0;
  }
  unknowns_.clear();
  for (std::uint32_t i = 0; i < number_of_.size(); ++i) {
    if (number_of_[i] == kNoParticle) continue;
    number_of_[i] = static_cast<std::uint32_t>(unknowns_.size());
    unknowns_.push_back(i);
  }
  for (Edge& edge : edges_) {
    if (edge.a != kNoParticle) edge.a = number_of_[edge.a];
    if (edge.b != kNoParticle) edge.b = number_of_[edge.b];
  }
}

template <class S> void ImplicitSprings<S>::analyse() {
  pairs_.clear();
  pair_of_.clear();
  for (const Edge& edge : edges_) {
    const bool coupled = edge.a != kNoParticle && edge.b != kNoParticle;
    pair_of_.push_back(coupled ? static_cast<std::uint32_t>(pairs_.size()) : kNoParticle);
    if (coupled) pairs_.push_back({edge.a, edge.b});
  }
  system_.analyse(static_cast<std::uint32_t>(unknowns_.size()), pairs_);
}

template <class S>
void ImplicitSprings<S>::weigh(const std::vector<Spring<S>>& springs, const Axes<S>& position,
                               const std::vector<InverseMass<S>>& inverse_mass, std::int32_t rate) {
  mass_.clear();
  const Value one = System::value(1), hz = System::value(rate);
  for (const std::uint32_t slot : unknowns_) {
    mass_.push_back(System::quotient(one, System::value(inverse_mass[slot])));
  }
  weight_ = mass_;
  tensions_.clear();
  for (const Edge& edge : edges_) {
    tensions_.push_back(tension_of(springs[edge.spring], position, hz));
    const Value whole = tensions_.back().whole;
    if (edge.a != kNoParticle) weight_[edge.a] = System::sum(weight_[edge.a], whole);
    if (edge.b != kNoParticle) weight_[edge.b] = System::sum(weight_[edge.b], whole);
  }
}

template <class S>
typename ImplicitSprings<S>::Tension ImplicitSprings<S>::tension_of(const Spring<S>& spring, const Axes<S>& position,
                                                                    Value rate) const {
  const Vec3<S> d = position[spring.a.slot] - (spring.b ? position[spring.b.slot] : spring.anchor);
  const Direction<S> n = direction_of(d.x, d.y, d.z);
  const Number none(0);
  const Value nothing = System::value(0);
  // Ends that meet push nowhere, but about a rest length of 0 that is no exception: the force is -k d all around.
  const bool centre = n.length == S(0);
  if (centre ? spring.rest_length > S(0) : spring.type == SpringType::bungee && n.length <= spring.rest_length) {
    return {{none, none, none}, none, nothing, nothing};
  }
  const S stretch = n.length - max(spring.rest_length, S(0));
  const Value stiff = System::value(max(spring.stiffness, S(0)));
  const Value damped = System::value(centre ? S(0) : max(spring.damping, S(0)));
  Tension result;
  result.n = {System::number(System::value(n.x), 0), System::number(System::value(n.y), 0),
              System::number(System::value(n.z), 0)};
  result.across = none;
  if (centre) result.across = Number(1);
  else if (stretch > S(0))
    result.across = System::number(System::quotient(System::value(stretch), System::value(n.length)), 0);
  result.stiff = System::quotient(System::quotient(stiff, rate), rate);
  result.whole = System::sum(result.stiff, System::quotient(damped, rate));
  return result;
}

template <class S> void ImplicitSprings<S>::choose_exponents() {
  exponent_.clear();
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    const int e = (System::exponent(weight_[i]) + 1) >> 1;  // d_i < 4^e
    // An eigenvalue is at least the least m_i / 4^e_i, for springs only add to the mass.
    const int loss = 2 * e - System::exponent(mass_[i]) + 1;
    if (i == 0 || e > top_exponent_) top_exponent_ = e;
    if (i == 0 || loss > loss_) loss_ = loss;
    exponent_.push_back(e);
  }
}

template <class S> void ImplicitSprings<S>::fill_matrix() {
  system_.clear();
  const Number none(0);
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    const Number m = System::number(mass_[i], 2 * exponent_[i]);
    system_.add_diagonal(static_cast<std::uint32_t>(i), {m, none, none, m, none, m});
  }
  // h^2 k (n n^T + s (1 - n n^T)) + h c n n^T, a share of 2^exponent; `sign` for what couples two particles.
  const auto block = [](const Tension& t, int exponent, Number sign) ISO_INLINE_LAMBDA -> SymmetricBlock<Number> {
    const Number across = sign * (t.across * System::number(t.stiff, exponent));
    const Number along = sign * System::number(t.whole, exponent) - across;
    const Number x = along * t.n.x, y = along * t.n.y, z = along * t.n.z;
    return {x * t.n.x + across, x * t.n.y, x * t.n.z, y * t.n.y + across, y * t.n.z, z * t.n.z + across};
  };
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const Edge& edge = edges_[i];
    const bool has_a = edge.a != kNoParticle, has_b = edge.b != kNoParticle;
    const int a = has_a ? exponent_[edge.a] : 0, b = has_b ? exponent_[edge.b] : 0;
    if (has_a) system_.add_diagonal(edge.a, block(tensions_[i], 2 * a, Number(1)));
    if (has_b) system_.add_diagonal(edge.b, block(tensions_[i], 2 * b, Number(1)));
    if (has_a && has_b) system_.add_pair(pair_of_[i], block(tensions_[i], a + b, Number(-1)));
  }
}

template <class S>
int ImplicitSprings<S>::fill_right(const Axes<Velocity<S>>& velocity, const Axes<S>& acceleration, std::int32_t rate) {
  const Value hz = System::value(rate);
  int exponent = -64;
  const auto see = [&](Value x) ISO_INLINE_LAMBDA {
    const int own = System::exponent(x) + 1;  // a difference of two velocities fits too
    if (own > exponent) exponent = own;
    return x;
  };
  push_.clear();
  for (const std::uint32_t slot : unknowns_) {
    see(System::value(velocity.x[slot]));
    see(System::value(velocity.y[slot]));
    see(System::value(velocity.z[slot]));
    const Value x = see(step_of(acceleration.x[slot], hz)), y = see(step_of(acceleration.y[slot], hz));
    push_.push_back({x, y, see(step_of(acceleration.z[slot], hz))});
  }
  const auto speed = [&](std::uint32_t i) ISO_INLINE_LAMBDA -> Vec3<Number> {
    if (i == kNoParticle) return {Number(0), Number(0), Number(0)};
    const std::uint32_t slot = unknowns_[i];
    return {System::number(System::value(velocity.x[slot]), exponent),
            System::number(System::value(velocity.y[slot]), exponent),
            System::number(System::value(velocity.z[slot]), exponent)};
  };
  // Every term is a share of one: m_i and h^2 k over 2^(e_i + top), which is at least d_i.
  right_.clear();
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    const Number m = System::number(mass_[i], exponent_[i] + top_exponent_);
    right_.push_back({m * System::number(push_[i].x, exponent), m * System::number(push_[i].y, exponent),
                      m * System::number(push_[i].z, exponent)});
  }
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const Edge& edge = edges_[i];
    const Tension& t = tensions_[i];
    const Vec3<Number> v = speed(edge.a) - speed(edge.b);
    const Number along = (Number(1) - t.across) * (v.x * t.n.x + v.y * t.n.y + v.z * t.n.z);
    const Vec3<Number> pull = v * t.across + t.n * along;
    if (edge.a != kNoParticle) {
      right_[edge.a] -= pull * System::number(t.stiff, exponent_[edge.a] + top_exponent_);
    }
    if (edge.b != kNoParticle) {
      right_[edge.b] += pull * System::number(t.stiff, exponent_[edge.b] + top_exponent_);
    }
  }
  return exponent;
}

}  // namespace isostep
