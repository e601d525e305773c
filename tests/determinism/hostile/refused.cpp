// A user's file, for flags that must be refused.
// SPDX-License-Identifier: MIT
#include "isostep/world/world.hpp"

int main() {}
