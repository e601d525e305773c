// Matches drawn from seeds: no frame is final in two ways, there is one host, and a match goes on when its machines are
// there. ISOSTEP_MATCHES=n plays n of them, from seed ISOSTEP_FIRST_MATCH on, and tells which fell.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <cstdlib>

#include "session/random_match.hpp"

namespace isostep::test {
namespace agreement_test {

std::uint64_t number_of(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

/// Each seed fell by another fault: half of a roster with its host and half with the host elected since (809);
/// followers that gave up what was final before the new host had told it all (960, 1813); a host that is one again in a
/// later term (1711); two who each take the other for gone (1082); all asking the one whose log is too old (493); who
/// had given up waiting for one another in a ring (2792); and a host that had greeted another when it was elected, and
/// was waited for there ever since (20193).
TEST(Agreement, MatchesThatFellOnceGoOnWithOneHistory) {
  for (const std::uint64_t seed : {493, 809, 960, 1082, 1711, 1813, 2792, 20193}) {
    RandomMatch match(seed);
    match.play();
    EXPECT_EQ(match.two_histories, 0) << seed << ": from frame " << match.first_of_them << "; " << match.story();
    EXPECT_EQ(match.hosts(), 1) << seed << ": " << match.story();
    EXPECT_TRUE(match.goes_on()) << seed << ": " << match.story();
  }
}

TEST(Agreement, OfMatchesDrawnFromSeedsNoneHasTwoHistoriesAndAllGoOn) {
  constexpr std::uint64_t kSample = 24;  // some ten seconds
  const std::uint64_t matches = number_of("ISOSTEP_MATCHES", kSample), first = number_of("ISOSTEP_FIRST_MATCH", 1);
  std::uint64_t histories = 0, without_memory = 0, hosts = 0, stand = 0, migrations = 0;
  for (std::uint64_t seed = first; seed < first + matches; ++seed) {
    RandomMatch match(seed);
    match.play();
    migrations += static_cast<std::uint64_t>(match.migrations());
    const bool has_two = match.two_histories > 0;
    if (has_two && match.has_lost_memory()) ++without_memory;
    else if (has_two) ++histories;
    // Of whom a majority has forgotten the match it may stand: a machine that lives may know of another host.
    const bool has_hosts = match.hosts() > 1 || (match.hosts() == 0 && !match.has_lost_memory());
    const bool stands = !match.goes_on() && !match.has_lost_memory();
    hosts += has_hosts ? 1 : 0;
    stand += stands ? 1 : 0;
    if (!has_two && !has_hosts && !stands) continue;
    std::printf(
        "match %llu: %d players, migration %.1f s, deadline %d, %s: %d frames in two ways from %d, %d hosts, %s; %s\n",
        static_cast<unsigned long long>(seed), match.config().players,
        static_cast<double>(match.config().migration) / 1e6, match.config().deadline,
        match.config().mode == SessionMode::lockstep ? "lockstep" : "rollback", match.two_histories,
        match.first_of_them, match.hosts(), stands ? "stands" : "goes on", match.story().c_str());
  }
  std::printf(
      "%llu matches, %llu new hosts: %llu with two histories (and %llu whose majority lost its memory), "
      "%llu with other than one host, %llu that stand\n",
      static_cast<unsigned long long>(matches), static_cast<unsigned long long>(migrations),
      static_cast<unsigned long long>(histories), static_cast<unsigned long long>(without_memory),
      static_cast<unsigned long long>(hosts), static_cast<unsigned long long>(stand));
  EXPECT_EQ(histories, 0u);
  EXPECT_EQ(hosts, 0u);
  EXPECT_EQ(stand, 0u);
  EXPECT_GT(migrations, matches);
}

}  // namespace agreement_test
}  // namespace isostep::test
