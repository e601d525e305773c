// A header on a high floor.
// SPDX-License-Identifier: MIT
#pragma once
