// Nothing: the headers that CMake compiles beside it are what it is there for.
// SPDX-License-Identifier: MIT
