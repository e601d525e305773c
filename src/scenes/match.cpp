// The match's start, its state as bytes, its bots; and the match for every scalar of the library.
// SPDX-License-Identifier: MIT
#include "match.hpp"

#include "build.hpp"
#include "match.inl"
#include "match_arena.hpp"

namespace isostep::scenes {

template <class S>
Match<S>::Match(const MatchSettings& settings)
    : settings_(within_range(settings)), starts_{}, half_(S(0)), report_{}, event_count_(0) {
  MatchPlan plan = plan_match(settings_);
  plan.scene.hz = settings_.hz;
  plan.scene.substeps = settings_.substeps;
  state_.world = World<S>(settings_of<S>(plan.scene));
  World<S>& world = state_.world;
  const Built<S> built = build(plan.scene, world);
  for (std::size_t n = 0; n < built.bodies.size(); ++n) {
    const bool loose =
        world.type(built.bodies[n]) == BodyType::dynamic && n < static_cast<std::size_t>(plan.first_rope);
    world.set_filter(built.bodies[n], {loose ? match_category::kPile : match_category::kArena, 0xffffffffu, 0});
  }
  mill_ = built.joints[static_cast<std::size_t>(plan.mill_joint)];
  ring_ = built.bodies[static_cast<std::size_t>(plan.ring)];
  half_ = value_of<S>(plan.half, "half");
  state_.user.random = Pcg32::seeded(settings_.seed, 1);
  set_up_pucks(plan.first_puck, built.bodies);
}

template <class S> void Match<S>::set_up_pucks(int first_puck, const std::vector<BodyId>& bodies) {
  for (int player = 0; player < settings_.players; ++player) {
    const auto n = static_cast<std::size_t>(player);
    pucks_[n] = bodies[static_cast<std::size_t>(first_puck) + n];
    starts_[n] = state_.world.pose(pucks_[n]).position;
    state_.world.set_filter(pucks_[n], {match_category::kPuck, 0xffffffffu, 0});
  }
}

template <class S> void Match<S>::save(Snapshot& to) const { state_.save(to); }
template <class S> void Match<S>::load(const Snapshot& from) { state_.load(from); }
template <class S> std::uint64_t Match<S>::hash() const { return state_.hash(); }

template <class S> void Match<S>::write_portable(Writer& writer) const {
  writer.write(settings_);
  state_.write_portable(writer);
}
/// The bytes about the game are only ever used as ids, which the world checks, and as counters.
template <class S> Result<void> Match<S>::read_portable(Reader& reader) {
  MatchSettings settings;
  if (reader.read(settings) && !(settings == settings_)) {
    reader.fail(ErrorCode::incompatible, "a match of other settings");
  }
  return reader.ok() ? state_.read_portable(reader) : reader.result("match");
}

template <class S> void Match<S>::write_inputs(InputView<MatchInput> inputs, Writer& writer) const {
  for (std::size_t n = 0; n < static_cast<std::size_t>(settings_.players); ++n) {
    writer.write(n < inputs.size() ? inputs[n] : MatchInput{});
    writer.write(n < inputs.statuses.size() && inputs.status(n) == InputStatus::disconnected);
  }
}
template <class S> Result<void> Match<S>::step_recorded(Bytes input) {
  Reader reader(input);
  const auto players = static_cast<std::size_t>(settings_.players);
  std::array<MatchInput, kMostPucks> values = {};
  std::array<InputStatus, kMostPucks> statuses = {};
  for (std::size_t n = 0; n < players; ++n) {
    reader.read(values[n]);
    statuses[n] = reader.read<bool>() ? InputStatus::disconnected : InputStatus::confirmed;
    if (!values[n].valid()) reader.fail(ErrorCode::invalid, "a button that does not exist");
  }
  reader.expect_end();
  if (reader.ok()) step({{values.data(), players}, {statuses.data(), players}});
  return reader.result("match input");
}

template <class S> std::span<const MatchEvent> Match<S>::events() const { return {events_.data(), event_count_}; }
template <class S> const StepReport& Match<S>::report() const { return report_; }
template <class S> const MatchSettings& Match<S>::settings() const { return settings_; }
template <class S> const World<S>& Match<S>::world() const { return state_.world; }
template <class S> World<S>& Match<S>::world() { return state_.world; }
template <class S> const MatchState& Match<S>::state() const { return state_.user; }
template <class S> BodyId Match<S>::puck(int player) const { return pucks_[static_cast<std::size_t>(player)]; }

MatchInput bot_input(std::uint64_t seed, int player, Frame frame) {
  // Two choices in every 24 frames, the second somewhere in the middle; no two players change together.
  constexpr std::uint32_t kPeriod = 24, kPressed = 3;  // [frames]
  const std::uint32_t time = static_cast<std::uint32_t>(frame) + 7u * static_cast<std::uint32_t>(player);
  const std::uint64_t period = time / kPeriod;
  const auto stream = static_cast<std::uint64_t>(player) + 100;
  Pcg32 random = Pcg32::seeded(seed ^ period << 16, stream);
  const std::uint32_t turn = 9 + random_below(random, 7);
  const std::uint32_t at = time % kPeriod;
  const bool second = at >= turn;
  for (int skipped = 0; second && skipped < 8; ++skipped) random.next();
  MatchInput input;
  const std::uint32_t push = random.next(), choice = random.next();
  if (push % 8 != 0) {  // else stands still
    input.push_x = static_cast<std::int8_t>(push >> 8);
    input.push_z = static_cast<std::int8_t>(push >> 16);
  }
  input.aim = static_cast<std::uint8_t>(choice >> 24);
  const bool pressed = at - (second ? turn : 0) < kPressed;
  constexpr MatchAction kHabits[] = {
      MatchAction::spawn,  MatchAction::spawn,  MatchAction::spawn,  MatchAction::spawn,   MatchAction::shove,
      MatchAction::shove,  MatchAction::jump,   MatchAction::jump,   MatchAction::strike,  MatchAction::strike,
      MatchAction::strike, MatchAction::tether, MatchAction::tether, MatchAction::reverse, MatchAction::tilt};
  const std::uint32_t habit = choice % 16;  // the last: no button
  if (pressed && habit < std::size(kHabits)) {
    input.buttons = static_cast<std::uint8_t>(1u << static_cast<unsigned>(kHabits[habit]));
  }
  return input;
}

#define ISO_INSTANTIATE(S) template class Match<S>;
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes
