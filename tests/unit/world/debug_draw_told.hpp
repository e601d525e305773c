// What a DebugDraw is told of a world, kept for tests, and a crate on the ground to look at.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/draw/debug_draw.hpp"
#include "unit/world/edited_state.hpp"

namespace isostep::test {

struct ToldPart {
  DrawnBody body;
  DrawnPart part;
};

/// Keeps all that it is told.
struct Told : DebugDraw {
  void body(const DrawnBody& drawn) override { bodies.push_back(drawn); }
  void part(const DrawnBody& of, const DrawnPart& drawn) override { parts.push_back({of, drawn}); }
  void line(const DrawnLine& drawn) override { lines.push_back(drawn); }
  void mass(const DrawnMass& drawn) override { masses.push_back(drawn); }
  void box(const DrawnBox& drawn) override { boxes.push_back(drawn); }
  void island(const DrawnIsland& drawn) override { islands.push_back(drawn); }
  void contact(const DrawnContact& drawn) override { contacts.push_back(drawn); }
  void joint(const DrawnJoint& drawn) override { joints.push_back(drawn); }
  void wheel(const DrawnWheel& drawn) override { wheels.push_back(drawn); }
  void character(const DrawnCharacter& drawn) override { characters.push_back(drawn); }
  void particle(const DrawnParticle& drawn) override { particles.push_back(drawn); }
  void spring(const DrawnSpring& drawn) override { springs.push_back(drawn); }
  void link(const DrawnLink& drawn) override { links.push_back(drawn); }
  void collider(const DrawnCollider& drawn) override { colliders.push_back(drawn); }

  std::vector<DrawnBody> bodies;
  std::vector<ToldPart> parts;
  std::vector<DrawnLine> lines;
  std::vector<DrawnMass> masses;
  std::vector<DrawnBox> boxes;
  std::vector<DrawnIsland> islands;
  std::vector<DrawnContact> contacts;
  std::vector<DrawnJoint> joints;
  std::vector<DrawnWheel> wheels;
  std::vector<DrawnCharacter> characters;
  std::vector<DrawnParticle> particles;
  std::vector<DrawnSpring> springs;
  std::vector<DrawnLink> links;
  std::vector<DrawnCollider> colliders;
};

inline constexpr DrawOptions everything() { return {.masses = true, .boxes = true, .islands = true}; }

template <class W> Told told(const W& world, const DrawOptions& options = everything()) {
  Told to;
  draw(world, to, options);
  return to;
}
inline D3 real(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

/// A crate of 1 x 2 x 3 m and 6 kg on the ground, above the point (4, 0, 5), its material's friction 0.6.
template <class S> struct Crate {
  explicit Crate(D3 velocity = {0, 0, 0}, double height = 1) : world(settings<S>()) {
    ground = add_ground(world);
    BodyDefinition<S> definition = moving<S>(add_box(world, 0.5, 1, 1.5), {4, height, 5}, velocity);
    definition.user_data = 42;
    definition.density = S(1);
    body = world.create(definition);
  }
  World<S> world;
  BodyId ground, body;
};

}  // namespace isostep::test
