// LineMeter's windows of numbers and of time.
// SPDX-License-Identifier: MIT
#include "isostep/session/pace/line_meter.hpp"

namespace isostep {

LineMeter::Part& LineMeter::newest(Time now) {
  const std::uint64_t part = now / kPart;
  for (std::uint64_t n = 0; n < kParts && newest_ < part; ++n) parts_[++newest_ % kParts] = Part{};
  if (newest_ < part) newest_ = part;
  return parts_[newest_ % kParts];
}

void LineMeter::arrived(std::uint16_t number, Time now) {
  Part& part = newest(now);
  const int ahead = has_number_ ? static_cast<std::int16_t>(static_cast<std::uint16_t>(number - highest_)) : 1;
  if (ahead > kMostLost || ahead < -kMostLost) {
    has_number_ = false;  // begins anew with the next
    return;
  }
  if (ahead > 0) {
    part.sent += static_cast<std::uint32_t>(ahead);
    seen_ = ahead < 64 ? seen_ << ahead : 0;
    highest_ = number;
    has_number_ = true;
  }
  const int age = ahead > 0 ? 0 : -ahead;
  if (age >= 64 || (seen_ >> age & 1) != 0) return;
  seen_ |= std::uint64_t{1} << age;
  ++part.received;
}

void LineMeter::measured(std::uint16_t sent, Time now) {
  if (has_time_) {
    const auto apart = static_cast<std::int16_t>(static_cast<std::uint16_t>(sent - sent_));  // [ms]
    const std::int64_t difference = static_cast<std::int64_t>(now - received_at_) - std::int64_t{apart} * 1000;
    Part& part = newest(now);
    part.differences += static_cast<Time>(difference < 0 ? -difference : difference);
    ++part.pairs;
  }
  has_time_ = true;
  sent_ = sent;
  received_at_ = now;
}

std::uint32_t LineMeter::loss(Time now) {
  newest(now);
  std::uint64_t sent = 0, received = 0;
  for (const Part& part : parts_) {
    sent += part.sent;
    received += part.received;
  }
  return received >= sent ? 0 : static_cast<std::uint32_t>(((sent - received) * 1000 + sent / 2) / sent);
}

std::uint32_t LineMeter::jitter(Time now) {
  newest(now);
  Time differences = 0, pairs = 0;
  for (const Part& part : parts_) {
    differences += part.differences;
    pairs += part.pairs;
  }
  return pairs == 0 ? 0 : static_cast<std::uint32_t>(differences / pairs);
}

}  // namespace isostep
