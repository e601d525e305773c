// A control that the gate must see where long double is arithmetic of the compiler's library: not on x86, s390x, armhf.
// SPDX-License-Identifier: MIT
long double quotient(long double a, long double b) { return a / b; }
