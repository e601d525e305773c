// A client takes a state of the host's again.
// SPDX-License-Identifier: MIT
#include "isostep/session/client_repair.hpp"

#include "isostep/session/verdict.hpp"

namespace isostep {

bool Repair::tend(const std::vector<InputStream>& streams, Frame current, FrameClock& clock, Time now) {
  while (present_ > current && clock.is_due(now)) {
    ++present_;
    clock.stepped(now);
  }
  if (receives() && arrival_.is_whole() && current >= offer_.start.frame) {
    for (const InputStream& stream : streams) {
      if (stream.begin() <= offer_.start.frame) continue;
      stage_ = Stage::asks;  // it was too long on its way: another
      return false;
    }
    stage_ = Stage::restores;
    after_ = hashes_.settled().frame;
    present_ = current;
  }
  // Which it still is where the requests of the last turn were not carried out.
  return restores();
}

bool Repair::write_next(std::vector<std::uint8_t>& message) {
  if (inquired_ != kNoFrame && hashes_.settled().frame >= inquired_) {
    const bool is_known = hashes_.has_chain(inquired_);
    write_statement({inquired_, is_known, is_known ? hashes_.chain(inquired_) : 0}, message);
    inquired_ = kNoFrame;
  } else if (stage_ == Stage::asks) {
    stage_ = Stage::waits;
    write_resync(message);
  } else if (arrival_.is_told() && due_.take(MessageKind::repaired)) {  // how much has arrived: first things first
    write_repaired({0xff, after_}, message);
  } else {
    return false;
  }
  return true;
}

}  // namespace isostep
