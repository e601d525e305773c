// Recorder: makes a recording of any world, by what a DebugDraw is told of it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "effect_records.hpp"
#include "isostep/draw/debug_draw.hpp"
#include "recording.hpp"
#include "scenes/measure.hpp"
#include "scenes/particles/particle_measure.hpp"

namespace isostep::tool::page {

class Recorder : public DebugDraw {
 public:
  explicit Recorder(Recording& recording) : recording_(recording) {}

  /// The world's moment becomes the recording's next frame.
  template <class W> void record(const W& world) {
    begin(world.tick(), world.hash(), scenes::measure_energy(world).total());
    draw(world, *this);
    record_effects(world, *this);
    finish();
  }

  void body(const DrawnBody& body) override;
  void part(const DrawnBody& body, const DrawnPart& part) override;
  bool wants_triangles(const DrawnPart& part) override;
  void triangle(const DrawnTriangle& triangle) override;
  void contact(const DrawnContact& contact) override;
  void joint(const DrawnJoint& joint) override;
  void wheel(const DrawnWheel& wheel) override;
  void character(const DrawnCharacter& character) override;
  void particle(const DrawnParticle& particle) override;
  void spring(const DrawnSpring& spring) override;
  void link(const DrawnLink& link) override;
  void collider(const DrawnCollider& collider) override;

  // record_effects tells these, after all bodies. `body` null: of the world.
  void effect(std::uint32_t slot, std::uint32_t generation, BodyId body, Effect effect);
  void push(Vector force, double control);  // of the effect told last
  void body_spring(BodySpringId id, BodyId a, BodyId b, Vector at_a, Vector at_b, bool only_pulls);

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  struct Cast {  // what is known of an actor
    Pose pose = {};
    Change is = Change::gone;
    std::uint32_t seen = kNone;      // frame
    float at[3] = {}, turn[4] = {};  // of that frame
  };
  struct Known {  // by slot
    std::uint32_t generation = 0, index = kNone;
  };

  void begin(std::uint64_t tick, std::uint64_t hash, double energy);
  void finish();
  std::uint32_t now() const { return static_cast<std::uint32_t>(recording_.frames.size() - 1); }
  Frame& frame() { return recording_.frames.back(); }
  bool cast(std::vector<Known>& all, std::uint32_t slot, std::uint32_t generation, std::uint32_t& actor);
  void point(const float (&at)[3], const float (&force)[3]);
  void appear(std::uint32_t actor, const DrawnPose& pose, Change is);
  std::int32_t actor_of(std::uint32_t slot) const;
  std::array<float, 3> local(std::int32_t actor, const float (&point)[3]) const;
  template <class IdType> Bond* bond(std::vector<Known>& known, IdType id);

  Recording& recording_;
  std::vector<Cast> casts_;                                                      // by actor
  std::vector<Known> by_slot_, wheels_;                                          // actors
  std::vector<Known> joints_, springs_, links_;                                  // bonds
  std::map<std::pair<std::string_view, std::uint64_t>, std::uint32_t> effects_;  // by kind and id
  std::uint32_t effect_ = 0;                                                     // told last
  bool parts_wanted_ = false;                                                    // of the body told last
};

}  // namespace isostep::tool::page
