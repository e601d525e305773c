// A shared library, compiled and linked with -ffast-math: the start-up code that comes with it makes the thread that
// loads the library flush denormals.
// SPDX-License-Identifier: MIT

extern "C" float half_of(float x) { return x / 2; }
