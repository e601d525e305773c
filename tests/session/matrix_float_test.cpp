// The matrix with numbers of 32 bits: float and Q16.16.
// SPDX-License-Identifier: MIT
#include "session/matrix.hpp"

namespace isostep::test {
namespace matrix_float_test {

TEST(Matrix, RowsMissAPairWhenOneOfThemIsTakenAway) {
  const std::vector<std::size_t> sizes = {3, 2};  // all pairs of two factors are the whole product
  std::vector<Row> rows = {{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 0}, {2, 1}};
  EXPECT_TRUE(covers_every_pair(rows, sizes));
  rows.pop_back();
  EXPECT_FALSE(covers_every_pair(rows, sizes));
}

TEST(Matrix, EveryPeerConfirmsTheStraightRunInFloat) { run_matrix<float>(0); }
TEST(Matrix, EveryPeerConfirmsTheStraightRunInQ16) { run_matrix<Q16_16>(2); }

}  // namespace matrix_float_test
}  // namespace isostep::test
