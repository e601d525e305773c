// The drawing of worlds for every shipped scalar, and a DebugDraw that draws nothing.
// SPDX-License-Identifier: MIT
#include "isostep/draw/debug_draw.inl"

namespace isostep {

DebugDraw::~DebugDraw() = default;
void DebugDraw::body(const DrawnBody&) {}
void DebugDraw::part(const DrawnBody&, const DrawnPart&) {}
void DebugDraw::line(const DrawnLine&) {}
bool DebugDraw::wants_triangles(const DrawnPart&) { return false; }
void DebugDraw::triangle(const DrawnTriangle&) {}
void DebugDraw::mass(const DrawnMass&) {}
void DebugDraw::box(const DrawnBox&) {}
void DebugDraw::island(const DrawnIsland&) {}
void DebugDraw::contact(const DrawnContact&) {}
void DebugDraw::joint(const DrawnJoint&) {}
void DebugDraw::wheel(const DrawnWheel&) {}
void DebugDraw::character(const DrawnCharacter&) {}
void DebugDraw::particle(const DrawnParticle&) {}
void DebugDraw::spring(const DrawnSpring&) {}
void DebugDraw::link(const DrawnLink&) {}
void DebugDraw::collider(const DrawnCollider&) {}

#define ISO_INSTANTIATE(S) ISO_DEBUG_DRAW_OF(, S)

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
