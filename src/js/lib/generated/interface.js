// The structs and enumerations of the C interface, as layout.js reads them.
// Written by generate.mjs from src/c: change nothing here.
// SPDX-License-Identifier: MIT

export const interfaceSchema = {
  abi: 0,
  shapes: ["sphere", "box", "capsule", "half_space", "cylinder", "cone"],
  joints: ["ball", "constant_velocity", "fixed", "universal", "angular", "hinge", "slider", "cylindrical", "planar", "rod", "rope", "wheel_joint", "motor_joint", "six_axis"],
  records: ["force_zone", "attractor", "body_spring", "thruster", "buoyancy", "explosion", "water", "drag", "aero_surface", "damping_zone", "material_pair", "breakable", "character", "vehicle", "wheel", "surface_velocity", "ghost", "one_way", "hit_report", "contact_report", "joint_load", "coupling", "axis_drive", "kind_ghost", "kind_response", "sensor_mount"],
  inputs: ["breakable", "character", "vehicle"],
  states: ["character", "vehicle", "wheel", "joint_load"],
  flags: {
    bodyFlags: {sensor: 1, allowSleep: 2, collide: 4, bullet: 16, disabled: 32, lockX: 256, lockY: 512, lockZ: 1024, lockAngularX: 2048, lockAngularY: 4096, lockAngularZ: 8192, allLocks: 16128},
    jointFlags: {collideConnected: 1, limit: 2, motor: 4, spring: 8, cone: 16, lockX: 256, lockY: 512, lockZ: 1024, lockSwingX: 2048, lockSwingY: 4096, lockTwist: 8192, lockPoint: 1792, lockSwing: 6144, lockTurns: 14336},
    zoneEffects: {acceleration: 1, wind: 2, gravity: 4, water: 8}
  },
  enums: {
    scalar: {f32: 0, f64: 1, q16: 2, q32: 3},
    body_type: {static: 0, kinematic: 1, dynamic: 2},
    shape_type: {sphere: 0, box: 1, capsule: 2, half_space: 3, hull: 4, mesh: 5, height_field: 6, cylinder: 7, cone: 8},
    joint_type: {ball: 0, hinge: 1, fixed: 2, distance: 3, slider: 4, cylindrical: 5, planar: 6, universal: 7, constant_velocity: 8, angular: 9, six_axis: 10},
    joint_axis: {x: 0, y: 1, z: 2, swing_x: 3, swing_y: 4, twist: 5},
    solver: {soft_step: 0, pgs: 1, worst_first: 2, direct: 3},
    projection: {nonlinear: 0, linear: 1, relaxed: 2, velocity_based: 3},
    broad_phase: {box_tree: 0, sphere_tree: 1, bsp_tree: 2, quad_tree: 3, oct_tree: 4, grid: 5, multi_grid: 6, sweep_and_prune: 7},
    simd: {best: 0, scalar: 1, sse2: 2, avx2: 3, avx512: 4, neon: 5, wasm: 6},
    zone_shape: {everywhere: 0, sphere: 1, box: 2},
    break_pattern: {eight_boxes: 0, grain: 1, radial: 2, voronoi: 3},
    footing: {airborne: 0, floor: 1, steep: 2},
    start_inside: {report: 0, ignore: 1},
    hit_per: {body: 0, child: 1, triangle: 2},
    blob_home: {carried: 0, asset: 1},
    fault: {none: 0, stale_id: 1, not_finite: 2, out_of_range: 3, bad_shape: 4, bad_mass: 5, bad_argument: 6, shape_in_use: 7, not_dynamic: 8, null_id: 9, foreign_id: 10, bad_snapshot: 11, called_in_step: 12},
    verify_outcome: {verified: 0, diverged: 1, incompatible: 2, truncated: 3, corrupt: 4, stopped: 5},
    verify_where: {start: 0, frame: 1, keyframe: 2},
    stage: {find_pairs: 0, apply_forces: 1, update_manifolds: 2, colour_constraints: 3, prepare: 4, solve_substeps: 5, store_impulses: 6, finalise_bodies: 7, continuous: 8, update_sensors: 9, emit_events: 10, update_sleep: 11, move_characters: 12},
    session_mode: {lockstep: 0, rollback: 1, spectator: 2, sync_test: 3, replay: 4},
    predictor: {repeat_last: 0, predict_neutral: 1},
    genre: {fighting: 0, brawler: 1, racing: 2, strategy: 3, sandbox: 4},
    input_status: {confirmed: 0, predicted: 1, disconnected: 2},
    request_kind: {nothing: 0, step: 1, rolled_back: 2, restarted: 3, confirmed: 4},
    channel: {datagram: 0, reliable: 1},
    proposal: {pause: 1, unpause: 2, speed: 3, kick: 4, other: 5},
    event_kind: {none: 0, started: 1, joined: 2, left: 3, waiting_for: 4, resumed: 5, replaced: 6, too_far: 7, paused: 8, unpaused: 9, speed_changed: 10, asks_pause: 11, asks_unpause: 12, asks_speed: 13, vote: 14, vote_passed: 15, vote_failed: 16, slowed_by: 17, full_speed: 18, refused: 19, lost_host: 20, seeks_host: 21, new_host: 22, deposed: 23, desync: 24, outvoted: 25, undecided: 26, repaired: 27, bad_snapshot: 28, misuse: 29, unhashed: 30},
    phase: {waiting: 0, joining: 1, playing: 2, watching: 3, seeking: 4, lost: 5, refused: 6, over: 7},
    recording: {match: 0, world: 1}
  },
  structs: {
    filter: {size: 12, sized: false, init: "filter_init", fields: [
      ["category", "u32", 0],
      ["mask", "u32", 4],
      ["group", "u32", 8]
    ]},
    query_filter: {size: 56, sized: false, init: "query_filter_init", fields: [
      ["mask", "u32", 0],
      ["sensors", "bool", 4],
      ["backFaces", "bool", 5],
      ["ignore", "id", 8],
      ["group", "u32", 16],
      ["startInside", "start_inside", 20],
      ["per", "hit_per", 24],
      ["ignoreAll", "list", 32, undefined, 28],
      ["ignoreKinds", "list", 48, undefined, 40]
    ]},
    overlap_hit: {size: 24, sized: false, fields: [
      ["body", "id", 0],
      ["child", "u32", 8],
      ["triangle", "u32", 12],
      ["material", "u8", 16]
    ]},
    body_pair: {size: 16, sized: false, fields: [
      ["a", "id", 0],
      ["b", "id", 8]
    ]},
    sensor_event: {size: 16, sized: false, fields: [
      ["sensor", "id", 0],
      ["other", "id", 8]
    ]},
    render_pose: {size: 40, sized: false, fields: [
      ["body", "id", 0],
      ["position", "f32", 8, 3],
      ["orientation", "f32", 20, 4]
    ]},
    step_report: {size: 40, sized: true, init: "step_report_init_sized", fields: [
      ["clampedSpeed", "u32", 8],
      ["clampedForce", "u32", 12],
      ["clampedPosition", "u32", 16],
      ["stopped", "u32", 20],
      ["crowded", "u32", 24],
      ["cutCompounds", "u32", 28],
      ["unsolved", "u32", 32]
    ]},
    world_counts: {size: 40, sized: true, init: "world_counts_init_sized", fields: [
      ["bodies", "u32", 8],
      ["staticBodies", "u32", 12],
      ["awake", "u32", 16],
      ["asleep", "u32", 20],
      ["contacts", "u32", 24],
      ["points", "u32", 28],
      ["joints", "u32", 32],
      ["shapes", "u32", 36]
    ]},
    break_report: {size: 24, sized: true, init: "break_report_init_sized", fields: [
      ["broken", "u32", 8],
      ["pieces", "u32", 12],
      ["whole", "u32", 16],
      ["expired", "u32", 20]
    ]},
    fault_report: {size: 40, sized: true, init: "fault_report_init_sized", fields: [
      ["status", "i32", 8],
      ["command", "pointer", 16],
      ["field", "pointer", 24],
      ["expected", "pointer", 32]
    ]},
    height_patch: {size: 40, sized: true, init: "height_patch_init_sized", fields: [
      ["column", "u32", 8],
      ["row", "u32", 12],
      ["columns", "u32", 16],
      ["rows", "u32", 20],
      ["heights", "pointer", 24],
      ["materials", "pointer", 32]
    ]},
    height_grid: {size: 32, sized: true, init: "height_grid_init_sized", fields: [
      ["exponent", "u32", 8],
      ["heightShift", "u32", 12],
      ["columns", "u32", 16],
      ["rows", "u32", 20],
      ["pitch", "u32", 24]
    ]},
    height_sheet: {size: 32, sized: true, init: "height_sheet_init_sized", fields: [
      ["columns", "u32", 8],
      ["rows", "u32", 12],
      ["pitch", "f64", 16],
      ["heights", "pointer", 24]
    ]},
    triangles: {size: 32, sized: true, init: "triangles_init_sized", fields: [
      ["pointCount", "u32", 8],
      ["triangleCount", "u32", 12],
      ["points", "pointer", 16],
      ["vertices", "pointer", 24]
    ]},
    surface_materials: {size: 32, sized: true, init: "surface_materials_init_sized", fields: [
      ["count", "u32", 8],
      ["tableCount", "u32", 12],
      ["numbers", "pointer", 16],
      ["table", "pointer", 24]
    ]},
    replay_info: {size: 296, sized: true, init: "replay_info_init_sized", fields: [
      ["behaviour", "u64", 8],
      ["frames", "u64", 16],
      ["startHash", "u64", 24],
      ["firstFrame", "u64", 32],
      ["keyframes", "u64", 40],
      ["file", "verify_outcome", 48],
      ["hz", "u32", 52],
      ["substeps", "u32", 56],
      ["hasState", "bool", 60],
      ["scalar", "text", 61, 32],
      ["scene", "text", 93, 136],
      ["world", "text", 229, 32],
      ["engine", "text", 261, 32]
    ]},
    replay_result: {size: 744, sized: true, init: "replay_result_init_sized", fields: [
      ["outcome", "verify_outcome", 8],
      ["where", "verify_where", 12],
      ["frames", "u64", 16],
      ["expected", "u64", 24],
      ["actual", "u64", 32],
      ["offset", "u64", 40],
      ["scalar", "text", 48, 32],
      ["scene", "text", 80, 136],
      ["lanes", "text", 216, 16],
      ["text", "text", 232, 512]
    ]},
    selfcheck_result: {size: 544, sized: true, init: "selfcheck_result_init_sized", fields: [
      ["sound", "bool", 8],
      ["engine", "u32", 12],
      ["recordings", "u32", 16],
      ["failed", "u32", 20],
      ["frames", "u64", 24],
      ["text", "text", 32, 512]
    ]},
    session_config: {size: 1280, sized: true, init: "session_config_init_sized", fields: [
      ["mode", "session_mode", 4],
      ["host", "bool", 8],
      ["relays", "bool", 9],
      ["repair", "bool", 10],
      ["asksAdmission", "bool", 11],
      ["votes", "bool", 12],
      ["playersSetTempo", "bool", 13],
      ["players", "i32", 16],
      ["localPlayers", "i32", 20],
      ["hz", "i32", 24],
      ["window", "i32", 28],
      ["delay", "i32", 32],
      ["leastDelay", "i32", 36],
      ["mostDelay", "i32", 40],
      ["deadline", "i32", 44],
      ["silence", "u64", 48],
      ["patience", "u64", 56],
      ["exclusion", "u64", 64],
      ["kept", "i32", 72],
      ["history", "i32", 76],
      ["mostReplayed", "i32", 80],
      ["maxPeers", "i32", 84],
      ["maxStrangers", "i32", 88],
      ["snapshotCap", "u32", 92],
      ["mostPackets", "u32", 96],
      ["broadcastDelay", "i32", 100],
      ["seed", "u64", 104],
      ["migration", "u64", 112],
      ["reservation", "u64", 120],
      ["token", "u64", 128],
      ["seat", "i32", 136],
      ["credential", "bytes", 144, 256, 140],
      ["address", "text", 400, 72],
      ["name", "text", 472, 136],
      ["inputText", "text", 608, 136],
      ["inputSchema", "u64", 744],
      ["inputLeast", "u32", 752],
      ["inputCap", "u32", 756],
      ["predictor", "predictor", 760],
      ["neutral", "bytes", 768, 512, 764]
    ]},
    input: {size: 516, sized: false, fields: [
      ["size", "u16", 0],
      ["status", "u8", 2],
      ["bytes", "u8", 4, 512]
    ]},
    game: {size: 68, sized: true, init: "game_init_sized", fields: [
      ["world", "word", 8],
      ["block", "word", 12],
      ["blockSize", "word", 16],
      ["user", "word", 20],
      ["step", "word", 24],
      ["rolledBack", "word", 28],
      ["restarted", "word", 32],
      ["confirmed", "word", 36],
      ["save", "word", 40],
      ["load", "word", 44],
      ["hash", "word", 48],
      ["write", "word", 52],
      ["read", "word", 56],
      ["predict", "word", 60],
      ["valid", "word", 64]
    ]},
    request: {size: 24, sized: true, init: "request_init_sized", fields: [
      ["kind", "request_kind", 4],
      ["frame", "i32", 8],
      ["hash", "u64", 16]
    ]},
    outgoing: {size: 24, sized: true, init: "outgoing_init_sized", fields: [
      ["peer", "u32", 4],
      ["channel", "channel", 8],
      ["length", "u32", 12],
      ["close", "bool", 16]
    ]},
    session_event: {size: 384, sized: true, init: "session_event_init_sized", fields: [
      ["kind", "event_kind", 4],
      ["player", "u32", 8],
      ["frame", "i32", 12],
      ["agreed", "i32", 16],
      ["players", "u32", 20],
      ["speed", "u32", 24],
      ["vote", "u32", 28],
      ["proposal", "proposal", 32],
      ["subject", "u32", 36],
      ["proposer", "u32", 40],
      ["voters", "u32", 44],
      ["yes", "u32", 48],
      ["no", "u32", 52],
      ["ours", "u64", 56],
      ["theirs", "u64", 64],
      ["key", "text", 72, 40],
      ["theirsText", "text", 112, 136],
      ["oursText", "text", 248, 136]
    ]},
    session_stats: {size: 640, sized: true, init: "session_stats_init_sized", fields: [
      ["delay", "i32", 4],
      ["steps", "u64", 8],
      ["rollbacks", "u64", 16, 65],
      ["waits", "u64", 536],
      ["datagramsOut", "u64", 544],
      ["datagramsIn", "u64", 552],
      ["bytesOut", "u64", 560],
      ["bytesIn", "u64", 568],
      ["refused", "u64", 576],
      ["flooded", "u64", 584],
      ["putOut", "u64", 592],
      ["eventsLost", "u64", 600],
      ["roundTrip", "u64", 608],
      ["peers", "i32", 616],
      ["machines", "i32", 620],
      ["jitter", "u32", 624],
      ["loss", "u32", 628],
      ["stretch", "i32", 632]
    ]},
    player_stats: {size: 32, sized: true, init: "player_stats_init_sized", fields: [
      ["early", "i32", 4],
      ["replaced", "u32", 8],
      ["waited", "u32", 12],
      ["roundTrip", "u32", 16],
      ["jitter", "u32", 20],
      ["loss", "u32", 24]
    ]},
    applicant: {size: 296, sized: true, init: "applicant_init_sized", fields: [
      ["peer", "u32", 4],
      ["id", "u64", 8],
      ["spectator", "bool", 16],
      ["seat", "i32", 20],
      ["seats", "i32", 24],
      ["player", "i32", 28],
      ["credential", "bytes", 40, 256, 32]
    ]},
    vec3: {size: [12, 24], sized: false, fields: [
      ["x", "number", 0],
      ["y", "number", [4, 8]],
      ["z", "number", [8, 16]]
    ]},
    unit_vec3: {size: [12, 24], sized: false, fields: [
      ["x", "unit", 0],
      ["y", "unit", [4, 8]],
      ["z", "unit", [8, 16]]
    ]},
    quat: {size: [16, 32], sized: false, fields: [
      ["x", "unit", 0],
      ["y", "unit", [4, 8]],
      ["z", "unit", [8, 16]],
      ["w", "unit", [12, 24]]
    ]},
    pose: {size: [28, 56], sized: false, fields: [
      ["position", "vec3", 0],
      ["orientation", "quat", [12, 24]]
    ]},
    mat3: {size: [36, 72], sized: false, fields: [
      ["rows", "vec3", 0, 3]
    ]},
    aabb: {size: [24, 48], sized: false, fields: [
      ["low", "vec3", 0],
      ["high", "vec3", [12, 24]]
    ]},
    material: {size: [52, 96], sized: false, init: "P_material_init", fields: [
      ["friction", "number", 0],
      ["restitution", "number", [4, 8]],
      ["rollingResistance", "number", [8, 16]],
      ["spinResistance", "number", [12, 24]],
      ["surfaceVelocity", "vec3", [16, 32]],
      ["staticFriction", "number", [28, 56]],
      ["anisotropy", "vec3", [32, 64]],
      ["kind", "u32", [44, 88]]
    ]},
    primitive: {size: [40, 72], sized: false, fields: [
      ["type", "shape_type", 0],
      ["blob", "u32", 4],
      ["half", "vec3", 8],
      ["radius", "number", [20, 32]],
      ["normal", "unit_vec3", [24, 40]],
      ["offset", "number", [36, 64]]
    ]},
    child: {size: [68, 128], sized: false, fields: [
      ["primitive", "primitive", 0],
      ["pose", "pose", [40, 72]]
    ]},
    joint_range: {size: [8, 16], sized: false, fields: [
      ["lower", "number", 0],
      ["upper", "number", [4, 8]]
    ]},
    joint_motor: {size: [8, 16], sized: false, fields: [
      ["speed", "number", 0],
      ["force", "number", [4, 8]]
    ]},
    joint_spring: {size: [12, 24], sized: false, fields: [
      ["frequency", "number", 0],
      ["damping", "number", [4, 8]],
      ["target", "number", [8, 16]]
    ]},
    joint_servo: {size: [20, 40], sized: false, fields: [
      ["frequency", "number", 0],
      ["damping", "number", [4, 8]],
      ["target", "number", [8, 16]],
      ["force", "number", [12, 24]],
      ["mass", "number", [16, 32]]
    ]},
    drive: {size: [56, 96], sized: false, fields: [
      ["joint", "id", 0],
      ["axis", "joint_axis", 8],
      ["limited", "bool", 12],
      ["motor", "bool", 13],
      ["lower", "number", 16],
      ["upper", "number", [20, 24]],
      ["motorSpeed", "number", [24, 32]],
      ["springTarget", "number", [28, 40]],
      ["springFrequency", "number", [32, 48]],
      ["springDamping", "number", [36, 56]],
      ["force", "number", [40, 64]],
      ["springMass", "number", [44, 72]],
      ["limitFrequency", "number", [48, 80]],
      ["limitDamping", "number", [52, 88]]
    ]},
    ragdoll_bone: {size: [96, 176], sized: false, init: "P_ragdoll_bone_init", fields: [
      ["parent", "i32", 0],
      ["shape", "id", 8],
      ["pose", "pose", 16],
      ["mass", "number", [44, 72]],
      ["joint", "pose", [48, 80]],
      ["hinge", "bool", [76, 136]],
      ["swingX", "number", [80, 144]],
      ["swingY", "number", [84, 152]],
      ["lower", "number", [88, 160]],
      ["upper", "number", [92, 168]]
    ]},
    ray_hit: {size: [48, 80], sized: false, fields: [
      ["body", "id", 0],
      ["child", "u32", 8],
      ["triangle", "u32", 12],
      ["point", "vec3", 16],
      ["normal", "unit_vec3", [28, 40]],
      ["fraction", "number", [40, 64]],
      ["material", "u8", [44, 72]],
      ["inside", "bool", [45, 73]]
    ]},
    shape_hit: {size: [48, 80], sized: false, fields: [
      ["body", "id", 0],
      ["child", "u32", 8],
      ["triangle", "u32", 12],
      ["point", "vec3", 16],
      ["normal", "unit_vec3", [28, 40]],
      ["fraction", "unit", [40, 64]],
      ["material", "u8", [44, 72]],
      ["inside", "bool", [45, 73]]
    ]},
    closest_body: {size: [40, 64], sized: false, fields: [
      ["body", "id", 0],
      ["point", "vec3", 8],
      ["normal", "unit_vec3", [20, 32]],
      ["distance", "number", [32, 56]]
    ]},
    contact_begin: {size: [32, 48], sized: false, fields: [
      ["a", "id", 0],
      ["b", "id", 8],
      ["impulse", "number", 16],
      ["normal", "unit_vec3", [20, 24]]
    ]},
    broke: {size: [40, 64], sized: false, fields: [
      ["body", "id", 0],
      ["impulse", "number", 8],
      ["point", "vec3", [12, 16]],
      ["direction", "unit_vec3", [24, 40]]
    ]},
    joint_broke: {size: [40, 48], sized: false, fields: [
      ["joint", "id", 0],
      ["a", "id", 8],
      ["b", "id", 16],
      ["userData", "u64", 24],
      ["force", "number", 32],
      ["torque", "number", [36, 40]]
    ]},
    contact_hit: {size: [48, 72], sized: false, fields: [
      ["a", "id", 0],
      ["b", "id", 8],
      ["point", "vec3", 16],
      ["normal", "unit_vec3", [28, 40]],
      ["speed", "number", [40, 64]]
    ]},
    contact_point: {size: [56, 88], sized: false, fields: [
      ["a", "id", 0],
      ["b", "id", 8],
      ["childA", "u32", 16],
      ["childB", "u32", 20],
      ["point", "vec3", 24],
      ["normal", "unit_vec3", [36, 48]],
      ["separation", "number", [48, 72]],
      ["impulse", "number", [52, 80]]
    ]},
    settings: {size: [56, 72], sized: true, init: "P_settings_init_sized", fields: [
      ["hz", "i32", 8],
      ["substeps", "i32", 12],
      ["gravity", "vec3", 16],
      ["allowSleep", "bool", [28, 40]],
      ["solver", "solver", [32, 44]],
      ["idSpace", "u32", [36, 48]],
      ["mostPairs", "i32", [40, 52]],
      ["projection", "projection", [44, 56]],
      ["restitutionThreshold", "number", [48, 64]]
    ]},
    body_definition: {size: [192, 320], sized: true, init: "P_body_definition_init_sized", fields: [
      ["type", "body_type", 8],
      ["shape", "id", 16],
      ["position", "vec3", 24],
      ["orientation", "quat", [36, 48]],
      ["velocity", "vec3", [52, 80]],
      ["angularVelocity", "vec3", [64, 104]],
      ["density", "number", [76, 128]],
      ["mass", "number", [80, 136]],
      ["inertia", "vec3", [84, 144]],
      ["material", "material", [96, 168]],
      ["filter", "filter", [148, 264]],
      ["userData", "u64", [160, 280]],
      ["gravityScale", "number", [168, 288]],
      ["linearDamping", "number", [172, 296]],
      ["angularDamping", "number", [176, 304]],
      ["locks", "u32", [180, 312]],
      ["sensor", "bool", [184, 316]],
      ["allowSleep", "bool", [185, 317]],
      ["collide", "bool", [186, 318]],
      ["bullet", "bool", [187, 319]]
    ]},
    body_mass: {size: [32, 48], sized: true, init: "P_body_mass_init_sized", fields: [
      ["density", "number", 8],
      ["mass", "number", [12, 16]],
      ["inertia", "vec3", [16, 24]]
    ]},
    body_state: {size: [88, 152], sized: true, init: "P_body_state_init_sized", fields: [
      ["pose", "pose", 8],
      ["centre", "vec3", [36, 64]],
      ["velocity", "vec3", [48, 88]],
      ["angularVelocity", "vec3", [60, 112]],
      ["userData", "u64", [72, 136]],
      ["type", "body_type", [80, 144]],
      ["awake", "bool", [84, 148]],
      ["enabled", "bool", [85, 149]]
    ]},
    body_properties: {size: [120, 192], sized: true, init: "P_body_properties_init_sized", fields: [
      ["type", "body_type", 8],
      ["flags", "u32", 12],
      ["filter", "filter", 16],
      ["userData", "u64", 32],
      ["mass", "number", 40],
      ["localCentre", "vec3", [44, 48]],
      ["material", "material", [56, 72]],
      ["gravityScale", "number", [108, 168]],
      ["linearDamping", "number", [112, 176]],
      ["angularDamping", "number", [116, 184]]
    ]},
    sphere: {size: 16, sized: true, init: "P_sphere_init_sized", fields: [
      ["radius", "number", 8]
    ]},
    box: {size: [24, 32], sized: true, init: "P_box_init_sized", fields: [
      ["halfExtents", "vec3", 8]
    ]},
    capsule: {size: [16, 24], sized: true, init: "P_capsule_init_sized", fields: [
      ["radius", "number", 8],
      ["halfHeight", "number", [12, 16]]
    ]},
    half_space: {size: [24, 40], sized: true, init: "P_half_space_init_sized", fields: [
      ["normal", "unit_vec3", 8],
      ["offset", "number", [20, 32]]
    ]},
    cylinder: {size: [16, 24], sized: true, init: "P_cylinder_init_sized", fields: [
      ["radius", "number", 8],
      ["halfHeight", "number", [12, 16]]
    ]},
    cone: {size: [16, 24], sized: true, init: "P_cone_init_sized", fields: [
      ["radius", "number", 8],
      ["halfHeight", "number", [12, 16]]
    ]},
    hull: {size: 16, sized: true, init: "P_hull_init_sized", fields: [
      ["radius", "number", 8]
    ]},
    joint_properties: {size: [128, 216], sized: true, init: "P_joint_properties_init_sized", fields: [
      ["type", "joint_type", 8],
      ["flags", "u32", 12],
      ["bodyA", "u32", 16],
      ["bodyB", "u32", 20],
      ["generationA", "u32", 24],
      ["generationB", "u32", 28],
      ["userData", "u64", 32],
      ["frameA", "pose", 40],
      ["frameB", "pose", [68, 96]],
      ["lower", "number", [96, 152]],
      ["upper", "number", [100, 160]],
      ["cone", "number", [104, 168]],
      ["motorSpeed", "number", [108, 176]],
      ["motorTorque", "number", [112, 184]],
      ["springTarget", "number", [116, 192]],
      ["springFrequency", "number", [120, 200]],
      ["springDamping", "number", [124, 208]]
    ]},
    ball: {size: [80, 128], sized: true, init: "P_ball_init_sized", fields: [
      ["a", "id", 8],
      ["b", "id", 16],
      ["frame", "pose", 24],
      ["cone", "optional number", [56, 88], undefined, [52, 80]],
      ["twist", "optional joint_range", [64, 104], undefined, [60, 96]],
      ["collide", "bool", [72, 120]]
    ]},
    constant_velocity: {size: [80, 128], sized: true, init: "P_constant_velocity_init_sized", fields: [
      ["a", "id", 8],
      ["b", "id", 16],
      ["frame", "pose", 24],
      ["cone", "optional number", [56, 88], undefined, [52, 80]],
      ["twist", "optional joint_range", [64, 104], undefined, [60, 96]],
      ["collide", "bool", [72, 120]]
    ]},
    fixed: {size: [56, 88], sized: true, init: "P_fixed_init_sized", fields: [
      ["a", "id", 8],
      ["b", "id", 16],
      ["frame", "pose", 24],
      ["collide", "bool", [52, 80]]
    ]},
    universal: {size: [56, 88], sized: true, init: "P_universal_init_sized", fields: [
      ["a", "id", 8],
      ["b", "id", 16],
      ["frame", "pose", 24],
      ["collide", "bool", [52, 80]]
    ]},
    angular: {size: [56, 88], sized: true, init: "P_angular_init_sized", fields: [
      ["a", "id", 8],
      ["b", "id", 16],
      ["frame", "pose", 24],
      ["collide", "bool", [52, 80]]
    ]},
    hinge: {size: [96, 168], sized: true, init: "P_hinge_init_sized", fields: [
      ["a", "id", 8],
      ["b", "id", 16],
      ["frame", "pose", 24],
      ["limit", "optional joint_range", [56, 88], undefined, [52, 80]],
      ["motor", "optional joint_motor", [68, 112], undefined, [64, 104]],
      ["spring", "optional joint_spring", [80, 136], undefined, [76, 128]],
      ["collide", "bool", [92, 160]]
    ]},
    slider: {size: [96, 168], sized: true, init: "P_slider_init_sized", fields: [
      ["a", "id", 8],
      ["b", "id", 16],
      ["frame", "pose", 24],
      ["limit", "optional joint_range", [56, 88], undefined, [52, 80]],
      ["motor", "optional joint_motor", [68, 112], undefined, [64, 104]],
      ["spring", "optional joint_spring", [80, 136], undefined, [76, 128]],
      ["collide", "bool", [92, 160]]
    ]},
    cylindrical: {size: [96, 168], sized: true, init: "P_cylindrical_init_sized", fields: [
      ["a", "id", 8],
      ["b", "id", 16],
      ["frame", "pose", 24],
      ["limit", "optional joint_range", [56, 88], undefined, [52, 80]],
      ["motor", "optional joint_motor", [68, 112], undefined, [64, 104]],
      ["spring", "optional joint_spring", [80, 136], undefined, [76, 128]],
      ["collide", "bool", [92, 160]]
    ]},
    planar: {size: [96, 168], sized: true, init: "P_planar_init_sized", fields: [
      ["a", "id", 8],
      ["b", "id", 16],
      ["frame", "pose", 24],
      ["limit", "optional joint_range", [56, 88], undefined, [52, 80]],
      ["motor", "optional joint_motor", [68, 112], undefined, [64, 104]],
      ["spring", "optional joint_spring", [80, 136], undefined, [76, 128]],
      ["collide", "bool", [92, 160]]
    ]},
    rod: {size: [72, 120], sized: true, init: "P_rod_init_sized", fields: [
      ["a", "id", 8],
      ["b", "id", 16],
      ["anchorA", "vec3", 24],
      ["anchorB", "vec3", [36, 48]],
      ["length", "number", [48, 72]],
      ["spring", "optional joint_spring", [56, 88], undefined, [52, 80]],
      ["collide", "bool", [68, 112]]
    ]},
    rope: {size: [72, 120], sized: true, init: "P_rope_init_sized", fields: [
      ["a", "id", 8],
      ["b", "id", 16],
      ["anchorA", "vec3", 24],
      ["anchorB", "vec3", [36, 48]],
      ["length", "number", [48, 72]],
      ["spring", "optional joint_spring", [56, 88], undefined, [52, 80]],
      ["collide", "bool", [68, 112]]
    ]},
    wheel_joint: {size: [112, 200], sized: true, init: "P_wheel_joint_init_sized", fields: [
      ["a", "id", 8],
      ["b", "id", 16],
      ["frame", "pose", 24],
      ["suspension", "joint_spring", [52, 80]],
      ["travel", "joint_range", [64, 104]],
      ["steer", "optional joint_servo", [76, 128], undefined, [72, 120]],
      ["drive", "optional joint_motor", [100, 176], undefined, [96, 168]],
      ["collide", "bool", [108, 192]]
    ]},
    motor_joint: {size: [128, 224], sized: true, init: "P_motor_joint_init_sized", fields: [
      ["a", "id", 8],
      ["b", "id", 16],
      ["frameA", "pose", 24],
      ["frameB", "pose", [52, 80]],
      ["place", "joint_servo", [80, 136]],
      ["turn", "joint_servo", [100, 176]],
      ["collide", "bool", [120, 216]]
    ]},
    six_axis: {size: [400, 672], sized: true, init: "P_six_axis_init_sized", fields: [
      ["a", "id", 8],
      ["b", "id", 16],
      ["frame", "pose", 24],
      ["locks", "u32", [52, 80]],
      ["drives", "drive", [56, 88], 6],
      ["driveCount", "u32", [392, 664]],
      ["collide", "bool", [396, 668]]
    ]},
    ragdoll_settings: {size: [104, 184], sized: true, init: "P_ragdoll_settings_init_sized", fields: [
      ["friction", "number", 8],
      ["pose", "joint_servo", [12, 16]],
      ["limitFrequency", "number", [32, 56]],
      ["limitDamping", "number", [36, 64]],
      ["filter", "filter", [40, 72]],
      ["material", "material", [52, 88]]
    ]},
    ray_cast: {size: [88, 112], sized: true, init: "P_ray_cast_init_sized", fields: [
      ["origin", "vec3", 8],
      ["translation", "vec3", [20, 32]],
      ["filter", "query_filter", [32, 56]]
    ]},
    shape_cast: {size: [152, 224], sized: true, init: "P_shape_cast_init_sized", fields: [
      ["shape", "id", 8],
      ["primitive", "primitive", 16],
      ["pose", "pose", [56, 88]],
      ["translation", "vec3", [84, 144]],
      ["filter", "query_filter", [96, 168]]
    ]},
    overlap_query: {size: [144, 200], sized: true, init: "P_overlap_query_init_sized", fields: [
      ["shape", "id", 8],
      ["primitive", "primitive", 16],
      ["pose", "pose", [56, 88]],
      ["filter", "query_filter", [88, 144]]
    ]},
    point_query: {size: [80, 96], sized: true, init: "P_point_query_init_sized", fields: [
      ["point", "vec3", 8],
      ["maxDistance", "number", [20, 32]],
      ["filter", "query_filter", [24, 40]]
    ]},
    box_query: {size: [88, 112], sized: true, init: "P_box_query_init_sized", fields: [
      ["box", "aabb", 8],
      ["filter", "query_filter", [32, 56]]
    ]},
    force_zone: {size: [88, 160], sized: true, init: "P_force_zone_init_sized", fields: [
      ["shape", "zone_shape", 8],
      ["pose", "pose", [12, 16]],
      ["half", "vec3", [40, 72]],
      ["acceleration", "vec3", [52, 96]],
      ["wind", "vec3", [64, 120]],
      ["mask", "u32", [76, 144]],
      ["priority", "i32", [80, 148]],
      ["replaces", "u32", [84, 152]]
    ]},
    attractor: {size: [48, 72], sized: true, init: "P_attractor_init_sized", fields: [
      ["body", "id", 8],
      ["point", "vec3", 16],
      ["strength", "number", [28, 40]],
      ["leastDistance", "number", [32, 48]],
      ["range", "number", [36, 56]],
      ["mask", "u32", [40, 64]]
    ]},
    body_spring: {size: [64, 104], sized: true, init: "P_body_spring_init_sized", fields: [
      ["a", "id", 8],
      ["b", "id", 16],
      ["anchorA", "vec3", 24],
      ["anchorB", "vec3", [36, 48]],
      ["restLength", "number", [48, 72]],
      ["stiffness", "number", [52, 80]],
      ["damping", "number", [56, 88]],
      ["onlyPulls", "bool", [60, 96]]
    ]},
    thruster: {size: [40, 64], sized: true, init: "P_thruster_init_sized", fields: [
      ["body", "id", 8],
      ["point", "vec3", 16],
      ["force", "vec3", [28, 40]]
    ]},
    buoyancy: {size: [48, 72], sized: true, init: "P_buoyancy_init_sized", fields: [
      ["body", "id", 8],
      ["point", "vec3", 16],
      ["maxDepth", "number", [28, 40]],
      ["volume", "number", [32, 48]],
      ["surfaceHeight", "number", [36, 56]],
      ["density", "number", [40, 64]]
    ]},
    explosion: {size: [96, 152], sized: true, init: "P_explosion_init_sized", fields: [
      ["centre", "vec3", 8],
      ["begin", "u64", [24, 32]],
      ["implosionForce", "number", [32, 40]],
      ["implosionLeast", "number", [36, 48]],
      ["implosionMost", "number", [40, 56]],
      ["implosionDuration", "number", [44, 64]],
      ["waveForce", "number", [48, 72]],
      ["waveSpeed", "number", [52, 80]],
      ["waveWidth", "number", [56, 88]],
      ["waveRamp", "number", [60, 96]],
      ["waveDuration", "number", [64, 104]],
      ["chimneyForce", "number", [68, 112]],
      ["chimneyRadius", "number", [72, 120]],
      ["chimneyHeight", "number", [76, 128]],
      ["chimneyDuration", "number", [80, 136]],
      ["isShielded", "bool", [84, 144]],
      ["mask", "u32", [88, 148]]
    ]},
    water: {size: [104, 184], sized: true, init: "P_water_init_sized", fields: [
      ["surfaceHeight", "number", 8],
      ["density", "number", [12, 16]],
      ["middle", "vec3", [16, 24]],
      ["half", "vec3", [28, 48]],
      ["current", "vec3", [40, 72]],
      ["linearDrag", "number", [52, 96]],
      ["quadraticDrag", "number", [56, 104]],
      ["angularDrag", "number", [60, 112]],
      ["waveHeight", "number", [64, 120]],
      ["waveLength", "number", [68, 128]],
      ["wavePeriod", "number", [72, 136]],
      ["waveDirection", "unit_vec3", [76, 144]],
      ["mask", "u32", [88, 168]],
      ["priority", "i32", [92, 172]],
      ["replaces", "bool", [96, 176]]
    ]},
    drag: {size: [32, 40], sized: true, init: "P_drag_init_sized", fields: [
      ["body", "id", 8],
      ["linear", "number", 16],
      ["quadratic", "number", [20, 24]],
      ["angular", "number", [24, 32]]
    ]},
    aero_surface: {size: [160, 304], sized: true, init: "P_aero_surface_init_sized", fields: [
      ["body", "id", 8],
      ["point", "vec3", 16],
      ["orientation", "quat", [28, 40]],
      ["tensor", "mat3", [44, 72]],
      ["low", "mat3", [80, 144]],
      ["high", "mat3", [116, 216]],
      ["control", "number", [152, 288]],
      ["isQuadratic", "bool", [156, 296]],
      ["isUnderWater", "bool", [157, 297]]
    ]},
    damping_zone: {size: [72, 128], sized: true, init: "P_damping_zone_init_sized", fields: [
      ["shape", "zone_shape", 8],
      ["pose", "pose", [12, 16]],
      ["half", "vec3", [40, 72]],
      ["linear", "number", [52, 96]],
      ["angular", "number", [56, 104]],
      ["mask", "u32", [60, 112]],
      ["priority", "i32", [64, 116]],
      ["replaces", "bool", [68, 120]]
    ]},
    material_pair: {size: [40, 56], sized: true, init: "P_material_pair_init_sized", fields: [
      ["kindA", "u32", 8],
      ["kindB", "u32", 12],
      ["friction", "number", 16],
      ["staticFriction", "number", [20, 24]],
      ["restitution", "number", [24, 32]],
      ["rollingResistance", "number", [28, 40]],
      ["spinResistance", "number", [32, 48]]
    ]},
    breakable: {size: [80, 104], sized: true, init: "P_breakable_init_sized", fields: [
      ["body", "id", 8],
      ["breakImpulse", "number", 16],
      ["pattern", "break_pattern", [20, 24]],
      ["mostPieces", "u32", [24, 28]],
      ["depth", "u32", [28, 32]],
      ["grain", "unit_vec3", [32, 40]],
      ["seed", "u64", [48, 64]],
      ["smallMass", "number", [56, 72]],
      ["lifetime", "u32", [60, 80]],
      ["expires", "u64", [64, 88]],
      ["ownsShape", "bool", [72, 96]]
    ]},
    character: {size: [48, 80], sized: true, init: "P_character_init_sized", fields: [
      ["body", "id", 8],
      ["stepHeight", "number", 16],
      ["leastUp", "number", [20, 24]],
      ["skin", "number", [24, 32]],
      ["mass", "number", [28, 40]],
      ["pushForce", "number", [32, 48]],
      ["airAcceleration", "number", [36, 56]],
      ["gravityScale", "number", [40, 64]],
      ["mask", "u32", [44, 72]]
    ]},
    vehicle: {size: [88, 160], sized: true, init: "P_vehicle_init_sized", fields: [
      ["body", "id", 8],
      ["engineTorque", "number", 16],
      ["engineSpeed", "number", [20, 24]],
      ["gears", "number", [24, 32], 8],
      ["finalDrive", "number", [56, 96]],
      ["engineInertia", "number", [60, 104]],
      ["clutchTorque", "number", [64, 112]],
      ["differentialLock", "number", [68, 120]],
      ["brakeTorque", "number", [72, 128]],
      ["handbrakeTorque", "number", [76, 136]],
      ["ackermann", "number", [80, 144]],
      ["trackSteer", "number", [84, 152]]
    ]},
    wheel: {size: [128, 240], sized: true, init: "P_wheel_init_sized", fields: [
      ["body", "id", 8],
      ["hardPoint", "vec3", 16],
      ["suspension", "unit_vec3", [28, 40]],
      ["axleDirection", "unit_vec3", [40, 64]],
      ["freeLength", "number", [52, 88]],
      ["travel", "number", [56, 96]],
      ["stiffness", "number", [60, 104]],
      ["damping", "number", [64, 112]],
      ["radius", "number", [68, 120]],
      ["inertia", "number", [72, 128]],
      ["gripAlong", "number", [76, 136]],
      ["gripAcross", "number", [80, 144]],
      ["peakSlip", "number", [84, 152]],
      ["peakGrip", "number", [88, 160]],
      ["slideSlip", "number", [92, 168]],
      ["slideGrip", "number", [96, 176]],
      ["steerAngle", "number", [100, 184]],
      ["driveShare", "number", [104, 192]],
      ["brakeShare", "number", [108, 200]],
      ["handbrakeShare", "number", [112, 208]],
      ["axle", "u32", [116, 216]],
      ["antiRoll", "number", [120, 224]],
      ["track", "u32", [124, 232]]
    ]},
    surface_velocity: {size: [48, 72], sized: true, init: "P_surface_velocity_init_sized", fields: [
      ["body", "id", 8],
      ["linear", "vec3", 16],
      ["angular", "vec3", [28, 40]],
      ["part", "u32", [40, 64]]
    ]},
    ghost: {size: 24, sized: true, init: "P_ghost_init_sized", fields: [
      ["a", "id", 8],
      ["b", "id", 16]
    ]},
    one_way: {size: [32, 48], sized: true, init: "P_one_way_init_sized", fields: [
      ["body", "id", 8],
      ["axis", "unit_vec3", 16],
      ["leastCosine", "number", [28, 40]]
    ]},
    hit_report: {size: 24, sized: true, init: "P_hit_report_init_sized", fields: [
      ["body", "id", 8],
      ["speed", "number", 16]
    ]},
    contact_report: {size: 16, sized: true, init: "P_contact_report_init_sized", fields: [
      ["body", "id", 8]
    ]},
    joint_load: {size: [24, 32], sized: true, init: "P_joint_load_init_sized", fields: [
      ["joint", "id", 8],
      ["breakForce", "number", 16],
      ["breakTorque", "number", [20, 24]]
    ]},
    coupling: {size: [56, 72], sized: true, init: "P_coupling_init_sized", fields: [
      ["jointA", "id", 8],
      ["jointB", "id", 16],
      ["jointC", "id", 24],
      ["ratioA", "number", 32],
      ["ratioB", "number", [36, 40]],
      ["ratioC", "number", [40, 48]],
      ["lower", "number", [44, 56]],
      ["upper", "number", [48, 64]]
    ]},
    axis_drive: {size: [64, 104], sized: true, init: "P_axis_drive_init_sized", fields: [
      ["joint", "id", 8],
      ["axis", "joint_axis", 16],
      ["limited", "bool", 20],
      ["motor", "bool", 21],
      ["lower", "number", 24],
      ["upper", "number", [28, 32]],
      ["motorSpeed", "number", [32, 40]],
      ["springTarget", "number", [36, 48]],
      ["springFrequency", "number", [40, 56]],
      ["springDamping", "number", [44, 64]],
      ["force", "number", [48, 72]],
      ["springMass", "number", [52, 80]],
      ["limitFrequency", "number", [56, 88]],
      ["limitDamping", "number", [60, 96]]
    ]},
    kind_ghost: {size: 16, sized: true, init: "P_kind_ghost_init_sized", fields: [
      ["kindA", "u32", 8],
      ["kindB", "u32", 12]
    ]},
    kind_response: {size: [40, 56], sized: true, init: "P_kind_response_init_sized", fields: [
      ["kindA", "u32", 8],
      ["kindB", "u32", 12],
      ["inverseMassScaleA", "number", 16],
      ["inverseMassScaleB", "number", [20, 24]],
      ["inverseInertiaScaleA", "number", [24, 32]],
      ["inverseInertiaScaleB", "number", [28, 40]],
      ["maxForce", "number", [32, 48]]
    ]},
    sensor_mount: {size: [56, 80], sized: true, init: "P_sensor_mount_init_sized", fields: [
      ["sensor", "id", 8],
      ["on", "id", 16],
      ["frame", "pose", 24]
    ]},
    breakable_input: {size: [40, 64], sized: true, init: "P_breakable_input_init_sized", fields: [
      ["impulse", "number", 8],
      ["point", "vec3", [12, 16]],
      ["direction", "unit_vec3", [24, 40]]
    ]},
    character_input: {size: [24, 40], sized: true, init: "P_character_input_init_sized", fields: [
      ["move", "vec3", 8],
      ["jump", "number", [20, 32]]
    ]},
    vehicle_input: {size: [32, 56], sized: true, init: "P_vehicle_input_init_sized", fields: [
      ["throttle", "number", 8],
      ["clutch", "number", [12, 16]],
      ["brake", "number", [16, 24]],
      ["handbrake", "number", [20, 32]],
      ["steer", "number", [24, 40]],
      ["gear", "u32", [28, 48]]
    ]},
    character_state: {size: [80, 128], sized: true, init: "P_character_state_init_sized", fields: [
      ["footing", "footing", 8],
      ["ground", "id", 16],
      ["stuck", "u32", 24],
      ["foot", "vec3", [28, 32]],
      ["footAt", "vec3", [40, 56]],
      ["velocity", "vec3", [52, 80]],
      ["normal", "unit_vec3", [64, 104]]
    ]},
    vehicle_state: {size: [16, 24], sized: true, init: "P_vehicle_state_init_sized", fields: [
      ["engineSpin", "number", 8],
      ["clutchLoad", "number", [12, 16]]
    ]},
    wheel_state: {size: [80, 128], sized: true, init: "P_wheel_state_init_sized", fields: [
      ["spin", "number", 8],
      ["angle", "number", [12, 16]],
      ["steered", "number", [16, 24]],
      ["length", "number", [20, 32]],
      ["slip", "number", [24, 40]],
      ["contactBody", "id", [32, 48]],
      ["contactPoint", "vec3", [40, 56]],
      ["contactNormal", "unit_vec3", [52, 80]],
      ["load", "number", [64, 104]],
      ["along", "number", [68, 112]],
      ["across", "number", [72, 120]]
    ]},
    joint_load_state: {size: [16, 24], sized: true, init: "P_joint_load_state_init_sized", fields: [
      ["force", "number", 8],
      ["torque", "number", [12, 16]]
    ]}
  }
};
