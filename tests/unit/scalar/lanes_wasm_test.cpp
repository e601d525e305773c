// Lanes in WebAssembly's registers: compiled with -msimd128.
// SPDX-License-Identifier: MIT
#include "isostep/scalar/lanes_wasm.hpp"

#include "lanes_checks.hpp"

bool isostep::test::cpu_can_run() { return true; }  // what the compiler may use everywhere is there

namespace lanes_wasm_test {

using isostep::Overflow;
using isostep::Q16_16;
using isostep::Q32_32;
using isostep::isa::WasmSimd;

using WasmLanes =
    testing::Types<Lanes<float, 4, WasmSimd>, Lanes<double, 2, WasmSimd>, Lanes<Q16_16, 4, WasmSimd>,
                   Lanes<Fixed<std::int32_t, 30>, 4, WasmSimd>, Lanes<Q32_32, 2, WasmSimd>,
                   Lanes<Fixed<std::int64_t, 40>, 2, WasmSimd>, Lanes<Fixed<std::int64_t, 62>, 2, WasmSimd>,
                   Lanes<float, 8, WasmSimd>, Lanes<Q32_32, 1, WasmSimd>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Wasm, LanesTest, WasmLanes);

TEST(WasmLanes, RoundEveryShiftOfEveryFormat) {
  check_formats<std::int32_t, 4, WasmSimd>();
  check_formats<std::int64_t, 2, WasmSimd>();
}

TEST(WasmLanes, TakeIeeeRoots) {
  check_sqrt<Lanes<float, 4, WasmSimd>>();
  check_sqrt<Lanes<double, 2, WasmSimd>>();
}

TEST(WasmLanes, RegistersHoldTheWholeType) {
  EXPECT_EQ(sizeof(Lanes<float, 4, WasmSimd>), 16u);
  EXPECT_EQ(sizeof(Lanes<Q16_16, 4, WasmSimd>), 16u);
  EXPECT_EQ(sizeof(Lanes<Q32_32, 2, WasmSimd>), 16u);
  EXPECT_EQ(sizeof(product(Lanes<Q16_16, 4, WasmSimd>::zero(), Lanes<Q16_16, 4, WasmSimd>::zero())), 32u);
}

}  // namespace lanes_wasm_test
