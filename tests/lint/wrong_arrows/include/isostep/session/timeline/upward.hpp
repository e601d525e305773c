// An arrow upwards, between rooms of one folder.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/host/high.hpp"
