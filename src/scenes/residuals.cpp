// Residuals, from the manifolds of now and the impulses that contacts remember.
// SPDX-License-Identifier: MIT
#include "residuals.hpp"

#include <algorithm>
#include <cmath>

#include "isostep/dynamics/contact.hpp"
#include "isostep/store/state.hpp"
#include "isostep/store/view_manifold.hpp"
#include "measure.hpp"

namespace isostep::scenes {
namespace {

using D3 = Vec3<double>;

/// A contact in doubles.
struct Touch {
  D3 normal, friction;   // [1] from a to b, [m/s] on b
  D3 slip;               // [m/s] of b against a, across the normal, in the middle of the points
  double load = 0;       // [m/s] of all points
  double limit = 0;      // [1] friction
  double signorini = 0;  // [m^2/s^2] sum of squares over the points
  int points = 0;
};

D3 clamped(D3 v, double most) {
  const double length = length_of(v);
  return length > most ? v * (most / length) : v;
}

template <class S> class Residuals {
 public:
  explicit Residuals(const World<S>& world) : world_(world), state_(world.state()) {}

  ContactResiduals of_all() const {
    ContactResiduals found;
    double points = 0;
    for (const Contact<S>& contact : state_.contacts) {
      const Touch touch = touch_of(contact);
      if (touch.points == 0) continue;
      ++found.contacts;
      points += touch.points;
      found.signorini += touch.signorini;
      const double beyond = std::max(length_of(touch.friction) - touch.limit * touch.load, 0.0);
      found.coulomb += beyond * beyond;
      const D3 best = clamped(touch.friction - touch.slip, touch.limit * touch.load);
      const D3 apart = touch.friction - best;
      found.dissipation += dot(apart, apart);
    }
    if (found.contacts == 0) return found;
    found.signorini = std::sqrt(found.signorini / points);
    found.coulomb = std::sqrt(found.coulomb / found.contacts);
    found.dissipation = std::sqrt(found.dissipation / found.contacts);
    return found;
  }

 private:
  BodyId id_of(std::uint32_t slot) const { return state_.body_slots.template id_of<BodyId>(slot); }

  /// [m/s] Returns the body's velocity where `arm` [m] leads from its centre of mass.
  static D3 velocity_at(const BodyView<S>& body, D3 arm) {
    return in_double(body.state->velocity) + cross(in_double(body.state->angular_velocity), arm);
  }

  /// Points whose names changed with the step's motion carry no impulse that is known: such contacts are left out.
  Touch touch_of(const Contact<S>& contact) const {
    Touch touch;
    const BodyView<S> a = world_.view(id_of(contact.key.body_a)), b = world_.view(id_of(contact.key.body_b));
    const Material<S>&of_a = a.properties->material, &of_b = b.properties->material;
    if (!(of_a.surface_velocity == Vec3<S>::zero()) || !(of_b.surface_velocity == Vec3<S>::zero())) return touch;
    const Manifold<S> manifold = detail::manifold_of(a, leaf_at(a.children, a.contents, contact.key.child_a), b,
                                                     leaf_at(b.children, b.contents, contact.key.child_b));
    touch.normal = in_double(manifold.normal);
    touch.friction = in_double(contact.friction_impulse);
    touch.limit = to_double(mixed_friction(of_a.friction, of_b.friction));
    const D3 between = in_double(b.state->centre - a.state->centre);
    D3 slip = {0, 0, 0};
    for (int i = 0; i < manifold.count; ++i) {
      const ManifoldPoint<S>& point = manifold.points[i];
      const auto* const name = std::find(contact.features, contact.features + contact.count, point.feature);
      if (name == contact.features + contact.count) return {};
      const double load = to_double(contact.normal_impulse[name - contact.features]);
      const D3 arm = in_double(point.position), speed = velocity_at(b, arm - between) - velocity_at(a, arm);
      const double opening = dot(speed, touch.normal) + rate() * std::max(to_double(point.separation), 0.0);
      const double both = std::min(load, opening);
      touch.signorini += both * both;
      touch.load += load;
      slip = slip + speed;
      ++touch.points;
    }
    if (touch.points == 0) return touch;
    slip = slip * (1.0 / touch.points);
    touch.slip = slip - touch.normal * dot(slip, touch.normal);
    return touch;
  }
  /// [1/s] Of velocities' integration: what a gap may close at.
  double rate() const {
    const Settings<S>& s = world_.settings();
    return integration_rate(s.solver, s.hz, s.substeps);
  }

  const World<S>& world_;
  const WorldState<S>& state_;
};

}  // namespace

template <class S> ContactResiduals measure_residuals(const World<S>& world) { return Residuals<S>(world).of_all(); }

#define ISO_INSTANTIATE(S) template ContactResiduals measure_residuals<S>(const World<S>&);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes
