// Match: a small game of two to eight pucks on a crowded floor; what sessions, the tool, the demo and benchmarks play.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/fields.hpp"
#include "isostep/core/random.hpp"
#include "isostep/session/timeline/frame.hpp"
#include "isostep/state/composite.hpp"
#include "isostep/world/world.hpp"

namespace isostep::scenes {

/// The action of a button while its wait is over; a held button acts again and again.
enum class MatchAction : std::uint8_t {
  jump,     // when something is underfoot
  shove,    // what is near flies off
  spawn,    // where there is room, a body of a new shape, thrown towards the aim; the oldest of kMaxSpawned goes
  strike,   // a ray towards the aim: a spawned body vanishes, another is pushed
  tether,   // a rope to what is nearest, or off with the one there is
  reverse,  // the mill turns the other way
  tilt      // gravity leans towards the aim for a while
};
inline constexpr std::size_t kMatchActions = 7;

/// Four bytes, any of which is a number: only a button that does not exist makes an input invalid. Sessions ask
/// `valid` of what comes from outside; `Match` takes an invalid input for no input, alike everywhere.
struct MatchInput {
  std::int8_t push_x = 0, push_z = 0;  // [1/128] of the full push
  std::uint8_t buttons = 0;            // bit n: MatchAction n
  std::uint8_t aim = 0;                // [1/256 turn] from +x towards +z

  bool valid() const { return buttons >> kMatchActions == 0; }
  bool pressed(MatchAction action) const { return (buttons >> static_cast<unsigned>(action) & 1u) != 0; }
  friend bool operator==(const MatchInput&, const MatchInput&) = default;

  ISO_FIELDS(push_x, push_z, buttons, aim)
};
static_assert(kHasNoPadding<MatchInput> && sizeof(MatchInput) == 4);

/// The input that a player might give: another choice every 9 to 24 frames, its buttons held for the first three. A
/// pure function.
MatchInput bot_input(std::uint64_t seed, int player, Frame frame);

/// Players of one arena: its state has a place for each.
inline constexpr std::size_t kMostPucks = 8;

/// Peers must agree on all of it. Numbers outside their range count as its nearer end.
struct MatchSettings {
  std::int32_t players = 2;   // 1 .. kMostPucks
  std::int32_t pile = 60;     // bodies, 0 .. 4000
  std::uint64_t seed = 1;     // of sizes, places and shapes
  std::int32_t hz = 60;       // [1/s] as Settings
  std::int32_t substeps = 8;  // as Settings

  friend bool operator==(const MatchSettings&, const MatchSettings&) = default;

  ISO_FIELDS(players, pile, seed, hz, substeps)
};

/// The events of a match, for sounds and sparks. Those of prediction and truth are alike when nothing was mispredicted:
/// an event holds names, no measures.
enum class MatchEventKind : std::uint16_t {
  jump,
  shove,
  spawn,   // body: what was made
  vanish,  // body: what was destroyed, by a ray or a hard hit
  clash,   // body: the other puck
  goal,    // in the ring
  fall     // off the floor, and put back
};
struct MatchEvent {
  MatchEventKind kind = MatchEventKind::jump;
  std::uint16_t player = 0;
  std::uint32_t body = 0;  // slot; the player's puck where the kind names no other

  friend bool operator==(const MatchEvent&, const MatchEvent&) = default;

  ISO_FIELDS(kind, player, body)
};
inline constexpr std::size_t kMaxMatchEvents = 32;  // a step; what is more goes unheard
inline constexpr std::size_t kMaxSpawned = 24;

/// The game's own state, beside the world.
struct MatchState {
  struct Player {
    JointId tether;      // null or stale: none
    std::int32_t score;  // clash 1, hard hit on a spawned body 1, goal 3, fall -1
    std::uint32_t falls;
    std::uint16_t waits[kMatchActions + 1];  // [frames] until the action is ready; the last is 0

    ISO_FIELDS(tether, score, falls, waits)
  };

  Pcg32 random;
  std::uint64_t tick;
  std::uint64_t level_at;       // the tick at which gravity points down again
  std::uint32_t away;           // bit n: player n is disconnected
  std::uint32_t spawn_count;    // ever; the next one's place in the ring is its remainder
  BodyId spawned[kMaxSpawned];  // null: none
  ShapeId shapes[kMaxSpawned];  // each spawned body's own
  Player players[kMostPucks];

  ISO_FIELDS(random, tick, level_at, away, spawn_count, spawned, shapes, players)
};
static_assert(kHasNoPadding<MatchState>);

/// Floor, four walls with open corners, a ring (sensor) above the middle, a mill that stirs a pile of mixed shapes, two
/// ropes with a ball, and the pucks. Models Simulation, PortableState and ReplayableSimulation.
template <class S> class Match {
  using State = Composite<World<S>, MatchState>;

 public:
  using Scalar = S;
  using Input = MatchInput;
  using Snapshot = typename State::Snapshot;

  explicit Match(const MatchSettings& settings = {});

  /// A missing input is none, a missing status is `confirmed`.
  void step(InputView<MatchInput> inputs);

  void save(Snapshot& to) const;
  void load(const Snapshot& from);
  std::uint64_t hash() const;
  void write_portable(Writer& writer) const;
  /// Reads a match of the same settings; another's is `incompatible`.
  Result<void> read_portable(Reader& reader);

  /// A frame as `step_recorded` takes it: for every player the input and a byte, 1 for disconnected.
  void write_inputs(InputView<MatchInput> inputs, Writer& writer) const;
  Result<void> step_recorded(Bytes input);

  /// The events and the report of the last step; not state.
  std::span<const MatchEvent> events() const;
  const StepReport& report() const;

  const MatchSettings& settings() const;
  /// The world, to be looked at, drawn and recorded; commands are the game's own affair.
  const World<S>& world() const;
  World<S>& world();
  const MatchState& state() const;
  BodyId puck(int player) const;

 private:
  void set_up_pucks(int first_puck, const std::vector<BodyId>& bodies);
  MatchState::Player& player_state(int player);

  // These run before the step.
  void cool_down();
  void attend(int player, bool away);
  void act(int player, const MatchInput& input);
  bool ready(int player, const MatchInput& input, MatchAction action);
  void push(int player, const MatchInput& input);
  void jump(int player);
  void shove(int player);
  void spawn(int player, Vec3<Unit<S>> aim);
  void strike(int player, Vec3<Unit<S>> aim);
  void tether(int player);
  void reverse();
  void tilt(Vec3<Unit<S>> aim);
  ShapeId draw_shape();

  // These run after it.
  void count_touches();
  void count_goals();
  void put_back_fallen();
  void put_back(BodyId body);

  int player_of(BodyId body) const;
  /// Its place in the ring, or -1.
  int spawned_place(BodyId body) const;
  void clear_spawned(int place);
  void untie(BodyId body);
  void emit(MatchEventKind kind, int player, BodyId body);

  MatchSettings settings_;
  State state_;

  // These are the same from the start of every match of these settings.
  std::array<BodyId, kMostPucks> pucks_;
  std::array<Vec3<S>, kMostPucks> starts_;  // [m] of the pucks
  JointId mill_;
  BodyId ring_;
  S half_;  // [m] of the floor's inside

  // These are of the last step.
  StepReport report_;
  std::array<MatchEvent, kMaxMatchEvents> events_;
  std::size_t event_count_;
  std::vector<BodyId> found_;
};

#define ISO_EXTERN(S) extern template class Match<S>;
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep::scenes
