// Sparse systems by Eigen, compiled once for the two numbers of LinearSystem.
// SPDX-License-Identifier: MIT

// A namespace of our own, for no linker may keep a user's copy of Eigen in place of this one: theirs may be another
// version, or aligned for another instruction set.
#if defined(EIGEN_CORE_H)
#error "Eigen is included here under a name of our own: compile this file by itself"
#endif
#define Eigen isostep_eigen
#define EIGEN_NO_DEBUG
#define EIGEN_DONT_VECTORIZE
#define EIGEN_DONT_PARALLELIZE
#define EIGEN_MPL2_ONLY
#define EIGEN_STACK_ALLOCATION_LIMIT 16384  // bytes of a working row; more is not for a thread's stack
#include "isostep/math/sparse_cholesky.hpp"

#include "isostep/scalar/math.hpp"

// Eigen takes this for std: its search for an order of elimination asks for the root of a double, and unoptimised that
// is a call of libm.
namespace isostep_eigen::std {
using namespace ::std;
ISO_INLINE double sqrt(double x) { return isostep::sqrt(x); }
}  // namespace isostep_eigen::std

#include <Eigen/SparseCholesky>

#include "isostep/scalar/eigen.hpp"

#if EIGEN_WORLD_VERSION != 3 || EIGEN_MAJOR_VERSION != 4
#error "Eigen 3.4 is needed: another release may eliminate in another order, and so give other bits"
#endif

namespace isostep {

namespace {

using Index = int;
using Pattern = Eigen::SparseMatrix<Index, Eigen::ColMajor, Index>;
using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// place[i]: when vector i is eliminated.
std::vector<Index> elimination_order(Index size, const Pairs& pairs) {
  std::vector<Eigen::Triplet<Index, Index>> entries;
  entries.reserve(pairs.size() * 2 + static_cast<std::size_t>(size));
  for (const auto& [a, b] : pairs) {
    entries.emplace_back(static_cast<Index>(a), static_cast<Index>(b), 1);
    entries.emplace_back(static_cast<Index>(b), static_cast<Index>(a), 1);
  }
  for (Index i = 0; i < size; ++i) entries.emplace_back(i, i, 1);
  Pattern graph(size, size);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, Index> order;
  Eigen::internal::minimum_degree_ordering(graph, order);
  std::vector<Index> place(static_cast<std::size_t>(size));
  for (Index i = 0; i < size; ++i) place[static_cast<std::size_t>(order.indices()[i])] = i;
  return place;
}

/// The blocks of the upper half in the order of elimination; rows ascend, the diagonal is every column's last.
Pattern upper_blocks(const std::vector<Index>& place, const Pairs& pairs) {
  const auto size = static_cast<Index>(place.size());
  std::vector<Eigen::Triplet<Index, Index>> entries;
  entries.reserve(pairs.size() + place.size());
  for (const auto& [a, b] : pairs) {
    const Index i = place[a], j = place[b];
    entries.emplace_back(i < j ? i : j, i < j ? j : i, 1);
  }
  for (Index i = 0; i < size; ++i) entries.emplace_back(i, i, 1);
  Pattern blocks(size, size);
  blocks.setFromTriplets(entries.begin(), entries.end());
  return blocks;
}

/// The index of the block of a column that is in `row`: a binary search.
Index nth_of(const Pattern& blocks, Index column, Index row) {
  const Index first = blocks.outerIndexPtr()[column];
  Index low = first, high = blocks.outerIndexPtr()[column + 1];
  while (high - low > 1) {
    const Index middle = low + (high - low) / 2;
    if (blocks.innerIndexPtr()[middle] <= row) low = middle;
    else high = middle;
  }
  return low - first;
}

/// The places among the matrix's values at which the three columns of a block begin.
struct Place {
  Index column[3];
  bool turned = false;  // a pair's block (second, first) is there
};

}  // namespace

template <class N> struct SparseCholesky<N>::Parts {
  using Matrix = Eigen::SparseMatrix<N, Eigen::ColMajor, Index>;
  using Column = Eigen::Matrix<N, Eigen::Dynamic, 1>;

  bool analysed = false;
  Pairs pattern;
  std::vector<Index> place;                                                           // of each vector
  Matrix matrix;                                                                      // A's upper half
  Matrix reduced;                                                                     // A with unknowns held
  bool has_reduced = false, is_reduced = false;                                       // has A's pattern; is factorised
  std::vector<std::uint8_t> held;                                                     // of each of its rows
  std::vector<Place> diagonal, pairs;                                                 // in it
  Eigen::SimplicialLLT<Matrix, Eigen::Upper, Eigen::NaturalOrdering<Index>> factors;  // we have put it in order
  Column right, answer, given, sum;
  std::vector<Int128> exact, rest;  // b, and what is left of it, in units of products

  Place place_of(const Pattern& blocks, Index row, Index column) const {
    const Index nth = nth_of(blocks, column, row);
    Place result;
    for (Index c = 0; c < 3; ++c) result.column[c] = matrix.outerIndexPtr()[3 * column + c] + 3 * nth;
    return result;
  }
  void build(const Pattern& blocks) {
    const Index size = static_cast<Index>(blocks.cols());
    matrix.resize(3 * size, 3 * size);
    matrix.resizeNonZeros(9 * (blocks.nonZeros() - size) + 6 * size);
    Index filled = 0;
    for (Index column = 0; column < 3 * size; ++column) {
      matrix.outerIndexPtr()[column] = filled;
      for (Index k = blocks.outerIndexPtr()[column / 3]; k < blocks.outerIndexPtr()[column / 3 + 1]; ++k) {
        const Index row = 3 * blocks.innerIndexPtr()[k];
        for (Index r = row; r < row + 3 && r <= column; ++r) matrix.innerIndexPtr()[filled++] = r;
      }
    }
    matrix.outerIndexPtr()[3 * size] = filled;
    has_reduced = is_reduced = false;
  }
  /// matrix, but for the unknowns that are held.
  void reduce(const std::vector<std::uint8_t>& which) {
    if (!has_reduced) reduced = matrix;
    has_reduced = true;
    held.resize(3 * place.size());
    for (std::size_t i = 0; i < place.size(); ++i) {
      for (Index c = 0; c < 3; ++c) held[static_cast<std::size_t>(3 * place[i] + c)] = which[i] >> c & 1;
    }
    for (Index j = 0; j < static_cast<Index>(matrix.cols()); ++j) {
      const bool column = held[static_cast<std::size_t>(j)] != 0;
      for (Index k = matrix.outerIndexPtr()[j]; k < matrix.outerIndexPtr()[j + 1]; ++k) {
        const Index i = matrix.innerIndexPtr()[k];
        const bool out = column || held[static_cast<std::size_t>(i)] != 0;
        reduced.valuePtr()[k] = !out ? matrix.valuePtr()[k] : i == j ? N(1) : N(0);
      }
    }
  }
  const Matrix& factorised() const { return is_reduced ? reduced : matrix; }
  ISO_INLINE void to_column(const std::vector<Vec3<N>>& vectors) {
    right.resize(static_cast<Index>(3 * vectors.size()));
    for (std::size_t i = 0; i < vectors.size(); ++i) {
      for (int c = 0; c < 3; ++c) right[3 * place[i] + c] = vectors[i][c];
    }
  }
};

namespace {

/// Solves once, in floating point.
template <class Parts, class T>
bool solve_with(Parts& parts, const std::vector<Vec3<Exact<T>>>& b, int, int, std::vector<Vec3<Exact<T>>>& x,
                int& exponent) {
  parts.to_column(b);
  parts.answer = parts.factors.solve(parts.right);
  exponent = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const Exact<T> component = parts.answer[3 * parts.place[i] + c];
      if (!is_finite(component)) return false;
      x[i][c] = component;
    }
  }
  return true;
}

// A number of 2^-62 units, times 2^exponent, for fixed point; residuals are sums of products, in 2^-124 units of x's.
using Entry = Fixed<std::int64_t, 62>;
using Column = Eigen::Matrix<Entry, Eigen::Dynamic, 1>;

int bits(std::uint64_t a) { return a == 0 ? 0 : 64 - detail::leading_zeros(a); }
int bits(Int128 a) {
  const UInt128Parts size = parts(a < Int128(0) ? -a : a);
  return size.high != 0 ? 64 + bits(size.high) : bits(size.low);
}
int bits(const Column& column) {
  int most = 0;
  for (Index i = 0; i < column.size(); ++i) {
    const int own = bits(detail::magnitude(column[i].raw()));
    if (own > most) most = own;
  }
  return most;
}
/// a 2^-n to nearest, ties up, modulo 2^128.
Int128 shifted(Int128 a, int n) {
  if (n <= -128) return Int128(0);
  if (n <= 0) return a << -n;
  if (n > 126) return Int128(0);
  return wrapping_add(a, Int128(1) << (n - 1)) >> n;
}
Entry entry(Int128 raw) { return Entry::from_raw(static_cast<std::int64_t>(raw)); }

/// b - A x, modulo 2^128, which is exact, for the whole is less than that.
template <class Matrix>
void residual(const Matrix& upper, const std::vector<Int128>& b, const Column& x, std::vector<Int128>& result) {
  result = b;
  for (Index j = 0; j < static_cast<Index>(upper.cols()); ++j) {
    for (Index k = upper.outerIndexPtr()[j]; k < upper.outerIndexPtr()[j + 1]; ++k) {
      const Index i = upper.innerIndexPtr()[k];
      const Entry a = upper.valuePtr()[k];
      Int128& above = result[static_cast<std::size_t>(i)];
      above = wrapping_subtract(above, product(a, x[j]).raw);
      if (i == j) continue;
      Int128& below = result[static_cast<std::size_t>(j)];
      below = wrapping_subtract(below, product(a, x[i]).raw);
    }
  }
}

/// Safe exponent of a solve: with |r| < 2^e for each of n numbers, |A^-1 r| < 2^(e + loss) sqrt(n) <= 2^(result - 1).
int solve_exponent(int e, int loss, Index n) { return e + loss + (bits(static_cast<std::uint64_t>(n)) + 1) / 2 + 1; }

template <class Parts>
bool solve_with(Parts& parts, const std::vector<Vec3<Entry>>& b, int b_exponent, int loss, std::vector<Vec3<Entry>>& x,
                int& exponent) {
  constexpr int kFrac = Entry::kFracBits, kPasses = 8, kDone = -44, kBad = -20;
  parts.to_column(b);
  const Index n = static_cast<Index>(parts.right.size());
  Column &given = parts.given, &sum = parts.sum;
  std::vector<Int128>&exact = parts.exact, &rest = parts.rest;
  given = parts.right;
  sum = Column::Zero(n);
  exact.resize(static_cast<std::size_t>(n));
  exponent = 0;
  const int given_bits = bits(given);
  int e = solve_exponent(b_exponent + given_bits - kFrac, loss, n);
  for (Index i = 0; i < n; ++i) {
    parts.right[i] = entry(shifted(Int128(given[i].raw()), e - b_exponent));
  }
  for (int pass = 0; pass < kPasses && given_bits != 0; ++pass) {
    parts.answer = parts.factors.solve(parts.right);
    const int size = bits(parts.answer) - kFrac + e;  // |answer| 2^e < 2^size
    if (pass == 0) {
      // The largest unknown gets an exponent of its own, for the safe one may be far too high.
      exponent = size + 1;
      for (Index i = 0; i < n; ++i) {
        exact[static_cast<std::size_t>(i)] = shifted(Int128(given[i].raw()), exponent - b_exponent - kFrac);
      }
    }
    if (size > exponent) return false;
    for (Index i = 0; i < n; ++i) sum[i] += entry(shifted(Int128(parts.answer[i].raw()), exponent - e));
    if (pass > 0 && size - exponent <= kDone) break;
    if (pass == kPasses - 1 && size - exponent > kBad) return false;
    residual(parts.factorised(), exact, sum, rest);
    int most = 0;
    for (const Int128 r : rest) most = bits(r) > most ? bits(r) : most;
    if (most == 0) break;
    e = solve_exponent(exponent + most - 2 * kFrac, loss, n);
    for (Index i = 0; i < n; ++i) {
      parts.right[i] = entry(shifted(rest[static_cast<std::size_t>(i)], e - exponent + kFrac));
    }
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (int c = 0; c < 3; ++c) x[i][c] = sum[3 * parts.place[i] + c];
  }
  return true;
}

}  // namespace

template <class N> SparseCholesky<N>::SparseCholesky() : parts_(new Parts) {}
template <class N> SparseCholesky<N>::~SparseCholesky() = default;
template <class N> SparseCholesky<N>::SparseCholesky(SparseCholesky&&) noexcept = default;
template <class N> SparseCholesky<N>& SparseCholesky<N>::operator=(SparseCholesky&&) noexcept = default;
template <class N> SparseCholesky<N>::SparseCholesky(const SparseCholesky&) : SparseCholesky() {}
template <class N> SparseCholesky<N>& SparseCholesky<N>::operator=(const SparseCholesky& other) {
  if (this != &other) parts_.reset(new Parts);
  return *this;
}

template <class N> bool SparseCholesky<N>::is_analysed() const { return parts_ != nullptr && parts_->analysed; }

template <class N> void SparseCholesky<N>::analyse(std::uint32_t size, const std::vector<Pair>& pairs) {
  if (parts_ == nullptr) parts_.reset(new Parts);
  Parts& parts = *parts_;
  if (parts.analysed && parts.place.size() == size && parts.pattern == pairs) {
    clear();
    return;
  }
  parts.place = elimination_order(static_cast<Index>(size), pairs);
  const Pattern blocks = upper_blocks(parts.place, pairs);
  parts.build(blocks);
  parts.diagonal.clear();
  parts.pairs.clear();
  for (const Index i : parts.place) parts.diagonal.push_back(parts.place_of(blocks, i, i));
  for (const Pair& pair : pairs) {
    const Index i = parts.place[pair.first], j = parts.place[pair.second];
    parts.pairs.push_back(parts.place_of(blocks, i < j ? i : j, i < j ? j : i));
    parts.pairs.back().turned = j < i;
  }
  clear();
  parts.factors.analyzePattern(parts.matrix);
  parts.pattern = pairs;
  parts.analysed = true;
}

template <class N> void SparseCholesky<N>::clear() {
  for (Index i = 0; i < static_cast<Index>(parts_->matrix.nonZeros()); ++i) parts_->matrix.valuePtr()[i] = N(0);
}

template <class N> void SparseCholesky<N>::add_diagonal(std::uint32_t i, const SymmetricBlock<N>& block) {
  N* const values = parts_->matrix.valuePtr();
  const Place& place = parts_->diagonal[i];
  values[place.column[0]] += block.xx;
  values[place.column[1]] += block.xy;
  values[place.column[1] + 1] += block.yy;
  values[place.column[2]] += block.xz;
  values[place.column[2] + 1] += block.yz;
  values[place.column[2] + 2] += block.zz;
}

template <class N> void SparseCholesky<N>::add_pair(std::uint32_t pair, const SymmetricBlock<N>& block) {
  N* const values = parts_->matrix.valuePtr();
  const Place& place = parts_->pairs[pair];
  const N rows[3][3] = {{block.xx, block.xy, block.xz}, {block.xy, block.yy, block.yz}, {block.xz, block.yz, block.zz}};
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) values[place.column[c] + r] += rows[r][c];
  }
}

template <class N> void SparseCholesky<N>::add_pair(std::uint32_t pair, const GeneralBlock<N>& block) {
  N* const values = parts_->matrix.valuePtr();
  const Place& place = parts_->pairs[pair];
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) values[place.column[c] + r] += place.turned ? block.rows[c][r] : block.rows[r][c];
  }
}

template <class N> bool SparseCholesky<N>::factorise(const std::vector<std::uint8_t>& held) {
  parts_->reduce(held);
  parts_->is_reduced = true;
  parts_->factors.factorize(parts_->reduced);
  return parts_->factors.info() == Eigen::Success;
}

template <class N> bool SparseCholesky<N>::factorise() {
  parts_->is_reduced = false;
  parts_->factors.factorize(parts_->matrix);
  return parts_->factors.info() == Eigen::Success;
}

template <class N>
bool SparseCholesky<N>::solve(const std::vector<Vec3<N>>& b, int b_exponent, int loss, std::vector<Vec3<N>>& x,
                              int& exponent) {
  x.resize(b.size());
  return solve_with(*parts_, b, b_exponent, loss, x, exponent);
}

template class SparseCholesky<Exact<double>>;
template class SparseCholesky<Fixed<std::int64_t, 62>>;

}  // namespace isostep
