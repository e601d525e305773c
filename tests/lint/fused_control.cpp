// What the fused-instruction test must be able to see: compiled for a machine with FMA and without the exact flags.
// SPDX-License-Identifier: MIT
double fused_control(double a, double b, double c) { return a * b + c; }
