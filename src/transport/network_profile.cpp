// Named network profiles and the reader of explicit ones.
// SPDX-License-Identifier: MIT
#include "transport/network_profile.hpp"

#include <optional>

namespace isostep::transport {
namespace {

constexpr std::uint32_t kMs = 1000;       // [us]
constexpr std::uint32_t kPerCent = 10;    // [permille]
constexpr Time kDark = 5 * kSecond;       // a match is well under way
constexpr Time kDarkness = 30 * kSecond;  // longer than transports wait before they give a peer up

constexpr NetworkProfile both(const char* name, const Conditions& conditions) { return {name, conditions, conditions}; }

constexpr Conditions kWifi = {.latency = 50 * kMs, .jitter = 20 * kMs, .loss = 1 * kPerCent};
constexpr Conditions kSteady = {.latency = 50 * kMs, .jitter = 20 * kMs};
constexpr Conditions kDarkened = {
    .latency = 50 * kMs, .jitter = 20 * kMs, .blackout_start = kDark, .blackout = kDarkness};

constexpr NetworkProfile kProfiles[] = {
    both("loopback", {}),
    both("lan", {.latency = 10 * kMs}),
    both("wifi", kWifi),
    both("mobile", {.latency = 100 * kMs, .jitter = 20 * kMs, .loss = 5 * kPerCent}),
    both("severe", {.latency = 200 * kMs, .jitter = 20 * kMs, .loss = 15 * kPerCent}),
    both("burst", {.latency = 50 * kMs, .jitter = 20 * kMs, .burst = 1 * kPerCent, .burst_length = 10}),
    both("duplicate", {.latency = 50 * kMs, .jitter = 20 * kMs, .duplication = 2 * kPerCent}),
    // No jitter, so that only what is held back is overtaken: by two packets at 60 a second.
    both("reorder", {.latency = 50 * kMs, .reordering = 10 * kPerCent, .hold = 50 * kMs}),
    {"asymmetric", {.latency = 10 * kMs}, {.latency = 200 * kMs}},
    // The delay that no clock can tell from a difference of clocks.
    both("constant", {.latency = 100 * kMs}),
    both("blackout", kDarkened),
    {"blackout-up", kDarkened, kSteady},
    {"blackout-down", kSteady, kDarkened},
};

/// Digits with up to `decimals` after a point, as a whole number of the last decimal; nothing when it is not one or
/// above `largest`.
std::optional<std::uint32_t> parse_number(std::string_view text, int decimals, std::uint64_t largest) {
  std::uint64_t number = 0;
  int left = -1;  // decimals still allowed, once the point was seen
  bool digits = false;
  for (const char c : text) {
    if (c == '.' && left < 0 && digits) {
      left = decimals;
      continue;
    }
    if (c < '0' || c > '9' || left == 0) return std::nullopt;
    number = number * 10 + static_cast<std::uint64_t>(c - '0');
    if (number > 1000000000000u) return std::nullopt;
    digits = true;
    if (left > 0) --left;
  }
  if (!digits || text.back() == '.') return std::nullopt;
  for (int i = left < 0 ? decimals : left; i > 0; --i) number *= 10;
  if (number > largest) return std::nullopt;
  return static_cast<std::uint32_t>(number);
}

struct Key {
  std::string_view name;
  int decimals;
  std::uint32_t largest;
  void (*set)(Conditions&, std::uint32_t);
};
constexpr Key kKeys[] = {
    {"latency", 3, kLongestDelay, [](Conditions& c, std::uint32_t us) { c.latency = us; }},
    {"jitter", 3, kLongestDelay, [](Conditions& c, std::uint32_t us) { c.jitter = us; }},
    {"loss", 1, 1000, [](Conditions& c, std::uint32_t permille) { c.loss = permille; }},
    {"burst", 1, 1000, [](Conditions& c, std::uint32_t permille) { c.burst = permille; }},
    {"burst-length", 0, kLongestBurst, [](Conditions& c, std::uint32_t packets) { c.burst_length = packets; }},
    {"duplication", 1, 1000, [](Conditions& c, std::uint32_t permille) { c.duplication = permille; }},
    {"reordering", 1, 1000, [](Conditions& c, std::uint32_t permille) { c.reordering = permille; }},
    {"hold", 3, kLongestDelay, [](Conditions& c, std::uint32_t us) { c.hold = us; }},
    {"rate", 3, 1000000000, [](Conditions& c, std::uint32_t bytes) { c.rate = bytes; }},
    {"blackout-start", 3, kLongestBlackout, [](Conditions& c, std::uint32_t us) { c.blackout_start = us; }},
    {"blackout", 3, kLongestBlackout, [](Conditions& c, std::uint32_t us) { c.blackout = us; }},
};

Error refusal(const char* message, std::string_view item) { return {ErrorCode::invalid, message, item}; }

bool take_prefix(std::string_view& text, std::string_view prefix) {
  if (text.substr(0, prefix.size()) != prefix) return false;
  text.remove_prefix(prefix.size());
  return true;
}

Result<void> apply_item(std::string_view item, NetworkProfile& profile) {
  const std::size_t equals = item.find('=');
  if (equals == std::string_view::npos)
    return refusal("expected key=value, or first a profile such as lan, wifi, mobile, severe", item);
  std::string_view name = item.substr(0, equals);
  const bool up_only = take_prefix(name, "up.");
  const bool down_only = !up_only && take_prefix(name, "down.");
  for (const Key& key : kKeys) {
    if (key.name != name) continue;
    const std::optional<std::uint32_t> number = parse_number(item.substr(equals + 1), key.decimals, key.largest);
    if (!number) return refusal("not a number, too large, or with too many decimals", item);
    if (!down_only) key.set(profile.up, *number);
    if (!up_only) key.set(profile.down, *number);
    return {};
  }
  return refusal("unknown key", item);
}

Result<void> check(const Conditions& conditions) {
  if ((conditions.burst != 0) != (conditions.burst_length != 0)) {
    return refusal("burst and burst-length come together", "burst");
  }
  if ((conditions.reordering != 0) != (conditions.hold != 0)) {
    return refusal("reordering and hold come together", "reordering");
  }
  return {};
}

}  // namespace

std::span<const NetworkProfile> named_profiles() { return kProfiles; }

Result<NetworkProfile> parse_profile(std::string_view text) {
  NetworkProfile profile{"explicit", {}, {}};
  bool first = true;
  while (true) {
    const std::string_view item = text.substr(0, text.find(','));
    const NetworkProfile* named = nullptr;
    for (const NetworkProfile& candidate : kProfiles) {
      if (first && candidate.name.view() == item) named = &candidate;
    }
    if (named != nullptr) {
      profile = *named;
    } else if (const Result<void> applied = apply_item(item, profile); !applied) {
      return applied.error();
    } else {
      profile.name = "explicit";
    }
    first = false;
    if (item.size() == text.size()) break;
    text.remove_prefix(item.size() + 1);
  }
  for (const Direction direction : kDirections) {
    if (const Result<void> checked = check(profile.of(direction)); !checked) return checked.error();
  }
  return profile;
}

}  // namespace isostep::transport
