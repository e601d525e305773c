// A control that the gate must see on x86: arithmetic in the x87 stack, which long double gets from every compiler.
// SPDX-License-Identifier: MIT
float rounded_twice(float a, float b) { return static_cast<float>(static_cast<long double>(a) * b + b); }
