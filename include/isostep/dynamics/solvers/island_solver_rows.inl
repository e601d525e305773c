// IslandSolver: rows of W from rows of J, and the way between answers and impulses.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_rows.hpp"
#include "isostep/dynamics/solvers/island_solver.hpp"

namespace isostep {

/// Returns L of k = L L^T. A pivot that rounding left below 2^-40 of the largest, or too small for its row, belongs to
/// an axis about which the body does not turn.
template <class S> Mat3<typename IslandSolver<S>::N> IslandSolver<S>::lower_root(const Mat3<N>& k) {
  const N none = N(0);
  const N largest = max(k.rows[0].x, max(k.rows[1].y, k.rows[2].z)), speck = largest * N(0x1p-40);
  N xx = none, yx = none, zx = none, yy = none, zy = none, zz = none;
  const N p = k.rows[0].x;
  if (speck < p && !(p * k.rows[1].y < k.rows[0].y * k.rows[0].y) && !(p * k.rows[2].z < k.rows[0].z * k.rows[0].z)) {
    xx = D::root(p);
    yx = D::quotient(k.rows[0].y, xx);
    zx = D::quotient(k.rows[0].z, xx);
  }
  const N q = k.rows[1].y - yx * yx, rest = k.rows[2].z - zx * zx, beside = k.rows[1].z - yx * zx;
  if (speck < q && !(q * rest < beside * beside)) {
    yy = D::root(q);
    zy = D::quotient(beside, yy);
  }
  const N r = rest - zy * zy;
  if (speck < r) zz = D::root(r);
  return {{{xx, none, none}, {yx, yy, none}, {zx, zy, zz}}};
}

template <class S> void IslandSolver<S>::find_root(std::uint32_t row, const Mat3<S>& kappa) {
  BodyRoot& root = roots_[row];
  const Value mass = System::value(bodies_.rows().mass[row].mass);
  const int half = (System::exponent(mass) + 1) >> 1;  // mass < 4^half
  root.root = D::inverse_root(System::number(mass, 2 * half), root.root_exponent);
  root.root_exponent -= half;
  root.turn_exponent = 0;
  const S largest = max(kappa.rows[0].x, max(kappa.rows[1].y, kappa.rows[2].z));
  root.turn = Mat3<N>::diagonal({N(0), N(0), N(0)});
  if (!(largest > S(0))) return;
  root.turn_exponent = (System::exponent(System::value(largest)) + 1) >> 1;
  Mat3<N> k;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      k.rows[i][j] = System::number(System::value(kappa.rows[i][j]), 2 * root.turn_exponent);
    }
  }
  root.turn = lower_root(k);
}

template <class S>
typename IslandSolver<S>::End IslandSolver<S>::end_of(std::uint32_t row, const Shape& shape, bool is_a) const {
  End end = {IslandMotion<N>::zero(), 0, 0};
  if (!bodies_.rows().moves(row)) return end;
  const BodyRoot& root = roots_[row];
  const Vec3<S> angular = is_a ? -shape.angular_a : shape.angular_b;
  const auto number = [](S x, int exponent) { return System::number(System::value(x), exponent); };
  const N unit = is_a ? -root.root : root.root;
  end.part.linear = {unit * number(shape.linear.x, 0), unit * number(shape.linear.y, 0),
                     unit * number(shape.linear.z, 0)};
  end.linear_exponent = root.root_exponent;
  const S largest = max_abs(angular);
  if (!(largest > S(0))) return end;
  // The parts are halved, so that three products add up to less than two.
  const int exponent = System::exponent(System::value(largest)) + D::kRoom;
  const Vec3<N> a = {number(angular.x, exponent), number(angular.y, exponent), number(angular.z, exponent)};
  const Mat3<N>& t = root.turn;
  end.part.angular = {root.root * (t.rows[0].x * a.x + t.rows[1].x * a.y + t.rows[2].x * a.z),
                      root.root * (t.rows[1].y * a.y + t.rows[2].y * a.z), root.root * (t.rows[2].z * a.z)};
  end.angular_exponent = exponent + root.root_exponent + root.turn_exponent;
  return end;
}

template <class S> IslandMotion<typename IslandSolver<S>::N> IslandSolver<S>::brought_to(const End& end, int exponent) {
  const auto moved = [](const Vec3<N>& v, int n) -> Vec3<N> {
    return {D::shifted(v.x, n), D::shifted(v.y, n), D::shifted(v.z, n)};
  };
  return {moved(end.part.linear, end.linear_exponent - exponent),
          moved(end.part.angular, end.angular_exponent - exponent)};
}

/// Returns the exponent for which the row's square is in (1/4, 1].
template <class S> int IslandSolver<S>::scale_of(const End& a, const End& b) {
  int most = -512;
  const auto see = [&](const Vec3<N>& v, int exponent) {
    for (int i = 0; i < 3; ++i) {
      const N x = v[i] < N(0) ? -v[i] : v[i];
      if (x != N(0) && most < exponent + D::size(x)) most = exponent + D::size(x);
    }
  };
  for (const End* end : {&a, &b}) {
    see(end->part.linear, end->linear_exponent);
    see(end->part.angular, end->angular_exponent);
  }
  if (D::kRoom == 0) return 0;
  most += 2;  // twelve squares
  const IslandMotion<N> at_a = brought_to(a, most), at_b = brought_to(b, most);
  N square = D::rounded(product_sum(at_a, at_a) + product_sum(at_b, at_b));
  for (; N(0) < square && !(N(0.25) < square); --most) square = square + square + square + square;
  return most;
}

/// Computes W of rows first..first + count - 1 of one block pair, with one exponent of at least least_exponent.
template <class S>
void IslandSolver<S>::place(Island& island, std::uint32_t first, std::uint32_t count, int least_exponent) {
  ends_.clear();
  int exponent = least_exponent;
  for (std::uint32_t r = first; r < first + count; ++r) {
    const Ends& ends = island.ends[r / 3];
    ends_.push_back(end_of(ends.a, island.shapes[r], true));
    ends_.push_back(end_of(ends.b, island.shapes[r], false));
    if (island.system->row(r).bound == RowBound::absent) continue;
    const int own = scale_of(ends_[ends_.size() - 2], ends_.back());
    if (exponent < own) exponent = own;
  }
  for (std::uint32_t r = first; r < first + count; ++r) {
    IslandRow<N>& row = island.system->row(r);
    row.exponent = exponent;
    row.soft = N(0);
    row.ends[0] = row.ends[1] = IslandMotion<N>::zero();
    if (row.bound == RowBound::absent) continue;
    row.ends[0] = brought_to(ends_[2 * (r - first)], exponent);
    row.ends[1] = brought_to(ends_[2 * (r - first) + 1], exponent);
    const N square = D::rounded(product_sum(row.ends[0], row.ends[0]) + product_sum(row.ends[1], row.ends[1]));
    if (square == N(0)) row.bound = RowBound::absent;  // nothing can move that way
  }
}

template <class S>
typename IslandSolver<S>::V IslandSolver<S>::speed_of(const Island& island, std::uint32_t r,
                                                      const std::vector<MotionRow<V>>& motion) const {
  const Shape& shape = island.shapes[r];
  const Ends& ends = island.ends[r / 3];
  const MotionRow<V>&a = motion[ends.a], &b = motion[ends.b];
  return round_to<V>(dot_sum(shape.linear, b.linear - a.linear) + dot_sum(shape.angular_b, b.angular) -
                     dot_sum(shape.angular_a, a.angular));
}

template <class S>
typename IslandSolver<S>::Value IslandSolver<S>::answer_of(const Island& island, std::uint32_t r, V impulse) const {
  return System::product(System::value(impulse), island.ends[r / 3].reduced);
}

/// Makes an impulse the answer that a row begins with.
template <class S> void IslandSolver<S>::load(Island& island, std::uint32_t r, V impulse) const {
  IslandRow<N>& row = island.system->row(r);
  if (row.bound == RowBound::absent) return;
  row.answer = D::bounded(System::number(answer_of(island, r, impulse), island.exponent - row.exponent));
}

/// [m/s] Returns a row's impulse, held within the speed limit: as a state it must not wrap, and it is only a guess.
template <class S>
typename IslandSolver<S>::V IslandSolver<S>::impulse_of(const Island& island, std::uint32_t r) const {
  const IslandRow<N>& row = island.system->row(r);
  if (row.bound == RowBound::absent) return V(0);
  const Value pushed = System::value(row.answer, island.exponent - row.exponent);
  const V most = convert<V>(Limits<S>::speed());
  return clamp(System::add(V(0), System::quotient(pushed, island.ends[r / 3].reduced)), -most, most);
}

}  // namespace isostep
