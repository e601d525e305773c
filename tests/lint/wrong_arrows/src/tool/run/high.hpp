// A header of a command.
// SPDX-License-Identifier: MIT
#pragma once
