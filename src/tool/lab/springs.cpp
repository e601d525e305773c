// The spring experiment's worlds, and what is measured of them.
// SPDX-License-Identifier: MIT
#include "springs.hpp"

#include <algorithm>
#include <cmath>

#include "isostep/particles/particle_state.hpp"
#include "isostep/particles/particle_world.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool::lab {
namespace {

constexpr int kRate = 10;           // [1/s]
constexpr int kSteps = 10 * kRate;  // 10 s
constexpr int kSide = 8;            // particles of the net along an edge
constexpr int kPulled = 2 * kSide + 3;

/// A scale that every scalar can hold: Q16.16 ends at 32768 and at 2^-16, its masses begin at 1/64 kg.
struct Scale {
  double mass;       // [kg]
  double stiffness;  // [N/m]
  double length;     // [m] of the springs at rest, where they are taut; no acceleration exceeds 2^14 m/s^2 as it starts
};
Scale scale_of(double stiffness) {
  const double per_mass = stiffness * kRate * kRate;  // [1/s^2] k/m
  constexpr double kMost = 16384;
  Scale scale = {per_mass <= kMost ? 1.0 : 1.0 / 64, 0, 0.125};
  scale.stiffness = per_mass * scale.mass;
  while (per_mass * scale.length > kMost) scale.length /= 2;
  return scale;
}

struct Energy {
  double kinetic = 0, potential = 0;  // [J]
  double farthest = 0;                // [m] of any particle from where it rests
  double total() const { return kinetic + potential; }
};

template <class S> class Springs {
 public:
  Springs(SpringSystem system, int method, double stiffness)
      : scale_(scale_of(stiffness)), side_(system == SpringSystem::net ? kSide : 1), world_(settings_of(method)) {
    Spring<S> plain;
    plain.type = method == kExactSpring ? SpringType::stiff : SpringType::spring;
    plain.stiffness = number(scale_.stiffness);
    std::vector<ParticleId> ids;
    for (int i = 0; i < side_ * side_; ++i) {
      ParticleDefinition<S> particle;
      particle.position = place(i);
      particle.mass = number(scale_.mass);
      ids.push_back(world_.create(particle));
    }
    if (side_ == 1) join(plain, ids, 0, -1);
    for (int row = 0; row < side_ && side_ > 1; ++row) {
      for (int i = -1; i < side_; ++i) {
        join_along(plain, ids, row, i, 1);
        join_along(plain, ids, row, i, side_);
      }
    }
    const int pulled = side_ == 1 ? 0 : kPulled;
    const Vec3<S> rest = place(pulled);
    const S far = number(side_ == 1 ? scale_.length : scale_.length / 4);
    world_.place(ids[static_cast<std::size_t>(pulled)], {rest.x + far, rest.y, side_ == 1 ? rest.z : rest.z + far},
                 Vec3<S>::zero());
    world_.save(start_);
  }

  SpringSample measure() {
    const Energy start = energy();
    double most = start.total(), early = 0, late = 0, end = 0;
    double farthest = start.farthest;
    bool cut = false;
    for (int i = 1; i <= kSteps && !cut; ++i) {
      const ParticleReport report = world_.step();
      const Energy now = energy();
      most = std::max(most, now.total());
      farthest = std::max(farthest, now.farthest);
      if (kSteps / 4 < i && i <= kSteps / 2) early += now.total();
      if (kSteps * 3 / 4 < i) late += now.total();
      if (kSteps - kRate < i) end += now.total() / kRate;
      cut = report.clamped_speed + report.clamped_force + report.clamped_position + report.stopped > 0;
      if (cut) end = now.total();
    }
    SpringSample sample = {};
    // Means over a quarter: of what only swings they are near to each other. Forces end at the scalar's ends, which may
    // hold back in the end what exploded.
    const bool grows = late > std::max(1.3 * early, kSteps / 4 * start.total()) || most > 100 * start.total() || cut;
    sample.verdict = grows                        ? SpringVerdict::exploded
                     : most > 1.5 * start.total() ? SpringVerdict::bounded
                                                  : SpringVerdict::stable;
    sample.energy = end / start.total();
    sample.amplitude = farthest / start.farthest;
    return sample;
  }

  /// [ns] a step; the median run's.
  double time(int runs) {
    std::vector<double> times;
    for (int run = 0; run < runs; ++run) {
      world_.load(start_);
      const double before = thread_milliseconds();
      for (int i = 0; i < kSteps; ++i) world_.step();
      times.push_back((thread_milliseconds() - before) * 1e6 / kSteps);
    }
    std::sort(times.begin(), times.end());
    return times.empty() ? 0 : times[times.size() / 2];
  }

 private:
  static S number(double value) { return from_double<S>(value); }
  static ParticleSettings<S> settings_of(int method) {
    ParticleSettings<S> settings;
    settings.hz = kRate;
    settings.substeps = 1;
    settings.gravity = Vec3<S>::zero();
    if (method != kExactSpring) settings.integrator = static_cast<Integrator>(method);
    return settings;
  }

  /// The place at which a particle rests; columns and rows -1 and kSide are the frame.
  Vec3<S> place(int column, int row) const {
    const double middle = (side_ - 1) / 2.0;
    return {number((column - middle) * scale_.length), number((row - middle) * scale_.length), S(0)};
  }
  Vec3<S> place(int i) const { return place(i % side_, i / side_); }

  /// The spring from the i-th of a row or, with stride kSide, of a column to the next.
  void join_along(const Spring<S>& plain, const std::vector<ParticleId>& ids, int line, int i, int stride) {
    const int first = stride == 1 ? line * side_ : line;
    const int a = i < 0 ? -1 : first + i * stride, b = i + 1 == side_ ? -1 : first + (i + 1) * stride;
    if (a >= 0 && b >= 0) return join(plain, ids, a, b);
    const int out = i < 0 ? -1 : side_;
    Spring<S> spring = plain;
    spring.anchor = stride == 1 ? place(out, line) : place(line, out);
    join(spring, ids, a >= 0 ? a : b, -1);
  }
  void join(Spring<S> spring, const std::vector<ParticleId>& ids, int a, int b) {
    spring.a = ids[static_cast<std::size_t>(a)];
    if (b >= 0) spring.b = ids[static_cast<std::size_t>(b)];
    world_.add(spring);
    joined_.push_back({a, b});
  }

  /// The energy of what differs from rest: springs of rest length 0 are linear, so what they hold there does not
  /// matter.
  Energy energy() const {
    Energy energy;
    std::vector<Vec3<double>> away;
    const ParticleState<S>& state = world_.state();
    for (int i = 0; i < side_ * side_; ++i) {
      const auto slot = static_cast<std::size_t>(i);
      away.push_back(exact(state.position[slot]) - exact(place(i)));
      energy.kinetic += 0.5 * scale_.mass * squared(exact(state.velocity[slot]));
      energy.farthest = std::max(energy.farthest, std::sqrt(squared(away.back())));
    }
    for (const Joined& joined : joined_) {
      const Vec3<double> a = away[static_cast<std::size_t>(joined.a)];
      const Vec3<double> b = joined.b < 0 ? Vec3<double>{0, 0, 0} : away[static_cast<std::size_t>(joined.b)];
      energy.potential += 0.5 * scale_.stiffness * squared(a - b);
    }
    return energy;
  }
  template <class T> static Vec3<double> exact(Vec3<T> v) { return {to_double(v.x), to_double(v.y), to_double(v.z)}; }
  static double squared(Vec3<double> v) { return v.x * v.x + v.y * v.y + v.z * v.z; }

  struct Joined {
    int a, b;
  };  // b < 0: the frame
  Scale scale_;
  int side_;
  ParticleWorld<S> world_;
  typename ParticleWorld<S>::Snapshot start_;
  std::vector<Joined> joined_;
};

}  // namespace

const char* spring_method_name(int method) {
  return method == kExactSpring ? "stiff_spring" : kIntegratorNames[method];
}

std::vector<double> spring_stiffnesses(bool quick) {
  std::vector<double> values;
  for (int i = 0; i <= 24; i += quick ? 3 : 1) values.push_back(std::pow(10.0, -2 + i / 4.0));
  return values;
}

SpringSample measure_springs(SpringSystem system, const std::string& scalar, int method, double stiffness,
                             int timings) {
  SpringSample sample = {};
  const bool found = with_scalar(scalar, [&](auto tag) {
    using S = typename decltype(tag)::Type;
    Springs<S> springs(system, method, stiffness);
    sample = springs.measure();
    sample.scalar = ScalarTraits<S>::kName;
    sample.step_ns = springs.time(timings);
  });
  if (!found) throw ToolError(exit_status::kUsage, "this build has no scalar " + scalar);
  sample.system = system;
  sample.method = method;
  sample.stiffness = stiffness;
  return sample;
}

}  // namespace isostep::tool::lab
