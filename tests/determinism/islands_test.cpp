// Islands that never touch do not know of each other: in whatever order they were made, beside whatever else, every
// body moves bit for bit as it does when its island is alone.
// SPDX-License-Identifier: MIT

#include "determinism/islands.hpp"

#include <numeric>
#include <string_view>
#include <tuple>

#include "built.hpp"
#include "determinism/mess.hpp"
#include "determinism/solver_cases.hpp"
#include "examples/thread_pool.hpp"
#include "isostep/state/fields.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace islands_test {

constexpr int kIslands = 12;

/// Enough to fall asleep and be woken; twice with the solvers that take their time over each.
constexpr int frames_of(SolverName solver) {
  return solver == SolverName::soft_step || solver == SolverName::pgs ? 240 : 110;
}

/// A look at all that a stage leaves takes longer than the stage.
constexpr int kWatched = 60;

/// The way in which a world comes to its islands.
struct Circumstances {
  std::vector<int> turns;  // an island makes its next body, again and again
  std::uint32_t past = 0;  // bodies that were there before and left their slots
  Simd simd = Simd::best;
  TaskRunner runner = {};
  Projection projection = Projection::nonlinear;
};
using Motions = std::vector<std::vector<std::uint64_t>>;  // by island, by frame

/// Slots come back in the order of `past`, some of them: those of an island stay in order among each other.
template <class S> void live_before(World<S>& w, ShapeId shape, std::uint32_t past) {
  std::vector<BodyId> former;
  for (std::uint32_t i = 0; i < past; ++i) former.push_back(w.create(moving<S>(shape, {30, 1.0 + i, 30})));
  for (int i = 0; i < 20; ++i) w.step();
  for (std::size_t i = former.size(); i-- > 0;) w.destroy(former[i]);
}

struct Seen {
  std::uint32_t contacts = 0, begins = 0, asleep = 0, woke = 0;
  std::uint64_t left = 0;  // islands that worst_first left with something still to be done
  bool apart = true;

  static void after(void* user, Stage stage, const StageView& view) {
    if (stage != Stage::solve_substeps) return;
    view.visit({[](void* seen, const PathPart& path, FieldFormat, std::uint64_t bits) {
                  if (path.name == nullptr || std::string_view(path.name) != "islands_left") return;
                  static_cast<Seen*>(seen)->left += bits;
                },
                user});
  }
};

template <class S> Motions motions_of(SolverName solver, const Circumstances& how, Seen* seen = nullptr) {
  Settings<S> s = settings<S>(-10, 60, 4);
  s.solver = solver;
  s.projection = how.projection;
  World<S> w(s);
  w.use_simd(how.simd);
  w.use_threads(how.runner);
  add_ground(w);
  const IslandShapes shapes = IslandShapes::of(w);
  live_before(w, shapes.box, how.past);
  std::vector<Island<S>> islands;
  for (int i = 0; i < kIslands; ++i) islands.emplace_back(i, shapes);
  std::vector<int> there;
  for (const int turn : how.turns) {
    if (std::find(there.begin(), there.end(), turn) == there.end()) there.push_back(turn);
    islands[static_cast<std::size_t>(turn)].make_next(w);
  }
  for (const int i : there) {
    while (islands[static_cast<std::size_t>(i)].make_next(w)) {}
  }
  const bool watched = seen != nullptr && solver == SolverName::worst_first;
  Motions motions(kIslands);
  for (int frame = 0; frame < frames_of(solver); ++frame) {
    for (const int i : there) islands[static_cast<std::size_t>(i)].play(w, frame);
    w.step(watched && frame < kWatched ? StageObserver{&Seen::after, seen} : StageObserver{});
    for (const int i : there) {
      const auto at = static_cast<std::size_t>(i);
      motions[at].push_back(islands[at].hash(w));
      if (seen != nullptr) seen->apart = seen->apart && islands[at].keeps_apart(w);
    }
    if (seen == nullptr) continue;
    seen->contacts = std::max(seen->contacts, w.counts().contacts);
    seen->asleep = std::max(seen->asleep, w.counts().asleep);
    seen->begins += static_cast<std::uint32_t>(w.events().contact_begin.size());
    seen->woke += static_cast<std::uint32_t>(w.events().woke.size());
  }
  return motions;
}

/// Compares the motions of islands that were there.
void expect_equal(const Motions& now, const Motions& expected, const char* what) {
  for (std::size_t i = 0; i < kIslands; ++i) {
    for (std::size_t f = 0; f < now[i].size(); ++f) {
      ASSERT_EQ(now[i][f], expected[i][f]) << what << ": island " << i << " at frame " << f;
    }
  }
}

template <class S> int scalar_of() { return static_cast<int>(pick<S>(0, 1, 2, 3)); }

std::vector<int> in_order() {
  std::vector<int> turns(kIslands);
  std::iota(turns.begin(), turns.end(), 0);
  return turns;
}
std::vector<int> in_turn(std::uint64_t seed) {
  Dice dice(seed);
  std::vector<int> turns;
  for (int i = 0; i < 400; ++i) turns.push_back(static_cast<int>(dice.below(kIslands)));
  return turns;
}

template <class Case> class Islands : public ::testing::Test {
 protected:
  using Number = std::tuple_element_t<0, Case>;
  static constexpr SolverName kSolver = std::tuple_element_t<1, Case>::value;
  static const Motions& expected() {
    static const Motions motions = motions_of<Number>(kSolver, {in_order()});
    return motions;
  }
};
TYPED_TEST_SUITE(Islands, SolverCases, SolverCaseNames);

TYPED_TEST(Islands, are_busy_and_apart_and_sleep_and_wake) {
  Seen seen;
  const Motions motions = motions_of<typename TestFixture::Number>(this->kSolver, {in_order()}, &seen);
  EXPECT_EQ(motions, this->expected());
  EXPECT_TRUE(seen.apart) << "islands met";
  EXPECT_GT(seen.contacts, 60u);
  EXPECT_GT(seen.begins, 80u);
  EXPECT_GT(seen.asleep, 0u);
  EXPECT_GT(seen.woke, 0u);
  if (this->kSolver == SolverName::worst_first) {
    EXPECT_GT(seen.left, 0u) << "no island came to its limit, so this shows nothing of limits";
  }
}

TYPED_TEST(Islands, move_as_each_does_alone) {
  for (int i = 0; i < Island<float>::kKinds; ++i) {
    expect_equal(motions_of<typename TestFixture::Number>(this->kSolver, {{i}}), this->expected(), "alone");
  }
}

TYPED_TEST(Islands, move_the_same_in_whatever_order_they_were_made) {
  using S = typename TestFixture::Number;
  std::vector<int> backwards = in_order();
  std::reverse(backwards.begin(), backwards.end());
  const struct {
    Circumstances how;
    const char* what;
  } orders[] = {
      {{backwards}, "backwards"}, {{in_turn(1)}, "in turn"}, {{in_turn(2), 17, Simd::scalar}, "in slots used before"}};
  for (int i = 0; i < 3; ++i) {  // of a sample one a scalar and solver, each with every solver
    if (!wants_whole() && (scalar_of<S>() + static_cast<int>(this->kSolver)) % 3 != i) continue;
    expect_equal(motions_of<S>(this->kSolver, orders[i].how), this->expected(), orders[i].what);
  }
}

TYPED_TEST(Islands, move_as_each_does_alone_however_worst_first_ends_overlaps) {
  ISO_NEEDS_BOOK();
  using S = typename TestFixture::Number;
  if (this->kSolver != SolverName::worst_first) return;
  for (std::uint32_t i = 0; i < kProjections; ++i) {
    if (!wants_whole() && static_cast<std::uint32_t>(scalar_of<S>()) != i) continue;  // of a sample one a scalar
    SCOPED_TRACE(kProjectionNames[i]);
    const auto projection = static_cast<Projection>(i);
    const Motions together = motions_of<S>(this->kSolver, {in_order(), 0, Simd::best, {}, projection});
    EXPECT_EQ(together == this->expected(), projection == Projection::nonlinear);
    for (int k = 0; k < Island<float>::kKinds; ++k) {
      expect_equal(motions_of<S>(this->kSolver, {{k}, 0, Simd::best, {}, projection}), together, "alone");
    }
    expect_equal(motions_of<S>(this->kSolver, {in_turn(1), 17, Simd::scalar, {}, projection}), together, "in turn");
  }
}

}  // namespace islands_test
}  // namespace isostep::test
