// A header of the tool.
// SPDX-License-Identifier: MIT
#pragma once
