// ParticleCoupling<S>: particles of a ParticleWorld meet the shapes of a World and push its bodies.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/math/mat3.hpp"
#include "isostep/particles/particle_world.hpp"
#include "isostep/world/world.hpp"

namespace isostep {

template <class S> struct CouplingSettings {
  Filter filter = {};  // of all particles, as if they were bodies
  /// [1] The share of a body's weight up to which a resting body bears pushes as if it were fixed; it may sleep under
  /// them. Such pushes are lost to momentum. 0: every push counts, and what particles press on stays awake.
  S unfelt = S(0);
};

/// Holds the counts of the last frame.
struct CouplingReport {
  std::uint32_t touches = 0;  // handed to the particles
  std::uint32_t bodies = 0;   // near particles, whether these touch them or not
  std::uint32_t pushed = 0;   // bodies that got an impulse
  std::uint32_t unfelt = 0;   // bodies that bore one at rest: CouplingSettings::unfelt
  std::uint32_t crowded = 0;  // touches whose body is too light to be shared among so many: see Limits
  std::uint32_t refused = 0;  // touches beyond the particles' limits: these were not made
};

/// A frame of a game that has both worlds, at one rate:
///   coupling.before_step(bodies, particles);
///   particles.step();
///   coupling.after_step(bodies, particles);
///   bodies.step();
/// Nothing is created, destroyed or loaded between the first and the third. All that passes between the worlds is
/// commands, touches one way, forces and impulses the other, so each world's recording replays without the other.
/// Nothing is remembered from frame to frame: composite(bodies, particles) is the state.
///
/// Any particle meets any part of a body with collisions whose filter agrees, pinned ones too; sensors meet none. A
/// particle is a ball of its material's radius. Friction and restitution mix as two bodies' do, so without friction of
/// its own a particle slides. Fast particles are traced to the shape they hit.
///
/// Particles solve each touch for itself; they know neither the body nor its other touches. Each therefore meets a body
/// that already moves as the others are foreseen to move it, at a mass that stands for its share, and the sum of what
/// comes out is given to the body: its weight's part as a force over its next step, so that what lies on particles
/// rests as still as on a body, the rest as an impulse. Momentum is kept to rounding.
///
/// A push wakes what sleeps, and bodies that particles press on stay awake; but see CouplingSettings::unfelt.
///
/// Source:  Tonge, Benevolenski, Voroshilov 2012, Mass Splitting for Jitter-Free Parallel Rigid Body Simulation.
/// Differs: the parts of a body are as heavy as their touches need, not equal, and meet again once a step; see
///          coupling_share.inl. Particles are pushed out of what they overlap; the body's part of that way is a speed
///          of at most 0.25 m/s.
/// Order:   touches by particle, body and part, ascending by slots. Nothing depends on the trees.
/// Cost:    a query of the bodies' tree for each particle, a closest point for each part near it, and a few rounds over
///          a body's touches. No allocation of its own once warm; World::overlap_aabb's where more than 32 bodies meet
///          one particle.
/// Limits:  both worlds' own ranges. A share of a body counts as no lighter than the particles' least mass (crowded in
///          the report): for Q16.16 a body of m kg borne by more than some 100 m heavy or pinned particles may be
///          pushed too far by what was not foreseen. Motion within a step is straight: what spins fast is met where its
///          surface goes at first. Springs between particles are not foreseen: a stiff net under a body trembles by
///          some millimetres. Nor are particles that bounce between a body and what is below within one step: under
///          worst_first, with restitution above 0.5, each bounces off all of the body, and a blow in which several do
///          so can leave with some times its energy. What begins deep inside a body and hangs on springs stretches them
///          by that depth. Under worst_first a touch waits for the sub-step in which its gap closes, and time division
///          does not stop there: particles that go far in a sub-step can pass a thin body. Impulses are in S: Q16.16
///          holds them at 32767 kg m/s a step, which no report says.
template <class S> class ParticleCoupling {
 public:
  explicit ParticleCoupling(const CouplingSettings<S>& settings = {});

  /// Finds the coming step's touches. Does nothing and returns false if the worlds' rates differ.
  bool before_step(const World<S>& bodies, ParticleWorld<S>& particles);
  /// Gives bodies what particles gave them in the step since `before_step`. Does nothing and returns false if there was
  /// not exactly one step.
  bool after_step(World<S>& bodies, const ParticleWorld<S>& particles);

  const CouplingReport& report() const { return report_; }

 private:
  using V = Velocity<S>;
  using U = Unit<S>;

  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// Holds sums over touches, of their pushes and levers.
  struct Press {
    Vec3<S> push, lever;
  };
  /// A body near particles, with what it got from them.
  struct Met {
    BodyId body;
    bool collides, moves, rests;  // moves: pushes matter; rests: asleep, or slow in the step before
    std::uint32_t first_part, part_count;
    Vec3<S> centre;                      // [m]
    Vec3<S> velocity, angular_velocity;  // [m/s] [rad/s]
    Vec3<S> gravity;                     // [m/s^2] that acts on it while awake
    Mat3<U> principal;                   // principal axes to world
    S mass;                              // [kg]
    Vec3<S> kappa;                       // [1/m^2]
    std::uint32_t locks;                 // body_flag
    std::uint32_t first_touch, last_touch;
    std::uint32_t pressing;   // touches that may press
    Press press;              // of those
    Vec3<S> impulse, moment;  // [kg m/s] [kg m^2/s]
  };
  struct Part {
    Transform<S> at;  // to world
    ShapeView<S> shape;
    Material<S> material;
  };
  /// A particle on its way.
  struct Flier {
    ParticleId id;
    Vec3<S> position;  // [m]
    Vec3<S> velocity;  // [m/s]
    InverseMass<S> inverse_mass;
    const ParticleMaterial<S>* material;
  };
  /// A direction at a point of a body.
  struct Along {
    Vec3<S> push;   // [1] the direction, where the body may move along it
    Vec3<S> lever;  // [m] arm x direction in principal axes, where the body may turn
    Vec3<S> turn;   // [1/m] kappa lever
  };
  struct Touching {
    ParticleTouch<S> touch;
    std::uint32_t met;
    Vec3<S> arm;                  // [m] from the body's centre
    InverseMass<S> inverse_mass;  // [1/kg] of the particle
    Along along;                  // the normal
    S answer;                     // [1] of the body at this point along the normal, times its mass
    S widest;                     // [1] and the largest in any direction that the touch acts in
    S own;                        // [1] of the particle, times the body's mass
    Vec3<S> surface;              // [m/s] of the body here
    S start_speed, speed;         // [m/s] of the particle along the normal: now, and foreseen
    S least_speed;                // [m/s] at which they may part
    S end_speed;                  // [m/s] of the body along the normal, foreseen
    S missing;                    // [m/s] of that, before they were solved
    S impulse, blow;              // [m/s] over the body's mass, foreseen: all, and that without its gravity
    std::uint32_t next;           // touch of the same body
  };
  /// The foreseen motion of a body.
  struct Motion {
    Vec3<S> velocity;          // [m/s]
    Vec3<S> angular_velocity;  // [rad/s] in principal axes
  };
  /// The place where a flier meets a part.
  struct Meeting {
    Vec3<S> point;    // [m] on the part
    Vec3<U> outward;  // [1]
    S gap;            // [m] along it, now
  };

  void find_touches(const World<S>& bodies, ParticleWorld<S>& particles);
  S farthest_way(const World<S>& bodies) const;
  void find_bodies(const World<S>& bodies, const Flier& flier);
  std::uint32_t meet(const World<S>& bodies, BodyId body);
  bool find_meeting(const Met& met, const Part& part, const Flier& flier, Meeting& meeting) const;
  void add_touch(std::uint32_t met, const Material<S>& material, const Flier& flier, const Meeting& meeting);
  Vec3<S> velocity_at(const Met& met, Vec3<S> arm) const;
  void weigh(const Met& met, Touching& touching, Vec3<S> surface, S speed);
  static S response(const Along& along, Vec3<S> push, Vec3<S> lever);
  static S speed_along(const Along& along, const Motion& motion);
  static S missing_speed(const Touching& touching, const Motion& motion);
  static S give(Touching& touching, Motion& motion, S missing, S answer, bool gives);
  static void count(Met& met, const Along& along);
  void solve(Met& met, Motion& motion, bool gives);
  void foresee(Met& met);
  void share(Met& met);
  static Vec3<S> gravity_told(const Met& met, Vec3<U> normal, S ahead);
  void push_bodies(World<S>& bodies, const ParticleWorld<S>& particles);
  U bearing_share(const Met& met) const;
  bool is_unfelt(const World<S>& bodies, const Met& met) const;

  CouplingSettings<S> settings_;
  CouplingReport report_;
  std::int32_t hz_ = 0;        // 0: no frame is under way
  Step<S> step_ = Step<S>(0);  // [s]
  S margin_ = S(0);            // [m] that a particle may go astray within a step
  S body_way_ = S(0);          // [m] that any body may go within it, at most
  std::uint64_t tick_ = 0;     // of the particles, before their step
  std::size_t first_touch_ = 0;
  std::vector<BodyId> found_;
  std::vector<std::uint32_t> met_of_slot_;  // one more than the place in met_; 0: not met
  std::vector<Met> met_;
  std::vector<Part> parts_;
  std::vector<Touching> touching_;
};

#define ISO_PARTICLE_COUPLING_OF(extern, S) extern template class ParticleCoupling<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PARTICLE_COUPLING_OF)

}  // namespace isostep
