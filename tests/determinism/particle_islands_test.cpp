// Clusters of particles that never touch: in whatever order they were made, beside whatever else, every particle moves
// bit for bit as it does when its cluster is alone.
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <numeric>

#include "determinism/clusters.hpp"
#include "determinism/particle_mess.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace particle_islands_test {

constexpr int kFrames = 90, kClusters = 9;
using Motions = std::vector<std::vector<std::uint64_t>>;  // by cluster, by frame

struct Seen {
  std::uint32_t contacts = 0, begins = 0, unresolved = 0;
  bool apart = true;
};

/// `turns`: a cluster makes its next particle, again and again; `past`: particles that were there before and left their
/// slots.
template <class S>
Motions motions_of(std::uint32_t way, const std::vector<int>& turns, Simd simd = Simd::best, int past = 0,
                   Seen* seen = nullptr) {
  ParticleWorld<S> w(settings_of_way<S>(way));
  w.use_simd(simd);
  const ClusterGround ground = ClusterGround::of(w);
  std::vector<ParticleId> former;
  for (int i = 0; i < past; ++i) former.push_back(w.create(particle_at<S>({30.0 + i, 9, 30})));
  while (!former.empty()) {
    w.destroy(former.back());
    former.pop_back();
  }
  std::vector<Cluster<S>> clusters;
  for (int i = 0; i < kClusters; ++i) clusters.emplace_back(i, ground);
  std::vector<std::size_t> there;
  for (const int turn : turns) {
    const auto i = static_cast<std::size_t>(turn);
    if (std::find(there.begin(), there.end(), i) == there.end()) there.push_back(i);
    clusters[i].make_next(w);
  }
  for (const std::size_t i : there) {
    while (clusters[i].make_next(w)) {}
  }
  Motions motions(kClusters);
  for (int frame = 0; frame < kFrames; ++frame) {
    for (const std::size_t i : there) clusters[i].play(w, frame);
    const ParticleReport report = w.step();
    for (const std::size_t i : there) {
      motions[i].push_back(clusters[i].hash(w));
      if (seen != nullptr) seen->apart = seen->apart && clusters[i].keeps_apart(w);
    }
    if (seen == nullptr) continue;
    seen->contacts = std::max(seen->contacts, w.counts().contacts);
    seen->unresolved += report.unresolved;
    seen->begins += static_cast<std::uint32_t>(w.events().contact_begin.size());
  }
  return motions;
}

void expect_equal(const Motions& now, const Motions& expected, std::uint32_t way, const char* what) {
  for (std::size_t i = 0; i < kClusters; ++i) {
    for (std::size_t f = 0; f < now[i].size(); ++f) {
      ASSERT_EQ(now[i][f], expected[i][f]) << what << ", way " << way << ": cluster " << i << " at frame " << f;
    }
  }
}

template <class S> class ParticleIslands : public ::testing::Test {};
TYPED_TEST_SUITE(ParticleIslands, AllScalars);

TYPED_TEST(ParticleIslands, move_the_same_in_whatever_order_they_were_made_and_beside_whatever_else) {
  using S = TypeParam;
  std::vector<int> order(kClusters);
  std::iota(order.begin(), order.end(), 0);
  const std::vector<int> backwards(order.rbegin(), order.rend());
  Chance chance(5);
  std::vector<int> mixed;
  for (int i = 0; i < 300; ++i) mixed.push_back(static_cast<int>(chance.below(kClusters)));
  for (std::uint32_t way = 0; way < kParticleWays; ++way) {
    SCOPED_TRACE(way);
    Seen seen;
    const Motions expected = motions_of<S>(way, order, Simd::best, 0, &seen);
    EXPECT_TRUE(seen.apart) << "clusters met";
    EXPECT_GT(seen.contacts, 8u);
    EXPECT_GT(seen.begins, 20u);
    if (settings_of_way<S>(way).solver == ParticleSolver::worst_first) {
      EXPECT_GT(seen.unresolved, 0u) << "no cluster came to its limit, so this shows nothing of limits";
    }
    // A sample takes one order and every third kind, others in the next way and scalar.
    const std::uint32_t turn = way + static_cast<std::uint32_t>(pick<S>(0, 1, 2, 3));
    if (wants_whole() || turn % 2 == 0) expect_equal(motions_of<S>(way, backwards), expected, way, "backwards");
    if (wants_whole() || turn % 2 == 1)
      expect_equal(motions_of<S>(way, mixed, Simd::scalar, 11), expected, way, "mixed, in slots used before");
    // Time division cuts the sub-step of the whole world where any two meet: company shows, order does not.
    if (settings_of_way<S>(way).stepping == Stepping::time_division) continue;
    for (int i = 0; i < Cluster<S>::kKinds; ++i) {
      if (wants_whole() || (turn + static_cast<std::uint32_t>(i)) % 3 == 0)
        expect_equal(motions_of<S>(way, {i}), expected, way, "alone");
    }
  }
}

}  // namespace particle_islands_test
}  // namespace isostep::test
