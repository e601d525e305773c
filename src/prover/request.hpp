// The request of the prover: its words, read.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "diagnostics/staged_replay.hpp"
#include "isostep/core/simd.hpp"
#include "isostep/state/verify.hpp"
#include "programs/exit_status.hpp"

namespace isostep::prover {

struct Request {
  std::string_view command;
  std::vector<std::string_view> operands;
  Simd simd = Simd::best;
  std::uint64_t frames = kAllFrames;  // at most; one or more
  std::optional<StageFault> fault;    // to inject, of trace and fields
};

/// Options, "--name value", stand anywhere; the first other word is the command. 0, or the exit status after a line on
/// stderr.
int read_request(int count, const char* const* words, Request& request);

/// "isostep_prover: what (detail)" on stderr; returns `status`.
int refuse(int status, std::string_view what, std::string_view detail = {});

}  // namespace isostep::prover
