// Bodies of world_base.hpp, over an engine with state_, desk_, commands_, load, hash, view and a portable form.
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "isostep/scalar/environment.hpp"
#include "isostep/state/fields.hpp"
#include "isostep/state/members.hpp"
#include "isostep/state/world_base.hpp"
#include "isostep/state/world_desk.hpp"

namespace isostep {

template <class World>
WorldBase<World>::WorldBase(const typename Parts::Settings& settings)
    : engine_(std::make_unique<typename Parts::Engine>(settings)) {}
template <class World> WorldBase<World>::~WorldBase() = default;
template <class World> WorldBase<World>::WorldBase(WorldBase&& other) noexcept : engine_(std::move(other.engine_)) {
  engine_->desk_.detach();
  other.engine_ = std::make_unique<typename Parts::Engine>(engine_->state_.settings);
}
template <class World> auto WorldBase<World>::operator=(WorldBase&& other) noexcept -> WorldBase& {
  if (this == &other) return *this;
  engine_ = std::move(other.engine_);
  engine_->desk_.detach();
  other.engine_ = std::make_unique<typename Parts::Engine>(engine_->state_.settings);
  return *this;
}

template <class World> auto WorldBase<World>::settings() const -> const typename Parts::Settings& {
  return engine_->state_.settings;
}
template <class World> std::uint64_t WorldBase<World>::tick() const { return engine_->state_.tick; }

template <class World> const FaultReport& WorldBase<World>::fault() const { return engine_->desk_.faults.last(); }
template <class World> const FaultReport& WorldBase<World>::first_fault() const {
  return engine_->desk_.faults.first();
}
template <class World> void WorldBase<World>::forget_faults() { engine_->desk_.faults.forget(); }
template <class World> bool WorldBase<World>::refuse(const char* call, const FaultReport& report) {
  return engine_->desk_.faults.refuse_call(call, report);
}
template <class World> void WorldBase<World>::set_fault_handler(const FaultHandler& handler) {
  engine_->desk_.faults.set_handler(handler);
}

template <class World> void WorldBase<World>::record_to(std::vector<std::uint8_t>* log) {
  engine_->desk_.journal.record_to(log);
}
template <class World> bool WorldBase<World>::records_to(const std::vector<std::uint8_t>* log) const {
  return engine_->desk_.journal.records_to(log);
}
template <class World> Result<void> WorldBase<World>::step_recorded(Bytes input) {
  return step_recorded(input, {[](void* world) { static_cast<World*>(world)->step(); }, static_cast<World*>(this)});
}
template <class World> Result<void> WorldBase<World>::step_recorded(Bytes input, const Stepper& stepper) {
  if (!engine_->desk_.enter("step_recorded").allowed())
    return Error{ErrorCode::invalid, "called while the world steps", "commands"};
  World& world = static_cast<World&>(*this);
  return play_commands<EveryCommand>(
      input, [&](const auto& command) ISO_INLINE_LAMBDA { return static_cast<bool>(world.apply(command)); },
      [&]() ISO_INLINE_LAMBDA { stepper.step(stepper.user); });
}
template <class World> void WorldBase<World>::trace_to(std::vector<std::uint64_t>* hashes) {
  engine_->desk_.trace = hashes;
}
template <class World> std::uint64_t WorldBase<World>::loads() const { return engine_->desk_.journal.loads(); }

template <class World> WorldBase<World>::Snapshot::Snapshot() = default;
template <class World> WorldBase<World>::Snapshot::~Snapshot() = default;
template <class World> WorldBase<World>::Snapshot::Snapshot(Snapshot&& other) noexcept = default;
template <class World> auto WorldBase<World>::Snapshot::operator=(Snapshot&& other) noexcept -> Snapshot& = default;
template <class World> std::size_t WorldBase<World>::Snapshot::bytes() const {
  if (state_ == nullptr) return 0;  // never saved to, or moved from
  detail::StateSize arrays;
  State::members(arrays, std::as_const(*state_));
  return sizeof(State) + arrays.value();
}
template <class World> void WorldBase<World>::save(Snapshot& to) const {
  if (to.state_ == nullptr) to.state_ = std::make_unique<State>();
  *to.state_ = engine_->state_;
}
template <class World> bool WorldBase<World>::load(const Snapshot& from) {
  const ExclusiveCall call = engine_->desk_.enter("load");
  if (!call.allowed()) return false;
  const auto refuse = [&](const char* expected) {
    return engine_->desk_.faults.refuse_call("load", {Fault::bad_snapshot, "", "from", expected});
  };
  if (from.state_ == nullptr) return refuse("one that was saved to");
  typename Parts::Settings its = from.state_->settings;
  its.gravity = settings().gravity;
  if (!(its == settings())) return refuse("one of a world with the same settings");
  pin_floats([&] { engine_->load(*from.state_); });
  return true;
}
template <class World> std::uint64_t WorldBase<World>::hash() const { return engine_->hash(); }
template <class World> void WorldBase<World>::write_portable(Writer& writer) const { engine_->write_portable(writer); }
template <class World> Result<void> WorldBase<World>::read_portable(Reader& reader) {
  const ExclusiveCall call = engine_->desk_.enter("read_portable");
  if (call.allowed()) return pin_floats([&] { return engine_->read_portable(reader); });
  reader.fail(ErrorCode::invalid, "read while the world steps");
  return reader.result(Parts::kName);
}
template <class World> auto WorldBase<World>::state() const -> const State& { return engine_->state_; }
template <class World> StageView WorldBase<World>::state_fields() const { return engine_->view(Parts::kStages); }

}  // namespace isostep
