// DebugDraw: what a game overrides to draw a world as the engine sees it: shapes, masses, contacts, joints, wheels,
// characters, sleepers.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/particles/particle_world.hpp"
#include "isostep/state/hash.hpp"
#include "isostep/world/world.hpp"

namespace isostep {

// Plain floats whatever the scalar: output, never state. World axes; kg, m, s, rad. Positions are less
// DrawOptions::origin.

struct DrawnPose {
  float position[3];     // [m]
  float orientation[4];  // x y z w
};

struct DrawnBody {
  static constexpr std::uint32_t kNoIsland = 0xffffffffu;

  BodyId body;
  BodyType type;
  bool awake;            // static bodies never are
  bool sensor;           // reports overlaps, is not solved
  std::uint32_t island;  // of those asleep, as DrawnIsland counts them; kNoIsland: awake or static
  std::uint64_t user_data;
  DrawnPose pose;             // of the body's origin
  float velocity[3];          // [m/s] of the centre of mass
  float angular_velocity[3];  // [rad/s]
};

/// One primitive of a body's shape.
struct DrawnPart {
  ShapeType type;
  std::uint32_t child;  // its place in the shape
  bool sensor;          // reports overlaps, is not solved: its own or its body's
  DrawnPose pose;   // of its centre; round ones lie along its y; of a half-space: its point nearest the body's origin;
                    // of a part with content: of the frame that its points are in
  float half[3];    // [m] of a box; of a capsule, cylinder or cone y alone
  float radius;     // [m] of a sphere, capsule, cylinder or cone; around a hull
  float normal[3];  // [1] of a half-space, world, out of the ground
  /// The name of its blob, of a shape that has one (hull), with a hull's radius mixed in: parts of equal content have
  /// equal triangles, see DebugDraw::wants_triangles. All 0: the numbers above say everything.
  ContentId content;
};

/// One triangle of a part's surface, in the part's own frame, so that a game draws parts of one content as instances of
/// one mesh, each at its DrawnPart::pose.
struct DrawnTriangle {
  float corners[3][3];  // [m] counter-clockwise seen from outside
};

/// One line of a part's outline.
struct DrawnLine {
  BodyId body;
  float from[3], to[3];  // [m]
};

struct DrawnMass {
  BodyId body;
  DrawnPose frame;   // centre of mass, principal axes
  float mass;        // [kg]
  float inertia[3];  // [kg m^2] about those axes; 0: does not turn
};

/// The broad phase's box of a body: its bounds and a margin.
struct DrawnBox {
  BodyId body;
  float low[3], high[3];  // [m]
};

/// Bodies that fell asleep together and will wake together.
struct DrawnIsland {
  std::uint32_t island;
  std::uint32_t bodies, contacts, joints;
  float low[3], high[3];  // [m] of the bodies' boxes
};

struct DrawnContact {
  struct Point {
    float position[3];      // [m] midway between the two surfaces
    float separation;       // [m] along the normal, negative: overlap
    float force;            // [N] along the normal, mean of the last step of integration; 0: new since
    std::uint32_t feature;  // the same from frame to frame
  };

  BodyId a, b;
  std::uint32_t child_a, child_b;  // the parts that meet
  bool asleep;                     // of a sleeping island
  float normal[3];                 // [1] from a to b
  std::uint32_t count;             // of points, 1..4
  Point points[4];
};

struct DrawnJoint {
  JointId joint;
  JointType type;
  BodyId a, b;  // null: the world
  bool asleep;  // of a sleeping island
  std::uint64_t user_data;
  DrawnPose frame_a, frame_b;  // position: the anchors; z: the joint's axis
  float centre_a[3];           // [m] of the bodies' masses; the world's: its anchor
  float centre_b[3];
  float error;  // [m] between the anchors; of a distance joint: out of its range
};

struct DrawnWheel {
  WheelId wheel;
  BodyId body;
  bool awake;           // its body
  DrawnPose pose;       // of its middle; y: its axle, steered; turns about that as the wheel rolls
  float radius;         // [m]
  float hard_point[3];  // [m] where its spring begins
  float spin;           // [rad/s] positive: rolls forward
  BodyId ground;        // null: it meets nothing, and what follows is 0
  float contact[3];     // [m]
  float normal[3];      // [1] of the ground
  float load;           // [N] along the normal, of the last sub-step
  float grip[3];        // [N] of the tyre, on the body, of the last sub-step
};
struct DrawnCharacter {
  CharacterId character;
  BodyId body;
  Footing footing;
  BodyId ground;        // null: airborne, and the normal is 0
  float foot[3];        // [m] on the ground; of who is airborne, its body's origin
  float normal[3];      // [1] of the ground
  float weight;         // [N]
  float velocity[3];    // [m/s]
  std::uint32_t stuck;  // [steps] in a row in which it could not leave what it overlaps
};

struct DrawnParticle {
  ParticleId particle;
  std::uint32_t material;  // slot
  bool pinned;
  float position[3];  // [m]
  float velocity[3];  // [m/s]
  float radius;       // [m] for contacts, may be 0
};
/// A spring between two particles, or a particle and a fixed point.
struct DrawnSpring {
  SpringId spring;
  SpringType type;
  ParticleId a, b;       // b null: a fixed point
  float from[3], to[3];  // [m]
  float rest_length;     // [m]
};
struct DrawnLink {
  LinkId link;
  LinkType type;
  ParticleId a, b;       // b null: a fixed point
  float from[3], to[3];  // [m]
  float error;           // [m] a rod's length less what it should be; a cable's only beyond
};
struct DrawnCollider {
  ColliderId collider;
  ColliderType type;
  float normal[3];       // [1] of a plane, out of the ground
  float start[3];        // [m] of a line; of a plane: its point nearest to DrawOptions::origin
  float end[3], radius;  // [m] of a line
};

/// The kinds that are drawn: each calls the function of its name, bodies and particles first.
struct DrawOptions {
  bool bodies = true;  // and their parts
  bool lines = false;  // of the parts: for who draws no solids
  bool masses = false;
  bool boxes = false;
  bool islands = false;
  bool contacts = true;
  bool joints = true;
  bool wheels = true;
  bool characters = true;
  bool particles = true;
  bool springs = true;
  bool links = true;
  bool colliders = true;
  double origin[3] = {0, 0, 0};  // [m] taken from positions before they are rounded to float: the camera, far out
};

/// Override what is to be seen; what is not overridden does nothing. Nothing is kept of what is handed over. The world
/// must not be changed meanwhile.
class DebugDraw {
 public:
  virtual ~DebugDraw();
  virtual void body(const DrawnBody& body);
  virtual void part(const DrawnBody& body, const DrawnPart& part);  // after its body, before the next
  virtual void line(const DrawnLine& line);                         // of the part before
  virtual void mass(const DrawnMass& mass);                         // of dynamic bodies
  virtual void box(const DrawnBox& box);
  virtual void island(const DrawnIsland& island);
  virtual void contact(const DrawnContact& contact);
  virtual void joint(const DrawnJoint& joint);
  virtual void wheel(const DrawnWheel& wheel);
  virtual void character(const DrawnCharacter& character);
  virtual void particle(const DrawnParticle& particle);
  virtual void spring(const DrawnSpring& spring);
  virtual void link(const DrawnLink& link);
  virtual void collider(const DrawnCollider& collider);

  /// Asked after `part`, for each part with content: true has calls of `triangle` follow with its surface. A surface
  /// depends on the content alone, so a game says yes once for each content. False unless overridden.
  virtual bool wants_triangles(const DrawnPart& part);
  virtual void triangle(const DrawnTriangle& triangle);
};

/// Draws to `to` what the state holds, whatever led there: after a step, a command or a load alike; sleepers too.
/// Changes and allocates nothing. Bodies: the static, the awake, then island by island, each ascending by slot.
/// Contacts are those that the last step left. Impulses are state, geometry is not: where the points are and how deep
/// is found anew from the poses of now, so it is what the next step begins with, not what the last one solved. A
/// contact whose parts have moved apart since is not drawn; a point with no namesake among the remembered has no force.
template <class S> void draw(const World<S>& world, DebugDraw& to, const DrawOptions& options = {});
template <class S> void draw(const ParticleWorld<S>& world, DebugDraw& to, const DrawOptions& options = {});

#define ISO_DEBUG_DRAW_OF(extern, S)                                             \
  extern template void draw<S>(const World<S>&, DebugDraw&, const DrawOptions&); \
  extern template void draw<S>(const ParticleWorld<S>&, DebugDraw&, const DrawOptions&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_DEBUG_DRAW_OF)

}  // namespace isostep
