/* isostep in C: deterministic 3D physics for lockstep and rollback games. C99; C++ as well.
   SPDX-License-Identifier: MIT

   Families. What holds no number exists once (iso_world_step). What holds one exists four times, by the scalar of its
   world: iso_f32_ (float), iso_f64_ (double), iso_q16_ (Q16.16 in int32_t), iso_q32_ (Q32.32 in int64_t). Numbers cross
   raw; a function of another family than the world's returns ISO_WRONG_SCALAR and changes nothing.
   Status. 0 is success. Above 0: why the world refused, an iso_fault. Below 0: what is wrong with the call. Every call
   that does not succeed changes nothing. iso_last_error() says it in words.
   Ids are slot | generation << 32, 0 is none. Structs that go by pointer begin with their size: call their _init first,
   which fills in the defaults. README.md beside this file has the rules on ownership, sizes, threads and versions. */
#ifndef ISOSTEP_H
#define ISOSTEP_H

#include <stddef.h>
#include <stdint.h>

#ifndef ISO_API
#if defined(_WIN32) && defined(ISO_BUILD)
#define ISO_API __declspec(dllexport)
#elif defined(_WIN32) && !defined(ISO_STATIC)
#define ISO_API __declspec(dllimport)
#elif defined(__GNUC__)
#define ISO_API __attribute__((visibility("default")))
#else
#define ISO_API
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* X(P, N, U): the family's prefix, its numbers (S in C++), and directions and quaternions (Unit<S>: Q2.30, Q2.62). */
#define ISO_C_SCALARS(X) \
  X(f32, float, float) X(f64, double, double) X(q16, int32_t, int32_t) X(q32, int64_t, int64_t)

typedef int32_t iso_status;
enum {
  ISO_OK = 0,
  ISO_NULL = -1,         /* a pointer is null that may not be */
  ISO_WRONG_SCALAR = -2, /* the world is of another family */
  ISO_NO_SCALAR = -3,    /* this library was built without the scalar */
  ISO_SMALL_BUFFER = -4, /* the room does not suffice; what is needed is in the size or count */
  ISO_WRONG_SIZE = -5,   /* a struct's size: _init was not called, or it has members that this library does not know */
  ISO_CORRUPT = -6,      /* bytes, points or triangles that are not what they should be */
  ISO_NO_MEMORY = -7,
  ISO_BAD_ENUM = -8,    /* a number that is no enumerator, or a truth value that is neither 0 nor 1 */
  ISO_NOT_ALIVE = -9,   /* a handle that was destroyed, or never was one of this kind */
  ISO_CALLED_BACK = -10 /* called from within a callback of the same object */
};

/* Objects. Each is destroyed by its _destroy, which takes null; see there for what must go first. */
typedef struct iso_world iso_world;       /* a world of one scalar */
typedef struct iso_snapshot iso_snapshot; /* a state of a world; reusable: no allocation once warm */
typedef struct iso_tape iso_tape;         /* a recording that grows */
typedef struct iso_replay iso_replay;     /* a recording that is read */
typedef struct iso_blob iso_blob;         /* points of a hull, triangles of a mesh, heights of a field: immutable */

typedef uint64_t iso_body;
typedef uint64_t iso_shape;
typedef uint64_t iso_joint;
typedef uint64_t iso_record; /* of any kind that is registered with a world */

/* Structs: written by isostep_interface from the C++ headers. */
typedef uint32_t iso_scalar;
enum {
  ISO_SCALAR_F32 = 0, ISO_SCALAR_F64 = 1, ISO_SCALAR_Q16 = 2, ISO_SCALAR_Q32 = 3
};
typedef uint32_t iso_body_type;
enum {
  ISO_BODY_TYPE_STATIC = 0, ISO_BODY_TYPE_KINEMATIC = 1, ISO_BODY_TYPE_DYNAMIC = 2
};
typedef uint32_t iso_shape_type;
enum {
  ISO_SHAPE_TYPE_SPHERE = 0, ISO_SHAPE_TYPE_BOX = 1, ISO_SHAPE_TYPE_CAPSULE = 2, ISO_SHAPE_TYPE_HALF_SPACE = 3,
  ISO_SHAPE_TYPE_HULL = 4, ISO_SHAPE_TYPE_MESH = 5, ISO_SHAPE_TYPE_HEIGHT_FIELD = 6, ISO_SHAPE_TYPE_CYLINDER = 7,
  ISO_SHAPE_TYPE_CONE = 8
};
typedef uint32_t iso_joint_type;
enum {
  ISO_JOINT_TYPE_BALL = 0, ISO_JOINT_TYPE_HINGE = 1, ISO_JOINT_TYPE_FIXED = 2, ISO_JOINT_TYPE_DISTANCE = 3,
  ISO_JOINT_TYPE_SLIDER = 4, ISO_JOINT_TYPE_CYLINDRICAL = 5, ISO_JOINT_TYPE_PLANAR = 6, ISO_JOINT_TYPE_UNIVERSAL = 7,
  ISO_JOINT_TYPE_CONSTANT_VELOCITY = 8, ISO_JOINT_TYPE_ANGULAR = 9, ISO_JOINT_TYPE_SIX_AXIS = 10
};
typedef uint32_t iso_joint_axis;
enum {
  ISO_JOINT_AXIS_X = 0, ISO_JOINT_AXIS_Y = 1, ISO_JOINT_AXIS_Z = 2, ISO_JOINT_AXIS_SWING_X = 3,
  ISO_JOINT_AXIS_SWING_Y = 4, ISO_JOINT_AXIS_TWIST = 5
};
typedef uint32_t iso_solver;
enum {
  ISO_SOLVER_SOFT_STEP = 0, ISO_SOLVER_PGS = 1, ISO_SOLVER_WORST_FIRST = 2, ISO_SOLVER_DIRECT = 3, ISO_SOLVER_AVBD = 4,
  ISO_SOLVER_ADMM = 5
};
typedef uint32_t iso_projection;
enum {
  ISO_PROJECTION_NONLINEAR = 0, ISO_PROJECTION_LINEAR = 1, ISO_PROJECTION_RELAXED = 2,
  ISO_PROJECTION_VELOCITY_BASED = 3
};
typedef uint32_t iso_broad_phase;
enum {
  ISO_BROAD_PHASE_BOX_TREE = 0, ISO_BROAD_PHASE_SPHERE_TREE = 1, ISO_BROAD_PHASE_BSP_TREE = 2,
  ISO_BROAD_PHASE_QUAD_TREE = 3, ISO_BROAD_PHASE_OCT_TREE = 4, ISO_BROAD_PHASE_GRID = 5,
  ISO_BROAD_PHASE_MULTI_GRID = 6, ISO_BROAD_PHASE_SWEEP_AND_PRUNE = 7
};
typedef uint32_t iso_simd;
enum {
  ISO_SIMD_BEST = 0, ISO_SIMD_SCALAR = 1, ISO_SIMD_SSE2 = 2, ISO_SIMD_AVX2 = 3, ISO_SIMD_AVX512 = 4, ISO_SIMD_NEON = 5,
  ISO_SIMD_WASM = 6
};
typedef uint32_t iso_zone_shape;
enum {
  ISO_ZONE_SHAPE_EVERYWHERE = 0, ISO_ZONE_SHAPE_SPHERE = 1, ISO_ZONE_SHAPE_BOX = 2
};
typedef uint32_t iso_break_pattern;
enum {
  ISO_BREAK_PATTERN_EIGHT_BOXES = 0, ISO_BREAK_PATTERN_GRAIN = 1, ISO_BREAK_PATTERN_RADIAL = 2,
  ISO_BREAK_PATTERN_VORONOI = 3
};
typedef uint32_t iso_footing;
enum {
  ISO_FOOTING_AIRBORNE = 0, ISO_FOOTING_FLOOR = 1, ISO_FOOTING_STEEP = 2
};
typedef uint32_t iso_start_inside;
enum {
  ISO_START_INSIDE_REPORT = 0, ISO_START_INSIDE_IGNORE = 1
};
typedef uint32_t iso_hit_per;
enum {
  ISO_HIT_PER_BODY = 0, ISO_HIT_PER_CHILD = 1, ISO_HIT_PER_TRIANGLE = 2
};
typedef uint32_t iso_blob_home;
enum {
  ISO_BLOB_HOME_CARRIED = 0, ISO_BLOB_HOME_ASSET = 1
};
typedef uint32_t iso_fault;
enum {
  ISO_FAULT_NONE = 0, ISO_FAULT_STALE_ID = 1, ISO_FAULT_NOT_FINITE = 2, ISO_FAULT_OUT_OF_RANGE = 3,
  ISO_FAULT_BAD_SHAPE = 4, ISO_FAULT_BAD_MASS = 5, ISO_FAULT_BAD_ARGUMENT = 6, ISO_FAULT_SHAPE_IN_USE = 7,
  ISO_FAULT_NOT_DYNAMIC = 8, ISO_FAULT_NULL_ID = 9, ISO_FAULT_FOREIGN_ID = 10, ISO_FAULT_BAD_SNAPSHOT = 11,
  ISO_FAULT_CALLED_IN_STEP = 12
};
typedef uint32_t iso_verify_outcome;
enum {
  ISO_VERIFY_OUTCOME_VERIFIED = 0, ISO_VERIFY_OUTCOME_DIVERGED = 1, ISO_VERIFY_OUTCOME_INCOMPATIBLE = 2,
  ISO_VERIFY_OUTCOME_TRUNCATED = 3, ISO_VERIFY_OUTCOME_CORRUPT = 4, ISO_VERIFY_OUTCOME_STOPPED = 5
};
typedef uint32_t iso_verify_where;
enum {
  ISO_VERIFY_WHERE_START = 0, ISO_VERIFY_WHERE_FRAME = 1, ISO_VERIFY_WHERE_KEYFRAME = 2
};
typedef uint32_t iso_stage;
enum {
  ISO_STAGE_FIND_PAIRS = 0, ISO_STAGE_APPLY_FORCES = 1, ISO_STAGE_UPDATE_MANIFOLDS = 2,
  ISO_STAGE_COLOUR_CONSTRAINTS = 3, ISO_STAGE_PREPARE = 4, ISO_STAGE_SOLVE_SUBSTEPS = 5, ISO_STAGE_STORE_IMPULSES = 6,
  ISO_STAGE_FINALISE_BODIES = 7, ISO_STAGE_CONTINUOUS = 8, ISO_STAGE_UPDATE_SENSORS = 9, ISO_STAGE_EMIT_EVENTS = 10,
  ISO_STAGE_UPDATE_SLEEP = 11, ISO_STAGE_MOVE_CHARACTERS = 12
};
typedef uint32_t iso_body_flag;
enum {
  ISO_BODY_FLAG_SENSOR = 1, ISO_BODY_FLAG_ALLOW_SLEEP = 2, ISO_BODY_FLAG_COLLIDE = 4, ISO_BODY_FLAG_BULLET = 16,
  ISO_BODY_FLAG_DISABLED = 32, ISO_BODY_FLAG_REPORT_CONTACTS = 64, ISO_BODY_FLAG_LOCK_X = 256,
  ISO_BODY_FLAG_LOCK_Y = 512, ISO_BODY_FLAG_LOCK_Z = 1024, ISO_BODY_FLAG_LOCK_ANGULAR_X = 2048,
  ISO_BODY_FLAG_LOCK_ANGULAR_Y = 4096, ISO_BODY_FLAG_LOCK_ANGULAR_Z = 8192, ISO_BODY_FLAG_ALL_LOCKS = 16128
};
typedef uint32_t iso_part_flag;
enum {
  ISO_PART_FLAG_OWN_MATERIAL = 1, ISO_PART_FLAG_OWN_FILTER = 2, ISO_PART_FLAG_SENSOR = 4,
  ISO_PART_FLAG_REPORT_CONTACTS = 8
};
typedef uint32_t iso_joint_flag;
enum {
  ISO_JOINT_FLAG_COLLIDE_CONNECTED = 1, ISO_JOINT_FLAG_LIMIT = 2, ISO_JOINT_FLAG_MOTOR = 4, ISO_JOINT_FLAG_SPRING = 8,
  ISO_JOINT_FLAG_CONE = 16, ISO_JOINT_FLAG_LOCK_X = 256, ISO_JOINT_FLAG_LOCK_Y = 512, ISO_JOINT_FLAG_LOCK_Z = 1024,
  ISO_JOINT_FLAG_LOCK_SWING_X = 2048, ISO_JOINT_FLAG_LOCK_SWING_Y = 4096, ISO_JOINT_FLAG_LOCK_TWIST = 8192,
  ISO_JOINT_FLAG_LOCK_POINT = 1792, ISO_JOINT_FLAG_LOCK_SWING = 6144, ISO_JOINT_FLAG_LOCK_TURNS = 14336
};
typedef uint32_t iso_zone_effect;
enum {
  ISO_ZONE_EFFECT_ACCELERATION = 1, ISO_ZONE_EFFECT_WIND = 2, ISO_ZONE_EFFECT_GRAVITY = 4, ISO_ZONE_EFFECT_WATER = 8
};

/* Pointers within structs: eight bytes on every target. */
typedef union iso_text { const char* at; uint64_t bits; } iso_text;
typedef union iso_body_list { const iso_body* at; uint64_t bits; } iso_body_list;
typedef union iso_number_list { const uint32_t* at; uint64_t bits; } iso_number_list;
typedef union iso_height_list { const int16_t* at; uint64_t bits; } iso_height_list;
typedef union iso_byte_list { const uint8_t* at; uint64_t bits; } iso_byte_list;
typedef union iso_double_list { const double* at; uint64_t bits; } iso_double_list;

typedef struct iso_filter {
  uint32_t category;
  uint32_t mask;
  uint32_t group;
} iso_filter;
typedef struct iso_query_filter {
  uint32_t mask; /* categories that are seen */
  uint8_t sensors; /* sensors are seen too */
  uint8_t back_faces; /* rays and casts hit triangles from behind too */
  uint8_t reserved1[2];
  iso_body ignore; /* is not seen */
  uint32_t group; /* bodies of this filter.group are not seen; 0: none */
  iso_start_inside start_inside;
  iso_hit_per per; /* what a list of hits has one of */
  uint32_t ignore_all_count; /* ids of ignore_all */
  iso_body_list ignore_all; /* iso_body: are not seen either */
  uint32_t ignore_kinds_count; /* numbers of ignore_kinds */
  uint32_t reserved; /* 0 */
  iso_number_list ignore_kinds; /* nor are bodies of these material.kind */
} iso_query_filter;
typedef struct iso_overlap_hit {
  iso_body body;
  uint32_t child; /* of the body's shape */
  uint32_t triangle; /* the lowest, of a mesh or height field; else 0 */
  uint8_t material; /* of the triangle; 0 where there is none */
  uint8_t reserved1[7];
} iso_overlap_hit;
typedef struct iso_body_pair {
  iso_body a;
  iso_body b;
  uint32_t child_a; /* the first of their parts that were in contact */
  uint32_t child_b; /* the first of their parts that were in contact */
} iso_body_pair;
typedef struct iso_sensor_event {
  iso_body sensor;
  iso_body other;
  uint32_t sensor_child; /* parts of their shapes */
  uint32_t other_child; /* parts of their shapes */
} iso_sensor_event;
typedef struct iso_render_pose {
  iso_body body;
  float position[3]; /* [m] of the body's origin */
  float orientation[4]; /* x y z w */
  uint8_t reserved1[4];
} iso_render_pose;
typedef struct iso_step_report {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  uint32_t clamped_speed; /* bodies whose speed was cut to Limits<S>, or whose turn to a radian a sub-step */
  uint32_t clamped_force; /* bodies whose forces or impulses were cut: they would leave its range at once */
  uint32_t clamped_position; /* bodies held at the edge of the world */
  uint32_t stopped; /* bodies put back and stopped because a number was not finite */
  uint32_t crowded; /* bodies that did not find all their pairs: beyond Settings::most_pairs */
  uint32_t cut_compounds; /* pairs of bodies some of whose parts were left out, by the same budget */
  uint32_t unsolved; /* islands left too early: by `direct`, `admm` or a pass of `worst_first` */
  uint8_t reserved1[4];
} iso_step_report;
typedef struct iso_world_counts {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  uint32_t bodies;
  uint32_t static_bodies;
  uint32_t awake;
  uint32_t asleep;
  uint32_t contacts;
  uint32_t points;
  uint32_t joints;
  uint32_t shapes;
} iso_world_counts;
typedef struct iso_break_report {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  uint32_t broken; /* bodies that pieces took the place of */
  uint32_t pieces; /* of them all */
  uint32_t whole; /* marked bodies that could not be broken: too small, or of a shape that does not break */
  uint32_t expired; /* bodies whose time was over */
} iso_break_report;
typedef struct iso_fault_report {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  int32_t status; /* 0, or the Fault */
  uint32_t reserved; /* 0 */
  iso_text command; /* "apply_force" */
  iso_text field; /* "material.friction"; empty: no field alone */
  iso_text expected; /* "0 to 16" */
} iso_fault_report;
typedef struct iso_height_patch {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  uint32_t column; /* of its first place */
  uint32_t row; /* of its first place */
  uint32_t columns; /* places along each side */
  uint32_t rows; /* places along each side */
  iso_height_list heights; /* columns times rows, by rows, in units of the field's height */
  iso_byte_list materials; /* of the (columns - 1) times (rows - 1) cells between; null: they stay */
} iso_height_patch;
typedef struct iso_height_grid {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  uint32_t exponent; /* a step is 2^-exponent m */
  uint32_t height_shift; /* a unit of height is 2^height_shift steps */
  uint32_t columns;
  uint32_t rows;
  uint32_t pitch; /* [steps] between columns, and between rows */
  uint8_t reserved1[4];
} iso_height_grid;
typedef struct iso_height_sheet {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  uint32_t columns;
  uint32_t rows;
  double pitch; /* [m] between columns, and between rows */
  iso_double_list heights; /* [m] columns times rows, by rows */
} iso_height_sheet;
typedef struct iso_triangles {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  uint32_t point_count;
  uint32_t triangle_count;
  iso_double_list points; /* [m] x, y, z of each */
  iso_number_list vertices; /* three a triangle, counter-clockwise seen from its outward side */
} iso_triangles;
typedef struct iso_surface_materials {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  uint32_t count; /* of numbers: one a triangle or cell; 0: all have number 0 */
  uint32_t table_count; /* of table: what number 0 stands for, then 1 ...; beyond: the body's own */
  iso_byte_list numbers; /* 254: a ghost, 255: a hole of a height field */
  iso_double_list table; /* friction and restitution of each */
} iso_surface_materials;
typedef struct iso_replay_info {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  uint64_t behaviour; /* behaviour version that it was recorded with */
  uint64_t frames; /* in whole blocks */
  uint64_t start_hash; /* of the state before the first */
  uint64_t first_frame; /* the number that the game gives to its first */
  uint64_t keyframes;
  iso_verify_outcome file; /* what the file alone says: verified, incompatible, truncated, corrupt */
  uint32_t hz; /* [1/s] steps */
  uint32_t substeps;
  uint8_t has_state; /* the start is there */
  char scalar[32]; /* "q32.32"; empty where the file does not tell */
  char scene[136];
  char world[32]; /* its kind; empty: rigid bodies */
  char engine[32]; /* the version that recorded it */
  uint8_t reserved1[3];
} iso_replay_info;
typedef struct iso_replay_result {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_verify_outcome outcome; /* its number is the exit status of `isostep verify` */
  iso_verify_where where; /* of what diverged */
  uint64_t frames; /* compared; else the frame that diverged, or the first that is missing or not played */
  uint64_t expected; /* diverged: the replay's hash */
  uint64_t actual; /* diverged: the hash here */
  uint64_t offset; /* [bytes] truncated, corrupt: the place in the file */
  char scalar[32];
  char scene[136];
  char lanes[16]; /* that stepped it; empty: nothing did */
  char text[512]; /* the outcome as a sentence */
} iso_replay_result;
typedef struct iso_selfcheck_result {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  uint8_t sound; /* every scalar with every set of lanes has frames that agree, and none that does not */
  uint8_t reserved1[3];
  uint32_t engine; /* deviations of the library's arithmetic, 0 on a sound machine */
  uint32_t recordings; /* replayed */
  uint32_t failed; /* of these */
  uint64_t frames; /* whose hashes were computed again and agreed */
  char text[512]; /* one line */
} iso_selfcheck_result;

/* F32: float. What the members mean is written here, and is the same in the other families. */
typedef struct iso_f32_vec3 {
  float x;
  float y;
  float z;
} iso_f32_vec3;
typedef struct iso_f32_unit_vec3 {
  float x;
  float y;
  float z;
} iso_f32_unit_vec3;
typedef struct iso_f32_quat {
  float x;
  float y;
  float z;
  float w;
} iso_f32_quat;
typedef struct iso_f32_pose {
  iso_f32_vec3 position;
  iso_f32_quat orientation;
} iso_f32_pose;
typedef struct iso_f32_mat3 {
  iso_f32_vec3 rows[3];
} iso_f32_mat3;
typedef struct iso_f32_aabb {
  iso_f32_vec3 low; /* [m], world frame; low <= high */
  iso_f32_vec3 high; /* [m], world frame; low <= high */
} iso_f32_aabb;
typedef struct iso_f32_material {
  float friction; /* [1] Coulomb, of what slides: the dynamic coefficient */
  float restitution; /* [1] 0..1, of what meets at Settings::restitution_threshold or more */
  float rolling_resistance; /* [m] lever arm of the normal force that resists rolling */
  /* [m] Radius of the least patch: friction resists spinning about a contact's normal as if it acted so far from the
     middle of its points, or as far as these lie. It slows balls of 1 m and 10 cm in radius by 0.1 and 12 rad/s^2. */
  float spin_resistance;
  iso_f32_vec3 surface_velocity; /* [m/s] world, a conveyor belt's */
  float static_friction; /* [1] of what does not slide; below friction: the same as friction */
  /* [1] 1/64..1: the part of friction that is left along the body's own x, y and z axes. Between the axes the force
     at its limit ends on an ellipsoid with these radii, so that runners {1/16, 1, 1} along x hold across. */
  iso_f32_vec3 anisotropy;
  uint32_t kind; /* of material, for the table of pairs; 0: none */
  uint32_t reserved; /* 0: keeps records of 8-byte scalars without padding */
} iso_f32_material;
typedef struct iso_f32_primitive {
  iso_shape_type type;
  uint32_t blob; /* 1 + the place of its blob, for shapes that have one; else 0 */
  iso_f32_vec3 half; /* [m] half extents of the core; of a cylinder or cone its half height is y */
  float radius; /* [m] added around the core, which then holds the whole shape; of a cylinder or cone its own */
  iso_f32_unit_vec3 normal; /* [1] half-space only */
  float offset; /* [m] half-space only */
} iso_f32_primitive;
typedef struct iso_f32_part_traits {
  uint32_t flags; /* part_flag */
  iso_filter filter;
  iso_f32_material material;
} iso_f32_part_traits;
typedef struct iso_f32_child {
  iso_f32_primitive primitive;
  iso_f32_pose pose;
  iso_f32_part_traits traits;
  uint64_t user_data; /* the game's, for whom events and hits name the part */
} iso_f32_child;
typedef struct iso_f32_joint_range {
  float lower;
  float upper;
} iso_f32_joint_range;
typedef struct iso_f32_joint_motor {
  float speed; /* [m/s] or [rad/s] */
  float max_force; /* [N] or [N m] at most */
} iso_f32_joint_motor;
typedef struct iso_f32_joint_spring {
  float frequency; /* [Hz] */
  float damping; /* [1] 1 = critical */
  float target; /* [m] or [rad] */
} iso_f32_joint_spring;
typedef struct iso_f32_joint_servo {
  float frequency; /* [Hz] */
  float damping; /* [1] 1 = critical */
  float target; /* [m] or [rad] */
  float max_force; /* [N] or [N m] at most; 0: any */
  float mass; /* [kg] or [kg m^2] that it is made for: AxisDrive::spring_mass */
} iso_f32_joint_servo;
typedef struct iso_f32_drive {
  iso_joint joint;
  iso_joint_axis axis;
  uint8_t limited; /* lower..upper holds */
  uint8_t motor;
  uint8_t reserved1[2];
  float lower; /* [m] or [rad] in (-pi, pi] */
  float upper;
  float motor_speed; /* [m/s] or [rad/s] of b against a; 0: the motor is a brake, or friction */
  float spring_target; /* [m] or [rad] */
  float spring_frequency; /* [Hz] up to half the sub-step rate; 0: no spring */
  float spring_damping; /* [1] ratio, 1 = critical */
  float max_force; /* [N] or [N m] most that the motor gives; without a motor the spring, 0: any */
  float spring_mass; /* [kg] or [kg m^2] that springs and soft limits are made for; 0: what they feel */
  float limit_frequency; /* [Hz] of limits that yield, up to half the sub-step rate; 0: hard ones */
  float limit_damping; /* [1] ratio, 1 = critical */
} iso_f32_drive;
typedef struct iso_f32_ragdoll_bone {
  int32_t parent; /* index of an earlier bone; -1: the root */
  uint8_t reserved1[4];
  iso_shape shape; /* of the world */
  iso_f32_pose pose; /* of the body's origin, world, at rest */
  float mass; /* [kg] 0: by the shape's volume at 1 kg/m^3, which is light as air */
  iso_f32_pose joint; /* to the parent, world; z: the bone's length, or a hinge's axis */
  uint8_t hinge; /* turns about z alone: knees, elbows */
  uint8_t reserved2[3];
  float swing_x; /* [rad] half axes of the ellipse in which z stays; of no hinge */
  float swing_y;
  float lower; /* [rad] of the twist, or of the hinge's angle */
  float upper;
} iso_f32_ragdoll_bone;
typedef struct iso_f32_ray_hit {
  iso_body body; /* null: nothing was hit */
  uint32_t child; /* of the body's shape */
  uint32_t triangle; /* of a mesh or height field; else 0 */
  iso_f32_vec3 point; /* [m] of the surface, world */
  iso_f32_unit_vec3 normal; /* [1] of the surface, against the ray or the shape that is cast */
  float fraction; /* [1] of the translation */
  uint8_t material; /* of the triangle; 0 where there is none */
  uint8_t inside; /* from the start: the normal is the way back of a ray, the shortest way out of a shape */
  uint8_t reserved1[2];
} iso_f32_ray_hit;
typedef struct iso_f32_shape_hit {
  iso_body body; /* null: nothing was hit */
  uint32_t child; /* of the body's shape */
  uint32_t triangle; /* of a mesh or height field; else 0 */
  iso_f32_vec3 point; /* [m] of the surface, world */
  iso_f32_unit_vec3 normal; /* [1] of the surface, against the ray or the shape that is cast */
  float fraction; /* [1] of the translation */
  uint8_t material; /* of the triangle; 0 where there is none */
  uint8_t inside; /* from the start: the normal is the way back of a ray, the shortest way out of a shape */
  uint8_t reserved1[2];
} iso_f32_shape_hit;
typedef struct iso_f32_closest_body {
  iso_body body;
  uint32_t child; /* of its shape */
  iso_f32_vec3 point; /* [m] on its surface */
  iso_f32_unit_vec3 normal; /* [1] outward */
  float distance; /* [m] negative: inside */
} iso_f32_closest_body;
typedef struct iso_f32_contact_begin {
  iso_body a;
  iso_body b;
  uint32_t child_a; /* the first parts of their shapes in contact */
  uint32_t child_b; /* the first parts of their shapes in contact */
  float impulse; /* [kg m/s] that reported contacts gave over the step along their normals; held at the format's end */
  iso_f32_unit_vec3 normal; /* [1] from a to b, of those parts */
} iso_f32_contact_begin;
typedef struct iso_f32_broke {
  iso_body body;
  /* [kg m/s] that all points of the pair gave over the step along their normals; held at the format's end */
  float impulse;
  iso_f32_vec3 point; /* [m] */
  iso_f32_unit_vec3 direction; /* [1] of the blow, into the body */
  uint8_t reserved1[4];
} iso_f32_broke;
typedef struct iso_f32_joint_broke {
  iso_joint joint;
  iso_body a; /* null: the world */
  iso_body b; /* null: the world */
  uint64_t user_data;
  float force; /* [N] as JointLoad has them */
  float torque; /* [N m] */
} iso_f32_joint_broke;
typedef struct iso_f32_contact_hit {
  iso_body a;
  iso_body b;
  uint32_t child_a; /* parts of their shapes */
  uint32_t child_b; /* parts of their shapes */
  iso_f32_vec3 point; /* [m] where they closed fastest, where b has it as the step ends */
  iso_f32_unit_vec3 normal; /* [1] from a to b */
  float speed; /* [m/s] of approach along the normal, as the step began */
  uint8_t reserved1[4];
} iso_f32_contact_hit;
typedef struct iso_f32_contact_point {
  iso_body a;
  iso_body b;
  uint32_t child_a; /* parts of their shapes */
  uint32_t child_b; /* parts of their shapes */
  uint32_t triangle_a; /* of a mesh or height field; else 0 */
  uint32_t triangle_b; /* of a mesh or height field; else 0 */
  iso_f32_vec3 point; /* [m] where b has it as the step ends */
  iso_f32_unit_vec3 normal; /* [1] from a to b */
  float separation; /* [m] as the step began; negative: overlap */
  float impulse; /* [kg m/s] that it gave over the step along the normal; held at the format's end */
} iso_f32_contact_point;
typedef struct iso_f32_settings {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  int32_t hz; /* [1/s] steps, 10..10000 */
  int32_t substeps; /* per step, 1..64, hz * substeps <= kMaxRate; of pgs: passes */
  iso_f32_vec3 gravity; /* [m/s^2] */
  uint8_t allow_sleep;
  uint8_t reserved1[3];
  iso_solver solver;
  uint32_t id_space; /* 0..255, in every id: worlds of one game with spaces of their own refuse each other's */
  /* [1] kLeastPairs..kMostPairs: the most pairs of bodies with overlapping boxes that a step handles. Each takes up
     to 2 kB and some microseconds. A heap of equal bodies has eight a body: the default suffices for 65 000 awake
     bodies, more than a core steps in real time. Beyond it a step leaves out pairs, last those that hold bodies up,
     and reports StepReport::crowded (crowd.hpp). Of compounds' parts twice as many collide:
     StepReport::cut_compounds. */
  int32_t most_pairs;
  iso_projection projection; /* of worst_first; other solvers take any and use none */
  /* [m/s] 0..Limits::speed(): bodies that meet more slowly do not bounce. Without it, rest is a rain of small
     bounces. Bodies that nothing presses together bounce above a sixteenth of it. */
  float restitution_threshold;
  uint8_t reserved2[4];
} iso_f32_settings;
typedef struct iso_f32_body_definition {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body_type type;
  uint8_t reserved1[4];
  iso_shape shape;
  iso_f32_vec3 position; /* [m] of the body's origin, world */
  iso_f32_quat orientation;
  iso_f32_vec3 velocity; /* [m/s] of the centre of mass */
  iso_f32_vec3 angular_velocity; /* [rad/s] world */
  float density; /* [kg/m^3] where mass is 0; water has 1000 */
  float mass; /* [kg] 0: from density */
  iso_f32_vec3 inertia; /* [kg m^2] principal, body axes; all 0: from the shape */
  iso_f32_material material;
  iso_filter filter;
  uint64_t user_data;
  float gravity_scale; /* [1] of the world's gravity */
  float linear_damping; /* [1/s] */
  float angular_damping; /* [1/s] */
  uint32_t locks; /* body_flag::kLockX ... */
  uint8_t sensor; /* tells what it overlaps, and touches nothing */
  uint8_t allow_sleep;
  uint8_t collide; /* false: no contacts, no events */
  uint8_t bullet; /* moving bodies stop it too, at any speed; two bullets may pass through each other */
  uint8_t report_contacts; /* events tell when contacts begin and end; parts may report by themselves */
  uint8_t reserved2[3];
} iso_f32_body_definition;
typedef struct iso_f32_body_mass {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  float density; /* [kg/m^3] where mass is 0; water has 1000 */
  float mass; /* [kg] 0: from density */
  iso_f32_vec3 inertia; /* [kg m^2] principal, body axes; all 0: from the shape */
  uint8_t reserved1[4];
} iso_f32_body_mass;
typedef struct iso_f32_body_state {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_f32_pose pose; /* [m] of the body's origin, world */
  iso_f32_vec3 centre; /* [m] centre of mass, world */
  iso_f32_vec3 velocity; /* [m/s] of the centre of mass */
  iso_f32_vec3 angular_velocity; /* [rad/s] world */
  uint64_t user_data;
  iso_body_type type;
  uint8_t awake;
  uint8_t enabled;
  uint8_t reserved1[2];
} iso_f32_body_state;
typedef struct iso_f32_body_properties {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body_type type;
  uint32_t flags; /* ISO_BODY_FLAG_... */
  iso_filter filter;
  uint8_t reserved1[4];
  uint64_t user_data;
  float mass; /* [kg] */
  iso_f32_vec3 local_centre; /* [m] centre of mass, body frame */
  iso_f32_material material;
  float gravity_scale; /* [1] */
  float linear_damping; /* [1/s] */
  float angular_damping; /* [1/s] */
} iso_f32_body_properties;
typedef struct iso_f32_sphere {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  float radius; /* [m] */
  uint8_t reserved1[4];
} iso_f32_sphere;
typedef struct iso_f32_box {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_f32_vec3 half_extents; /* [m] */
  uint8_t reserved1[4];
} iso_f32_box;
typedef struct iso_f32_capsule {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  float radius; /* [m] */
  float half_height; /* [m] of the cylinder alone */
} iso_f32_capsule;
typedef struct iso_f32_half_space {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_f32_unit_vec3 normal; /* [1] */
  float offset; /* [m] */
} iso_f32_half_space;
typedef struct iso_f32_cylinder {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  float radius; /* [m] */
  float half_height; /* [m] */
} iso_f32_cylinder;
typedef struct iso_f32_cone {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  float radius; /* [m] of the base */
  float half_height; /* [m] */
} iso_f32_cone;
typedef struct iso_f32_hull {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  float radius; /* [m] around the core */
  uint8_t reserved1[4];
} iso_f32_hull;
typedef struct iso_f32_joint_properties {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_joint_type type;
  uint32_t flags; /* joint_flag */
  uint32_t body_a; /* slots */
  uint32_t body_b;
  uint32_t generation_a; /* of the bodies' ids: checked when the joint is made */
  uint32_t generation_b;
  uint64_t user_data;
  iso_f32_pose frame_a; /* from the centre of mass, body axes; for the world its own frame */
  iso_f32_pose frame_b;
  float lower; /* [rad] or [m]: the kind's JointMeasure */
  float upper;
  float cone; /* [rad] largest angle between the z axes */
  float motor_speed; /* [rad/s] or [m/s] of b against a */
  /* [N m] or [N] most that the motor gives; less where in one sub-step it would turn the bodies, were they free,
     beyond Limits<S>::surface_speed() */
  float max_force;
  float spring_target; /* [rad] or [m], as lower */
  float spring_frequency; /* [Hz] up to half the sub-step rate; a spring's swing lasts up to 0.25 rad a sub-step */
  float spring_damping; /* [1] ratio, 1 = critical */
} iso_f32_joint_properties;
typedef struct iso_f32_ball {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body a;
  iso_body b;
  iso_f32_pose frame;
  uint8_t has_cone; /* cone counts */
  uint8_t reserved1[3];
  float cone; /* [rad] most between the z axes */
  uint8_t has_twist; /* twist counts */
  uint8_t reserved2[3];
  iso_f32_joint_range twist; /* of a ball joint */
  uint8_t collide;
  uint8_t reserved3[7];
} iso_f32_ball;
typedef struct iso_f32_constant_velocity {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body a;
  iso_body b;
  iso_f32_pose frame;
  uint8_t has_cone; /* cone counts */
  uint8_t reserved1[3];
  float cone; /* [rad] most between the z axes */
  uint8_t has_twist; /* twist counts */
  uint8_t reserved2[3];
  iso_f32_joint_range twist; /* of a ball joint */
  uint8_t collide;
  uint8_t reserved3[7];
} iso_f32_constant_velocity;
typedef struct iso_f32_fixed {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body a;
  iso_body b;
  iso_f32_pose frame;
  uint8_t collide; /* a and b have contacts with each other */
  uint8_t reserved1[3];
} iso_f32_fixed;
typedef struct iso_f32_universal {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body a;
  iso_body b;
  iso_f32_pose frame;
  uint8_t collide; /* a and b have contacts with each other */
  uint8_t reserved1[3];
} iso_f32_universal;
typedef struct iso_f32_angular {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body a;
  iso_body b;
  iso_f32_pose frame;
  uint8_t collide; /* a and b have contacts with each other */
  uint8_t reserved1[3];
} iso_f32_angular;
typedef struct iso_f32_hinge {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body a;
  iso_body b;
  iso_f32_pose frame;
  uint8_t has_limit; /* limit counts */
  uint8_t reserved1[3];
  iso_f32_joint_range limit;
  uint8_t has_motor; /* motor counts */
  uint8_t reserved2[3];
  iso_f32_joint_motor motor;
  uint8_t has_spring; /* spring counts */
  uint8_t reserved3[3];
  iso_f32_joint_spring spring;
  uint8_t collide;
  uint8_t reserved4[3];
} iso_f32_hinge;
typedef struct iso_f32_slider {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body a;
  iso_body b;
  iso_f32_pose frame;
  uint8_t has_limit; /* limit counts */
  uint8_t reserved1[3];
  iso_f32_joint_range limit;
  uint8_t has_motor; /* motor counts */
  uint8_t reserved2[3];
  iso_f32_joint_motor motor;
  uint8_t has_spring; /* spring counts */
  uint8_t reserved3[3];
  iso_f32_joint_spring spring;
  uint8_t collide;
  uint8_t reserved4[3];
} iso_f32_slider;
typedef struct iso_f32_cylindrical {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body a;
  iso_body b;
  iso_f32_pose frame;
  uint8_t has_limit; /* limit counts */
  uint8_t reserved1[3];
  iso_f32_joint_range limit;
  uint8_t has_motor; /* motor counts */
  uint8_t reserved2[3];
  iso_f32_joint_motor motor;
  uint8_t has_spring; /* spring counts */
  uint8_t reserved3[3];
  iso_f32_joint_spring spring;
  uint8_t collide;
  uint8_t reserved4[3];
} iso_f32_cylindrical;
typedef struct iso_f32_planar {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body a;
  iso_body b;
  iso_f32_pose frame;
  uint8_t has_limit; /* limit counts */
  uint8_t reserved1[3];
  iso_f32_joint_range limit;
  uint8_t has_motor; /* motor counts */
  uint8_t reserved2[3];
  iso_f32_joint_motor motor;
  uint8_t has_spring; /* spring counts */
  uint8_t reserved3[3];
  iso_f32_joint_spring spring;
  uint8_t collide;
  uint8_t reserved4[3];
} iso_f32_planar;
typedef struct iso_f32_rod {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body a;
  iso_body b;
  iso_f32_vec3 anchor_a; /* [m] world */
  iso_f32_vec3 anchor_b;
  float length; /* [m] */
  uint8_t has_spring; /* spring counts */
  uint8_t reserved1[3];
  iso_f32_joint_spring spring; /* its target is `length` */
  uint8_t collide;
  uint8_t reserved2[3];
} iso_f32_rod;
typedef struct iso_f32_rope {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body a;
  iso_body b;
  iso_f32_vec3 anchor_a; /* [m] world */
  iso_f32_vec3 anchor_b;
  float length; /* [m] */
  uint8_t has_spring; /* spring counts */
  uint8_t reserved1[3];
  iso_f32_joint_spring spring; /* its target is `length` */
  uint8_t collide;
  uint8_t reserved2[3];
} iso_f32_rope;
typedef struct iso_f32_wheel_joint {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body a;
  iso_body b;
  iso_f32_pose frame;
  iso_f32_joint_spring suspension;
  iso_f32_joint_range travel; /* [m] along y */
  uint8_t has_steer; /* steer counts */
  uint8_t reserved1[3];
  iso_f32_joint_servo steer; /* [rad] about y; without it the wheel does not steer */
  uint8_t has_drive; /* drive counts */
  uint8_t reserved2[3];
  iso_f32_joint_motor drive; /* of the spin about z; a speed of 0 brakes */
  uint8_t collide;
  uint8_t reserved3[3];
} iso_f32_wheel_joint;
typedef struct iso_f32_motor_joint {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body a;
  iso_body b;
  iso_f32_pose frame_a;
  iso_f32_pose frame_b;
  iso_f32_joint_servo place;
  iso_f32_joint_servo turn;
  uint8_t collide;
  uint8_t reserved1[7];
} iso_f32_motor_joint;
typedef struct iso_f32_six_axis {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body a;
  iso_body b;
  iso_f32_pose frame;
  uint32_t locks; /* joint_flag::kLock..., and kCone */
  iso_f32_drive drives[6];
  uint32_t drive_count;
  uint8_t collide;
  uint8_t reserved1[3];
} iso_f32_six_axis;
typedef struct iso_f32_ragdoll_settings {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  float friction; /* [N m] each axis resists; 0 where servos hold the pose */
  iso_f32_joint_servo pose; /* holds the rest pose where its `max_force` [N m] is above 0; its target is 0 */
  float limit_frequency; /* [Hz] of limits that yield, as in AxisDrive; 0: hard ones */
  float limit_damping; /* [1] ratio, 1 = critical */
  /* of all bodies. Bones that a joint ties have no contacts with each other, and bones that overlap at rest none
     until they are apart */
  iso_filter filter;
  iso_f32_material material;
} iso_f32_ragdoll_settings;
typedef struct iso_f32_ray_cast {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_f32_vec3 origin; /* [m] world */
  iso_f32_vec3 translation; /* [m] */
  iso_query_filter filter;
} iso_f32_ray_cast;
typedef struct iso_f32_shape_cast {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_shape shape; /* of the world, of a single convex part; null: `primitive` */
  iso_f32_primitive primitive; /* without a blob */
  iso_f32_pose pose; /* [m] of the shape's frame at the start, world */
  iso_f32_vec3 translation; /* [m] */
  iso_query_filter filter;
} iso_f32_shape_cast;
typedef struct iso_f32_overlap_query {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_shape shape; /* of the world, of a single convex part; null: `primitive` */
  iso_f32_primitive primitive; /* without a blob */
  iso_f32_pose pose; /* [m] of the shape's frame, world */
  uint8_t reserved1[4];
  iso_query_filter filter;
} iso_f32_overlap_query;
typedef struct iso_f32_point_query {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_f32_vec3 point; /* [m] world */
  float max_distance; /* [m] */
  iso_query_filter filter;
} iso_f32_point_query;
typedef struct iso_f32_box_query {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_f32_aabb box; /* [m] world */
  iso_query_filter filter;
} iso_f32_box_query;
typedef struct iso_f32_force_zone {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_zone_shape shape;
  iso_f32_pose pose; /* of a sphere the position alone */
  iso_f32_vec3 half; /* [m] of a box; of a sphere x is the radius */
  iso_f32_vec3 acceleration; /* [m/s^2] world */
  iso_f32_vec3 wind; /* [m/s] world */
  uint32_t mask; /* categories: Filter. The wind blows for all */
  int32_t priority;
  uint32_t replaces; /* zone_effect: what it hides, of zones of lower priority; 0: it adds to them */
} iso_f32_force_zone;
typedef struct iso_f32_attractor {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body body; /* whose centre of mass attracts; null: the point */
  iso_f32_vec3 point; /* [m] world */
  float strength; /* [m^3/s^2] the constant of gravitation times the mass; negative: pushes away */
  float least_distance; /* [m] */
  float range; /* [m] 0: everywhere */
  uint32_t mask; /* categories: Filter */
  uint8_t reserved1[4];
} iso_f32_attractor;
typedef struct iso_f32_body_spring {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body a;
  iso_body b; /* null: the world */
  iso_f32_vec3 anchor_a; /* [m] body a's frame */
  iso_f32_vec3 anchor_b; /* [m] body b's frame, or the world's */
  float rest_length; /* [m] */
  float stiffness; /* [N/m] */
  float damping; /* [N s/m] along the spring */
  uint8_t only_pulls;
  uint8_t reserved1[3];
} iso_f32_body_spring;
typedef struct iso_f32_thruster {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body body;
  iso_f32_vec3 point; /* [m] body frame */
  iso_f32_vec3 force; /* [N] body frame */
} iso_f32_thruster;
typedef struct iso_f32_buoyancy {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body body;
  iso_f32_vec3 point; /* [m] body frame: the centre of buoyancy */
  float max_depth; /* [m] */
  float volume; /* [m^3] */
  float surface_height; /* [m] of the liquid's surface, along up */
  float density; /* [kg/m^3] of the liquid */
  uint8_t reserved1[4];
} iso_f32_buoyancy;
typedef struct iso_f32_explosion {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_f32_vec3 centre; /* [m] */
  uint8_t reserved1[4];
  uint64_t begin; /* [steps] World::tick() at which it goes off; add() makes now of what is past */
  float implosion_force; /* [N] */
  float implosion_least; /* [m] */
  float implosion_most; /* [m] */
  float implosion_duration; /* [s] */
  float wave_force; /* [N] */
  float wave_speed; /* [m/s] */
  float wave_width; /* [m] */
  float wave_ramp; /* [1] of the width */
  float wave_duration; /* [s] */
  float chimney_force; /* [N] */
  float chimney_radius; /* [m] */
  float chimney_height; /* [m] */
  float chimney_duration; /* [s] */
  uint8_t is_shielded; /* static bodies between the centre and the point keep it off */
  uint8_t reserved2[3];
  uint32_t mask; /* categories: Filter */
  uint8_t reserved3[4];
} iso_f32_explosion;
typedef struct iso_f32_water {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  float surface_height; /* [m] along up, of the water at rest */
  float density; /* [kg/m^3] */
  iso_f32_vec3 middle; /* [m] of the region: a box along the world's axes */
  iso_f32_vec3 half; /* [m] all 0: everywhere */
  iso_f32_vec3 current; /* [m/s] */
  float linear_drag; /* [1/s] each of a kg of water displaced */
  float quadratic_drag; /* [1/m] the same, times speed */
  float angular_drag; /* [1/s] of the body's turning, each of its kg displaced */
  float wave_height; /* [m] above the water at rest; 0: no wave */
  float wave_length; /* [m] */
  float wave_period; /* [s] */
  iso_f32_unit_vec3 wave_direction; /* [1] unit length; along the surface */
  uint32_t mask; /* categories: Filter */
  int32_t priority;
  uint8_t replaces; /* hides water of lower priority from what it acts on */
  uint8_t reserved1[7];
} iso_f32_water;
typedef struct iso_f32_drag {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body body;
  float linear; /* [N s/m] */
  float quadratic; /* [N s^2/m^2] */
  float angular; /* [N m s] */
  uint8_t reserved1[4];
} iso_f32_drag;
typedef struct iso_f32_aero_surface {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body body;
  iso_f32_vec3 point; /* [m] body frame */
  iso_f32_quat orientation; /* surface's frame to body frame */
  iso_f32_mat3 tensor; /* [N s/m], or [N s^2/m^2] of |v| v */
  iso_f32_mat3 low;
  iso_f32_mat3 high;
  float control; /* [1] -1 to 1 */
  uint8_t is_quadratic;
  uint8_t is_under_water; /* a keel, a water rudder, a hydrofoil */
  uint8_t reserved1[2];
} iso_f32_aero_surface;
typedef struct iso_f32_damping_zone {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_zone_shape shape;
  iso_f32_pose pose; /* of a sphere the position alone */
  iso_f32_vec3 half; /* [m] of a box; of a sphere x is the radius */
  float linear; /* [1/s] of velocities */
  float angular; /* [1/s] of angular velocities */
  uint32_t mask; /* categories: Filter */
  int32_t priority;
  uint8_t replaces; /* hides zones of lower priority from what it acts on */
  uint8_t reserved1[3];
} iso_f32_damping_zone;
typedef struct iso_f32_material_pair {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  uint32_t kind_a; /* Material::kind, 1 or more */
  uint32_t kind_b; /* Material::kind, 1 or more */
  float friction; /* [1] of what slides */
  float static_friction; /* [1] of what does not; below friction: the same */
  float restitution; /* [1] 0..1 */
  float rolling_resistance; /* [m] */
  float spin_resistance; /* [m] */
  uint8_t reserved1[4];
} iso_f32_material_pair;
typedef struct iso_f32_breakable {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body body;
  float break_impulse; /* [kg m/s] */
  iso_break_pattern pattern;
  uint32_t most_pieces; /* 2 to 256; of eight_boxes 8 or more */
  uint32_t depth; /* how often: 1: its pieces do not break; 0: it does not, but may expire */
  iso_f32_unit_vec3 grain; /* [1] of wood, in the shape's frame: unit length */
  uint8_t reserved1[4];
  uint64_t seed;
  float small_mass; /* [kg] pieces lighter than that are gone */
  uint32_t lifetime; /* [steps] after so long; 0: all stay */
  uint64_t expires; /* [steps] World::tick() from which break_bodies() takes it away; 0: never */
  uint8_t owns_shape; /* break_bodies() removes the shape along with it: pieces have shapes of their own */
  uint8_t reserved2[7];
} iso_f32_breakable;
typedef struct iso_f32_character {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body body;
  float step_height; /* [m] that it climbs, and follows down */
  float least_up; /* [1] of a normal that it stands on: the cosine of the steepest slope */
  float skin; /* [m] that it keeps from what is in its way */
  float mass; /* [kg] that its ground bears */
  float push_force; /* [N] */
  float air_acceleration; /* [m/s^2] towards CharacterInput::move while it is in the air */
  float gravity_scale; /* [1] */
  uint32_t mask; /* categories in its way, of those that its body's Filter collides with */
} iso_f32_character;
typedef struct iso_f32_vehicle {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body body;
  float engine_torque; /* [N m] at full throttle */
  float engine_speed; /* [rad/s] at which it has no torque left */
  float gears[8]; /* [1] 0: neutral; below 0: reverse */
  float final_drive; /* [1] */
  float engine_inertia; /* [kg m^2] 0, or 2^-10 or more */
  float clutch_torque; /* [N m] at most, fully engaged */
  float differential_lock; /* [1] 0 to 1 */
  float brake_torque; /* [N m] a wheel */
  float handbrake_torque; /* [N m] a wheel */
  float ackermann; /* [1] 0 to 1 */
  float track_steer; /* [1] 0 to 2 */
} iso_f32_vehicle;
typedef struct iso_f32_wheel {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body body;
  iso_f32_vec3 hard_point; /* [m] body frame: the wheel's middle at length 0 */
  iso_f32_unit_vec3 suspension; /* [1] body frame, unit length: down */
  iso_f32_unit_vec3 axle_direction; /* [1] body frame, unit length: to the left */
  float free_length; /* [m] */
  float travel; /* [m] */
  float stiffness; /* [N/m] */
  float damping; /* [N s/m] */
  float radius; /* [m] */
  float inertia; /* [kg m^2] about the axle */
  float grip_along; /* [1] friction */
  float grip_across; /* [1] */
  float peak_slip; /* [1] above 0 */
  float peak_grip; /* [1] */
  float slide_slip; /* [1] above peak_slip */
  float slide_grip; /* [1] */
  float steer_angle; /* [rad] at steer 1 */
  float drive_share; /* [1] of the torque, to those of the other wheels */
  float brake_share; /* [1] */
  float handbrake_share; /* [1] */
  uint32_t axle; /* of the anti-roll bar */
  float anti_roll; /* [N/m] the larger of the two counts */
  uint32_t track; /* 0: none */
} iso_f32_wheel;
typedef struct iso_f32_surface_velocity {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body body;
  iso_f32_vec3 linear; /* [m/s] body frame */
  iso_f32_vec3 angular; /* [rad/s] body frame, about the body's origin, of a part's record too */
  uint32_t part; /* child of the body's shape */
  uint8_t reserved1[4];
} iso_f32_surface_velocity;
typedef struct iso_f32_ghost {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body a;
  iso_body b;
} iso_f32_ghost;
typedef struct iso_f32_one_way {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body body;
  iso_f32_unit_vec3 axis; /* [1] body frame, unit length */
  float least_cosine; /* [1] of the normal to the axis: 60 degrees */
} iso_f32_one_way;
typedef struct iso_f32_hit_report {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body body;
  float speed; /* [m/s] along the normal, as the step begins in which they first press on each other */
  uint8_t reserved1[4];
} iso_f32_hit_report;
typedef struct iso_f32_contact_report {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body body;
} iso_f32_contact_report;
typedef struct iso_f32_joint_load {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_joint joint;
  float break_force; /* [N] 0: no force breaks it */
  float break_torque; /* [N m] 0: no torque breaks it */
} iso_f32_joint_load;
typedef struct iso_f32_coupling {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_joint joint_a;
  iso_joint joint_b;
  iso_joint joint_c; /* null: of two joints */
  float ratio_a; /* [1] of an angle, a whole number up to kMostTeeth; [rad/m] of a length beside an angle */
  float ratio_b;
  float ratio_c;
  float lower; /* [rad], of lengths alone [m] */
  float upper;
  uint8_t reserved1[4];
} iso_f32_coupling;
typedef struct iso_f32_axis_drive {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_joint joint;
  iso_joint_axis axis;
  uint8_t limited; /* lower..upper holds */
  uint8_t motor;
  uint8_t reserved1[2];
  float lower; /* [m] or [rad] in (-pi, pi] */
  float upper;
  float motor_speed; /* [m/s] or [rad/s] of b against a; 0: the motor is a brake, or friction */
  float spring_target; /* [m] or [rad] */
  float spring_frequency; /* [Hz] up to half the sub-step rate; 0: no spring */
  float spring_damping; /* [1] ratio, 1 = critical */
  float max_force; /* [N] or [N m] most that the motor gives; without a motor the spring, 0: any */
  float spring_mass; /* [kg] or [kg m^2] that springs and soft limits are made for; 0: what they feel */
  float limit_frequency; /* [Hz] of limits that yield, up to half the sub-step rate; 0: hard ones */
  float limit_damping; /* [1] ratio, 1 = critical */
} iso_f32_axis_drive;
typedef struct iso_f32_kind_ghost {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  uint32_t kind_a; /* Material::kind, 1 or more */
  uint32_t kind_b; /* Material::kind, 1 or more */
} iso_f32_kind_ghost;
typedef struct iso_f32_kind_response {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  uint32_t kind_a; /* Material::kind, 1 or more */
  uint32_t kind_b; /* Material::kind, 1 or more */
  float inverse_mass_scale_a; /* [1] 0, or 2^-8 to 1; not both 0 */
  float inverse_mass_scale_b;
  float inverse_inertia_scale_a; /* [1] 0 to 1, times those of the masses; 0: the contact does not turn the body */
  float inverse_inertia_scale_b;
  float max_force; /* [N] along the normal; 0: any */
  uint8_t reserved1[4];
} iso_f32_kind_response;
typedef struct iso_f32_sensor_mount {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_body sensor;
  iso_body on; /* the carrier: of any type */
  iso_f32_pose frame; /* of the sensor's origin in the carrier's frame */
  uint8_t reserved1[4];
} iso_f32_sensor_mount;
typedef struct iso_f32_breakable_input {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  float impulse; /* [kg m/s] 0: whole */
  iso_f32_vec3 point; /* [m] body frame */
  iso_f32_unit_vec3 direction; /* [1] into the body, body frame */
  uint8_t reserved1[4];
} iso_f32_breakable_input;
typedef struct iso_f32_character_input {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_f32_vec3 move; /* [m/s] along the ground, world */
  float jump; /* [m/s] upwards; 0 again once it has left the ground */
} iso_f32_character_input;
typedef struct iso_f32_vehicle_input {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  float throttle; /* [1] -1 to 1 */
  float clutch; /* [1] 0: the engine runs alone, to 1: engaged */
  float brake; /* [1] 0 to 1 */
  float handbrake; /* [1] 0 to 1 */
  float steer; /* [1] -1 to 1 */
  uint32_t gear; /* of VehicleSettings::gears */
} iso_f32_vehicle_input;
typedef struct iso_f32_character_state {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  iso_footing footing;
  uint8_t reserved1[4];
  iso_body ground; /* null: airborne, or put elsewhere since */
  uint32_t stuck; /* [steps] in a row in which it could not leave what it overlaps */
  iso_f32_vec3 foot; /* [m] on the ground, in its body's frame */
  iso_f32_vec3 foot_at; /* [m] the same, world */
  iso_f32_vec3 velocity; /* [m/s] world */
  iso_f32_unit_vec3 normal; /* [1] of the ground */
  uint8_t reserved2[4];
} iso_f32_character_state;
typedef struct iso_f32_vehicle_state {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  float engine_spin; /* [rad/s] of its shaft, up to fastest_engine() */
  float clutch_load; /* [N m] on the gears, in the last sub-step */
} iso_f32_vehicle_state;
typedef struct iso_f32_wheel_state {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  float spin; /* [rad/s] about the axle, seen from the body */
  float angle; /* [rad] that it has turned, 0 to 2 pi */
  float steered; /* [rad] from axle_direction, counter-clockwise seen from above */
  float length; /* [m] from the hard point to the wheel's middle */
  float slip; /* [1] of the tyre: the mean of this and earlier sub-steps, the last counts a half */
  uint8_t reserved1[4];
  iso_body contact_body;
  iso_f32_vec3 contact_point; /* [m] world */
  iso_f32_unit_vec3 contact_normal; /* [1] of the ground, world */
  float load; /* [N] along the normal */
  float along; /* [N] on the body, forward */
  float across; /* [N] on the body, normal x forward */
  uint8_t reserved2[4];
} iso_f32_wheel_state;
typedef struct iso_f32_joint_load_state {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  float force; /* [N] on body b, of all the joint does; held at the format's end */
  float torque; /* [N m] about b's origin of the joint; held at the format's end */
} iso_f32_joint_load_state;
typedef struct iso_f32_coupling_state {
  uint32_t size; /* [bytes] of this struct, as _init sets it */
  uint32_t reserved0;
  float load; /* [N m], of lengths alone [N]: each joint's coordinate is pushed with its ratio times that */
  uint8_t reserved1[4];
} iso_f32_coupling_state;

/* F64: double. The members are those of F32. */
typedef struct iso_f64_vec3 {
  double x; double y; double z;
} iso_f64_vec3;
typedef struct iso_f64_unit_vec3 {
  double x; double y; double z;
} iso_f64_unit_vec3;
typedef struct iso_f64_quat {
  double x; double y; double z; double w;
} iso_f64_quat;
typedef struct iso_f64_pose {
  iso_f64_vec3 position; iso_f64_quat orientation;
} iso_f64_pose;
typedef struct iso_f64_mat3 {
  iso_f64_vec3 rows[3];
} iso_f64_mat3;
typedef struct iso_f64_aabb {
  iso_f64_vec3 low; iso_f64_vec3 high;
} iso_f64_aabb;
typedef struct iso_f64_material {
  double friction; double restitution; double rolling_resistance; double spin_resistance;
  iso_f64_vec3 surface_velocity; double static_friction; iso_f64_vec3 anisotropy; uint32_t kind; uint32_t reserved;
} iso_f64_material;
typedef struct iso_f64_primitive {
  iso_shape_type type; uint32_t blob; iso_f64_vec3 half; double radius; iso_f64_unit_vec3 normal; double offset;
} iso_f64_primitive;
typedef struct iso_f64_part_traits {
  uint32_t flags; iso_filter filter; iso_f64_material material;
} iso_f64_part_traits;
typedef struct iso_f64_child {
  iso_f64_primitive primitive; iso_f64_pose pose; iso_f64_part_traits traits; uint64_t user_data;
} iso_f64_child;
typedef struct iso_f64_joint_range {
  double lower; double upper;
} iso_f64_joint_range;
typedef struct iso_f64_joint_motor {
  double speed; double max_force;
} iso_f64_joint_motor;
typedef struct iso_f64_joint_spring {
  double frequency; double damping; double target;
} iso_f64_joint_spring;
typedef struct iso_f64_joint_servo {
  double frequency; double damping; double target; double max_force; double mass;
} iso_f64_joint_servo;
typedef struct iso_f64_drive {
  iso_joint joint; iso_joint_axis axis; uint8_t limited; uint8_t motor; uint8_t reserved1[2]; double lower;
  double upper; double motor_speed; double spring_target; double spring_frequency; double spring_damping;
  double max_force; double spring_mass; double limit_frequency; double limit_damping;
} iso_f64_drive;
typedef struct iso_f64_ragdoll_bone {
  int32_t parent; uint8_t reserved1[4]; iso_shape shape; iso_f64_pose pose; double mass; iso_f64_pose joint;
  uint8_t hinge; uint8_t reserved2[7]; double swing_x; double swing_y; double lower; double upper;
} iso_f64_ragdoll_bone;
typedef struct iso_f64_ray_hit {
  iso_body body; uint32_t child; uint32_t triangle; iso_f64_vec3 point; iso_f64_unit_vec3 normal; double fraction;
  uint8_t material; uint8_t inside; uint8_t reserved1[6];
} iso_f64_ray_hit;
typedef struct iso_f64_shape_hit {
  iso_body body; uint32_t child; uint32_t triangle; iso_f64_vec3 point; iso_f64_unit_vec3 normal; double fraction;
  uint8_t material; uint8_t inside; uint8_t reserved1[6];
} iso_f64_shape_hit;
typedef struct iso_f64_closest_body {
  iso_body body; uint32_t child; uint8_t reserved1[4]; iso_f64_vec3 point; iso_f64_unit_vec3 normal; double distance;
} iso_f64_closest_body;
typedef struct iso_f64_contact_begin {
  iso_body a; iso_body b; uint32_t child_a; uint32_t child_b; double impulse; iso_f64_unit_vec3 normal;
} iso_f64_contact_begin;
typedef struct iso_f64_broke {
  iso_body body; double impulse; iso_f64_vec3 point; iso_f64_unit_vec3 direction;
} iso_f64_broke;
typedef struct iso_f64_joint_broke {
  iso_joint joint; iso_body a; iso_body b; uint64_t user_data; double force; double torque;
} iso_f64_joint_broke;
typedef struct iso_f64_contact_hit {
  iso_body a; iso_body b; uint32_t child_a; uint32_t child_b; iso_f64_vec3 point; iso_f64_unit_vec3 normal;
  double speed;
} iso_f64_contact_hit;
typedef struct iso_f64_contact_point {
  iso_body a; iso_body b; uint32_t child_a; uint32_t child_b; uint32_t triangle_a; uint32_t triangle_b;
  iso_f64_vec3 point; iso_f64_unit_vec3 normal; double separation; double impulse;
} iso_f64_contact_point;
typedef struct iso_f64_settings {
  uint32_t size; uint32_t reserved0; int32_t hz; int32_t substeps; iso_f64_vec3 gravity; uint8_t allow_sleep;
  uint8_t reserved1[3]; iso_solver solver; uint32_t id_space; int32_t most_pairs; iso_projection projection;
  uint8_t reserved2[4]; double restitution_threshold;
} iso_f64_settings;
typedef struct iso_f64_body_definition {
  uint32_t size; uint32_t reserved0; iso_body_type type; uint8_t reserved1[4]; iso_shape shape; iso_f64_vec3 position;
  iso_f64_quat orientation; iso_f64_vec3 velocity; iso_f64_vec3 angular_velocity; double density; double mass;
  iso_f64_vec3 inertia; iso_f64_material material; iso_filter filter; uint8_t reserved2[4]; uint64_t user_data;
  double gravity_scale; double linear_damping; double angular_damping; uint32_t locks; uint8_t sensor;
  uint8_t allow_sleep; uint8_t collide; uint8_t bullet; uint8_t report_contacts; uint8_t reserved3[7];
} iso_f64_body_definition;
typedef struct iso_f64_body_mass {
  uint32_t size; uint32_t reserved0; double density; double mass; iso_f64_vec3 inertia;
} iso_f64_body_mass;
typedef struct iso_f64_body_state {
  uint32_t size; uint32_t reserved0; iso_f64_pose pose; iso_f64_vec3 centre; iso_f64_vec3 velocity;
  iso_f64_vec3 angular_velocity; uint64_t user_data; iso_body_type type; uint8_t awake; uint8_t enabled;
  uint8_t reserved1[2];
} iso_f64_body_state;
typedef struct iso_f64_body_properties {
  uint32_t size; uint32_t reserved0; iso_body_type type; uint32_t flags; iso_filter filter; uint8_t reserved1[4];
  uint64_t user_data; double mass; iso_f64_vec3 local_centre; iso_f64_material material; double gravity_scale;
  double linear_damping; double angular_damping;
} iso_f64_body_properties;
typedef struct iso_f64_sphere {
  uint32_t size; uint32_t reserved0; double radius;
} iso_f64_sphere;
typedef struct iso_f64_box {
  uint32_t size; uint32_t reserved0; iso_f64_vec3 half_extents;
} iso_f64_box;
typedef struct iso_f64_capsule {
  uint32_t size; uint32_t reserved0; double radius; double half_height;
} iso_f64_capsule;
typedef struct iso_f64_half_space {
  uint32_t size; uint32_t reserved0; iso_f64_unit_vec3 normal; double offset;
} iso_f64_half_space;
typedef struct iso_f64_cylinder {
  uint32_t size; uint32_t reserved0; double radius; double half_height;
} iso_f64_cylinder;
typedef struct iso_f64_cone {
  uint32_t size; uint32_t reserved0; double radius; double half_height;
} iso_f64_cone;
typedef struct iso_f64_hull {
  uint32_t size; uint32_t reserved0; double radius;
} iso_f64_hull;
typedef struct iso_f64_joint_properties {
  uint32_t size; uint32_t reserved0; iso_joint_type type; uint32_t flags; uint32_t body_a; uint32_t body_b;
  uint32_t generation_a; uint32_t generation_b; uint64_t user_data; iso_f64_pose frame_a; iso_f64_pose frame_b;
  double lower; double upper; double cone; double motor_speed; double max_force; double spring_target;
  double spring_frequency; double spring_damping;
} iso_f64_joint_properties;
typedef struct iso_f64_ball {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_f64_pose frame; uint8_t has_cone;
  uint8_t reserved1[7]; double cone; uint8_t has_twist; uint8_t reserved2[7]; iso_f64_joint_range twist;
  uint8_t collide; uint8_t reserved3[7];
} iso_f64_ball;
typedef struct iso_f64_constant_velocity {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_f64_pose frame; uint8_t has_cone;
  uint8_t reserved1[7]; double cone; uint8_t has_twist; uint8_t reserved2[7]; iso_f64_joint_range twist;
  uint8_t collide; uint8_t reserved3[7];
} iso_f64_constant_velocity;
typedef struct iso_f64_fixed {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_f64_pose frame; uint8_t collide; uint8_t reserved1[7];
} iso_f64_fixed;
typedef struct iso_f64_universal {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_f64_pose frame; uint8_t collide; uint8_t reserved1[7];
} iso_f64_universal;
typedef struct iso_f64_angular {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_f64_pose frame; uint8_t collide; uint8_t reserved1[7];
} iso_f64_angular;
typedef struct iso_f64_hinge {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_f64_pose frame; uint8_t has_limit;
  uint8_t reserved1[7]; iso_f64_joint_range limit; uint8_t has_motor; uint8_t reserved2[7]; iso_f64_joint_motor motor;
  uint8_t has_spring; uint8_t reserved3[7]; iso_f64_joint_spring spring; uint8_t collide; uint8_t reserved4[7];
} iso_f64_hinge;
typedef struct iso_f64_slider {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_f64_pose frame; uint8_t has_limit;
  uint8_t reserved1[7]; iso_f64_joint_range limit; uint8_t has_motor; uint8_t reserved2[7]; iso_f64_joint_motor motor;
  uint8_t has_spring; uint8_t reserved3[7]; iso_f64_joint_spring spring; uint8_t collide; uint8_t reserved4[7];
} iso_f64_slider;
typedef struct iso_f64_cylindrical {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_f64_pose frame; uint8_t has_limit;
  uint8_t reserved1[7]; iso_f64_joint_range limit; uint8_t has_motor; uint8_t reserved2[7]; iso_f64_joint_motor motor;
  uint8_t has_spring; uint8_t reserved3[7]; iso_f64_joint_spring spring; uint8_t collide; uint8_t reserved4[7];
} iso_f64_cylindrical;
typedef struct iso_f64_planar {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_f64_pose frame; uint8_t has_limit;
  uint8_t reserved1[7]; iso_f64_joint_range limit; uint8_t has_motor; uint8_t reserved2[7]; iso_f64_joint_motor motor;
  uint8_t has_spring; uint8_t reserved3[7]; iso_f64_joint_spring spring; uint8_t collide; uint8_t reserved4[7];
} iso_f64_planar;
typedef struct iso_f64_rod {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_f64_vec3 anchor_a; iso_f64_vec3 anchor_b;
  double length; uint8_t has_spring; uint8_t reserved1[7]; iso_f64_joint_spring spring; uint8_t collide;
  uint8_t reserved2[7];
} iso_f64_rod;
typedef struct iso_f64_rope {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_f64_vec3 anchor_a; iso_f64_vec3 anchor_b;
  double length; uint8_t has_spring; uint8_t reserved1[7]; iso_f64_joint_spring spring; uint8_t collide;
  uint8_t reserved2[7];
} iso_f64_rope;
typedef struct iso_f64_wheel_joint {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_f64_pose frame; iso_f64_joint_spring suspension;
  iso_f64_joint_range travel; uint8_t has_steer; uint8_t reserved1[7]; iso_f64_joint_servo steer; uint8_t has_drive;
  uint8_t reserved2[7]; iso_f64_joint_motor drive; uint8_t collide; uint8_t reserved3[7];
} iso_f64_wheel_joint;
typedef struct iso_f64_motor_joint {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_f64_pose frame_a; iso_f64_pose frame_b;
  iso_f64_joint_servo place; iso_f64_joint_servo turn; uint8_t collide; uint8_t reserved1[7];
} iso_f64_motor_joint;
typedef struct iso_f64_six_axis {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_f64_pose frame; uint32_t locks; uint8_t reserved1[4];
  iso_f64_drive drives[6]; uint32_t drive_count; uint8_t collide; uint8_t reserved2[3];
} iso_f64_six_axis;
typedef struct iso_f64_ragdoll_settings {
  uint32_t size; uint32_t reserved0; double friction; iso_f64_joint_servo pose; double limit_frequency;
  double limit_damping; iso_filter filter; uint8_t reserved1[4]; iso_f64_material material;
} iso_f64_ragdoll_settings;
typedef struct iso_f64_ray_cast {
  uint32_t size; uint32_t reserved0; iso_f64_vec3 origin; iso_f64_vec3 translation; iso_query_filter filter;
} iso_f64_ray_cast;
typedef struct iso_f64_shape_cast {
  uint32_t size; uint32_t reserved0; iso_shape shape; iso_f64_primitive primitive; iso_f64_pose pose;
  iso_f64_vec3 translation; iso_query_filter filter;
} iso_f64_shape_cast;
typedef struct iso_f64_overlap_query {
  uint32_t size; uint32_t reserved0; iso_shape shape; iso_f64_primitive primitive; iso_f64_pose pose;
  iso_query_filter filter;
} iso_f64_overlap_query;
typedef struct iso_f64_point_query {
  uint32_t size; uint32_t reserved0; iso_f64_vec3 point; double max_distance; iso_query_filter filter;
} iso_f64_point_query;
typedef struct iso_f64_box_query {
  uint32_t size; uint32_t reserved0; iso_f64_aabb box; iso_query_filter filter;
} iso_f64_box_query;
typedef struct iso_f64_force_zone {
  uint32_t size; uint32_t reserved0; iso_zone_shape shape; uint8_t reserved1[4]; iso_f64_pose pose; iso_f64_vec3 half;
  iso_f64_vec3 acceleration; iso_f64_vec3 wind; uint32_t mask; int32_t priority; uint32_t replaces;
  uint8_t reserved2[4];
} iso_f64_force_zone;
typedef struct iso_f64_attractor {
  uint32_t size; uint32_t reserved0; iso_body body; iso_f64_vec3 point; double strength; double least_distance;
  double range; uint32_t mask; uint8_t reserved1[4];
} iso_f64_attractor;
typedef struct iso_f64_body_spring {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_f64_vec3 anchor_a; iso_f64_vec3 anchor_b;
  double rest_length; double stiffness; double damping; uint8_t only_pulls; uint8_t reserved1[7];
} iso_f64_body_spring;
typedef struct iso_f64_thruster {
  uint32_t size; uint32_t reserved0; iso_body body; iso_f64_vec3 point; iso_f64_vec3 force;
} iso_f64_thruster;
typedef struct iso_f64_buoyancy {
  uint32_t size; uint32_t reserved0; iso_body body; iso_f64_vec3 point; double max_depth; double volume;
  double surface_height; double density;
} iso_f64_buoyancy;
typedef struct iso_f64_explosion {
  uint32_t size; uint32_t reserved0; iso_f64_vec3 centre; uint64_t begin; double implosion_force;
  double implosion_least; double implosion_most; double implosion_duration; double wave_force; double wave_speed;
  double wave_width; double wave_ramp; double wave_duration; double chimney_force; double chimney_radius;
  double chimney_height; double chimney_duration; uint8_t is_shielded; uint8_t reserved1[3]; uint32_t mask;
} iso_f64_explosion;
typedef struct iso_f64_water {
  uint32_t size; uint32_t reserved0; double surface_height; double density; iso_f64_vec3 middle; iso_f64_vec3 half;
  iso_f64_vec3 current; double linear_drag; double quadratic_drag; double angular_drag; double wave_height;
  double wave_length; double wave_period; iso_f64_unit_vec3 wave_direction; uint32_t mask; int32_t priority;
  uint8_t replaces; uint8_t reserved1[7];
} iso_f64_water;
typedef struct iso_f64_drag {
  uint32_t size; uint32_t reserved0; iso_body body; double linear; double quadratic; double angular;
} iso_f64_drag;
typedef struct iso_f64_aero_surface {
  uint32_t size; uint32_t reserved0; iso_body body; iso_f64_vec3 point; iso_f64_quat orientation; iso_f64_mat3 tensor;
  iso_f64_mat3 low; iso_f64_mat3 high; double control; uint8_t is_quadratic; uint8_t is_under_water;
  uint8_t reserved1[6];
} iso_f64_aero_surface;
typedef struct iso_f64_damping_zone {
  uint32_t size; uint32_t reserved0; iso_zone_shape shape; uint8_t reserved1[4]; iso_f64_pose pose; iso_f64_vec3 half;
  double linear; double angular; uint32_t mask; int32_t priority; uint8_t replaces; uint8_t reserved2[7];
} iso_f64_damping_zone;
typedef struct iso_f64_material_pair {
  uint32_t size; uint32_t reserved0; uint32_t kind_a; uint32_t kind_b; double friction; double static_friction;
  double restitution; double rolling_resistance; double spin_resistance;
} iso_f64_material_pair;
typedef struct iso_f64_breakable {
  uint32_t size; uint32_t reserved0; iso_body body; double break_impulse; iso_break_pattern pattern;
  uint32_t most_pieces; uint32_t depth; uint8_t reserved1[4]; iso_f64_unit_vec3 grain; uint64_t seed;
  double small_mass; uint32_t lifetime; uint8_t reserved2[4]; uint64_t expires; uint8_t owns_shape;
  uint8_t reserved3[7];
} iso_f64_breakable;
typedef struct iso_f64_character {
  uint32_t size; uint32_t reserved0; iso_body body; double step_height; double least_up; double skin; double mass;
  double push_force; double air_acceleration; double gravity_scale; uint32_t mask; uint8_t reserved1[4];
} iso_f64_character;
typedef struct iso_f64_vehicle {
  uint32_t size; uint32_t reserved0; iso_body body; double engine_torque; double engine_speed; double gears[8];
  double final_drive; double engine_inertia; double clutch_torque; double differential_lock; double brake_torque;
  double handbrake_torque; double ackermann; double track_steer;
} iso_f64_vehicle;
typedef struct iso_f64_wheel {
  uint32_t size; uint32_t reserved0; iso_body body; iso_f64_vec3 hard_point; iso_f64_unit_vec3 suspension;
  iso_f64_unit_vec3 axle_direction; double free_length; double travel; double stiffness; double damping; double radius;
  double inertia; double grip_along; double grip_across; double peak_slip; double peak_grip; double slide_slip;
  double slide_grip; double steer_angle; double drive_share; double brake_share; double handbrake_share; uint32_t axle;
  uint8_t reserved1[4]; double anti_roll; uint32_t track; uint8_t reserved2[4];
} iso_f64_wheel;
typedef struct iso_f64_surface_velocity {
  uint32_t size; uint32_t reserved0; iso_body body; iso_f64_vec3 linear; iso_f64_vec3 angular; uint32_t part;
  uint8_t reserved1[4];
} iso_f64_surface_velocity;
typedef struct iso_f64_ghost {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b;
} iso_f64_ghost;
typedef struct iso_f64_one_way {
  uint32_t size; uint32_t reserved0; iso_body body; iso_f64_unit_vec3 axis; double least_cosine;
} iso_f64_one_way;
typedef struct iso_f64_hit_report {
  uint32_t size; uint32_t reserved0; iso_body body; double speed;
} iso_f64_hit_report;
typedef struct iso_f64_contact_report {
  uint32_t size; uint32_t reserved0; iso_body body;
} iso_f64_contact_report;
typedef struct iso_f64_joint_load {
  uint32_t size; uint32_t reserved0; iso_joint joint; double break_force; double break_torque;
} iso_f64_joint_load;
typedef struct iso_f64_coupling {
  uint32_t size; uint32_t reserved0; iso_joint joint_a; iso_joint joint_b; iso_joint joint_c; double ratio_a;
  double ratio_b; double ratio_c; double lower; double upper;
} iso_f64_coupling;
typedef struct iso_f64_axis_drive {
  uint32_t size; uint32_t reserved0; iso_joint joint; iso_joint_axis axis; uint8_t limited; uint8_t motor;
  uint8_t reserved1[2]; double lower; double upper; double motor_speed; double spring_target; double spring_frequency;
  double spring_damping; double max_force; double spring_mass; double limit_frequency; double limit_damping;
} iso_f64_axis_drive;
typedef struct iso_f64_kind_ghost {
  uint32_t size; uint32_t reserved0; uint32_t kind_a; uint32_t kind_b;
} iso_f64_kind_ghost;
typedef struct iso_f64_kind_response {
  uint32_t size; uint32_t reserved0; uint32_t kind_a; uint32_t kind_b; double inverse_mass_scale_a;
  double inverse_mass_scale_b; double inverse_inertia_scale_a; double inverse_inertia_scale_b; double max_force;
} iso_f64_kind_response;
typedef struct iso_f64_sensor_mount {
  uint32_t size; uint32_t reserved0; iso_body sensor; iso_body on; iso_f64_pose frame;
} iso_f64_sensor_mount;
typedef struct iso_f64_breakable_input {
  uint32_t size; uint32_t reserved0; double impulse; iso_f64_vec3 point; iso_f64_unit_vec3 direction;
} iso_f64_breakable_input;
typedef struct iso_f64_character_input {
  uint32_t size; uint32_t reserved0; iso_f64_vec3 move; double jump;
} iso_f64_character_input;
typedef struct iso_f64_vehicle_input {
  uint32_t size; uint32_t reserved0; double throttle; double clutch; double brake; double handbrake; double steer;
  uint32_t gear; uint8_t reserved1[4];
} iso_f64_vehicle_input;
typedef struct iso_f64_character_state {
  uint32_t size; uint32_t reserved0; iso_footing footing; uint8_t reserved1[4]; iso_body ground; uint32_t stuck;
  uint8_t reserved2[4]; iso_f64_vec3 foot; iso_f64_vec3 foot_at; iso_f64_vec3 velocity; iso_f64_unit_vec3 normal;
} iso_f64_character_state;
typedef struct iso_f64_vehicle_state {
  uint32_t size; uint32_t reserved0; double engine_spin; double clutch_load;
} iso_f64_vehicle_state;
typedef struct iso_f64_wheel_state {
  uint32_t size; uint32_t reserved0; double spin; double angle; double steered; double length; double slip;
  iso_body contact_body; iso_f64_vec3 contact_point; iso_f64_unit_vec3 contact_normal; double load; double along;
  double across;
} iso_f64_wheel_state;
typedef struct iso_f64_joint_load_state {
  uint32_t size; uint32_t reserved0; double force; double torque;
} iso_f64_joint_load_state;
typedef struct iso_f64_coupling_state {
  uint32_t size; uint32_t reserved0; double load;
} iso_f64_coupling_state;

/* Q16: q16.16. The members are those of F32. */
typedef struct iso_q16_vec3 {
  int32_t x; int32_t y; int32_t z;
} iso_q16_vec3;
typedef struct iso_q16_unit_vec3 {
  int32_t x; int32_t y; int32_t z;
} iso_q16_unit_vec3;
typedef struct iso_q16_quat {
  int32_t x; int32_t y; int32_t z; int32_t w;
} iso_q16_quat;
typedef struct iso_q16_pose {
  iso_q16_vec3 position; iso_q16_quat orientation;
} iso_q16_pose;
typedef struct iso_q16_mat3 {
  iso_q16_vec3 rows[3];
} iso_q16_mat3;
typedef struct iso_q16_aabb {
  iso_q16_vec3 low; iso_q16_vec3 high;
} iso_q16_aabb;
typedef struct iso_q16_material {
  int32_t friction; int32_t restitution; int32_t rolling_resistance; int32_t spin_resistance;
  iso_q16_vec3 surface_velocity; int32_t static_friction; iso_q16_vec3 anisotropy; uint32_t kind; uint32_t reserved;
} iso_q16_material;
typedef struct iso_q16_primitive {
  iso_shape_type type; uint32_t blob; iso_q16_vec3 half; int32_t radius; iso_q16_unit_vec3 normal; int32_t offset;
} iso_q16_primitive;
typedef struct iso_q16_part_traits {
  uint32_t flags; iso_filter filter; iso_q16_material material;
} iso_q16_part_traits;
typedef struct iso_q16_child {
  iso_q16_primitive primitive; iso_q16_pose pose; iso_q16_part_traits traits; uint64_t user_data;
} iso_q16_child;
typedef struct iso_q16_joint_range {
  int32_t lower; int32_t upper;
} iso_q16_joint_range;
typedef struct iso_q16_joint_motor {
  int32_t speed; int32_t max_force;
} iso_q16_joint_motor;
typedef struct iso_q16_joint_spring {
  int32_t frequency; int32_t damping; int32_t target;
} iso_q16_joint_spring;
typedef struct iso_q16_joint_servo {
  int32_t frequency; int32_t damping; int32_t target; int32_t max_force; int32_t mass;
} iso_q16_joint_servo;
typedef struct iso_q16_drive {
  iso_joint joint; iso_joint_axis axis; uint8_t limited; uint8_t motor; uint8_t reserved1[2]; int32_t lower;
  int32_t upper; int32_t motor_speed; int32_t spring_target; int32_t spring_frequency; int32_t spring_damping;
  int32_t max_force; int32_t spring_mass; int32_t limit_frequency; int32_t limit_damping;
} iso_q16_drive;
typedef struct iso_q16_ragdoll_bone {
  int32_t parent; uint8_t reserved1[4]; iso_shape shape; iso_q16_pose pose; int32_t mass; iso_q16_pose joint;
  uint8_t hinge; uint8_t reserved2[3]; int32_t swing_x; int32_t swing_y; int32_t lower; int32_t upper;
} iso_q16_ragdoll_bone;
typedef struct iso_q16_ray_hit {
  iso_body body; uint32_t child; uint32_t triangle; iso_q16_vec3 point; iso_q16_unit_vec3 normal; int32_t fraction;
  uint8_t material; uint8_t inside; uint8_t reserved1[2];
} iso_q16_ray_hit;
typedef struct iso_q16_shape_hit {
  iso_body body; uint32_t child; uint32_t triangle; iso_q16_vec3 point; iso_q16_unit_vec3 normal; int32_t fraction;
  uint8_t material; uint8_t inside; uint8_t reserved1[2];
} iso_q16_shape_hit;
typedef struct iso_q16_closest_body {
  iso_body body; uint32_t child; iso_q16_vec3 point; iso_q16_unit_vec3 normal; int32_t distance;
} iso_q16_closest_body;
typedef struct iso_q16_contact_begin {
  iso_body a; iso_body b; uint32_t child_a; uint32_t child_b; int32_t impulse; iso_q16_unit_vec3 normal;
} iso_q16_contact_begin;
typedef struct iso_q16_broke {
  iso_body body; int32_t impulse; iso_q16_vec3 point; iso_q16_unit_vec3 direction; uint8_t reserved1[4];
} iso_q16_broke;
typedef struct iso_q16_joint_broke {
  iso_joint joint; iso_body a; iso_body b; uint64_t user_data; int32_t force; int32_t torque;
} iso_q16_joint_broke;
typedef struct iso_q16_contact_hit {
  iso_body a; iso_body b; uint32_t child_a; uint32_t child_b; iso_q16_vec3 point; iso_q16_unit_vec3 normal;
  int32_t speed; uint8_t reserved1[4];
} iso_q16_contact_hit;
typedef struct iso_q16_contact_point {
  iso_body a; iso_body b; uint32_t child_a; uint32_t child_b; uint32_t triangle_a; uint32_t triangle_b;
  iso_q16_vec3 point; iso_q16_unit_vec3 normal; int32_t separation; int32_t impulse;
} iso_q16_contact_point;
typedef struct iso_q16_settings {
  uint32_t size; uint32_t reserved0; int32_t hz; int32_t substeps; iso_q16_vec3 gravity; uint8_t allow_sleep;
  uint8_t reserved1[3]; iso_solver solver; uint32_t id_space; int32_t most_pairs; iso_projection projection;
  int32_t restitution_threshold; uint8_t reserved2[4];
} iso_q16_settings;
typedef struct iso_q16_body_definition {
  uint32_t size; uint32_t reserved0; iso_body_type type; uint8_t reserved1[4]; iso_shape shape; iso_q16_vec3 position;
  iso_q16_quat orientation; iso_q16_vec3 velocity; iso_q16_vec3 angular_velocity; int32_t density; int32_t mass;
  iso_q16_vec3 inertia; iso_q16_material material; iso_filter filter; uint64_t user_data; int32_t gravity_scale;
  int32_t linear_damping; int32_t angular_damping; uint32_t locks; uint8_t sensor; uint8_t allow_sleep;
  uint8_t collide; uint8_t bullet; uint8_t report_contacts; uint8_t reserved2[3];
} iso_q16_body_definition;
typedef struct iso_q16_body_mass {
  uint32_t size; uint32_t reserved0; int32_t density; int32_t mass; iso_q16_vec3 inertia; uint8_t reserved1[4];
} iso_q16_body_mass;
typedef struct iso_q16_body_state {
  uint32_t size; uint32_t reserved0; iso_q16_pose pose; iso_q16_vec3 centre; iso_q16_vec3 velocity;
  iso_q16_vec3 angular_velocity; uint64_t user_data; iso_body_type type; uint8_t awake; uint8_t enabled;
  uint8_t reserved1[2];
} iso_q16_body_state;
typedef struct iso_q16_body_properties {
  uint32_t size; uint32_t reserved0; iso_body_type type; uint32_t flags; iso_filter filter; uint8_t reserved1[4];
  uint64_t user_data; int32_t mass; iso_q16_vec3 local_centre; iso_q16_material material; int32_t gravity_scale;
  int32_t linear_damping; int32_t angular_damping;
} iso_q16_body_properties;
typedef struct iso_q16_sphere {
  uint32_t size; uint32_t reserved0; int32_t radius; uint8_t reserved1[4];
} iso_q16_sphere;
typedef struct iso_q16_box {
  uint32_t size; uint32_t reserved0; iso_q16_vec3 half_extents; uint8_t reserved1[4];
} iso_q16_box;
typedef struct iso_q16_capsule {
  uint32_t size; uint32_t reserved0; int32_t radius; int32_t half_height;
} iso_q16_capsule;
typedef struct iso_q16_half_space {
  uint32_t size; uint32_t reserved0; iso_q16_unit_vec3 normal; int32_t offset;
} iso_q16_half_space;
typedef struct iso_q16_cylinder {
  uint32_t size; uint32_t reserved0; int32_t radius; int32_t half_height;
} iso_q16_cylinder;
typedef struct iso_q16_cone {
  uint32_t size; uint32_t reserved0; int32_t radius; int32_t half_height;
} iso_q16_cone;
typedef struct iso_q16_hull {
  uint32_t size; uint32_t reserved0; int32_t radius; uint8_t reserved1[4];
} iso_q16_hull;
typedef struct iso_q16_joint_properties {
  uint32_t size; uint32_t reserved0; iso_joint_type type; uint32_t flags; uint32_t body_a; uint32_t body_b;
  uint32_t generation_a; uint32_t generation_b; uint64_t user_data; iso_q16_pose frame_a; iso_q16_pose frame_b;
  int32_t lower; int32_t upper; int32_t cone; int32_t motor_speed; int32_t max_force; int32_t spring_target;
  int32_t spring_frequency; int32_t spring_damping;
} iso_q16_joint_properties;
typedef struct iso_q16_ball {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q16_pose frame; uint8_t has_cone;
  uint8_t reserved1[3]; int32_t cone; uint8_t has_twist; uint8_t reserved2[3]; iso_q16_joint_range twist;
  uint8_t collide; uint8_t reserved3[7];
} iso_q16_ball;
typedef struct iso_q16_constant_velocity {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q16_pose frame; uint8_t has_cone;
  uint8_t reserved1[3]; int32_t cone; uint8_t has_twist; uint8_t reserved2[3]; iso_q16_joint_range twist;
  uint8_t collide; uint8_t reserved3[7];
} iso_q16_constant_velocity;
typedef struct iso_q16_fixed {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q16_pose frame; uint8_t collide; uint8_t reserved1[3];
} iso_q16_fixed;
typedef struct iso_q16_universal {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q16_pose frame; uint8_t collide; uint8_t reserved1[3];
} iso_q16_universal;
typedef struct iso_q16_angular {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q16_pose frame; uint8_t collide; uint8_t reserved1[3];
} iso_q16_angular;
typedef struct iso_q16_hinge {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q16_pose frame; uint8_t has_limit;
  uint8_t reserved1[3]; iso_q16_joint_range limit; uint8_t has_motor; uint8_t reserved2[3]; iso_q16_joint_motor motor;
  uint8_t has_spring; uint8_t reserved3[3]; iso_q16_joint_spring spring; uint8_t collide; uint8_t reserved4[3];
} iso_q16_hinge;
typedef struct iso_q16_slider {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q16_pose frame; uint8_t has_limit;
  uint8_t reserved1[3]; iso_q16_joint_range limit; uint8_t has_motor; uint8_t reserved2[3]; iso_q16_joint_motor motor;
  uint8_t has_spring; uint8_t reserved3[3]; iso_q16_joint_spring spring; uint8_t collide; uint8_t reserved4[3];
} iso_q16_slider;
typedef struct iso_q16_cylindrical {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q16_pose frame; uint8_t has_limit;
  uint8_t reserved1[3]; iso_q16_joint_range limit; uint8_t has_motor; uint8_t reserved2[3]; iso_q16_joint_motor motor;
  uint8_t has_spring; uint8_t reserved3[3]; iso_q16_joint_spring spring; uint8_t collide; uint8_t reserved4[3];
} iso_q16_cylindrical;
typedef struct iso_q16_planar {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q16_pose frame; uint8_t has_limit;
  uint8_t reserved1[3]; iso_q16_joint_range limit; uint8_t has_motor; uint8_t reserved2[3]; iso_q16_joint_motor motor;
  uint8_t has_spring; uint8_t reserved3[3]; iso_q16_joint_spring spring; uint8_t collide; uint8_t reserved4[3];
} iso_q16_planar;
typedef struct iso_q16_rod {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q16_vec3 anchor_a; iso_q16_vec3 anchor_b;
  int32_t length; uint8_t has_spring; uint8_t reserved1[3]; iso_q16_joint_spring spring; uint8_t collide;
  uint8_t reserved2[3];
} iso_q16_rod;
typedef struct iso_q16_rope {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q16_vec3 anchor_a; iso_q16_vec3 anchor_b;
  int32_t length; uint8_t has_spring; uint8_t reserved1[3]; iso_q16_joint_spring spring; uint8_t collide;
  uint8_t reserved2[3];
} iso_q16_rope;
typedef struct iso_q16_wheel_joint {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q16_pose frame; iso_q16_joint_spring suspension;
  iso_q16_joint_range travel; uint8_t has_steer; uint8_t reserved1[3]; iso_q16_joint_servo steer; uint8_t has_drive;
  uint8_t reserved2[3]; iso_q16_joint_motor drive; uint8_t collide; uint8_t reserved3[3];
} iso_q16_wheel_joint;
typedef struct iso_q16_motor_joint {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q16_pose frame_a; iso_q16_pose frame_b;
  iso_q16_joint_servo place; iso_q16_joint_servo turn; uint8_t collide; uint8_t reserved1[7];
} iso_q16_motor_joint;
typedef struct iso_q16_six_axis {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q16_pose frame; uint32_t locks;
  iso_q16_drive drives[6]; uint32_t drive_count; uint8_t collide; uint8_t reserved1[3];
} iso_q16_six_axis;
typedef struct iso_q16_ragdoll_settings {
  uint32_t size; uint32_t reserved0; int32_t friction; iso_q16_joint_servo pose; int32_t limit_frequency;
  int32_t limit_damping; iso_filter filter; iso_q16_material material;
} iso_q16_ragdoll_settings;
typedef struct iso_q16_ray_cast {
  uint32_t size; uint32_t reserved0; iso_q16_vec3 origin; iso_q16_vec3 translation; iso_query_filter filter;
} iso_q16_ray_cast;
typedef struct iso_q16_shape_cast {
  uint32_t size; uint32_t reserved0; iso_shape shape; iso_q16_primitive primitive; iso_q16_pose pose;
  iso_q16_vec3 translation; iso_query_filter filter;
} iso_q16_shape_cast;
typedef struct iso_q16_overlap_query {
  uint32_t size; uint32_t reserved0; iso_shape shape; iso_q16_primitive primitive; iso_q16_pose pose;
  uint8_t reserved1[4]; iso_query_filter filter;
} iso_q16_overlap_query;
typedef struct iso_q16_point_query {
  uint32_t size; uint32_t reserved0; iso_q16_vec3 point; int32_t max_distance; iso_query_filter filter;
} iso_q16_point_query;
typedef struct iso_q16_box_query {
  uint32_t size; uint32_t reserved0; iso_q16_aabb box; iso_query_filter filter;
} iso_q16_box_query;
typedef struct iso_q16_force_zone {
  uint32_t size; uint32_t reserved0; iso_zone_shape shape; iso_q16_pose pose; iso_q16_vec3 half;
  iso_q16_vec3 acceleration; iso_q16_vec3 wind; uint32_t mask; int32_t priority; uint32_t replaces;
} iso_q16_force_zone;
typedef struct iso_q16_attractor {
  uint32_t size; uint32_t reserved0; iso_body body; iso_q16_vec3 point; int32_t strength; int32_t least_distance;
  int32_t range; uint32_t mask; uint8_t reserved1[4];
} iso_q16_attractor;
typedef struct iso_q16_body_spring {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q16_vec3 anchor_a; iso_q16_vec3 anchor_b;
  int32_t rest_length; int32_t stiffness; int32_t damping; uint8_t only_pulls; uint8_t reserved1[3];
} iso_q16_body_spring;
typedef struct iso_q16_thruster {
  uint32_t size; uint32_t reserved0; iso_body body; iso_q16_vec3 point; iso_q16_vec3 force;
} iso_q16_thruster;
typedef struct iso_q16_buoyancy {
  uint32_t size; uint32_t reserved0; iso_body body; iso_q16_vec3 point; int32_t max_depth; int32_t volume;
  int32_t surface_height; int32_t density; uint8_t reserved1[4];
} iso_q16_buoyancy;
typedef struct iso_q16_explosion {
  uint32_t size; uint32_t reserved0; iso_q16_vec3 centre; uint8_t reserved1[4]; uint64_t begin;
  int32_t implosion_force; int32_t implosion_least; int32_t implosion_most; int32_t implosion_duration;
  int32_t wave_force; int32_t wave_speed; int32_t wave_width; int32_t wave_ramp; int32_t wave_duration;
  int32_t chimney_force; int32_t chimney_radius; int32_t chimney_height; int32_t chimney_duration; uint8_t is_shielded;
  uint8_t reserved2[3]; uint32_t mask; uint8_t reserved3[4];
} iso_q16_explosion;
typedef struct iso_q16_water {
  uint32_t size; uint32_t reserved0; int32_t surface_height; int32_t density; iso_q16_vec3 middle; iso_q16_vec3 half;
  iso_q16_vec3 current; int32_t linear_drag; int32_t quadratic_drag; int32_t angular_drag; int32_t wave_height;
  int32_t wave_length; int32_t wave_period; iso_q16_unit_vec3 wave_direction; uint32_t mask; int32_t priority;
  uint8_t replaces; uint8_t reserved1[7];
} iso_q16_water;
typedef struct iso_q16_drag {
  uint32_t size; uint32_t reserved0; iso_body body; int32_t linear; int32_t quadratic; int32_t angular;
  uint8_t reserved1[4];
} iso_q16_drag;
typedef struct iso_q16_aero_surface {
  uint32_t size; uint32_t reserved0; iso_body body; iso_q16_vec3 point; iso_q16_quat orientation; iso_q16_mat3 tensor;
  iso_q16_mat3 low; iso_q16_mat3 high; int32_t control; uint8_t is_quadratic; uint8_t is_under_water;
  uint8_t reserved1[2];
} iso_q16_aero_surface;
typedef struct iso_q16_damping_zone {
  uint32_t size; uint32_t reserved0; iso_zone_shape shape; iso_q16_pose pose; iso_q16_vec3 half; int32_t linear;
  int32_t angular; uint32_t mask; int32_t priority; uint8_t replaces; uint8_t reserved1[3];
} iso_q16_damping_zone;
typedef struct iso_q16_material_pair {
  uint32_t size; uint32_t reserved0; uint32_t kind_a; uint32_t kind_b; int32_t friction; int32_t static_friction;
  int32_t restitution; int32_t rolling_resistance; int32_t spin_resistance; uint8_t reserved1[4];
} iso_q16_material_pair;
typedef struct iso_q16_breakable {
  uint32_t size; uint32_t reserved0; iso_body body; int32_t break_impulse; iso_break_pattern pattern;
  uint32_t most_pieces; uint32_t depth; iso_q16_unit_vec3 grain; uint8_t reserved1[4]; uint64_t seed;
  int32_t small_mass; uint32_t lifetime; uint64_t expires; uint8_t owns_shape; uint8_t reserved2[7];
} iso_q16_breakable;
typedef struct iso_q16_character {
  uint32_t size; uint32_t reserved0; iso_body body; int32_t step_height; int32_t least_up; int32_t skin; int32_t mass;
  int32_t push_force; int32_t air_acceleration; int32_t gravity_scale; uint32_t mask;
} iso_q16_character;
typedef struct iso_q16_vehicle {
  uint32_t size; uint32_t reserved0; iso_body body; int32_t engine_torque; int32_t engine_speed; int32_t gears[8];
  int32_t final_drive; int32_t engine_inertia; int32_t clutch_torque; int32_t differential_lock; int32_t brake_torque;
  int32_t handbrake_torque; int32_t ackermann; int32_t track_steer;
} iso_q16_vehicle;
typedef struct iso_q16_wheel {
  uint32_t size; uint32_t reserved0; iso_body body; iso_q16_vec3 hard_point; iso_q16_unit_vec3 suspension;
  iso_q16_unit_vec3 axle_direction; int32_t free_length; int32_t travel; int32_t stiffness; int32_t damping;
  int32_t radius; int32_t inertia; int32_t grip_along; int32_t grip_across; int32_t peak_slip; int32_t peak_grip;
  int32_t slide_slip; int32_t slide_grip; int32_t steer_angle; int32_t drive_share; int32_t brake_share;
  int32_t handbrake_share; uint32_t axle; int32_t anti_roll; uint32_t track;
} iso_q16_wheel;
typedef struct iso_q16_surface_velocity {
  uint32_t size; uint32_t reserved0; iso_body body; iso_q16_vec3 linear; iso_q16_vec3 angular; uint32_t part;
  uint8_t reserved1[4];
} iso_q16_surface_velocity;
typedef struct iso_q16_ghost {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b;
} iso_q16_ghost;
typedef struct iso_q16_one_way {
  uint32_t size; uint32_t reserved0; iso_body body; iso_q16_unit_vec3 axis; int32_t least_cosine;
} iso_q16_one_way;
typedef struct iso_q16_hit_report {
  uint32_t size; uint32_t reserved0; iso_body body; int32_t speed; uint8_t reserved1[4];
} iso_q16_hit_report;
typedef struct iso_q16_contact_report {
  uint32_t size; uint32_t reserved0; iso_body body;
} iso_q16_contact_report;
typedef struct iso_q16_joint_load {
  uint32_t size; uint32_t reserved0; iso_joint joint; int32_t break_force; int32_t break_torque;
} iso_q16_joint_load;
typedef struct iso_q16_coupling {
  uint32_t size; uint32_t reserved0; iso_joint joint_a; iso_joint joint_b; iso_joint joint_c; int32_t ratio_a;
  int32_t ratio_b; int32_t ratio_c; int32_t lower; int32_t upper; uint8_t reserved1[4];
} iso_q16_coupling;
typedef struct iso_q16_axis_drive {
  uint32_t size; uint32_t reserved0; iso_joint joint; iso_joint_axis axis; uint8_t limited; uint8_t motor;
  uint8_t reserved1[2]; int32_t lower; int32_t upper; int32_t motor_speed; int32_t spring_target;
  int32_t spring_frequency; int32_t spring_damping; int32_t max_force; int32_t spring_mass; int32_t limit_frequency;
  int32_t limit_damping;
} iso_q16_axis_drive;
typedef struct iso_q16_kind_ghost {
  uint32_t size; uint32_t reserved0; uint32_t kind_a; uint32_t kind_b;
} iso_q16_kind_ghost;
typedef struct iso_q16_kind_response {
  uint32_t size; uint32_t reserved0; uint32_t kind_a; uint32_t kind_b; int32_t inverse_mass_scale_a;
  int32_t inverse_mass_scale_b; int32_t inverse_inertia_scale_a; int32_t inverse_inertia_scale_b; int32_t max_force;
  uint8_t reserved1[4];
} iso_q16_kind_response;
typedef struct iso_q16_sensor_mount {
  uint32_t size; uint32_t reserved0; iso_body sensor; iso_body on; iso_q16_pose frame; uint8_t reserved1[4];
} iso_q16_sensor_mount;
typedef struct iso_q16_breakable_input {
  uint32_t size; uint32_t reserved0; int32_t impulse; iso_q16_vec3 point; iso_q16_unit_vec3 direction;
  uint8_t reserved1[4];
} iso_q16_breakable_input;
typedef struct iso_q16_character_input {
  uint32_t size; uint32_t reserved0; iso_q16_vec3 move; int32_t jump;
} iso_q16_character_input;
typedef struct iso_q16_vehicle_input {
  uint32_t size; uint32_t reserved0; int32_t throttle; int32_t clutch; int32_t brake; int32_t handbrake; int32_t steer;
  uint32_t gear;
} iso_q16_vehicle_input;
typedef struct iso_q16_character_state {
  uint32_t size; uint32_t reserved0; iso_footing footing; uint8_t reserved1[4]; iso_body ground; uint32_t stuck;
  iso_q16_vec3 foot; iso_q16_vec3 foot_at; iso_q16_vec3 velocity; iso_q16_unit_vec3 normal; uint8_t reserved2[4];
} iso_q16_character_state;
typedef struct iso_q16_vehicle_state {
  uint32_t size; uint32_t reserved0; int32_t engine_spin; int32_t clutch_load;
} iso_q16_vehicle_state;
typedef struct iso_q16_wheel_state {
  uint32_t size; uint32_t reserved0; int32_t spin; int32_t angle; int32_t steered; int32_t length; int32_t slip;
  uint8_t reserved1[4]; iso_body contact_body; iso_q16_vec3 contact_point; iso_q16_unit_vec3 contact_normal;
  int32_t load; int32_t along; int32_t across; uint8_t reserved2[4];
} iso_q16_wheel_state;
typedef struct iso_q16_joint_load_state {
  uint32_t size; uint32_t reserved0; int32_t force; int32_t torque;
} iso_q16_joint_load_state;
typedef struct iso_q16_coupling_state {
  uint32_t size; uint32_t reserved0; int32_t load; uint8_t reserved1[4];
} iso_q16_coupling_state;

/* Q32: q32.32. The members are those of F32. */
typedef struct iso_q32_vec3 {
  int64_t x; int64_t y; int64_t z;
} iso_q32_vec3;
typedef struct iso_q32_unit_vec3 {
  int64_t x; int64_t y; int64_t z;
} iso_q32_unit_vec3;
typedef struct iso_q32_quat {
  int64_t x; int64_t y; int64_t z; int64_t w;
} iso_q32_quat;
typedef struct iso_q32_pose {
  iso_q32_vec3 position; iso_q32_quat orientation;
} iso_q32_pose;
typedef struct iso_q32_mat3 {
  iso_q32_vec3 rows[3];
} iso_q32_mat3;
typedef struct iso_q32_aabb {
  iso_q32_vec3 low; iso_q32_vec3 high;
} iso_q32_aabb;
typedef struct iso_q32_material {
  int64_t friction; int64_t restitution; int64_t rolling_resistance; int64_t spin_resistance;
  iso_q32_vec3 surface_velocity; int64_t static_friction; iso_q32_vec3 anisotropy; uint32_t kind; uint32_t reserved;
} iso_q32_material;
typedef struct iso_q32_primitive {
  iso_shape_type type; uint32_t blob; iso_q32_vec3 half; int64_t radius; iso_q32_unit_vec3 normal; int64_t offset;
} iso_q32_primitive;
typedef struct iso_q32_part_traits {
  uint32_t flags; iso_filter filter; iso_q32_material material;
} iso_q32_part_traits;
typedef struct iso_q32_child {
  iso_q32_primitive primitive; iso_q32_pose pose; iso_q32_part_traits traits; uint64_t user_data;
} iso_q32_child;
typedef struct iso_q32_joint_range {
  int64_t lower; int64_t upper;
} iso_q32_joint_range;
typedef struct iso_q32_joint_motor {
  int64_t speed; int64_t max_force;
} iso_q32_joint_motor;
typedef struct iso_q32_joint_spring {
  int64_t frequency; int64_t damping; int64_t target;
} iso_q32_joint_spring;
typedef struct iso_q32_joint_servo {
  int64_t frequency; int64_t damping; int64_t target; int64_t max_force; int64_t mass;
} iso_q32_joint_servo;
typedef struct iso_q32_drive {
  iso_joint joint; iso_joint_axis axis; uint8_t limited; uint8_t motor; uint8_t reserved1[2]; int64_t lower;
  int64_t upper; int64_t motor_speed; int64_t spring_target; int64_t spring_frequency; int64_t spring_damping;
  int64_t max_force; int64_t spring_mass; int64_t limit_frequency; int64_t limit_damping;
} iso_q32_drive;
typedef struct iso_q32_ragdoll_bone {
  int32_t parent; uint8_t reserved1[4]; iso_shape shape; iso_q32_pose pose; int64_t mass; iso_q32_pose joint;
  uint8_t hinge; uint8_t reserved2[7]; int64_t swing_x; int64_t swing_y; int64_t lower; int64_t upper;
} iso_q32_ragdoll_bone;
typedef struct iso_q32_ray_hit {
  iso_body body; uint32_t child; uint32_t triangle; iso_q32_vec3 point; iso_q32_unit_vec3 normal; int64_t fraction;
  uint8_t material; uint8_t inside; uint8_t reserved1[6];
} iso_q32_ray_hit;
typedef struct iso_q32_shape_hit {
  iso_body body; uint32_t child; uint32_t triangle; iso_q32_vec3 point; iso_q32_unit_vec3 normal; int64_t fraction;
  uint8_t material; uint8_t inside; uint8_t reserved1[6];
} iso_q32_shape_hit;
typedef struct iso_q32_closest_body {
  iso_body body; uint32_t child; uint8_t reserved1[4]; iso_q32_vec3 point; iso_q32_unit_vec3 normal; int64_t distance;
} iso_q32_closest_body;
typedef struct iso_q32_contact_begin {
  iso_body a; iso_body b; uint32_t child_a; uint32_t child_b; int64_t impulse; iso_q32_unit_vec3 normal;
} iso_q32_contact_begin;
typedef struct iso_q32_broke {
  iso_body body; int64_t impulse; iso_q32_vec3 point; iso_q32_unit_vec3 direction;
} iso_q32_broke;
typedef struct iso_q32_joint_broke {
  iso_joint joint; iso_body a; iso_body b; uint64_t user_data; int64_t force; int64_t torque;
} iso_q32_joint_broke;
typedef struct iso_q32_contact_hit {
  iso_body a; iso_body b; uint32_t child_a; uint32_t child_b; iso_q32_vec3 point; iso_q32_unit_vec3 normal;
  int64_t speed;
} iso_q32_contact_hit;
typedef struct iso_q32_contact_point {
  iso_body a; iso_body b; uint32_t child_a; uint32_t child_b; uint32_t triangle_a; uint32_t triangle_b;
  iso_q32_vec3 point; iso_q32_unit_vec3 normal; int64_t separation; int64_t impulse;
} iso_q32_contact_point;
typedef struct iso_q32_settings {
  uint32_t size; uint32_t reserved0; int32_t hz; int32_t substeps; iso_q32_vec3 gravity; uint8_t allow_sleep;
  uint8_t reserved1[3]; iso_solver solver; uint32_t id_space; int32_t most_pairs; iso_projection projection;
  uint8_t reserved2[4]; int64_t restitution_threshold;
} iso_q32_settings;
typedef struct iso_q32_body_definition {
  uint32_t size; uint32_t reserved0; iso_body_type type; uint8_t reserved1[4]; iso_shape shape; iso_q32_vec3 position;
  iso_q32_quat orientation; iso_q32_vec3 velocity; iso_q32_vec3 angular_velocity; int64_t density; int64_t mass;
  iso_q32_vec3 inertia; iso_q32_material material; iso_filter filter; uint8_t reserved2[4]; uint64_t user_data;
  int64_t gravity_scale; int64_t linear_damping; int64_t angular_damping; uint32_t locks; uint8_t sensor;
  uint8_t allow_sleep; uint8_t collide; uint8_t bullet; uint8_t report_contacts; uint8_t reserved3[7];
} iso_q32_body_definition;
typedef struct iso_q32_body_mass {
  uint32_t size; uint32_t reserved0; int64_t density; int64_t mass; iso_q32_vec3 inertia;
} iso_q32_body_mass;
typedef struct iso_q32_body_state {
  uint32_t size; uint32_t reserved0; iso_q32_pose pose; iso_q32_vec3 centre; iso_q32_vec3 velocity;
  iso_q32_vec3 angular_velocity; uint64_t user_data; iso_body_type type; uint8_t awake; uint8_t enabled;
  uint8_t reserved1[2];
} iso_q32_body_state;
typedef struct iso_q32_body_properties {
  uint32_t size; uint32_t reserved0; iso_body_type type; uint32_t flags; iso_filter filter; uint8_t reserved1[4];
  uint64_t user_data; int64_t mass; iso_q32_vec3 local_centre; iso_q32_material material; int64_t gravity_scale;
  int64_t linear_damping; int64_t angular_damping;
} iso_q32_body_properties;
typedef struct iso_q32_sphere {
  uint32_t size; uint32_t reserved0; int64_t radius;
} iso_q32_sphere;
typedef struct iso_q32_box {
  uint32_t size; uint32_t reserved0; iso_q32_vec3 half_extents;
} iso_q32_box;
typedef struct iso_q32_capsule {
  uint32_t size; uint32_t reserved0; int64_t radius; int64_t half_height;
} iso_q32_capsule;
typedef struct iso_q32_half_space {
  uint32_t size; uint32_t reserved0; iso_q32_unit_vec3 normal; int64_t offset;
} iso_q32_half_space;
typedef struct iso_q32_cylinder {
  uint32_t size; uint32_t reserved0; int64_t radius; int64_t half_height;
} iso_q32_cylinder;
typedef struct iso_q32_cone {
  uint32_t size; uint32_t reserved0; int64_t radius; int64_t half_height;
} iso_q32_cone;
typedef struct iso_q32_hull {
  uint32_t size; uint32_t reserved0; int64_t radius;
} iso_q32_hull;
typedef struct iso_q32_joint_properties {
  uint32_t size; uint32_t reserved0; iso_joint_type type; uint32_t flags; uint32_t body_a; uint32_t body_b;
  uint32_t generation_a; uint32_t generation_b; uint64_t user_data; iso_q32_pose frame_a; iso_q32_pose frame_b;
  int64_t lower; int64_t upper; int64_t cone; int64_t motor_speed; int64_t max_force; int64_t spring_target;
  int64_t spring_frequency; int64_t spring_damping;
} iso_q32_joint_properties;
typedef struct iso_q32_ball {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q32_pose frame; uint8_t has_cone;
  uint8_t reserved1[7]; int64_t cone; uint8_t has_twist; uint8_t reserved2[7]; iso_q32_joint_range twist;
  uint8_t collide; uint8_t reserved3[7];
} iso_q32_ball;
typedef struct iso_q32_constant_velocity {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q32_pose frame; uint8_t has_cone;
  uint8_t reserved1[7]; int64_t cone; uint8_t has_twist; uint8_t reserved2[7]; iso_q32_joint_range twist;
  uint8_t collide; uint8_t reserved3[7];
} iso_q32_constant_velocity;
typedef struct iso_q32_fixed {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q32_pose frame; uint8_t collide; uint8_t reserved1[7];
} iso_q32_fixed;
typedef struct iso_q32_universal {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q32_pose frame; uint8_t collide; uint8_t reserved1[7];
} iso_q32_universal;
typedef struct iso_q32_angular {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q32_pose frame; uint8_t collide; uint8_t reserved1[7];
} iso_q32_angular;
typedef struct iso_q32_hinge {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q32_pose frame; uint8_t has_limit;
  uint8_t reserved1[7]; iso_q32_joint_range limit; uint8_t has_motor; uint8_t reserved2[7]; iso_q32_joint_motor motor;
  uint8_t has_spring; uint8_t reserved3[7]; iso_q32_joint_spring spring; uint8_t collide; uint8_t reserved4[7];
} iso_q32_hinge;
typedef struct iso_q32_slider {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q32_pose frame; uint8_t has_limit;
  uint8_t reserved1[7]; iso_q32_joint_range limit; uint8_t has_motor; uint8_t reserved2[7]; iso_q32_joint_motor motor;
  uint8_t has_spring; uint8_t reserved3[7]; iso_q32_joint_spring spring; uint8_t collide; uint8_t reserved4[7];
} iso_q32_slider;
typedef struct iso_q32_cylindrical {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q32_pose frame; uint8_t has_limit;
  uint8_t reserved1[7]; iso_q32_joint_range limit; uint8_t has_motor; uint8_t reserved2[7]; iso_q32_joint_motor motor;
  uint8_t has_spring; uint8_t reserved3[7]; iso_q32_joint_spring spring; uint8_t collide; uint8_t reserved4[7];
} iso_q32_cylindrical;
typedef struct iso_q32_planar {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q32_pose frame; uint8_t has_limit;
  uint8_t reserved1[7]; iso_q32_joint_range limit; uint8_t has_motor; uint8_t reserved2[7]; iso_q32_joint_motor motor;
  uint8_t has_spring; uint8_t reserved3[7]; iso_q32_joint_spring spring; uint8_t collide; uint8_t reserved4[7];
} iso_q32_planar;
typedef struct iso_q32_rod {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q32_vec3 anchor_a; iso_q32_vec3 anchor_b;
  int64_t length; uint8_t has_spring; uint8_t reserved1[7]; iso_q32_joint_spring spring; uint8_t collide;
  uint8_t reserved2[7];
} iso_q32_rod;
typedef struct iso_q32_rope {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q32_vec3 anchor_a; iso_q32_vec3 anchor_b;
  int64_t length; uint8_t has_spring; uint8_t reserved1[7]; iso_q32_joint_spring spring; uint8_t collide;
  uint8_t reserved2[7];
} iso_q32_rope;
typedef struct iso_q32_wheel_joint {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q32_pose frame; iso_q32_joint_spring suspension;
  iso_q32_joint_range travel; uint8_t has_steer; uint8_t reserved1[7]; iso_q32_joint_servo steer; uint8_t has_drive;
  uint8_t reserved2[7]; iso_q32_joint_motor drive; uint8_t collide; uint8_t reserved3[7];
} iso_q32_wheel_joint;
typedef struct iso_q32_motor_joint {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q32_pose frame_a; iso_q32_pose frame_b;
  iso_q32_joint_servo place; iso_q32_joint_servo turn; uint8_t collide; uint8_t reserved1[7];
} iso_q32_motor_joint;
typedef struct iso_q32_six_axis {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q32_pose frame; uint32_t locks; uint8_t reserved1[4];
  iso_q32_drive drives[6]; uint32_t drive_count; uint8_t collide; uint8_t reserved2[3];
} iso_q32_six_axis;
typedef struct iso_q32_ragdoll_settings {
  uint32_t size; uint32_t reserved0; int64_t friction; iso_q32_joint_servo pose; int64_t limit_frequency;
  int64_t limit_damping; iso_filter filter; uint8_t reserved1[4]; iso_q32_material material;
} iso_q32_ragdoll_settings;
typedef struct iso_q32_ray_cast {
  uint32_t size; uint32_t reserved0; iso_q32_vec3 origin; iso_q32_vec3 translation; iso_query_filter filter;
} iso_q32_ray_cast;
typedef struct iso_q32_shape_cast {
  uint32_t size; uint32_t reserved0; iso_shape shape; iso_q32_primitive primitive; iso_q32_pose pose;
  iso_q32_vec3 translation; iso_query_filter filter;
} iso_q32_shape_cast;
typedef struct iso_q32_overlap_query {
  uint32_t size; uint32_t reserved0; iso_shape shape; iso_q32_primitive primitive; iso_q32_pose pose;
  iso_query_filter filter;
} iso_q32_overlap_query;
typedef struct iso_q32_point_query {
  uint32_t size; uint32_t reserved0; iso_q32_vec3 point; int64_t max_distance; iso_query_filter filter;
} iso_q32_point_query;
typedef struct iso_q32_box_query {
  uint32_t size; uint32_t reserved0; iso_q32_aabb box; iso_query_filter filter;
} iso_q32_box_query;
typedef struct iso_q32_force_zone {
  uint32_t size; uint32_t reserved0; iso_zone_shape shape; uint8_t reserved1[4]; iso_q32_pose pose; iso_q32_vec3 half;
  iso_q32_vec3 acceleration; iso_q32_vec3 wind; uint32_t mask; int32_t priority; uint32_t replaces;
  uint8_t reserved2[4];
} iso_q32_force_zone;
typedef struct iso_q32_attractor {
  uint32_t size; uint32_t reserved0; iso_body body; iso_q32_vec3 point; int64_t strength; int64_t least_distance;
  int64_t range; uint32_t mask; uint8_t reserved1[4];
} iso_q32_attractor;
typedef struct iso_q32_body_spring {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b; iso_q32_vec3 anchor_a; iso_q32_vec3 anchor_b;
  int64_t rest_length; int64_t stiffness; int64_t damping; uint8_t only_pulls; uint8_t reserved1[7];
} iso_q32_body_spring;
typedef struct iso_q32_thruster {
  uint32_t size; uint32_t reserved0; iso_body body; iso_q32_vec3 point; iso_q32_vec3 force;
} iso_q32_thruster;
typedef struct iso_q32_buoyancy {
  uint32_t size; uint32_t reserved0; iso_body body; iso_q32_vec3 point; int64_t max_depth; int64_t volume;
  int64_t surface_height; int64_t density;
} iso_q32_buoyancy;
typedef struct iso_q32_explosion {
  uint32_t size; uint32_t reserved0; iso_q32_vec3 centre; uint64_t begin; int64_t implosion_force;
  int64_t implosion_least; int64_t implosion_most; int64_t implosion_duration; int64_t wave_force; int64_t wave_speed;
  int64_t wave_width; int64_t wave_ramp; int64_t wave_duration; int64_t chimney_force; int64_t chimney_radius;
  int64_t chimney_height; int64_t chimney_duration; uint8_t is_shielded; uint8_t reserved1[3]; uint32_t mask;
} iso_q32_explosion;
typedef struct iso_q32_water {
  uint32_t size; uint32_t reserved0; int64_t surface_height; int64_t density; iso_q32_vec3 middle; iso_q32_vec3 half;
  iso_q32_vec3 current; int64_t linear_drag; int64_t quadratic_drag; int64_t angular_drag; int64_t wave_height;
  int64_t wave_length; int64_t wave_period; iso_q32_unit_vec3 wave_direction; uint32_t mask; int32_t priority;
  uint8_t replaces; uint8_t reserved1[7];
} iso_q32_water;
typedef struct iso_q32_drag {
  uint32_t size; uint32_t reserved0; iso_body body; int64_t linear; int64_t quadratic; int64_t angular;
} iso_q32_drag;
typedef struct iso_q32_aero_surface {
  uint32_t size; uint32_t reserved0; iso_body body; iso_q32_vec3 point; iso_q32_quat orientation; iso_q32_mat3 tensor;
  iso_q32_mat3 low; iso_q32_mat3 high; int64_t control; uint8_t is_quadratic; uint8_t is_under_water;
  uint8_t reserved1[6];
} iso_q32_aero_surface;
typedef struct iso_q32_damping_zone {
  uint32_t size; uint32_t reserved0; iso_zone_shape shape; uint8_t reserved1[4]; iso_q32_pose pose; iso_q32_vec3 half;
  int64_t linear; int64_t angular; uint32_t mask; int32_t priority; uint8_t replaces; uint8_t reserved2[7];
} iso_q32_damping_zone;
typedef struct iso_q32_material_pair {
  uint32_t size; uint32_t reserved0; uint32_t kind_a; uint32_t kind_b; int64_t friction; int64_t static_friction;
  int64_t restitution; int64_t rolling_resistance; int64_t spin_resistance;
} iso_q32_material_pair;
typedef struct iso_q32_breakable {
  uint32_t size; uint32_t reserved0; iso_body body; int64_t break_impulse; iso_break_pattern pattern;
  uint32_t most_pieces; uint32_t depth; uint8_t reserved1[4]; iso_q32_unit_vec3 grain; uint64_t seed;
  int64_t small_mass; uint32_t lifetime; uint8_t reserved2[4]; uint64_t expires; uint8_t owns_shape;
  uint8_t reserved3[7];
} iso_q32_breakable;
typedef struct iso_q32_character {
  uint32_t size; uint32_t reserved0; iso_body body; int64_t step_height; int64_t least_up; int64_t skin; int64_t mass;
  int64_t push_force; int64_t air_acceleration; int64_t gravity_scale; uint32_t mask; uint8_t reserved1[4];
} iso_q32_character;
typedef struct iso_q32_vehicle {
  uint32_t size; uint32_t reserved0; iso_body body; int64_t engine_torque; int64_t engine_speed; int64_t gears[8];
  int64_t final_drive; int64_t engine_inertia; int64_t clutch_torque; int64_t differential_lock; int64_t brake_torque;
  int64_t handbrake_torque; int64_t ackermann; int64_t track_steer;
} iso_q32_vehicle;
typedef struct iso_q32_wheel {
  uint32_t size; uint32_t reserved0; iso_body body; iso_q32_vec3 hard_point; iso_q32_unit_vec3 suspension;
  iso_q32_unit_vec3 axle_direction; int64_t free_length; int64_t travel; int64_t stiffness; int64_t damping;
  int64_t radius; int64_t inertia; int64_t grip_along; int64_t grip_across; int64_t peak_slip; int64_t peak_grip;
  int64_t slide_slip; int64_t slide_grip; int64_t steer_angle; int64_t drive_share; int64_t brake_share;
  int64_t handbrake_share; uint32_t axle; uint8_t reserved1[4]; int64_t anti_roll; uint32_t track;
  uint8_t reserved2[4];
} iso_q32_wheel;
typedef struct iso_q32_surface_velocity {
  uint32_t size; uint32_t reserved0; iso_body body; iso_q32_vec3 linear; iso_q32_vec3 angular; uint32_t part;
  uint8_t reserved1[4];
} iso_q32_surface_velocity;
typedef struct iso_q32_ghost {
  uint32_t size; uint32_t reserved0; iso_body a; iso_body b;
} iso_q32_ghost;
typedef struct iso_q32_one_way {
  uint32_t size; uint32_t reserved0; iso_body body; iso_q32_unit_vec3 axis; int64_t least_cosine;
} iso_q32_one_way;
typedef struct iso_q32_hit_report {
  uint32_t size; uint32_t reserved0; iso_body body; int64_t speed;
} iso_q32_hit_report;
typedef struct iso_q32_contact_report {
  uint32_t size; uint32_t reserved0; iso_body body;
} iso_q32_contact_report;
typedef struct iso_q32_joint_load {
  uint32_t size; uint32_t reserved0; iso_joint joint; int64_t break_force; int64_t break_torque;
} iso_q32_joint_load;
typedef struct iso_q32_coupling {
  uint32_t size; uint32_t reserved0; iso_joint joint_a; iso_joint joint_b; iso_joint joint_c; int64_t ratio_a;
  int64_t ratio_b; int64_t ratio_c; int64_t lower; int64_t upper;
} iso_q32_coupling;
typedef struct iso_q32_axis_drive {
  uint32_t size; uint32_t reserved0; iso_joint joint; iso_joint_axis axis; uint8_t limited; uint8_t motor;
  uint8_t reserved1[2]; int64_t lower; int64_t upper; int64_t motor_speed; int64_t spring_target;
  int64_t spring_frequency; int64_t spring_damping; int64_t max_force; int64_t spring_mass; int64_t limit_frequency;
  int64_t limit_damping;
} iso_q32_axis_drive;
typedef struct iso_q32_kind_ghost {
  uint32_t size; uint32_t reserved0; uint32_t kind_a; uint32_t kind_b;
} iso_q32_kind_ghost;
typedef struct iso_q32_kind_response {
  uint32_t size; uint32_t reserved0; uint32_t kind_a; uint32_t kind_b; int64_t inverse_mass_scale_a;
  int64_t inverse_mass_scale_b; int64_t inverse_inertia_scale_a; int64_t inverse_inertia_scale_b; int64_t max_force;
} iso_q32_kind_response;
typedef struct iso_q32_sensor_mount {
  uint32_t size; uint32_t reserved0; iso_body sensor; iso_body on; iso_q32_pose frame;
} iso_q32_sensor_mount;
typedef struct iso_q32_breakable_input {
  uint32_t size; uint32_t reserved0; int64_t impulse; iso_q32_vec3 point; iso_q32_unit_vec3 direction;
} iso_q32_breakable_input;
typedef struct iso_q32_character_input {
  uint32_t size; uint32_t reserved0; iso_q32_vec3 move; int64_t jump;
} iso_q32_character_input;
typedef struct iso_q32_vehicle_input {
  uint32_t size; uint32_t reserved0; int64_t throttle; int64_t clutch; int64_t brake; int64_t handbrake; int64_t steer;
  uint32_t gear; uint8_t reserved1[4];
} iso_q32_vehicle_input;
typedef struct iso_q32_character_state {
  uint32_t size; uint32_t reserved0; iso_footing footing; uint8_t reserved1[4]; iso_body ground; uint32_t stuck;
  uint8_t reserved2[4]; iso_q32_vec3 foot; iso_q32_vec3 foot_at; iso_q32_vec3 velocity; iso_q32_unit_vec3 normal;
} iso_q32_character_state;
typedef struct iso_q32_vehicle_state {
  uint32_t size; uint32_t reserved0; int64_t engine_spin; int64_t clutch_load;
} iso_q32_vehicle_state;
typedef struct iso_q32_wheel_state {
  uint32_t size; uint32_t reserved0; int64_t spin; int64_t angle; int64_t steered; int64_t length; int64_t slip;
  iso_body contact_body; iso_q32_vec3 contact_point; iso_q32_unit_vec3 contact_normal; int64_t load; int64_t along;
  int64_t across;
} iso_q32_wheel_state;
typedef struct iso_q32_joint_load_state {
  uint32_t size; uint32_t reserved0; int64_t force; int64_t torque;
} iso_q32_joint_load_state;
typedef struct iso_q32_coupling_state {
  uint32_t size; uint32_t reserved0; int64_t load;
} iso_q32_coupling_state;

/* What begins with its size, of a family. */
#define ISO_C_FOR_EACH_SIZED(X, P) \
  X(P, settings) X(P, body_definition) X(P, body_mass) X(P, body_state) X(P, body_properties) X(P, sphere) X(P, box) \
  X(P, capsule) X(P, half_space) X(P, cylinder) X(P, cone) X(P, hull) X(P, joint_properties) X(P, ball) \
  X(P, constant_velocity) X(P, fixed) X(P, universal) X(P, angular) X(P, hinge) X(P, slider) X(P, cylindrical) \
  X(P, planar) X(P, rod) X(P, rope) X(P, wheel_joint) X(P, motor_joint) X(P, six_axis) X(P, ragdoll_settings) \
  X(P, ray_cast) X(P, shape_cast) X(P, overlap_query) X(P, point_query) X(P, box_query) X(P, force_zone) \
  X(P, attractor) X(P, body_spring) X(P, thruster) X(P, buoyancy) X(P, explosion) X(P, water) X(P, drag) \
  X(P, aero_surface) X(P, damping_zone) X(P, material_pair) X(P, breakable) X(P, character) X(P, vehicle) X(P, wheel) \
  X(P, surface_velocity) X(P, ghost) X(P, one_way) X(P, hit_report) X(P, contact_report) X(P, joint_load) \
  X(P, coupling) X(P, axis_drive) X(P, kind_ghost) X(P, kind_response) X(P, sensor_mount) X(P, breakable_input) \
  X(P, character_input) X(P, vehicle_input) X(P, character_state) X(P, vehicle_state) X(P, wheel_state) \
  X(P, joint_load_state) X(P, coupling_state)
/* The same of structs without numbers. */
#define ISO_C_FOR_EACH_COMMON_SIZED(X, P) \
  X(P, step_report) X(P, world_counts) X(P, break_report) X(P, fault_report) X(P, height_patch) X(P, height_grid) \
  X(P, height_sheet) X(P, triangles) X(P, surface_materials) X(P, replay_info) X(P, replay_result) \
  X(P, selfcheck_result)
/* Records that are registered with a world. */
#define ISO_C_FOR_EACH_RECORD(X, P) \
  X(P, force_zone) X(P, attractor) X(P, body_spring) X(P, thruster) X(P, buoyancy) X(P, explosion) X(P, water) \
  X(P, drag) X(P, aero_surface) X(P, damping_zone) X(P, material_pair) X(P, breakable) X(P, character) X(P, vehicle) \
  X(P, wheel) X(P, surface_velocity) X(P, ghost) X(P, one_way) X(P, hit_report) X(P, contact_report) X(P, joint_load) \
  X(P, coupling) X(P, axis_drive) X(P, kind_ghost) X(P, kind_response) X(P, sensor_mount)
/* Those of them that have an input. */
#define ISO_C_FOR_EACH_INPUT(X, P) \
  X(P, breakable) X(P, character) X(P, vehicle)
/* Those of them of which a step writes a state. */
#define ISO_C_FOR_EACH_STATE(X, P) \
  X(P, character) X(P, vehicle) X(P, wheel) X(P, joint_load) X(P, coupling)
/* Shapes that numbers describe. */
#define ISO_C_FOR_EACH_SHAPE(X, P) \
  X(P, sphere) X(P, box) X(P, capsule) X(P, half_space) X(P, cylinder) X(P, cone)
/* Joints by name. */
#define ISO_C_FOR_EACH_JOINT(X, P) \
  X(P, ball) X(P, constant_velocity) X(P, fixed) X(P, universal) X(P, angular) X(P, hinge) X(P, slider) \
  X(P, cylindrical) X(P, planar) X(P, rod) X(P, rope) X(P, wheel_joint) X(P, motor_joint) X(P, six_axis)
/* End of structs */

/* Library */

/* The interface's version, the number in the library's soname. */
ISO_API uint32_t iso_abi_version(void);
/* The release, "0.1.0". */
ISO_API const char* iso_version(void);
/* The version of the results: two builds of one behaviour version promise each other's hashes. What lobbies compare. */
ISO_API uint64_t iso_behaviour_version(void);
/* A status in words; "unknown status" for any other number. */
ISO_API const char* iso_status_text(iso_status status);
/* The last call on this thread that did not succeed, as a sentence; empty before there was one. */
ISO_API const char* iso_last_error(void);
/* 1 where this library has the scalar. */
ISO_API uint8_t iso_has_scalar(iso_scalar scalar);
/* "q32.32", as replays name it; null for a number that is no iso_scalar. */
ISO_API const char* iso_scalar_name(iso_scalar scalar);
/* Replays the built-in recordings with every scalar and set of lanes: half a second. What a game asks at start. */
ISO_API iso_status iso_selfcheck(iso_selfcheck_result* out);
#define ISO_C_COMMON_INIT(P, name) \
  /* What _init calls. Sets `size`, [bytes] of the caller's struct, and the defaults. */ \
  ISO_API iso_status iso_##name##_init_sized(iso_##name* out, size_t size);
ISO_C_FOR_EACH_COMMON_SIZED(ISO_C_COMMON_INIT, )
ISO_API iso_status iso_filter_init(iso_filter* out);
ISO_API iso_status iso_query_filter_init(iso_query_filter* out);

/* Worlds. One thread at a time changes a world; between changes any number may ask it. */

/* Snapshots of it may outlive it. A tape that records it ends. */
ISO_API iso_status iso_world_destroy(iso_world* world);
ISO_API iso_status iso_world_get_scalar(const iso_world* world, iso_scalar* out);
/* Steps taken; 0 for what is no world. */
ISO_API uint64_t iso_world_tick(const iso_world* world);
/* Of the whole state; 0 for what is no world. */
ISO_API uint64_t iso_world_hash(const iso_world* world);
/* One step of 1 / hz seconds. `report` may be null. */
ISO_API iso_status iso_world_step(iso_world* world, iso_step_report* report);
ISO_API iso_status iso_world_get_counts(const iso_world* world, iso_world_counts* out);
/* All bodies, ascending by slot. */
ISO_API iso_status iso_world_bodies(const iso_world* world, iso_body* out, size_t room, size_t* count);
ISO_API iso_status iso_world_joints(const iso_world* world, iso_joint* out, size_t room, size_t* count);
/* Lanes of the solver. Never changes a bit. ISO_FAULT_BAD_ARGUMENT where this processor or build has none such. */
ISO_API iso_status iso_world_use_simd(iso_world* world, iso_simd simd);
/* Null for what is no world. */
ISO_API const char* iso_world_simd_name(const iso_world* world);
/* The structure that finds bodies near each other. Never changes a bit. */
ISO_API iso_status iso_world_use_broad_phase(iso_world* world, iso_broad_phase name);
ISO_API iso_status iso_world_get_broad_phase(const iso_world* world, iso_broad_phase* out);
/* run(user, copies, task, data) calls task(data) up to `copies` times, on any threads, and returns when those calls
   have. It calls nothing of this world. */
typedef void (*iso_task)(void* data);
typedef void (*iso_run)(void* user, int32_t copies, iso_task task, void* data);
/* Threads that help with steps and batches; a null `run` ends that. Never changes a bit. `user` outlives the world. */
ISO_API iso_status iso_world_use_threads(iso_world* world, iso_run run, void* user, int32_t threads);
/* Why the last call was refused: the status of that call if the world refused it, with texts that live for ever. */
ISO_API iso_status iso_world_fault(const iso_world* world, iso_fault_report* out);
/* The same of the first call since the world was made or told to forget: refusals come in chains. */
ISO_API iso_status iso_world_first_fault(const iso_world* world, iso_fault_report* out);
ISO_API iso_status iso_world_forget_faults(iso_world* world);
/* The last one as a sentence that ends in 0. `size`: room in, need out. */
ISO_API iso_status iso_world_fault_text(const iso_world* world, char* text, size_t* size);

/* State */

/* For worlds of the same scalar as `like`. */
ISO_API iso_status iso_snapshot_create(const iso_world* like, iso_snapshot** out);
ISO_API iso_status iso_snapshot_destroy(iso_snapshot* snapshot);
/* [bytes] What it holds for itself. */
ISO_API iso_status iso_snapshot_get_size(const iso_snapshot* snapshot, size_t* out);
ISO_API iso_status iso_world_save(const iso_world* world, iso_snapshot* to);
/* Same ids, same future. ISO_FAULT_BAD_SNAPSHOT: of a world with other settings, or nothing was saved there. */
ISO_API iso_status iso_world_load(iso_world* world, const iso_snapshot* from);
/* The portable form, for files and late joiners. `size`: room in, need out. */
ISO_API iso_status iso_world_write(const iso_world* world, void* bytes, size_t* size);
/* The portable form of a world of the same scalar; its settings come along. */
ISO_API iso_status iso_world_read(iso_world* world, const void* bytes, size_t size);
/* Commands and steps as the log has them: a frame of a replay, a message from another machine. What comes before an
   error was done; then the world is to be loaded. */
ISO_API iso_status iso_world_apply(iso_world* world, const void* commands, size_t size);
/* 1: every accepted command and every step is appended to the world's log. Not while a tape records the world. */
ISO_API iso_status iso_world_keep_log(iso_world* world, uint8_t on);
/* Until the next call that changes the world or clears the log. */
ISO_API iso_status iso_world_log(const iso_world* world, const void** bytes, size_t* size);
ISO_API iso_status iso_world_clear_log(iso_world* world);
/* 1: every step appends the state's hash as it begins and after each iso_stage: what desyncs are narrowed down with. */
ISO_API iso_status iso_world_trace(iso_world* world, uint8_t on);
/* Of all steps since the trace began or was cleared. Until the next step. */
ISO_API iso_status iso_world_stage_hashes(const iso_world* world, const uint64_t** hashes, size_t* count);
ISO_API iso_status iso_world_clear_trace(iso_world* world);

/* Shapes */

ISO_API iso_status iso_blob_create_mesh(const iso_triangles* triangles, const iso_surface_materials* materials_or_null,
                                        iso_blob_home home, iso_blob** out);
ISO_API iso_status iso_blob_create_height_field(const iso_height_sheet* sheet,
                                                const iso_surface_materials* materials_or_null, iso_blob_home home,
                                                iso_blob** out);
/* A file of `isostep bake`, or what iso_blob_write wrote. */
ISO_API iso_status iso_blob_read(const void* bytes, size_t size, iso_blob_home home, iso_blob** out);
/* As such a file. `size`: room in, need out. */
ISO_API iso_status iso_blob_write(const iso_blob* blob, void* bytes, size_t* size);
/* The hash of its content: equal content has one name on every machine. */
ISO_API iso_status iso_blob_get_name(const iso_blob* blob, uint64_t* low, uint64_t* high);
ISO_API iso_status iso_blob_get_type(const iso_blob* blob, iso_shape_type* out);
/* Worlds that use its content keep that. */
ISO_API iso_status iso_blob_destroy(iso_blob* blob);
/* A shape of a hull, mesh or height field. */
ISO_API iso_status iso_add_blob(iso_world* world, const iso_blob* blob, iso_shape* out);
/* What states and commands name and do not carry: blobs of ISO_BLOB_HOME_ASSET. */
ISO_API iso_status iso_world_add_asset(iso_world* world, const iso_blob* blob);
/* Other heights, and materials, for a part of the field that is that child of the shape. */
ISO_API iso_status iso_set_heights(iso_world* world, iso_shape shape, uint32_t child, const iso_height_patch* patch);
/* The field's grid, its heights by rows and its materials by cells, until the next call that changes the world. */
ISO_API iso_status iso_get_heights(const iso_world* world, iso_shape shape, uint32_t child, iso_height_grid* grid,
                                   const int16_t** heights, const uint8_t** materials);
ISO_API iso_status iso_remove_shape(iso_world* world, iso_shape shape);
/* 0 also for what is no world. */
ISO_API uint8_t iso_shape_exists(const iso_world* world, iso_shape shape);

/* Bodies, joints and records by their ids */

ISO_API iso_status iso_body_destroy(iso_world* world, iso_body body);
/* All of them for the price of one. Ids of nothing are passed over: `destroyed`, how many there were, may be null. */
ISO_API iso_status iso_bodies_destroy(iso_world* world, const iso_body* bodies, size_t count, size_t* destroyed);
ISO_API uint8_t iso_body_exists(const iso_world* world, iso_body body);
ISO_API iso_status iso_body_wake(iso_world* world, iso_body body);
ISO_API iso_status iso_body_sleep(iso_world* world, iso_body body);
/* 0: takes part in nothing until it is enabled again; id, pose, joints and records stay. */
ISO_API iso_status iso_body_set_enabled(iso_world* world, iso_body body, uint8_t enabled);
ISO_API iso_status iso_body_set_filter(iso_world* world, iso_body body, const iso_filter* filter);
ISO_API iso_status iso_body_set_user_data(iso_world* world, iso_body body, uint64_t user_data);
ISO_API iso_status iso_joint_destroy(iso_world* world, iso_joint joint);
ISO_API uint8_t iso_joint_exists(const iso_world* world, iso_joint joint);
/* The id of the axis_drive record on one axis of a six-axis joint; wheels, motors and ragdolls have them too. With it the
   record is read, set and removed: another target for a servo, another speed for a motor. 0 where there is none. */
ISO_API iso_status iso_joint_get_axis_drive(const iso_world* world, iso_joint joint, iso_joint_axis axis,
                                            iso_record* out);
#define ISO_C_REMOVE(P, name) ISO_API iso_status iso_remove_##name(iso_world* world, iso_record id);
ISO_C_FOR_EACH_RECORD(ISO_C_REMOVE, )
/* Pieces in place of bodies that a step broke, at most `most` bodies. Once a frame. `report` may be null. */
ISO_API iso_status iso_break_bodies(iso_world* world, uint32_t most, iso_break_report* report);

/* Events of the last step, and poses. Arrays belong to the world, until the next call that changes it. */

ISO_API iso_status iso_contact_ends(iso_world* world, const iso_body_pair** out, size_t* count);
ISO_API iso_status iso_sensor_begins(iso_world* world, const iso_sensor_event** out, size_t* count);
ISO_API iso_status iso_sensor_ends(iso_world* world, const iso_sensor_event** out, size_t* count);
ISO_API iso_status iso_fell_asleep(iso_world* world, const iso_body** out, size_t* count);
ISO_API iso_status iso_woke(iso_world* world, const iso_body** out, size_t* count);
/* For drawing, of all moving bodies between the step before the last and the last; alpha from 0 to 1. */
ISO_API iso_status iso_world_poses(iso_world* world, float alpha, const iso_render_pose** out, size_t* count);

/* Recordings: whatever the game does to the world, as a file that isostep verifies without the game's code. */

ISO_API iso_status iso_tape_create(iso_tape** out);
/* A recording that is not finished is a truncated one. */
ISO_API iso_status iso_tape_destroy(iso_tape* tape);
/* From the state that the world has now. `scene`: what the header calls it. A tape records once, a world to one. */
ISO_API iso_status iso_world_record(iso_world* world, iso_tape* tape, const char* scene);
/* After the commands and steps of each frame, at most 64 steps. */
ISO_API iso_status iso_tape_end_frame(iso_tape* tape);
/* The whole state, for seeking; after iso_tape_end_frame, before the next command. */
ISO_API iso_status iso_tape_keyframe(iso_tape* tape);
/* All frames so far are in its bytes, where a crash costs none of them; a second's are without it. */
ISO_API iso_status iso_tape_flush(iso_tape* tape);
ISO_API iso_status iso_tape_finish(iso_tape* tape);
/* What there is of the file, until the next call with the tape. */
ISO_API iso_status iso_tape_bytes(const iso_tape* tape, const void** bytes, size_t* size);
/* Forgets those bytes, for who writes the file as it grows. */
ISO_API iso_status iso_tape_drop_bytes(iso_tape* tape);

/* What the header says. A file that is no replay is ISO_CORRUPT; one that is cut is told in `out`. */
ISO_API iso_status iso_replay_about(const void* bytes, size_t size, iso_replay_info* out);
/* What `isostep verify` does: plays the file, at most so many frames (UINT64_MAX: all), and compares every hash. The
   status is ISO_OK whatever the outcome. */
ISO_API iso_status iso_replay_verify(const void* bytes, size_t size, iso_simd simd, uint64_t most_frames,
                                     iso_replay_result* out);
/* Of a whole or truncated file, whose bytes are copied. */
ISO_API iso_status iso_replay_open(const void* bytes, size_t size, iso_replay** out);
ISO_API iso_status iso_replay_destroy(iso_replay* replay);
ISO_API iso_status iso_replay_get_info(const iso_replay* replay, iso_replay_info* out);
/* A world in the state before the first frame. */
ISO_API iso_status iso_replay_create_world(const iso_replay* replay, iso_world** out);
/* The commands of a frame, for iso_world_apply, and the hash after it. The pointer holds as long as the replay. */
ISO_API iso_status iso_replay_get_frame(const iso_replay* replay, uint64_t frame, const void** commands, size_t* size,
                                        uint64_t* hash);

/* What each family has. Pointers may not be null unless that is said. */
#define ISO_C_FUNCTIONS(P, N, U)                                                                                       \
  /* Nearest to the double, ties away from zero, held at the format's ends; NaN is 0 in fixed point. Two machines that \
     computed different doubles get different worlds. */                                                               \
  ISO_API N iso_##P##_from_double(double value);                                                                       \
  ISO_API double iso_##P##_to_double(N value);                                                                         \
  ISO_API U iso_##P##_unit_from_double(double value);                                                                  \
  ISO_API double iso_##P##_unit_to_double(U value);                                                                    \
                                                                                                                       \
  ISO_API iso_status iso_##P##_material_init(iso_##P##_material* out);                                                 \
  ISO_API iso_status iso_##P##_ragdoll_bone_init(iso_##P##_ragdoll_bone* out);                                         \
                                                                                                                       \
  /* Settings out of range are refused. */                                                                             \
  ISO_API iso_status iso_##P##_world_create(const iso_##P##_settings* settings, iso_world** out);                      \
  ISO_API iso_status iso_##P##_world_get_settings(const iso_world* world, iso_##P##_settings* out);                    \
  ISO_API iso_status iso_##P##_world_set_gravity(iso_world* world, const iso_##P##_vec3* gravity);                     \
                                                                                                                       \
  /* The hull of points [m]. */                                                                                        \
  ISO_API iso_status iso_##P##_blob_create_hull(const iso_##P##_vec3* points, size_t count, iso_blob_home home,        \
                                                iso_blob** out);                                                       \
  /* A hull with a radius around it. */                                                                                \
  ISO_API iso_status iso_##P##_add_hull(iso_world* world, const iso_##P##_hull* hull, const iso_blob* blob,            \
                                        iso_shape* out);                                                               \
  /* Parts at poses of their own. A part's primitive.blob is 1 + an index into `blobs`, or 0. */                       \
  ISO_API iso_status iso_##P##_add_compound(iso_world* world, const iso_##P##_child* children, size_t count,           \
                                            const iso_blob* const* blobs, size_t blob_count, iso_shape* out);          \
                                                                                                                       \
  ISO_API iso_status iso_##P##_body_create(iso_world* world, const iso_##P##_body_definition* definition,              \
                                           iso_body* out);                                                             \
  ISO_API iso_status iso_##P##_body_get_state(const iso_world* world, iso_body body, iso_##P##_body_state* out);       \
  /* Of many at once. `out` has one for each of `bodies`, every one with its size set. */                              \
  ISO_API iso_status iso_##P##_bodies_get_states(const iso_world* world, const iso_body* bodies, size_t count,         \
                                                 iso_##P##_body_state* out);                                           \
  ISO_API iso_status iso_##P##_body_get_properties(const iso_world* world, iso_body body,                              \
                                                   iso_##P##_body_properties* out);                                    \
  /* The parts of its shape, in the body's frame. */                                                                   \
  ISO_API iso_status iso_##P##_body_get_children(const iso_world* world, iso_body body, iso_##P##_child* out,          \
                                                 size_t room, size_t* count);                                          \
  /* [m/s] of a point [m] that moves with the body, both world. */                                                     \
  ISO_API iso_status iso_##P##_body_get_velocity_at(const iso_world* world, iso_body body,                             \
                                                    const iso_##P##_vec3* point, iso_##P##_vec3* out);                 \
  /* [kg m^2] about an axis through its centre of mass, world. */                                                      \
  ISO_API iso_status iso_##P##_body_get_inertia(const iso_world* world, iso_body body,                                 \
                                                const iso_##P##_unit_vec3* axis, N* out);                              \
  /* Teleports; velocity stays. */                                                                                     \
  ISO_API iso_status iso_##P##_body_set_pose(iso_world* world, iso_body body, const iso_##P##_pose* pose);             \
  ISO_API iso_status iso_##P##_body_set_velocity(iso_world* world, iso_body body, const iso_##P##_vec3* linear,        \
                                                 const iso_##P##_vec3* angular);                                       \
  ISO_API iso_status iso_##P##_body_set_material(iso_world* world, iso_body body,                                      \
                                                 const iso_##P##_material* material);                                  \
  /* Locks: ISO_BODY_FLAG_LOCK_... */                                                                                  \
  ISO_API iso_status iso_##P##_body_set_motion(iso_world* world, iso_body body, N gravity_scale, N linear_damping,     \
                                               N angular_damping, uint32_t locks);                                     \
  /* `mass`: of what becomes dynamic; null: the default. */                                                            \
  ISO_API iso_status iso_##P##_body_set_type(iso_world* world, iso_body body, iso_body_type type,                      \
                                             const iso_##P##_body_mass* mass);                                         \
  ISO_API iso_status iso_##P##_body_set_mass(iso_world* world, iso_body body, const iso_##P##_body_mass* mass);        \
  /* Another shape; id, pose, joints and records stay. `mass`: null keeps that of a dynamic body. */                   \
  ISO_API iso_status iso_##P##_body_set_shape(iso_world* world, iso_body body, iso_shape shape,                        \
                                              const iso_##P##_body_mass* mass);                                        \
  /* The next step carries a kinematic body there. */                                                                  \
  ISO_API iso_status iso_##P##_body_move_to(iso_world* world, iso_body body, const iso_##P##_pose* pose);              \
  /* [N], [N m] over the next step; `torque` may be null. */                                                           \
  ISO_API iso_status iso_##P##_body_apply_force(iso_world* world, iso_body body, const iso_##P##_vec3* force,          \
                                                const iso_##P##_vec3* torque);                                         \
  ISO_API iso_status iso_##P##_body_apply_force_at(iso_world* world, iso_body body, const iso_##P##_vec3* force,       \
                                                   const iso_##P##_vec3* point);                                       \
  /* [kg m/s], [kg m^2/s] at once; `angular_impulse` may be null. */                                                   \
  ISO_API iso_status iso_##P##_body_apply_impulse(iso_world* world, iso_body body, const iso_##P##_vec3* impulse,      \
                                                  const iso_##P##_vec3* angular_impulse);                              \
  ISO_API iso_status iso_##P##_body_apply_impulse_at(iso_world* world, iso_body body, const iso_##P##_vec3* impulse,   \
                                                     const iso_##P##_vec3* point);                                     \
                                                                                                                       \
  /* A joint whose frames lie where `frame` (world) is now; body 0 is the world. Add limits, motor, spring; then       \
     create. */                                                                                                        \
  ISO_API iso_status iso_##P##_joint_at(const iso_world* world, iso_joint_type type, iso_body a, iso_body b,           \
                                        const iso_##P##_pose* frame, iso_##P##_joint_properties* out);                 \
  ISO_API iso_status iso_##P##_joint_between(const iso_world* world, iso_joint_type type, iso_body a,                  \
                                             const iso_##P##_pose* frame_a, iso_body b, const iso_##P##_pose* frame_b, \
                                             iso_##P##_joint_properties* out);                                         \
  ISO_API iso_status iso_##P##_joint_create(iso_world* world, const iso_##P##_joint_properties* joint,                 \
                                            iso_joint* out);                                                           \
  /* Limits, motor and spring; bodies, frames and type stay. */                                                        \
  ISO_API iso_status iso_##P##_joint_set(iso_world* world, iso_joint joint,                                            \
                                         const iso_##P##_joint_properties* properties);                                \
  /* Parts of it: [rad] or [m]. Torque [N m] or [N], 0: no motor; frequency [Hz], 0: no spring. */                     \
  ISO_API iso_status iso_##P##_joint_set_limits(iso_world* world, iso_joint joint, N lower, N upper);                  \
  ISO_API iso_status iso_##P##_joint_set_motor(iso_world* world, iso_joint joint, N speed, N torque);                  \
  ISO_API iso_status iso_##P##_joint_set_spring(iso_world* world, iso_joint joint, N frequency, N damping);            \
  ISO_API iso_status iso_##P##_joint_set_target(iso_world* world, iso_joint joint, N target);                          \
  ISO_API iso_status iso_##P##_joint_get(const iso_world* world, iso_joint joint, iso_##P##_joint_properties* out);    \
  /* [m] between the anchors; of a distance joint its error. */                                                        \
  ISO_API iso_status iso_##P##_joint_get_error(const iso_world* world, iso_joint joint, N* out);                       \
  /* [rad] or [m]: what lower, upper and spring_target count. */                                                       \
  ISO_API iso_status iso_##P##_joint_get_position(const iso_world* world, iso_joint joint, N* out);                    \
  /* Of one axis of a six-axis joint. */                                                                               \
  ISO_API iso_status iso_##P##_joint_get_axis_position(const iso_world* world, iso_joint joint, iso_joint_axis axis,   \
                                                       N* out);                                                        \
                                                                                                                       \
  /* Couplings of joints, to be added as records. */                                                                   \
  ISO_API iso_status iso_##P##_coupling_gears(iso_joint a, int32_t teeth_a, iso_joint b, int32_t teeth_b,              \
                                              iso_##P##_coupling* out);                                                \
  /* Radius [m], not 0. */                                                                                             \
  ISO_API iso_status iso_##P##_coupling_rack_and_pinion(iso_joint hinge, N radius, iso_joint slider,                   \
                                                        iso_##P##_coupling* out);                                      \
  /* Pitch [m] a turn, not 0. */                                                                                       \
  ISO_API iso_status iso_##P##_coupling_screw(iso_joint hinge, N pitch, iso_joint slider, iso_##P##_coupling* out);    \
  /* Rope [m]. */                                                                                                      \
  ISO_API iso_status iso_##P##_coupling_pulley(iso_joint a, iso_joint b, N ratio, N rope, iso_##P##_coupling* out);    \
  ISO_API iso_status iso_##P##_coupling_differential(iso_joint shaft, iso_joint left, iso_joint right,                 \
                                                     iso_##P##_coupling* out);                                         \
  ISO_API iso_status iso_##P##_coupling_mimic(iso_joint a, iso_joint b, iso_##P##_coupling* out);                      \
                                                                                                                       \
  /* A figure of bodies and joints, all of it or nothing. `settings` may be null. `bodies` and `joints` have room for  \
     one a bone; a root's joint is 0. */                                                                               \
  ISO_API iso_status iso_##P##_add_ragdoll(iso_world* world, const iso_##P##_ragdoll_bone* bones, size_t count,        \
                                           const iso_##P##_ragdoll_settings* settings, iso_body* bodies,               \
                                           iso_joint* joints);                                                         \
                                                                                                                       \
  /* The first hit; `found` is 1 or 0. */                                                                              \
  ISO_API iso_status iso_##P##_cast_ray(const iso_world* world, const iso_##P##_ray_cast* ray, iso_##P##_ray_hit* out, \
                                        uint8_t* found);                                                               \
  /* All hits in order: as many as there is room for. `count`: how many there are; more than `room` is                 \
     ISO_SMALL_BUFFER. */                                                                                              \
  ISO_API iso_status iso_##P##_cast_ray_all(const iso_world* world, const iso_##P##_ray_cast* ray,                     \
                                            iso_##P##_ray_hit* out, size_t room, size_t* count);                       \
  ISO_API iso_status iso_##P##_cast_shape(const iso_world* world, const iso_##P##_shape_cast* cast,                    \
                                          iso_##P##_shape_hit* out, uint8_t* found);                                   \
  ISO_API iso_status iso_##P##_cast_shape_all(const iso_world* world, const iso_##P##_shape_cast* cast,                \
                                              iso_##P##_shape_hit* out, size_t room, size_t* count);                   \
  /* Many at once, on the world's threads. `each`: hits for each, 1 or more, the nearest ones, in order, then some     \
     with body 0. */                                                                                                   \
  ISO_API iso_status iso_##P##_cast_rays(const iso_world* world, const iso_##P##_ray_cast* rays, size_t count,         \
                                         iso_##P##_ray_hit* out, size_t each);                                         \
  ISO_API iso_status iso_##P##_cast_shapes(const iso_world* world, const iso_##P##_shape_cast* casts, size_t count,    \
                                           iso_##P##_shape_hit* out, size_t each);                                     \
  ISO_API iso_status iso_##P##_closest_point(const iso_world* world, const iso_##P##_point_query* query,               \
                                             iso_##P##_closest_body* out, uint8_t* found);                             \
  ISO_API iso_status iso_##P##_overlap_first(const iso_world* world, const iso_##P##_overlap_query* query,             \
                                             iso_overlap_hit* out, uint8_t* found);                                    \
  ISO_API iso_status iso_##P##_overlap_shape(const iso_world* world, const iso_##P##_overlap_query* query,             \
                                             iso_overlap_hit* out, size_t room, size_t* count);                        \
  /* Bodies whose bounds meet the box: a cheap first query. */                                                         \
  ISO_API iso_status iso_##P##_overlap_box(const iso_world* world, const iso_##P##_box_query* query, iso_body* out,    \
                                           size_t room, size_t* count);                                                \
                                                                                                                       \
  /* Events of the last step: arrays of the world's, until the next call that changes it. */                           \
  ISO_API iso_status iso_##P##_contact_begins(iso_world* world, const iso_##P##_contact_begin** out, size_t* count);   \
  /* Bodies that contacts broke: their breakable records are marked. */                                                \
  ISO_API iso_status iso_##P##_broke_events(iso_world* world, const iso_##P##_broke** out, size_t* count);             \
  ISO_API iso_status iso_##P##_joint_broke_events(iso_world* world, const iso_##P##_joint_broke** out, size_t* count); \
  /* Of bodies with a hit_report. */                                                                                   \
  ISO_API iso_status iso_##P##_contact_hits(iso_world* world, const iso_##P##_contact_hit** out, size_t* count);       \
  /* Of bodies with a contact_report. */                                                                               \
  ISO_API iso_status iso_##P##_contact_points(iso_world* world, const iso_##P##_contact_point** out, size_t* count);   \
  /* Of those the ones of one body. */                                                                                 \
  ISO_API iso_status iso_##P##_body_get_contacts(const iso_world* world, iso_body body, iso_##P##_contact_point* out,  \
                                                 size_t room, size_t* count);                                          \
  /* A wheel turns so fast from now on [rad/s]: of a car that is put on the road at speed. */                          \
  ISO_API iso_status iso_##P##_wheel_set_spin(iso_world* world, iso_record wheel, N spin);

#define ISO_C_INIT(P, name) \
  ISO_API iso_status iso_##P##_##name##_init_sized(iso_##P##_##name* out, size_t size);
#define ISO_C_RECORD(P, name)                                                                                     \
  ISO_API iso_status iso_##P##_add_##name(iso_world* world, const iso_##P##_##name* record, iso_record* out);     \
  ISO_API iso_status iso_##P##_set_##name(iso_world* world, iso_record id, const iso_##P##_##name* record);       \
  ISO_API iso_status iso_##P##_get_##name(const iso_world* world, iso_record id, iso_##P##_##name* out);
/* What a game asks of a record from frame to frame, until it asks something else: move and jump of a character, the
   pedals of a vehicle. It stands apart from the record, so that setting one never takes back the other. */
#define ISO_C_INPUT(P, name)                                                                                              \
  ISO_API iso_status iso_##P##_set_##name##_input(iso_world* world, iso_record id, const iso_##P##_##name##_input* input); \
  ISO_API iso_status iso_##P##_get_##name##_input(const iso_world* world, iso_record id, iso_##P##_##name##_input* out);
/* How the last step left a record. */
#define ISO_C_STATE(P, name) \
  ISO_API iso_status iso_##P##_get_##name##_state(const iso_world* world, iso_record id, iso_##P##_##name##_state* out);
/* A shape of the world; and as a primitive, for parts of compounds and for queries. */
#define ISO_C_SHAPE(P, name)                                                                                      \
  ISO_API iso_status iso_##P##_add_##name(iso_world* world, const iso_##P##_##name* shape, iso_shape* out);       \
  ISO_API iso_status iso_##P##_##name##_primitive(const iso_##P##_##name* shape, iso_##P##_primitive* out);
#define ISO_C_JOINT(P, name) \
  ISO_API iso_status iso_##P##_create_##name(iso_world* world, const iso_##P##_##name* joint, iso_joint* out);
#define ISO_C_LISTED_FUNCTIONS(P, N, U)        \
  ISO_C_FOR_EACH_SIZED(ISO_C_INIT, P)          \
  ISO_C_FOR_EACH_SHAPE(ISO_C_SHAPE, P)         \
  ISO_C_FOR_EACH_JOINT(ISO_C_JOINT, P)         \
  ISO_C_FOR_EACH_RECORD(ISO_C_RECORD, P)       \
  ISO_C_FOR_EACH_INPUT(ISO_C_INPUT, P)         \
  ISO_C_FOR_EACH_STATE(ISO_C_STATE, P)

ISO_C_SCALARS(ISO_C_FUNCTIONS)
ISO_C_SCALARS(ISO_C_LISTED_FUNCTIONS)

/* Sessions */

/* A session decides which frames a game steps, with whose inputs, and when: lockstep, rollback, watching, sync tests,
   replays. It has no sockets, no clock and no threads: bytes and the time go in, bytes and requests come out. See
   SESSIONS.md. Times are microseconds since any moment of the caller's choice and never run backwards; frames count
   from 0, -1 is none; sets of players are a bit each.

   Strings that come out end with a zero byte and hold until the session's next call. Structs that are filled here begin
   with `size`, which the caller sets, by their _init or as iso_session_event event = {.size = sizeof event}. */

typedef struct iso_session iso_session;

enum {
  ISO_REFUSED = -11, /* not now, not yours or not sound: iso_last_error() says more */
  ISO_UNFINISHED = -12 /* not between iso_session_advance and the last request of iso_session_next */
};

enum {
  ISO_MAX_PLAYERS = 32,
  ISO_INPUT_CAP = 512,      /* [bytes] of one player's input for one frame */
  ISO_CREDENTIAL_CAP = 256, /* [bytes] */
  ISO_DATAGRAM_CAP = 1180,  /* [bytes] of one datagram of a session */
  ISO_RELIABLE_CAP = 16384, /* [bytes] of one reliable message of a session */
  ISO_NO_PLAYER = 0xff,
  ISO_NORMAL_SPEED = 8 /* [1/8 of the match's rate] 4 to 16 may be set */
};

typedef uint32_t iso_session_mode;
enum {
  ISO_LOCKSTEP,  /* a frame is stepped when all its inputs are known */
  ISO_ROLLBACK,  /* a frame is stepped when it is due; wrong guesses are stepped again */
  ISO_SPECTATOR, /* no player; steps what is known, and catches up when behind */
  ISO_SYNC_TEST, /* one machine: every frame is rolled back, stepped again and compared */
  ISO_REPLAY     /* plays a recorded match */
};

typedef uint32_t iso_predictor;
enum {
  ISO_REPEAT_LAST,    /* a held stick stays held */
  ISO_PREDICT_NEUTRAL /* nobody gives the same order twice */
};

typedef uint32_t iso_genre;
enum {
  ISO_FIGHTING, /* two players; a frame of delay is felt */
  ISO_BRAWLER,  /* a few players on one small stage */
  ISO_RACING,   /* many players; a step is cheap, and others' cars may be corrected */
  ISO_STRATEGY, /* orders now and then; nothing that is shown may be taken back */
  ISO_SANDBOX   /* a thousand awake bodies: a step is dear */
};

typedef struct iso_session_config {
  uint32_t size;
  iso_session_mode mode;
  uint8_t host;              /* others connect to us; the host fixes what was played */
  uint8_t relays;            /* spectator: it serves up to max_peers further ones, who connect to it as to a host */
  uint8_t repair;            /* who is outvoted takes the host's state again by itself */
  uint8_t asks_admission;    /* host: its game decides whom it lets in: iso_session_poll_applicant */
  uint8_t votes;             /* host: who plays may propose a vote */
  uint8_t players_set_tempo; /* host: who plays may pause and set the speed; else the host's game is asked, by events */
  uint8_t reserved1[2];
  int32_t players;
  int32_t local_players;   /* host: how many of the first play here, 0: dedicated; client: for how many seats it asks */
  int32_t hz;              /* [1/s] */
  int32_t window;          /* [frames] rollback: stepped on guesses at most; sync test: rolled back */
  int32_t delay;           /* [frames] an input waits at first; adapts between the next two */
  int32_t least_delay;     /* [frames] */
  int32_t most_delay;      /* [frames] */
  int32_t deadline;        /* [frames] host: an input that is late by so many is replaced by the guess; 0: none */
  uint64_t silence;        /* [us] without a word from a peer until it counts as lost */
  uint64_t patience;       /* [us] that one player may make the others wait within a minute; then it is left out */
  uint64_t exclusion;      /* [us] for so long */
  int32_t kept;            /* states kept, more than window, delay and latency; iso_game.save has slots below this */
  int32_t history;         /* frames of inputs kept: how long a snapshot may take to reach a late joiner */
  int32_t most_replayed;   /* [frames] whose state is at most so old steps them all; older ones are sent a snapshot */
  int32_t max_peers;       /* whom the host serves: the players, and as many spectators as they leave room for */
  int32_t max_strangers;   /* host: connections beside those; peers are numbered below the sum of both */
  uint32_t snapshot_cap;   /* [bytes] of a snapshot that a client accepts */
  uint32_t most_packets;   /* [1/s] datagrams, and messages, accepted of one peer */
  int32_t broadcast_delay; /* [frames] relay: it and all whom it serves see the match so late */
  uint64_t seed;      /* host: 64 random bits that no other match has, and a secret: tokens come of it. 0 is refused */
  uint64_t migration; /* [us] without a word from the host until the clients go on without it; 0: never */
  uint64_t reservation;     /* [us] host: a seat that was played on is kept so long for its player's token */
  uint64_t token;           /* client: what iso_session_token gave a former process of this player; 0: a new player */
  int32_t seat;             /* client: this seat, and those after it for further players of ours, or none; -1: any */
  uint32_t credential_size; /* [bytes] */
  uint8_t credential[256];  /* client: for the host's game */
  char address[72];      /* where the others' transports reach ours, at most 64 characters: iso_session_poll_connect */
  char name[136];        /* what all peers must have alike: the game and its version, 1 to 128 characters of ASCII */
  char input_text[136];  /* likewise: names the fields of an input, at most 128 characters */
  uint64_t input_schema; /* 0: hash of input_text, sizes and neutral; else this, as of a C++ InputCodec */
  uint32_t input_least;  /* [bytes] an input has, 0 to input_cap */
  uint32_t input_cap;    /* [bytes] and at most, 1 to ISO_INPUT_CAP */
  iso_predictor predictor; /* iso_game.predict replaces it */
  uint32_t neutral_size;   /* [bytes] input_least to input_cap */
  uint8_t neutral[512];    /* what is played for who is not there */
} iso_session_config;

/* What _init calls. C++'s defaults; inputs of 1 byte, neutral 0. To be set: `name`, `seed` of a host, the input. */
ISO_API iso_status iso_session_config_init_sized(iso_session_config* config, size_t size);
/* Likewise, with mode, window, delays and deadline for a genre and so many players. Of a struct whose size is set. */
ISO_API iso_status iso_session_config_preset(iso_session_config* config, iso_genre genre, int32_t players);
/* The first rule that it breaks, as the name of the field and what it may be; or null. */
ISO_API const char* iso_session_config_problem(const iso_session_config* config);

/* One player's input for one frame. */
typedef struct iso_input {
  uint16_t size;  /* [bytes] */
  uint8_t status; /* ISO_CONFIRMED ... */
  uint8_t reserved;
  uint8_t bytes[512]; /* zero from `size` on */
} iso_input;
/* Of an input. A game may look at ISO_DISCONNECTED, and at nothing else. */
typedef uint32_t iso_input_status;
enum {
  ISO_CONFIRMED,   /* the player's own word */
  ISO_PREDICTED,   /* a guess; the frame will be stepped again if it was wrong */
  ISO_DISCONNECTED /* the player is gone: the bytes are `neutral` */
};

/* The game: what is saved, rolled back, hashed and sent to who joins late. At least one of `world`, `block` and
   `save` is there; each in use is hashed and written in this order. All that it names outlives the session. */
typedef struct iso_game {
  uint32_t size;
  uint32_t reserved;
  iso_world* world; /* of any scalar, or null */
  void* block; /* the game's own state as one block of bytes, or null: no pointers, no padding with rubbish in it */
  size_t block_size; /* [bytes] */

  /* Callbacks, for iso_session_drive and for state of another form; each may be null. From within them nothing of the
     session may be called but what asks (it takes a const iso_session), and the world may be changed in `step` and
     `read`. They do not throw and do not jump out. */
  void* user; /* their first argument */
  /* Steps the game by one frame; its outcome depends on the state, the inputs' bytes and who is disconnected. */
  void (*step)(void* user, int32_t frame, const iso_input* inputs, uint32_t players);
  void (*rolled_back)(void* user, int32_t frame); /* the state is again that before `frame` */
  void (*restarted)(void* user, int32_t frame);   /* the state is one that arrived from elsewhere, before `frame` */
  void (*confirmed)(void* user, int32_t frame, uint64_t hash); /* `frame` is final, hash: of the state after it */
  /* State of another form: save, load and hash together, write and read together, or else nobody joins late. */
  void (*save)(void* user, uint32_t slot); /* into a place of the game's own, below config.kept */
  void (*load)(void* user, uint32_t slot); /* what was saved there last */
  uint64_t (*hash)(void* user);
  size_t (*write)(void* user, void* bytes, size_t room); /* returns the size, and writes nothing where room is less */
  int32_t (*read)(void* user, const void* bytes, size_t size); /* 0: taken; else refused, and all is as it was */
  /* Guesses the input `ahead` frames after `last` into `to`, which has input_cap bytes; returns its size. The same on
     all machines is better, and not needed. */
  size_t (*predict)(void* user, const void* last, size_t size, int32_t ahead, void* to);
  /* 0: no player can make this input; it has a size within the bounds. */
  int32_t (*valid)(void* user, const void* bytes, size_t size);
} iso_game;
/* all null */
ISO_API iso_status iso_game_init_sized(iso_game* game, size_t size);
/* XXH3-64, with which `block` is hashed: for iso_game.hash. */
ISO_API uint64_t iso_hash_bytes(const void* bytes, size_t size);

/* `file`: of ISO_REPLAY the recording of a match, of a host that goes on with one what iso_session_save_match gave;
   else null. ISO_REFUSED: see iso_session_config_problem. What is wrong with a file is the event ISO_EVENT_REFUSED. */
ISO_API iso_status iso_session_create(const iso_session_config* config, const iso_game* game, const void* file,
                                      size_t file_size, iso_session** out);
/* Refused from within a callback, and then the session stays. Null is allowed. The world and the block stay. */
ISO_API iso_status iso_session_destroy(iso_session* session);

/* A turn of the game's loop:

     what the transport has       -> iso_session_connected, _disconnected, _receive
     iso_session_add_local_input
     iso_session_drive                            with callbacks, or without any:
       iso_session_advance(session, now);
       while (iso_session_next(session, &request) == ISO_OK && request.kind != ISO_NOTHING)
         if (request.kind == ISO_STEP) step the game with iso_session_inputs(session, &players);
     iso_session_poll_send        -> the transport, until there is nothing more
     iso_session_poll_event                       likewise

   A transport of isostep's does the first and the last by its _deliver and _dispatch. */

typedef uint32_t iso_request_kind;
enum {
  ISO_NOTHING,        /* the turn is done */
  ISO_STEP,           /* step the game by one frame, before the next call */
  ISO_ROLLED_BACK,    /* the state is again that before `frame` */
  ISO_RESTARTED,      /* the state is one that arrived from elsewhere, before `frame` */
  ISO_FRAME_CONFIRMED /* `frame` is final, once each, ascending; `hash`: of the state after it */
};
typedef struct iso_request {
  uint32_t size;
  iso_request_kind kind;
  int32_t frame;
  uint32_t reserved;
  uint64_t hash;
} iso_request;
ISO_API iso_status iso_request_init_sized(iso_request* out, size_t size);

/* Begins the turn. One that was left in its middle, as by an exception of the game's step, is over: ISO_EVENT_MISUSE
   tells, and what was missed is stepped again from the newest final state. */
ISO_API iso_status iso_session_advance(iso_session* session, uint64_t now);
/* The next request; saves, loads and all else is done by itself in between. */
ISO_API iso_status iso_session_next(iso_session* session, iso_request* out);
/* Of the step that was asked for, by player, until the next call; else null. */
ISO_API const iso_input* iso_session_inputs(const iso_session* session, uint32_t* players);
/* Begins a turn and carries it out with iso_game.step. `steps` (or null): how many, those again included. */
ISO_API iso_status iso_session_drive(iso_session* session, uint64_t now, uint32_t* steps);

/* For the next frame; until that is stepped a later one replaces it. Refused: not a player of ours, not in the match
   now, or `valid` refuses. */
ISO_API iso_status iso_session_add_local_input(iso_session* session, int32_t player, const void* bytes, size_t size);
/* 1: the last one has been taken. A game of orders hands over the next only then. */
ISO_API uint8_t iso_session_wants_input(const iso_session* session, int32_t player);

/* The transport's side. `incoming`: the other side asked for the connection, as all do at a host. */
typedef uint32_t iso_channel;
enum {
  ISO_DATAGRAM, /* may be lost, doubled, late or out of order */
  ISO_RELIABLE  /* arrives whole and in order, or the connection ends */
};
ISO_API iso_status iso_session_connected(iso_session* session, uint32_t peer, uint64_t now, uint8_t incoming);
ISO_API iso_status iso_session_disconnected(iso_session* session, uint32_t peer, uint64_t now);
/* Malformed bytes are counted, and otherwise without effect. */
ISO_API iso_status iso_session_receive(iso_session* session, uint32_t peer, iso_channel channel, const void* bytes,
                                       size_t size, uint64_t now);
typedef struct iso_outgoing {
  uint32_t size;
  uint32_t peer;
  iso_channel channel;
  uint32_t length; /* [bytes] 0: nothing to send, `close` alone */
  uint8_t close;   /* end the connection after it */
  uint8_t reserved1[7];
} iso_outgoing;
ISO_API iso_status iso_outgoing_init_sized(iso_outgoing* out, size_t size);
/* `bytes`: null when there is nothing more; they hold until the next call. */
ISO_API iso_status iso_session_poll_send(iso_session* session, uint64_t now, iso_outgoing* out, const uint8_t** bytes);
/* Connect to this machine, as iso_session_config.address of its session says; null: none. */
ISO_API iso_status iso_session_poll_connect(iso_session* session, const char** address);
/* [us] until the next frame is due: how long a loop may sleep when the network is silent. */
ISO_API uint64_t iso_session_wait(const iso_session* session, uint64_t now);

/* What players may vote on. */
typedef uint32_t iso_proposal;
enum { ISO_VOTE_PAUSE = 1, ISO_VOTE_UNPAUSE, ISO_VOTE_SPEED, ISO_VOTE_KICK, ISO_VOTE_OTHER };

typedef uint32_t iso_event_kind;
enum {
  ISO_EVENT_NONE,          /* there is none */
  ISO_EVENT_STARTED,       /* frame: the first */
  ISO_EVENT_JOINED,        /* player plays from frame on: reported when that is final, alike on all peers */
  ISO_EVENT_LEFT,          /* player is gone from frame on: as well */
  ISO_EVENT_WAITING_FOR,   /* players hold the match up, their inputs are missing; none: the host is silent */
  ISO_EVENT_RESUMED,       /* it goes on */
  ISO_EVENT_REPLACED,      /* guesses count for player's inputs, too late for the deadline: once a second at most */
  ISO_EVENT_TOO_FAR,       /* no delay covers player's line under the deadline: it watches */
  ISO_EVENT_PAUSED,        /* from frame on, by player; ISO_NO_PLAYER: by the host's game */
  ISO_EVENT_UNPAUSED,      /* likewise */
  ISO_EVENT_SPEED_CHANGED, /* likewise: speed */
  ISO_EVENT_ASKS_PAUSE,    /* host: player asks for it, and players_set_tempo is 0: iso_session_pause or not */
  ISO_EVENT_ASKS_UNPAUSE,  /* likewise */
  ISO_EVENT_ASKS_SPEED,    /* likewise: speed */
  ISO_EVENT_VOTE,          /* the ballot as it stands now, when it is opened, and when somebody has voted */
  ISO_EVENT_VOTE_PASSED,   /* likewise */
  ISO_EVENT_VOTE_FAILED,   /* likewise; also when the host that counted is gone */
  ISO_EVENT_SLOWED_BY,     /* all step as slowly as player's machine can */
  ISO_EVENT_FULL_SPEED,    /* no longer */
  ISO_EVENT_REFUSED,       /* key: what differs, or why not; the host reports whom it refused */
  ISO_EVENT_LOST_HOST,     /* nothing was heard of it for too long, or the connection ended */
  ISO_EVENT_SEEKS_HOST,    /* likewise, but the match goes on at another */
  ISO_EVENT_NEW_HOST,      /* frame: where it goes on; player: the first of the host's */
  ISO_EVENT_DEPOSED,       /* host: the others went on without us, or have gone: we seek their host */
  ISO_EVENT_DESYNC,        /* player's states differ from ours after state agreed and at the latest in state frame */
  ISO_EVENT_OUTVOTED,      /* player's states are wrong, as of state frame: most machines have others */
  ISO_EVENT_UNDECIDED,     /* machines differ in state frame, and no majority says who is wrong */
  ISO_EVENT_REPAIRED,      /* player has a state of the host's again */
  ISO_EVENT_BAD_SNAPSHOT,  /* the state that arrived has another hash, was refused, or the host has none */
  ISO_EVENT_MISUSE,        /* requests of the last turn were not carried out */
  ISO_EVENT_UNHASHED       /* sync test: the game takes another byte `ours` of state frame, and its hash stays */
};
typedef struct iso_session_event {
  uint32_t size;
  iso_event_kind kind;
  uint32_t player; /* ISO_NO_PLAYER: none, or the host's machine */
  int32_t frame;
  int32_t agreed; /* [frame] */
  uint32_t players;
  uint32_t speed; /* [1/8 of the match's rate] */
  uint32_t vote;  /* its number in the match; 0: none */
  iso_proposal proposal;
  uint32_t subject;
  uint32_t proposer;
  uint32_t voters;       /* players */
  uint32_t yes;          /* players */
  uint32_t no;           /* players */
  uint64_t ours;         /* hash chains; outvoted: player's */
  uint64_t theirs;       /* and the majority's */
  char key[40];          /* refused: what differs */
  char theirs_text[136]; /* there, or in the file */
  char ours_text[136];   /* here */
} iso_session_event;
ISO_API iso_status iso_session_event_init_sized(iso_session_event* out, size_t size);
/* The session keeps the last 128: stats.events_lost. */
ISO_API iso_status iso_session_poll_event(iso_session* session, iso_session_event* out);

typedef uint32_t iso_phase;
enum {
  ISO_WAITING,       /* for the others, or for the host */
  ISO_JOINING,       /* a snapshot arrives, or the frames since */
  ISO_PLAYING,       /* a player of ours is in the match; replay, sync test: running */
  ISO_WATCHING,      /* as a spectator, or cut out of the match and on the way back */
  ISO_SEEKING,       /* the host is gone, and another machine follows it */
  ISO_LOST,          /* the host is gone: connect again */
  ISO_PHASE_REFUSED, /* the host will not have us: the event says why */
  ISO_OVER           /* a replay has ended */
};
ISO_API iso_phase iso_session_phase(const iso_session* session);
/* Says who we are after a crash: iso_session_config.token. 0: not seated yet. */
ISO_API uint64_t iso_session_token(const iso_session* session);
/* the first of this machine; -1: none yet */
ISO_API int32_t iso_session_local_player(const iso_session* session);
/* all of them */
ISO_API uint32_t iso_session_local_players(const iso_session* session);
/* the next frame to be stepped */
ISO_API int32_t iso_session_current(const iso_session* session);
/* states up to this one are final */
ISO_API int32_t iso_session_confirmed(const iso_session* session);
/* What a player did in a frame that is at most `kept` frames old; ISO_DISCONNECTED for who was absent. */
ISO_API iso_status iso_session_input(const iso_session* session, int32_t frame, int32_t player, iso_input* out);
/* [bytes] Of the snapshot under way: on a client the one that it waits for, on a host the one that `peer` is sent. */
ISO_API iso_status iso_session_snapshot_progress(const iso_session* session, uint32_t peer, uint32_t* arrived,
                                                 uint32_t* size);

typedef struct iso_session_stats {
  uint32_t size;
  int32_t delay;          /* [frames] an input waits now */
  uint64_t steps;         /* carried out, again or for the first time */
  uint64_t rollbacks[65]; /* by depth [frames] */
  uint64_t waits;         /* times that a due frame had to wait */
  uint64_t datagrams_out;
  uint64_t datagrams_in;
  uint64_t bytes_out; /* datagrams' and messages' own, without UDP/IP */
  uint64_t bytes_in;
  uint64_t refused;     /* datagrams and messages that were malformed or not for us */
  uint64_t flooded;     /* dropped unread */
  uint64_t put_out;     /* host: peers that did not acknowledge what they were sent */
  uint64_t events_lost; /* the caller did not take them in time */
  uint64_t round_trip;  /* [us] client: to the host; host: the slowest client's */
  int32_t peers;        /* connected */
  int32_t machines;     /* that decide without a host, with migration */
  uint32_t jitter;      /* [us] client: of the host's datagrams */
  uint32_t loss;        /* [permille] likewise */
  int32_t stretch;      /* [1/256 period] by which frames are longer than they should be */
  uint32_t reserved1;
} iso_session_stats;
ISO_API iso_status iso_session_stats_init_sized(iso_session_stats* out, size_t size);
ISO_API iso_status iso_session_get_stats(const iso_session* session, iso_session_stats* out);
typedef struct iso_player_stats {
  uint32_t size;
  int32_t early;       /* [frames] by which the latest input of a second came before it was needed; negative: late */
  uint32_t replaced;   /* inputs that came after the deadline */
  uint32_t waited;     /* [us] that the others waited for it within the last minute */
  uint32_t round_trip; /* [us] to the host and back */
  uint32_t jitter;     /* [us] */
  uint32_t loss;       /* [permille] of its datagrams that the host did not get */
  uint32_t reserved1;
} iso_player_stats;
ISO_API iso_status iso_player_stats_init_sized(iso_player_stats* out, size_t size);
ISO_API iso_status iso_session_get_player_stats(const iso_session* session, int32_t player, iso_player_stats* out);

/* Decisions. Those of who may not make them, or not now, are refused. */
/* host: begins although seats are empty */
ISO_API iso_status iso_session_start(iso_session* session, uint64_t now);
/* client: takes a state of the host's, keeps its seat */
ISO_API iso_status iso_session_resync(iso_session* session);
/* With migration, where the match stands for lack of a majority, or its host is lost: goes on with those who are here, at
   this machine. Whoever calls knows that the others play nowhere else: nothing else keeps two matches from becoming of
   one. ISO_REFUSED: the match goes on without, or this machine has no part in it. */
ISO_API iso_status iso_session_go_on(iso_session* session, uint64_t now);
/* The match stands still, or goes on, on all machines before the same frame. A client's is a request to the host. */
ISO_API iso_status iso_session_pause(iso_session* session);
ISO_API iso_status iso_session_unpause(iso_session* session);
ISO_API iso_status iso_session_set_speed(iso_session* session, int32_t eighths);
/* `player`, one of ours, asks all who play. `subject`: speed [1/8], whom to kick, or what the game likes. */
ISO_API iso_status iso_session_propose(iso_session* session, int32_t player, iso_proposal proposal, uint32_t subject);
/* In the vote of the last event; the last word counts. */
ISO_API iso_status iso_session_vote(iso_session* session, int32_t player, uint8_t yes);

/* Host with asks_admission: who waits for an answer, each once; id 0: none. */
typedef struct iso_applicant {
  uint32_t size;
  uint32_t peer;
  uint64_t id;
  uint8_t spectator;
  uint8_t reserved1[3];
  int32_t seat;             /* that it asks for, with those after it; -1: any */
  int32_t seats;            /* how many */
  int32_t player;           /* whose token it has shown; -1: nobody's */
  uint32_t credential_size; /* [bytes] */
  uint32_t reserved2;
  uint8_t credential[256];
} iso_applicant;
ISO_API iso_status iso_applicant_init_sized(iso_applicant* out, size_t size);
ISO_API iso_status iso_session_poll_applicant(iso_session* session, iso_applicant* out);
ISO_API iso_status iso_session_admit(iso_session* session, uint64_t applicant);
/* Reasons are printable ASCII of 1 to 128 characters, for people. */
ISO_API iso_status iso_session_refuse(iso_session* session, uint64_t applicant, const char* reason);
ISO_API iso_status iso_session_kick(iso_session* session, int32_t player, const char* reason);
ISO_API iso_status iso_session_kick_peer(iso_session* session, uint32_t peer, const char* reason);
ISO_API int32_t iso_session_peer_of(const iso_session* session,
                                    int32_t player); /* host: who has the seat; -1: nobody */

/* Host: the match in its newest final state, for iso_session_create of another process. In: room, out: need. */
ISO_API iso_status iso_session_save_match(iso_session* session, void* bytes, size_t* size);

/* Recordings of the confirmed frames, from the next frame stepped on. One of each kind at a time. */
typedef uint32_t iso_recording;
enum {
  ISO_RECORD_MATCH, /* inputs and hashes: some 50 kB a minute, for ISO_REPLAY by who has the game */
  ISO_RECORD_WORLD  /* the world's commands and hashes: `isostep verify` plays it without the game. Of a game with a
                       world, to which nothing else records meanwhile */
};
/* `scene`: of ISO_RECORD_WORLD the name in the file, 1 to 128 characters; null: config.name. */
ISO_API iso_status iso_session_record(iso_session* session, iso_recording kind, const char* scene);
/* All final frames so far, and the bytes of the file that are new since the last such call, until the session's next
   call: for who appends them to a file, so that a crash costs nothing of them. */
ISO_API iso_status iso_session_flush_recording(iso_session* session, iso_recording kind, const void** bytes,
                                               size_t* size);
/* Ends it with the last confirmed frame; the file. Asked with too little room it stays for the next call. It has ended
   before where the session restarted from another state. */
ISO_API iso_status iso_session_recorded(iso_session* session, iso_recording kind, void* bytes, size_t* size);

/* A network in virtual time, for tests and testbeds: endpoint 0 is the host, clients follow. */
typedef struct iso_network iso_network;
ISO_API iso_status iso_network_create(uint64_t seed, iso_network** out);
ISO_API iso_status iso_network_destroy(iso_network* network);
/* `profile`: "wifi", "latency=80,jitter=20,loss=5", "lan,down.loss=2.5": [ms], [%]; up. and down. are to and from the
   host. Names: loopback lan wifi mobile severe burst duplicate reorder asymmetric constant blackout blackout-up
   blackout-down. */
ISO_API iso_status iso_network_add_client(iso_network* network, const char* profile, uint32_t* endpoint);
ISO_API iso_status iso_network_set_profile(iso_network* network, uint32_t client, const char* profile);
/* Refused while the last connection between them is not over. */
ISO_API iso_status iso_network_connect(iso_network* network, uint32_t from, uint32_t to);
/* both sides hear it now */
ISO_API iso_status iso_network_cut(iso_network* network, uint32_t client);
ISO_API iso_status iso_network_set_silent(iso_network* network, uint32_t endpoint,
                                          uint8_t silent);                                      /* as a pulled cable */
/* sides do not meet */
ISO_API iso_status iso_network_set_side(iso_network* network, uint32_t endpoint, int32_t side);
/* Lets everything due until then happen; refused where that is in the past. */
ISO_API iso_status iso_network_advance_to(iso_network* network, uint64_t now);
/* What has arrived goes into the session; what it has to say goes out. Addresses of a migration are endpoints: "2". */
ISO_API iso_status iso_network_deliver(iso_network* network, uint32_t endpoint, iso_session* session, uint64_t now);
ISO_API iso_status iso_network_dispatch(iso_network* network, uint32_t endpoint, iso_session* session, uint64_t now);

/* End of sessions */

/* _init, of everything that begins with its size: iso_q32_settings_init(&settings). Inline, so that the size is that of
   the header that the caller was compiled with: a later library writes no more, an earlier one no less. */
#define ISO_C_INLINE_INIT(name) \
  static inline iso_status iso_##name##_init(iso_##name* out) { return iso_##name##_init_sized(out, sizeof *out); }
#define ISO_C_INLINE_COMMON_INIT(P, name) ISO_C_INLINE_INIT(name)
#define ISO_C_INLINE_FAMILY_INIT(P, name) ISO_C_INLINE_INIT(P##_##name)
#define ISO_C_INLINE_INITS(P, N, U) ISO_C_FOR_EACH_SIZED(ISO_C_INLINE_FAMILY_INIT, P)
ISO_C_FOR_EACH_COMMON_SIZED(ISO_C_INLINE_COMMON_INIT, )
ISO_C_SCALARS(ISO_C_INLINE_INITS)
ISO_C_INLINE_INIT(session_config)
ISO_C_INLINE_INIT(game)
ISO_C_INLINE_INIT(request)
ISO_C_INLINE_INIT(outgoing)
ISO_C_INLINE_INIT(session_event)
ISO_C_INLINE_INIT(session_stats)
ISO_C_INLINE_INIT(player_stats)
ISO_C_INLINE_INIT(applicant)

#ifdef __cplusplus
}
#endif

#endif
