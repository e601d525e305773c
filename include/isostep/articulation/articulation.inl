// Bodies of articulation.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "isostep/articulation/articulated_accelerations.inl"
#include "isostep/articulation/articulated_inertias.inl"
#include "isostep/articulation/articulated_poses.inl"
#include "isostep/articulation/articulated_tree.inl"
#include "isostep/articulation/articulation_step.inl"
#include "isostep/articulation/articulation_validator.hpp"
#include "isostep/articulation/free_motion.inl"
#include "isostep/articulation/joint_work.inl"
#include "isostep/scalar/environment.hpp"
#include "isostep/state/members.hpp"

namespace isostep {

namespace detail {
/// This bit stands in the first word of a portable articulation, beside the scalar's id.
inline constexpr std::uint32_t kArticulationBit = 0x40000000u;
}  // namespace detail

template <class S> Articulation<S>::Articulation() : engine_(std::make_unique<Engine>()) {
  engine_->use(engine_->tree);
}
template <class S> Articulation<S>::~Articulation() = default;
template <class S> Articulation<S>::Articulation(Articulation&& other) noexcept : Articulation() {
  std::swap(engine_, other.engine_);
}
template <class S> auto Articulation<S>::operator=(Articulation&& other) noexcept -> Articulation& {
  if (this == &other) return *this;
  engine_ = std::move(other.engine_);
  other.engine_ = std::make_unique<Engine>();
  other.engine_->use(other.engine_->tree);
  return *this;
}

/// Everything at rest where coordinates are 0.
template <class S> void Articulation<S>::Engine::use(std::shared_ptr<const Tree> next) {
  tree = std::move(next);
  links.reset(*tree);
  state = {};
  state.coordinates.assign(tree->coordinates, S(0));
  state.rotations.assign(tree->rotations, Quat<Unit<S>>::identity());
  state.speeds.assign(tree->speeds, S(0));
  for (const ArticulationLink<S>& l : tree->definition.links) state.drives.push_back(l.drive);
  loads.assign(tree->links.size(), LinkLoad<S>{Vec3<S>::zero(), Vec3<S>::zero()});
  state.loads = loads;
  middle = state.speeds;
  before = state;
  refresh();
}

template <class S> Result<void> Articulation<S>::build(const ArticulationDefinition<S>& definition) {
  return pin_floats([&]() -> Result<void> {
    const auto tree = detail::make_tree(definition);
    if (!tree) return tree.error();
    engine_->use(tree.value());
    return {};
  });
}
template <class S> const ArticulationDefinition<S>& Articulation<S>::definition() const {
  return engine_->tree->definition;
}
template <class S> std::uint32_t Articulation<S>::links() const {
  return static_cast<std::uint32_t>(engine_->tree->links.size());
}
template <class S> std::uint64_t Articulation<S>::tick() const { return engine_->state.tick; }
template <class S> const FaultReport& Articulation<S>::fault() const { return engine_->faults.last(); }
template <class S> const FaultReport& Articulation<S>::first_fault() const { return engine_->faults.first(); }
template <class S> void Articulation<S>::forget_faults() { engine_->faults.forget(); }
template <class S> void Articulation<S>::set_fault_handler(const FaultHandler& handler) {
  engine_->faults.set_handler(handler);
}
template <class S> const ArticulationState<S>& Articulation<S>::state() const { return engine_->state; }
template <class S> ArticulationReport Articulation<S>::step() { return engine_->step(); }

// ---- commands

template <class S> FaultReport Articulation<S>::Engine::fault_of_link(std::uint32_t link) const {
  return detail::Checklist().proper(link < tree->links.size(), "link", "a link of the definition").report();
}

template <class S> bool Articulation<S>::set_coordinates(std::uint32_t link, const JointCoordinates<S>& to) {
  return pin_floats([&] {
    Engine& e = *engine_;
    if (!e.faults.accept_call("set_coordinates", e.fault_of_link(link))) return false;
    const detail::PreparedLink<S>& l = e.tree->links[link];
    const FaultReport report =
        detail::Checklist()
            .in_range(detail::fits_position(e.tree->definition.links[link], to.position), "coordinates.position",
                      "32768 rad, twice Limits::extent() or, of a free link, Limits::position()")
            .proper(detail::is_rotation<S>(to.rotation), "coordinates.rotation", detail::kUnitLength)
            .in_range(detail::fits_velocity(to), "coordinates.velocity",
                      "Limits::speed() and 1024 rad/s along each axis")
            .report();
    if (!e.faults.accept_call("set_coordinates", report)) return false;
    const bool free = l.type == ArticulationJoint::free;
    for (std::uint32_t k = 0; k < (free ? 3u : detail::is_scalar(l.type) ? 1u : 0u); ++k) {
      e.state.coordinates[l.coordinate + k] = to.position[static_cast<int>(k)];
      e.state.speeds[l.speed + k] = to.velocity[static_cast<int>(k)];
    }
    if (l.type == ArticulationJoint::hinge && !l.limited) {
      const S whole = detail::kHalfTurn<S> + detail::kHalfTurn<S>;
      S& q = e.state.coordinates[l.coordinate];
      while (detail::kHalfTurn<S> < q) q -= whole;
      while (q < -detail::kHalfTurn<S>) q += whole;
    }
    for (std::uint32_t k = 0; k < 3 && detail::has_rotation(l.type); ++k)
      e.state.speeds[l.speed + k + (free ? 3u : 0u)] = to.angular_velocity[static_cast<int>(k)];
    if (detail::has_rotation(l.type)) e.state.rotations[l.rotation] = normalise(to.rotation);
    e.refresh();
    return true;
  });
}

template <class S> bool Articulation<S>::set_drive(std::uint32_t link, const ArticulationDrive<S>& drive) {
  return pin_floats([&] {
    Engine& e = *engine_;
    if (!e.faults.accept_call("set_drive", e.fault_of_link(link))) return false;
    const bool sound = detail::check_drive(*e.tree, link, drive).ok();
    const auto report = detail::Checklist().proper(sound, "drive", "what a definition's drive may be").report();
    if (!e.faults.accept_call("set_drive", report)) return false;
    e.state.drives[link] = drive;
    return true;
  });
}

template <class S> bool Articulation<S>::apply_force(std::uint32_t link, Vec3<S> force, Vec3<S> point) {
  return pin_floats([&] {
    Engine& e = *engine_;
    if (!e.faults.accept_call("apply_force", e.fault_of_link(link))) return false;
    const auto fits = [](Vec3<S> v) { return is_finite(v) && detail::within(v, detail::kMostLoad<S>); };
    const bool nearby = is_finite(point) && detail::within(point, Limits<S>::position());
    Vec3<S> lever = nearby ? point - link_centre(link) : Vec3<S>::zero();
    const Vec3<S> all = fits(force) ? saturating_add(e.state.loads[link].force, force) : force;
    const Vec3<S> torque =
        fits(force) ? saturating_add(e.state.loads[link].torque, detail::held_cross(lever, force)) : Vec3<S>::zero();
    const auto report = detail::Checklist()
                            .in_range(nearby, "point", detail::kWithinPosition)
                            .in_range(fits(force) && fits(all) && fits(torque), "force", detail::kMostLoadText)
                            .report();
    if (!e.faults.accept_call("apply_force", report)) return false;
    e.state.loads[link] = {all, torque};
    return true;
  });
}

template <class S> bool Articulation<S>::apply_torque(std::uint32_t link, Vec3<S> torque) {
  return pin_floats([&] {
    Engine& e = *engine_;
    if (!e.faults.accept_call("apply_torque", e.fault_of_link(link))) return false;
    const auto fits = [](Vec3<S> v) { return is_finite(v) && detail::within(v, detail::kMostLoad<S>); };
    const Vec3<S> all = fits(torque) ? saturating_add(e.state.loads[link].torque, torque) : torque;
    const auto report = detail::Checklist().in_range(fits(all), "torque", detail::kMostLoadText).report();
    if (!e.faults.accept_call("apply_torque", report)) return false;
    e.state.loads[link].torque = all;
    return true;
  });
}

// ---- what it tells

template <class S> JointCoordinates<S> Articulation<S>::coordinates(std::uint32_t link) const {
  JointCoordinates<S> m;
  if (links() <= link) return m;
  const detail::PreparedLink<S>& l = engine_->tree->links[link];
  const ArticulationState<S>& s = engine_->state;
  const bool free = l.type == ArticulationJoint::free;
  for (std::uint32_t k = 0; k < (free ? 3u : detail::is_scalar(l.type) ? 1u : 0u); ++k) {
    m.position[static_cast<int>(k)] = s.coordinates[l.coordinate + k];
    m.velocity[static_cast<int>(k)] = s.speeds[l.speed + k];
  }
  for (std::uint32_t k = 0; k < 3 && detail::has_rotation(l.type); ++k)
    m.angular_velocity[static_cast<int>(k)] = s.speeds[l.speed + k + (free ? 3u : 0u)];
  if (detail::has_rotation(l.type)) m.rotation = s.rotations[l.rotation];
  return m;
}
template <class S> ArticulationDrive<S> Articulation<S>::drive(std::uint32_t link) const {
  return link < links() ? engine_->state.drives[link] : ArticulationDrive<S>{};
}

namespace detail {
/// [m] world: the base, or the free link's anchor, from which places are measured.
template <class S, class Engine> Vec3<S> origin_of(const Engine& e) {
  const Pose<S>& base = e.tree->definition.settings.base;
  if (!e.tree->free) return base.position;
  const Pose<S>& frame = e.tree->definition.links[0].frame_a;
  const S* const q = e.state.coordinates.data() + e.tree->links[0].coordinate;
  const Vec3<S> anchor = frame.position + to_matrix(normalise(frame.orientation)) * Vec3<S>{q[0], q[1], q[2]};
  return base.position + to_matrix(normalise(base.orientation)) * anchor;
}
}  // namespace detail

template <class S> Pose<S> Articulation<S>::link_pose(std::uint32_t link) const {
  if (links() <= link) return Pose<S>::identity();
  return pin_floats([&]() -> Pose<S> {
    const Engine& e = *engine_;
    const detail::LinkWork<S>& w = e.links.of(link);
    const Vec3<S> back = w.turn * e.tree->definition.links[link].frame_b.position;
    return {detail::origin_of<S>(e) + detail::held_product(w.place, e.tree->unscale) - back, w.orientation};
  });
}

template <class S> Vec3<S> Articulation<S>::link_centre(std::uint32_t link) const {
  if (links() <= link) return Vec3<S>::zero();
  return pin_floats([&] {
    const Engine& e = *engine_;
    const detail::LinkWork<S>& w = e.links.of(link);
    return detail::origin_of<S>(e) + detail::held_product(w.place + w.centre, e.tree->unscale);
  });
}

template <class S> LinkVelocity<S> Articulation<S>::link_velocity(std::uint32_t link) const {
  if (links() <= link) return {Vec3<S>::zero(), Vec3<S>::zero()};
  return pin_floats([&]() -> LinkVelocity<S> {
    const Engine& e = *engine_;
    const detail::LinkWork<S>& w = e.links.of(link);
    Vec3<S> linear = detail::held_product(w.moving, e.tree->unscale);
    if (e.tree->free) {
      const S* const v = e.state.speeds.data() + e.tree->links[0].speed;
      linear = detail::held_sum(linear, e.links.of(0).frame * Vec3<S>{v[0], v[1], v[2]});
    }
    const Vec3<S> back = w.turn * e.tree->definition.links[link].frame_b.position;
    return {detail::held_sum(linear, -detail::held_cross(w.spin, back)), w.spin};
  });
}

template <class S> LinkLoad<S> Articulation<S>::joint_load(std::uint32_t link) const {
  return link < links() ? engine_->loads[link] : LinkLoad<S>{Vec3<S>::zero(), Vec3<S>::zero()};
}

// ---- state

template <class S> Articulation<S>::Snapshot::Snapshot() = default;
template <class S> Articulation<S>::Snapshot::~Snapshot() = default;
template <class S> Articulation<S>::Snapshot::Snapshot(Snapshot&& other) noexcept = default;
template <class S> auto Articulation<S>::Snapshot::operator=(Snapshot&& other) noexcept -> Snapshot& = default;

template <class S> void Articulation<S>::save(Snapshot& to) const {
  if (to.kept_ == nullptr) to.kept_ = std::make_unique<typename Snapshot::Kept>();
  to.kept_->tree = engine_->tree;
  to.kept_->state = engine_->state;
}
template <class S> bool Articulation<S>::load(const Snapshot& from) {
  Engine& e = *engine_;
  if (from.kept_ == nullptr)
    return e.faults.refuse_call("load", {Fault::bad_snapshot, "", "from", "one that was saved to"});
  if (e.tree != from.kept_->tree) e.use(from.kept_->tree);
  e.state = from.kept_->state;
  e.loads.assign(e.loads.size(), LinkLoad<S>{Vec3<S>::zero(), Vec3<S>::zero()});
  e.refresh();
  return true;
}
template <class S> std::uint64_t Articulation<S>::hash() const {
  detail::StateHasher hasher;
  hasher("definition", engine_->tree->hash);
  ArticulationState<S>::members(hasher, std::as_const(engine_->state));
  return hasher.value();
}
template <class S> void Articulation<S>::write_portable(Writer& writer) const {
  writer.write(ScalarTraits<S>::kId | detail::kArticulationBit);
  detail::write_definition(writer, engine_->tree->definition);
  ArticulationState<S>::members(detail::StateWriter(writer), std::as_const(engine_->state));
}
template <class S> Result<void> Articulation<S>::read_portable(Reader& reader) {
  return pin_floats([&]() -> Result<void> {
    if (reader.read<std::uint32_t>() != (ScalarTraits<S>::kId | detail::kArticulationBit) && reader.ok())
      reader.fail(ErrorCode::incompatible, "not written by an articulation of this scalar");
    const ArticulationDefinition<S> definition = detail::read_definition<S>(reader);
    ArticulationState<S> next;
    ArticulationState<S>::members(detail::StateReader(reader), next);
    std::shared_ptr<const detail::ArticulatedTree<S>> tree = std::make_shared<detail::ArticulatedTree<S>>();
    if (reader.ok() && !definition.links.empty()) {
      const auto made = detail::make_tree(definition);
      if (!made) reader.fail(ErrorCode::corrupt, "its definition is refused");
      else tree = made.value();
    }
    if (reader.ok()) {
      if (const char* rule = detail::ArticulationValidator<S>(*tree, next).broken_rule())
        reader.fail(ErrorCode::corrupt, rule);
    }
    const Result<void> result = reader.result("articulation");
    if (!reader.ok()) return result;
    engine_->use(std::move(tree));
    engine_->state = std::move(next);
    engine_->refresh();
    return result;
  });
}

}  // namespace isostep
