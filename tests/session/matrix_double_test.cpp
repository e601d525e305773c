// The matrix with numbers of 64 bits: double and Q32.32.
// SPDX-License-Identifier: MIT
#include "session/matrix.hpp"

namespace isostep::test {
namespace matrix_double_test {

TEST(Matrix, EveryPeerConfirmsTheStraightRunInDouble) { run_matrix<double>(1); }
TEST(Matrix, EveryPeerConfirmsTheStraightRunInQ32) { run_matrix<Q32_32>(3); }

}  // namespace matrix_double_test
}  // namespace isostep::test
