// The judges that several trials share, and what judges are made of.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <memory>
#include <type_traits>

#include "trial.hpp"

namespace isostep::scenes {

/// The greater one; a value that is no number stays, where std::max would drop it.
inline double worse(double a, double b) { return std::isnan(a) || a > b ? a : b; }

/// A Trial's maker of judges that know their scene, or need not.
template <class J> std::unique_ptr<Judge> judge_of(const Scene& scene) {
  if constexpr (std::is_constructible_v<J, const Scene&>) return std::make_unique<J>(scene);
  else return std::make_unique<J>();
}

/// Compares every sight with the first one, that one included.
class FromStart : public Judge {
 public:
  void see(const Sight& sight) final {
    if (!started_) start_ = sight;
    started_ = true;
    compare(start_, sight);
  }

 protected:
  virtual void compare(const Sight& start, const Sight& now) = 0;

 private:
  bool started_ = false;
  Sight start_;
};

/// [m] The way of a body since the start.
inline Vec3<double> way_of(const Sight& start, const Sight& now, std::size_t body) {
  return now.bodies[body].centre - start.bodies[body].centre;
}

/// [%] The largest way sideways of any of a tower's unit boxes over a box's side; they are listed from the ground up.
/// At most 100, and that for a box that sank by half of itself into the one below, or fell off it.
class Drift : public FromStart {
 public:
  double figure() const override { return 100 * worst_; }

 private:
  void compare(const Sight& start, const Sight& now) override;
  double worst_ = 0;
};

/// Bodies that were at any time, all at once, further from their start than `limit` [m].
class Displaced : public FromStart {
 public:
  explicit Displaced(double limit) : limit_(limit) {}
  double figure() const override { return most_; }

 private:
  void compare(const Sight& start, const Sight& now) override;
  double limit_;
  double most_ = 0;
};
inline std::unique_ptr<Judge> displaced_by_half(const Scene&) { return std::make_unique<Displaced>(0.5); }

/// The largest separation of any joint's anchors at any time, in units of so many metres.
class Separation : public Judge {
 public:
  explicit Separation(double unit) : unit_(unit) {}
  void see(const Sight& sight) override { worst_ = worse(worst_, sight.joint_error / unit_); }
  double figure() const override { return worst_; }

 private:
  double unit_;
  double worst_ = 0;
};

/// [m/s] The largest speed of any body at any time.
class TopSpeed : public Judge {
 public:
  void see(const Sight& sight) override {
    for (const BodySight& body : sight.bodies) worst_ = worse(worst_, length_of(body.velocity));
  }
  double figure() const override { return worst_; }

 private:
  double worst_ = 0;
};

}  // namespace isostep::scenes
