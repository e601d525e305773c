// Who vouches for a client's states.
// SPDX-License-Identifier: MIT
#include "isostep/session/client_vouching.hpp"

#include "isostep/session/verdict.hpp"

namespace isostep {
namespace {
/// [us] for the other machines to vouch for our states: some reports of each, with losses on the longest lines.
constexpr Time kVouching = 5 * kSecond;
}  // namespace

bool Vouching::suffices(std::uint64_t agreeing, std::uint64_t differing, std::uint32_t with_host, Time now) const {
  // Until the host says that nobody plays for us, inputs of ours from before are still on their way.
  for (const int p : EachPlayer(own_.players())) {
    const InputStream& stream = streams_[static_cast<std::size_t>(p)];
    if (stream.end() == stream.begin() || !stream.last().absent) return false;
  }
  std::uint64_t counted = std::uint64_t{1} << kHostMachine;
  int needed = 1;
  for (std::size_t p = 0; p < streams_.size(); ++p) {
    if (((with_host | own_.players()) >> p & 1) != 0) continue;
    counted |= std::uint64_t{1} << p;
    if (!streams_[p].last().absent) needed = 2;
  }
  const int agree = std::popcount(agreeing & counted);
  if (agree >= needed && agree > std::popcount(differing & counted)) return true;
  // Who says nothing, or what is not so, does not keep us out for ever: then the host's word alone counts.
  return near_since_ != 0 && now - near_since_ > kVouching && (agreeing >> kHostMachine & 1) != 0;
}

}  // namespace isostep
