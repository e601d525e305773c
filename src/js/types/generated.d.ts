// The structs and enumerations of the C interface as TypeScript's.
// Written by generate.mjs from src/c: change nothing here.
// SPDX-License-Identifier: MIT

export type Vec3<N = number> = [x: N, y: N, z: N];
export type Quat<N = number> = [x: N, y: N, z: N, w: N];

export type ScalarName = 'f32' | 'f64' | 'q16' | 'q32';
export type BodyTypeName = 'static' | 'kinematic' | 'dynamic';
export type ShapeTypeName = 'sphere' | 'box' | 'capsule' | 'half_space' | 'hull' | 'mesh' | 'height_field' | 'cylinder' | 'cone';
export type JointTypeName = 'ball' | 'hinge' | 'fixed' | 'distance' | 'slider' | 'cylindrical' | 'planar' | 'universal' | 'constant_velocity' | 'angular' | 'six_axis';
export type JointAxisName = 'x' | 'y' | 'z' | 'swing_x' | 'swing_y' | 'twist';
export type SolverName = 'soft_step' | 'pgs' | 'worst_first' | 'direct';
export type ProjectionName = 'nonlinear' | 'linear' | 'relaxed' | 'velocity_based';
export type BroadPhaseName = 'box_tree' | 'sphere_tree' | 'bsp_tree' | 'quad_tree' | 'oct_tree' | 'grid' | 'multi_grid' | 'sweep_and_prune';
export type SimdName = 'best' | 'scalar' | 'sse2' | 'avx2' | 'avx512' | 'neon' | 'wasm';
export type ZoneShapeName = 'everywhere' | 'sphere' | 'box';
export type BreakPatternName = 'eight_boxes' | 'grain' | 'radial' | 'voronoi';
export type FootingName = 'airborne' | 'floor' | 'steep';
export type StartInsideName = 'report' | 'ignore';
export type HitPerName = 'body' | 'child' | 'triangle';
export type BlobHomeName = 'carried' | 'asset';
export type FaultName = 'none' | 'stale_id' | 'not_finite' | 'out_of_range' | 'bad_shape' | 'bad_mass' | 'bad_argument' | 'shape_in_use' | 'not_dynamic' | 'null_id' | 'foreign_id' | 'bad_snapshot' | 'called_in_step';
export type VerifyOutcomeName = 'verified' | 'diverged' | 'incompatible' | 'truncated' | 'corrupt' | 'stopped';
export type VerifyWhereName = 'start' | 'frame' | 'keyframe';
export type StageName = 'find_pairs' | 'apply_forces' | 'update_manifolds' | 'colour_constraints' | 'prepare' | 'solve_substeps' | 'store_impulses' | 'finalise_bodies' | 'continuous' | 'update_sensors' | 'emit_events' | 'update_sleep' | 'move_characters';
export type SessionModeName = 'lockstep' | 'rollback' | 'spectator' | 'sync_test' | 'replay';
export type PredictorName = 'repeat_last' | 'predict_neutral';
export type GenreName = 'fighting' | 'brawler' | 'racing' | 'strategy' | 'sandbox';
export type InputStatusName = 'confirmed' | 'predicted' | 'disconnected';
export type RequestKindName = 'nothing' | 'step' | 'rolled_back' | 'restarted' | 'confirmed';
export type ChannelName = 'datagram' | 'reliable';
export type ProposalName = 'pause' | 'unpause' | 'speed' | 'kick' | 'other';
export type EventKindName = 'none' | 'started' | 'joined' | 'left' | 'waiting_for' | 'resumed' | 'replaced' | 'too_far' | 'paused' | 'unpaused' | 'speed_changed' | 'asks_pause' | 'asks_unpause' | 'asks_speed' | 'vote' | 'vote_passed' | 'vote_failed' | 'slowed_by' | 'full_speed' | 'refused' | 'lost_host' | 'seeks_host' | 'new_host' | 'deposed' | 'desync' | 'outvoted' | 'undecided' | 'repaired' | 'bad_snapshot' | 'misuse' | 'unhashed';
export type PhaseName = 'waiting' | 'joining' | 'playing' | 'watching' | 'seeking' | 'lost' | 'refused' | 'over';
export type RecordingName = 'match' | 'world';

export interface BodyFlagsBits {
  readonly sensor: number;
  readonly allowSleep: number;
  readonly collide: number;
  readonly bullet: number;
  readonly disabled: number;
  readonly lockX: number;
  readonly lockY: number;
  readonly lockZ: number;
  readonly lockAngularX: number;
  readonly lockAngularY: number;
  readonly lockAngularZ: number;
  readonly allLocks: number;
}
export interface JointFlagsBits {
  readonly collideConnected: number;
  readonly limit: number;
  readonly motor: number;
  readonly spring: number;
  readonly cone: number;
  readonly lockX: number;
  readonly lockY: number;
  readonly lockZ: number;
  readonly lockSwingX: number;
  readonly lockSwingY: number;
  readonly lockTwist: number;
  readonly lockPoint: number;
  readonly lockSwing: number;
  readonly lockTurns: number;
}
export interface ZoneEffectsBits {
  readonly acceleration: number;
  readonly wind: number;
  readonly gravity: number;
  readonly water: number;
}

export interface Shapes<N = number> {
  sphere: Sphere<N>;
  box: Box<N>;
  capsule: Capsule<N>;
  half_space: HalfSpace<N>;
  cylinder: Cylinder<N>;
  cone: Cone<N>;
}
export interface Joints<N = number> {
  ball: Ball<N>;
  constant_velocity: ConstantVelocity<N>;
  fixed: Fixed<N>;
  universal: Universal<N>;
  angular: Angular<N>;
  hinge: Hinge<N>;
  slider: Slider<N>;
  cylindrical: Cylindrical<N>;
  planar: Planar<N>;
  rod: Rod<N>;
  rope: Rope<N>;
  wheel_joint: WheelJoint<N>;
  motor_joint: MotorJoint<N>;
  six_axis: SixAxis<N>;
}
export interface RecordKinds<N = number> {
  force_zone: ForceZone<N>;
  attractor: Attractor<N>;
  body_spring: BodySpring<N>;
  thruster: Thruster<N>;
  buoyancy: Buoyancy<N>;
  explosion: Explosion<N>;
  water: Water<N>;
  drag: Drag<N>;
  aero_surface: AeroSurface<N>;
  damping_zone: DampingZone<N>;
  material_pair: MaterialPair<N>;
  breakable: Breakable<N>;
  character: Character<N>;
  vehicle: Vehicle<N>;
  wheel: Wheel<N>;
  surface_velocity: SurfaceVelocity<N>;
  ghost: Ghost;
  one_way: OneWay<N>;
  hit_report: HitReport<N>;
  contact_report: ContactReport;
  joint_load: JointLoad<N>;
  coupling: Coupling<N>;
  axis_drive: AxisDrive<N>;
  kind_ghost: KindGhost;
  kind_response: KindResponse<N>;
  sensor_mount: SensorMount<N>;
}
export interface RecordInputs<N = number> {
  breakable: BreakableInput<N>;
  character: CharacterInput<N>;
  vehicle: VehicleInput<N>;
}
export interface RecordStates<N = number> {
  character: CharacterState<N>;
  vehicle: VehicleState<N>;
  wheel: WheelState<N>;
  joint_load: JointLoadState<N>;
}

export interface Filter {
  category: number;
  mask: number;
  group: number;
}

export interface QueryFilter {
  /** categories that are seen */
  mask: number;
  /** sensors are seen too */
  sensors: boolean;
  /** rays and casts hit triangles from behind too */
  backFaces: boolean;
  /** is not seen */
  ignore: bigint;
  /** bodies of this filter.group are not seen; 0: none */
  group: number;
  startInside: StartInsideName;
  /** what a list of hits has one of */
  per: HitPerName;
  /** iso_body: are not seen either */
  ignoreAll: readonly (bigint | number)[];
  /** nor are bodies of these material.kind */
  ignoreKinds: readonly (bigint | number)[];
}

export interface OverlapHit {
  body: bigint;
  /** of the body's shape */
  child: number;
  /** the lowest, of a mesh or height field; else 0 */
  triangle: number;
  /** of the triangle; 0 where there is none */
  material: number;
}

export interface BodyPair {
  a: bigint;
  b: bigint;
}

export interface SensorEvent {
  sensor: bigint;
  other: bigint;
}

export interface RenderPose {
  body: bigint;
  /** [m] of the body's origin */
  position: number[];
  /** x y z w */
  orientation: number[];
}

export interface StepReport {
  /** bodies whose speed was cut to Limits<S>, or whose turn to a radian a sub-step */
  clampedSpeed: number;
  /** bodies whose forces or impulses were cut: they would leave its range at once */
  clampedForce: number;
  /** bodies held at the edge of the world */
  clampedPosition: number;
  /** bodies put back and stopped because a number was not finite */
  stopped: number;
  /** bodies that did not find all their pairs: beyond Settings::most_pairs */
  crowded: number;
  /** pairs of bodies some of whose parts were left out, by the same budget */
  cutCompounds: number;
  /** islands that `direct` or, for each of its passes, `worst_first` left too early */
  unsolved: number;
}

export interface WorldCounts {
  bodies: number;
  staticBodies: number;
  awake: number;
  asleep: number;
  contacts: number;
  points: number;
  joints: number;
  shapes: number;
}

export interface BreakReport {
  /** bodies that pieces took the place of */
  broken: number;
  /** of them all */
  pieces: number;
  /** marked bodies that could not be broken: too small, or of a shape that does not break */
  whole: number;
  /** bodies whose time was over */
  expired: number;
}

export interface HeightGrid {
  /** a step is 2^-exponent m */
  exponent: number;
  /** a unit of height is 2^height_shift steps */
  heightShift: number;
  columns: number;
  rows: number;
  /** [steps] between columns, and between rows */
  pitch: number;
}

export interface ReplayInfo {
  /** behaviour version that it was recorded with */
  behaviour: bigint;
  /** in whole blocks */
  frames: bigint;
  /** of the state before the first */
  startHash: bigint;
  /** the number that the game gives to its first */
  firstFrame: bigint;
  keyframes: bigint;
  /** what the file alone says: verified, incompatible, truncated, corrupt */
  file: VerifyOutcomeName;
  /** [1/s] steps */
  hz: number;
  substeps: number;
  /** the start is there */
  hasState: boolean;
  /** "q32.32"; empty where the file does not tell */
  scalar: string;
  scene: string;
  /** its kind; empty: rigid bodies */
  world: string;
  /** the version that recorded it */
  engine: string;
}

export interface ReplayResult {
  /** its number is the exit status of `isostep verify` */
  outcome: VerifyOutcomeName;
  /** of what diverged */
  where: VerifyWhereName;
  /** compared; else the frame that diverged, or the first that is missing or not played */
  frames: bigint;
  /** diverged: the replay's hash */
  expected: bigint;
  /** diverged: the hash here */
  actual: bigint;
  /** [bytes] truncated, corrupt: the place in the file */
  offset: bigint;
  scalar: string;
  scene: string;
  /** that stepped it; empty: nothing did */
  lanes: string;
  /** the outcome as a sentence */
  text: string;
}

export interface SelfcheckResult {
  /** every scalar with every set of lanes has frames that agree, and none that does not */
  sound: boolean;
  /** deviations of the library's arithmetic, 0 on a sound machine */
  engine: number;
  /** replayed */
  recordings: number;
  /** of these */
  failed: number;
  /** whose hashes were computed again and agreed */
  frames: bigint;
  /** one line */
  text: string;
}

export interface SessionConfig {
  mode: SessionModeName;
  /** others connect to us; the host fixes what was played */
  host: boolean;
  /** spectator: it serves up to max_peers further ones, who connect to it as to a host */
  relays: boolean;
  /** who is outvoted takes the host's state again by itself */
  repair: boolean;
  /** host: its game decides whom it lets in: iso_session_poll_applicant */
  asksAdmission: boolean;
  /** host: who plays may propose a vote */
  votes: boolean;
  /** host: who plays may pause and set the speed; else the host's game is asked, by events */
  playersSetTempo: boolean;
  players: number;
  /** host: how many of the first play here, 0: dedicated; client: for how many seats it asks */
  localPlayers: number;
  /** [1/s] */
  hz: number;
  /** [frames] rollback: stepped on guesses at most; sync test: rolled back */
  window: number;
  /** [frames] an input waits at first; adapts between the next two */
  delay: number;
  /** [frames] */
  leastDelay: number;
  /** [frames] */
  mostDelay: number;
  /** [frames] host: an input that is late by so many is replaced by the guess; 0: none */
  deadline: number;
  /** [us] without a word from a peer until it counts as lost */
  silence: bigint;
  /** [us] that one player may make the others wait within a minute; then it is left out */
  patience: bigint;
  /** [us] for so long */
  exclusion: bigint;
  /** states kept, more than window, delay and latency; iso_game.save has slots below this */
  kept: number;
  /** frames of inputs kept: how long a snapshot may take to reach a late joiner */
  history: number;
  /** [frames] whose state is at most so old steps them all; older ones are sent a snapshot */
  mostReplayed: number;
  /** whom the host serves: the players, and as many spectators as they leave room for */
  maxPeers: number;
  /** host: connections beside those; peers are numbered below the sum of both */
  maxStrangers: number;
  /** [bytes] of a snapshot that a client accepts */
  snapshotCap: number;
  /** [1/s] datagrams, and messages, accepted of one peer */
  mostPackets: number;
  /** [frames] relay: it and all whom it serves see the match so late */
  broadcastDelay: number;
  /** host: 64 random bits that no other match has, and a secret: tokens come of it. 0 is refused */
  seed: bigint;
  /** [us] without a word from the host until the clients go on without it; 0: never */
  migration: bigint;
  /** [us] host: a seat that was played on is kept so long for its player's token */
  reservation: bigint;
  /** client: what iso_session_token gave a former process of this player; 0: a new player */
  token: bigint;
  /** client: this seat, and those after it for further players of ours, or none; -1: any */
  seat: number;
  /** client: for the host's game */
  credential: Uint8Array;
  /** where the others' transports reach ours, at most 64 characters: iso_session_poll_connect */
  address: string;
  /** what all peers must have alike: the game and its version, 1 to 128 characters of ASCII */
  name: string;
  /** likewise: names the fields of an input, at most 128 characters */
  inputText: string;
  /** 0: hash of input_text, sizes and neutral; else this, as of a C++ InputCodec */
  inputSchema: bigint;
  /** [bytes] an input has, 0 to input_cap */
  inputLeast: number;
  /** [bytes] and at most, 1 to INPUT_CAP */
  inputCap: number;
  /** iso_game.predict replaces it */
  predictor: PredictorName;
  /** what is played for who is not there */
  neutral: Uint8Array;
}

export interface SessionEvent {
  kind: EventKindName;
  /** NO_PLAYER: none, or the host's machine */
  player: number;
  frame: number;
  /** [frame] */
  agreed: number;
  players: number;
  /** [1/8 of the match's rate] */
  speed: number;
  /** its number in the match; 0: none */
  vote: number;
  proposal: ProposalName;
  subject: number;
  proposer: number;
  /** players */
  voters: number;
  /** players */
  yes: number;
  /** players */
  no: number;
  /** hash chains; outvoted: player's */
  ours: bigint;
  /** and the majority's */
  theirs: bigint;
  /** refused: what differs */
  key: string;
  /** there, or in the file */
  theirsText: string;
  /** here */
  oursText: string;
}

export interface SessionStats {
  /** [frames] an input waits now */
  delay: number;
  /** carried out, again or for the first time */
  steps: bigint;
  /** by depth [frames] */
  rollbacks: bigint[];
  /** times that a due frame had to wait */
  waits: bigint;
  datagramsOut: bigint;
  datagramsIn: bigint;
  /** datagrams' and messages' own, without UDP/IP */
  bytesOut: bigint;
  bytesIn: bigint;
  /** datagrams and messages that were malformed or not for us */
  refused: bigint;
  /** dropped unread */
  flooded: bigint;
  /** host: peers that did not acknowledge what they were sent */
  putOut: bigint;
  /** the caller did not take them in time */
  eventsLost: bigint;
  /** [us] client: to the host; host: the slowest client's */
  roundTrip: bigint;
  /** connected */
  peers: number;
  /** that decide without a host, with migration */
  machines: number;
  /** [us] client: of the host's datagrams */
  jitter: number;
  /** [permille] likewise */
  loss: number;
  /** [1/256 period] by which frames are longer than they should be */
  stretch: number;
}

export interface PlayerStats {
  /** [frames] by which the latest input of a second came before it was needed; negative: late */
  early: number;
  /** inputs that came after the deadline */
  replaced: number;
  /** [us] that the others waited for it within the last minute */
  waited: number;
  /** [us] to the host and back */
  roundTrip: number;
  /** [us] */
  jitter: number;
  /** [permille] of its datagrams that the host did not get */
  loss: number;
}

export interface Applicant {
  peer: number;
  id: bigint;
  spectator: boolean;
  /** that it asks for, with those after it; -1: any */
  seat: number;
  /** how many */
  seats: number;
  /** whose token it has shown; -1: nobody's */
  player: number;
  credential: Uint8Array;
}

export interface Pose<N = number> {
  position: Vec3<N>;
  orientation: Quat<N>;
}

export interface Mat3<N = number> {
  rows: Vec3<N>[];
}

export interface Aabb<N = number> {
  /** [m], world frame; low <= high */
  low: Vec3<N>;
  /** [m], world frame; low <= high */
  high: Vec3<N>;
}

export interface Material<N = number> {
  /** [1] Coulomb, of what slides: the dynamic coefficient */
  friction: N;
  /** [1] 0..1, of what meets at Settings::restitution_threshold or more */
  restitution: N;
  /** [m] lever arm of the normal force that resists rolling */
  rollingResistance: N;
  /** [m] Radius of the least patch: friction resists spinning about a contact's normal as if it acted so far from the middle of its points, or as far as these lie. It slows balls of 1 m and 10 cm in radius by 0.1 and 12 rad/s^2. */
  spinResistance: N;
  /** [m/s] world, a conveyor belt's */
  surfaceVelocity: Vec3<N>;
  /** [1] of what does not slide; below friction: the same as friction */
  staticFriction: N;
  /** [1] 1/64..1: the part of friction that is left along the body's own x, y and z axes. Between the axes the force at its limit ends on an ellipsoid with these radii, so that runners {1/16, 1, 1} along x hold across. */
  anisotropy: Vec3<N>;
  /** of material, for the table of pairs; 0: none */
  kind: number;
}

export interface Primitive<N = number> {
  type: ShapeTypeName;
  /** 1 + the place of its blob, for shapes that have one; else 0 */
  blob: number;
  /** [m] half extents of the core; of a cylinder or cone its half height is y */
  half: Vec3<N>;
  /** [m] added around the core, which then holds the whole shape; of a cylinder or cone its own */
  radius: N;
  /** [1] half-space only */
  normal: Vec3<N>;
  /** [m] half-space only */
  offset: N;
}

export interface Child<N = number> {
  primitive: Primitive<N>;
  pose: Pose<N>;
}

export interface JointRange<N = number> {
  lower: N;
  upper: N;
}

export interface JointMotor<N = number> {
  /** [m/s] or [rad/s] */
  speed: N;
  /** [N] or [N m] at most */
  force: N;
}

export interface JointSpring<N = number> {
  /** [Hz] */
  frequency: N;
  /** [1] 1 = critical */
  damping: N;
  /** [m] or [rad] */
  target: N;
}

export interface JointServo<N = number> {
  /** [Hz] */
  frequency: N;
  /** [1] 1 = critical */
  damping: N;
  /** [m] or [rad] */
  target: N;
  /** [N] or [N m] at most; 0: any */
  force: N;
  /** [kg] or [kg m^2] that it is made for: AxisDrive::spring_mass */
  mass: N;
}

export interface Drive<N = number> {
  joint: bigint;
  axis: JointAxisName;
  /** lower..upper holds */
  limited: boolean;
  motor: boolean;
  /** [m] or [rad] in (-pi, pi] */
  lower: N;
  upper: N;
  /** [m/s] or [rad/s] of b against a; 0: the motor is a brake, or friction */
  motorSpeed: N;
  /** [m] or [rad] */
  springTarget: N;
  /** [Hz] up to half the sub-step rate; 0: no spring */
  springFrequency: N;
  /** [1] ratio, 1 = critical */
  springDamping: N;
  /** [N] or [N m] most that the motor gives; without a motor the spring, 0: any */
  force: N;
  /** [kg] or [kg m^2] that springs and soft limits are made for; 0: what they feel */
  springMass: N;
  /** [Hz] of limits that yield, up to half the sub-step rate; 0: hard ones */
  limitFrequency: N;
  /** [1] ratio, 1 = critical */
  limitDamping: N;
}

export interface RagdollBone<N = number> {
  /** index of an earlier bone; -1: the root */
  parent: number;
  /** of the world */
  shape: bigint;
  /** of the body's origin, world, at rest */
  pose: Pose<N>;
  /** [kg] 0: by the shape's volume at 1 kg/m^3, which is light as air */
  mass: N;
  /** to the parent, world; z: the bone's length, or a hinge's axis */
  joint: Pose<N>;
  /** turns about z alone: knees, elbows */
  hinge: boolean;
  /** [rad] half axes of the ellipse in which z stays; of no hinge */
  swingX: N;
  swingY: N;
  /** [rad] of the twist, or of the hinge's angle */
  lower: N;
  upper: N;
}

export interface RayHit<N = number> {
  /** null: nothing was hit */
  body: bigint;
  /** of the body's shape */
  child: number;
  /** of a mesh or height field; else 0 */
  triangle: number;
  /** [m] of the surface, world */
  point: Vec3<N>;
  /** [1] of the surface, against the ray or the shape that is cast */
  normal: Vec3<N>;
  /** [1] of the translation */
  fraction: N;
  /** of the triangle; 0 where there is none */
  material: number;
  /** from the start: the normal is the way back of a ray, the shortest way out of a shape */
  inside: boolean;
}

export interface ShapeHit<N = number> {
  /** null: nothing was hit */
  body: bigint;
  /** of the body's shape */
  child: number;
  /** of a mesh or height field; else 0 */
  triangle: number;
  /** [m] of the surface, world */
  point: Vec3<N>;
  /** [1] of the surface, against the ray or the shape that is cast */
  normal: Vec3<N>;
  /** [1] of the translation */
  fraction: N;
  /** of the triangle; 0 where there is none */
  material: number;
  /** from the start: the normal is the way back of a ray, the shortest way out of a shape */
  inside: boolean;
}

export interface ClosestBody<N = number> {
  body: bigint;
  /** [m] on its surface */
  point: Vec3<N>;
  /** [1] outward */
  normal: Vec3<N>;
  /** [m] negative: inside */
  distance: N;
}

export interface ContactBegin<N = number> {
  a: bigint;
  b: bigint;
  /** [kg m/s] that all points together gave over the step along their normals; held at the format's end */
  impulse: N;
  /** [1] from a to b, of the first parts in contact */
  normal: Vec3<N>;
}

export interface Broke<N = number> {
  body: bigint;
  /** [kg m/s] as ContactBegin has it */
  impulse: N;
  /** [m] */
  point: Vec3<N>;
  /** [1] of the blow, into the body */
  direction: Vec3<N>;
}

export interface JointBroke<N = number> {
  joint: bigint;
  /** null: the world */
  a: bigint;
  /** null: the world */
  b: bigint;
  userData: bigint;
  /** [N] as JointLoad has them */
  force: N;
  /** [N m] */
  torque: N;
}

export interface ContactHit<N = number> {
  a: bigint;
  b: bigint;
  /** [m] where they closed fastest, where b has it as the step ends */
  point: Vec3<N>;
  /** [1] from a to b */
  normal: Vec3<N>;
  /** [m/s] of approach along the normal, as the step began */
  speed: N;
}

export interface ContactPoint<N = number> {
  a: bigint;
  b: bigint;
  /** parts of their shapes; of what touches a mesh or field, its triangles are counted */
  childA: number;
  /** parts of their shapes; of what touches a mesh or field, its triangles are counted */
  childB: number;
  /** [m] where b has it as the step ends */
  point: Vec3<N>;
  /** [1] from a to b */
  normal: Vec3<N>;
  /** [m] as the step began; negative: overlap */
  separation: N;
  /** [kg m/s] that it gave over the step along the normal; held at the format's end */
  impulse: N;
}

export interface Settings<N = number> {
  /** [1/s] steps, 10..1000 */
  hz: number;
  /** per step, 1..64, hz * substeps <= kMaxRate; of pgs: passes */
  substeps: number;
  /** [m/s^2] */
  gravity: Vec3<N>;
  allowSleep: boolean;
  solver: SolverName;
  /** 0..255, in every id: worlds of one game with spaces of their own refuse each other's */
  idSpace: number;
  /** [1] kLeastPairs..kMostPairs: pairs of bodies whose boxes meet that a step looks at. Each takes up to 2 kB and some microseconds; a heap of equal bodies has eight a body, so the default is met by 65 000 of them awake at once, more than a core steps in real time. Beyond it a step leaves out pairs, those last that hold bodies up, and reports StepReport::crowded (crowd.hpp). Twice as many pairs of compounds' parts are collided, StepReport::cut_compounds. */
  mostPairs: number;
  /** of worst_first; other solvers take any and use none */
  projection: ProjectionName;
  /** [m/s] 0..Limits::speed(): what meets more slowly does not bounce. Rest is a rain of small bounces without it; of what nothing presses together all bounces above a sixteenth of it. */
  restitutionThreshold: N;
}

export interface BodyDefinition<N = number> {
  type: BodyTypeName;
  shape: bigint;
  /** [m] of the body's origin, world */
  position: Vec3<N>;
  orientation: Quat<N>;
  /** [m/s] of the centre of mass */
  velocity: Vec3<N>;
  /** [rad/s] world */
  angularVelocity: Vec3<N>;
  /** [kg/m^3] where mass is 0; water has 1000 */
  density: N;
  /** [kg] 0: from density */
  mass: N;
  /** [kg m^2] principal, body axes; all 0: from the shape */
  inertia: Vec3<N>;
  material: Material<N>;
  filter: Filter;
  userData: bigint;
  /** [1] of the world's gravity */
  gravityScale: N;
  /** [1/s] */
  linearDamping: N;
  /** [1/s] */
  angularDamping: N;
  /** body_flag::kLockX ... */
  locks: number;
  /** tells what it overlaps, and touches nothing */
  sensor: boolean;
  allowSleep: boolean;
  /** false: no contacts, no events */
  collide: boolean;
  /** moving bodies stop it too, at any speed; two bullets may pass through each other */
  bullet: boolean;
}

export interface BodyMass<N = number> {
  /** [kg/m^3] where mass is 0; water has 1000 */
  density: N;
  /** [kg] 0: from density */
  mass: N;
  /** [kg m^2] principal, body axes; all 0: from the shape */
  inertia: Vec3<N>;
}

export interface BodyState<N = number> {
  /** [m] of the body's origin, world */
  pose: Pose<N>;
  /** [m] centre of mass, world */
  centre: Vec3<N>;
  /** [m/s] of the centre of mass */
  velocity: Vec3<N>;
  /** [rad/s] world */
  angularVelocity: Vec3<N>;
  userData: bigint;
  type: BodyTypeName;
  awake: boolean;
  enabled: boolean;
}

export interface BodyProperties<N = number> {
  type: BodyTypeName;
  /** ... */
  flags: number;
  filter: Filter;
  userData: bigint;
  /** [kg] */
  mass: N;
  /** [m] centre of mass, body frame */
  localCentre: Vec3<N>;
  material: Material<N>;
  /** [1] */
  gravityScale: N;
  /** [1/s] */
  linearDamping: N;
  /** [1/s] */
  angularDamping: N;
}

export interface Sphere<N = number> {
  /** [m] */
  radius: N;
}

export interface Box<N = number> {
  /** [m] */
  halfExtents: Vec3<N>;
}

export interface Capsule<N = number> {
  /** [m] */
  radius: N;
  /** [m] of the cylinder alone */
  halfHeight: N;
}

export interface HalfSpace<N = number> {
  /** [1] */
  normal: Vec3<N>;
  /** [m] */
  offset: N;
}

export interface Cylinder<N = number> {
  /** [m] */
  radius: N;
  /** [m] */
  halfHeight: N;
}

export interface Cone<N = number> {
  /** [m] of the base */
  radius: N;
  /** [m] */
  halfHeight: N;
}

export interface Hull<N = number> {
  /** [m] around the core */
  radius: N;
}

export interface JointProperties<N = number> {
  type: JointTypeName;
  /** joint_flag */
  flags: number;
  /** slots */
  bodyA: number;
  bodyB: number;
  /** of the bodies' ids: checked when the joint is made */
  generationA: number;
  generationB: number;
  userData: bigint;
  /** from the centre of mass, body axes; for the world its own frame */
  frameA: Pose<N>;
  frameB: Pose<N>;
  /** [rad] or [m]: the kind's JointMeasure */
  lower: N;
  upper: N;
  /** [rad] largest angle between the z axes */
  cone: N;
  /** [rad/s] or [m/s] of b against a */
  motorSpeed: N;
  /** [N m] or [N] most that the motor gives; less where in one sub-step it would turn the bodies, were they free, beyond Limits<S>::surface_speed() */
  motorTorque: N;
  /** [rad] or [m], as lower */
  springTarget: N;
  /** [Hz] up to half the sub-step rate; a spring's swing lasts up to 0.25 rad a sub-step */
  springFrequency: N;
  /** [1] ratio, 1 = critical */
  springDamping: N;
}

export interface Ball<N = number> {
  a: bigint;
  b: bigint;
  frame: Pose<N>;
  /** [rad] most between the z axes */
  cone: N | null;
  /** of a ball joint */
  twist: JointRange<N> | null;
  collide: boolean;
}

export interface ConstantVelocity<N = number> {
  a: bigint;
  b: bigint;
  frame: Pose<N>;
  /** [rad] most between the z axes */
  cone: N | null;
  /** of a ball joint */
  twist: JointRange<N> | null;
  collide: boolean;
}

export interface Fixed<N = number> {
  a: bigint;
  b: bigint;
  frame: Pose<N>;
  /** a and b have contacts with each other */
  collide: boolean;
}

export interface Universal<N = number> {
  a: bigint;
  b: bigint;
  frame: Pose<N>;
  /** a and b have contacts with each other */
  collide: boolean;
}

export interface Angular<N = number> {
  a: bigint;
  b: bigint;
  frame: Pose<N>;
  /** a and b have contacts with each other */
  collide: boolean;
}

export interface Hinge<N = number> {
  a: bigint;
  b: bigint;
  frame: Pose<N>;
  limit: JointRange<N> | null;
  motor: JointMotor<N> | null;
  spring: JointSpring<N> | null;
  collide: boolean;
}

export interface Slider<N = number> {
  a: bigint;
  b: bigint;
  frame: Pose<N>;
  limit: JointRange<N> | null;
  motor: JointMotor<N> | null;
  spring: JointSpring<N> | null;
  collide: boolean;
}

export interface Cylindrical<N = number> {
  a: bigint;
  b: bigint;
  frame: Pose<N>;
  limit: JointRange<N> | null;
  motor: JointMotor<N> | null;
  spring: JointSpring<N> | null;
  collide: boolean;
}

export interface Planar<N = number> {
  a: bigint;
  b: bigint;
  frame: Pose<N>;
  limit: JointRange<N> | null;
  motor: JointMotor<N> | null;
  spring: JointSpring<N> | null;
  collide: boolean;
}

export interface Rod<N = number> {
  a: bigint;
  b: bigint;
  /** [m] world */
  anchorA: Vec3<N>;
  anchorB: Vec3<N>;
  /** [m] */
  length: N;
  /** its target is `length` */
  spring: JointSpring<N> | null;
  collide: boolean;
}

export interface Rope<N = number> {
  a: bigint;
  b: bigint;
  /** [m] world */
  anchorA: Vec3<N>;
  anchorB: Vec3<N>;
  /** [m] */
  length: N;
  /** its target is `length` */
  spring: JointSpring<N> | null;
  collide: boolean;
}

export interface WheelJoint<N = number> {
  a: bigint;
  b: bigint;
  frame: Pose<N>;
  suspension: JointSpring<N>;
  /** [m] along y */
  travel: JointRange<N>;
  /** [rad] about y; without it the wheel does not steer */
  steer: JointServo<N> | null;
  /** of the spin about z; a speed of 0 brakes */
  drive: JointMotor<N> | null;
  collide: boolean;
}

export interface MotorJoint<N = number> {
  a: bigint;
  b: bigint;
  frameA: Pose<N>;
  frameB: Pose<N>;
  place: JointServo<N>;
  turn: JointServo<N>;
  collide: boolean;
}

export interface SixAxis<N = number> {
  a: bigint;
  b: bigint;
  frame: Pose<N>;
  /** joint_flag::kLock..., and kCone */
  locks: number;
  drives: Drive<N>[];
  driveCount: number;
  collide: boolean;
}

export interface RagdollSettings<N = number> {
  /** [N m] each axis resists; 0 where servos hold the pose */
  friction: N;
  /** holds the rest pose where its `force` [N m] is above 0; its target is 0 */
  pose: JointServo<N>;
  /** [Hz] of limits that yield, as in AxisDrive; 0: hard ones */
  limitFrequency: N;
  /** [1] ratio, 1 = critical */
  limitDamping: N;
  /** of all bodies. Bones that a joint ties have no contacts with each other, and bones that overlap at rest none until they are apart */
  filter: Filter;
  material: Material<N>;
}

export interface RayCast<N = number> {
  /** [m] world */
  origin: Vec3<N>;
  /** [m] */
  translation: Vec3<N>;
  filter: QueryFilter;
}

export interface ShapeCast<N = number> {
  /** of the world, of a single convex part; null: `primitive` */
  shape: bigint;
  /** without a blob */
  primitive: Primitive<N>;
  /** [m] of the shape's frame at the start, world */
  pose: Pose<N>;
  /** [m] */
  translation: Vec3<N>;
  filter: QueryFilter;
}

export interface OverlapQuery<N = number> {
  /** of the world, of a single convex part; null: `primitive` */
  shape: bigint;
  /** without a blob */
  primitive: Primitive<N>;
  /** [m] of the shape's frame, world */
  pose: Pose<N>;
  filter: QueryFilter;
}

export interface PointQuery<N = number> {
  /** [m] world */
  point: Vec3<N>;
  /** [m] */
  maxDistance: N;
  filter: QueryFilter;
}

export interface BoxQuery<N = number> {
  /** [m] world */
  box: Aabb<N>;
  filter: QueryFilter;
}

export interface ForceZone<N = number> {
  shape: ZoneShapeName;
  /** of a sphere the position alone */
  pose: Pose<N>;
  /** [m] of a box; of a sphere x is the radius */
  half: Vec3<N>;
  /** [m/s^2] world */
  acceleration: Vec3<N>;
  /** [m/s] world */
  wind: Vec3<N>;
  /** categories: Filter. The wind blows for all */
  mask: number;
  priority: number;
  /** zone_effect: what it hides, of zones of lower priority; 0: it adds to them */
  replaces: number;
}

export interface Attractor<N = number> {
  /** whose centre of mass attracts; null: the point */
  body: bigint;
  /** [m] world */
  point: Vec3<N>;
  /** [m^3/s^2] the constant of gravitation times the mass; negative: pushes away */
  strength: N;
  /** [m] */
  leastDistance: N;
  /** [m] 0: everywhere */
  range: N;
  /** categories: Filter */
  mask: number;
}

export interface BodySpring<N = number> {
  a: bigint;
  /** null: the world */
  b: bigint;
  /** [m] body a's frame */
  anchorA: Vec3<N>;
  /** [m] body b's frame, or the world's */
  anchorB: Vec3<N>;
  /** [m] */
  restLength: N;
  /** [N/m] */
  stiffness: N;
  /** [N s/m] along the spring */
  damping: N;
  onlyPulls: boolean;
}

export interface Thruster<N = number> {
  body: bigint;
  /** [m] body frame */
  point: Vec3<N>;
  /** [N] body frame */
  force: Vec3<N>;
}

export interface Buoyancy<N = number> {
  body: bigint;
  /** [m] body frame: the centre of buoyancy */
  point: Vec3<N>;
  /** [m] */
  maxDepth: N;
  /** [m^3] */
  volume: N;
  /** [m] of the liquid's surface, along up */
  surfaceHeight: N;
  /** [kg/m^3] of the liquid */
  density: N;
}

export interface Explosion<N = number> {
  /** [m] */
  centre: Vec3<N>;
  /** [steps] World::tick() at which it goes off; add() makes now of what is past */
  begin: bigint;
  /** [N] */
  implosionForce: N;
  /** [m] */
  implosionLeast: N;
  /** [m] */
  implosionMost: N;
  /** [s] */
  implosionDuration: N;
  /** [N] */
  waveForce: N;
  /** [m/s] */
  waveSpeed: N;
  /** [m] */
  waveWidth: N;
  /** [1] of the width */
  waveRamp: N;
  /** [s] */
  waveDuration: N;
  /** [N] */
  chimneyForce: N;
  /** [m] */
  chimneyRadius: N;
  /** [m] */
  chimneyHeight: N;
  /** [s] */
  chimneyDuration: N;
  /** static bodies between the centre and the point keep it off */
  isShielded: boolean;
  /** categories: Filter */
  mask: number;
}

export interface Water<N = number> {
  /** [m] along up, of the water at rest */
  surfaceHeight: N;
  /** [kg/m^3] */
  density: N;
  /** [m] of the region: a box along the world's axes */
  middle: Vec3<N>;
  /** [m] all 0: everywhere */
  half: Vec3<N>;
  /** [m/s] */
  current: Vec3<N>;
  /** [1/s] each of a kg of water displaced */
  linearDrag: N;
  /** [1/m] the same, times speed */
  quadraticDrag: N;
  /** [1/s] of the body's turning, each of its kg displaced */
  angularDrag: N;
  /** [m] above the water at rest; 0: no wave */
  waveHeight: N;
  /** [m] */
  waveLength: N;
  /** [s] */
  wavePeriod: N;
  /** [1] unit length; along the surface */
  waveDirection: Vec3<N>;
  /** categories: Filter */
  mask: number;
  priority: number;
  /** hides water of lower priority from what it acts on */
  replaces: boolean;
}

export interface Drag<N = number> {
  body: bigint;
  /** [N s/m] */
  linear: N;
  /** [N s^2/m^2] */
  quadratic: N;
  /** [N m s] */
  angular: N;
}

export interface AeroSurface<N = number> {
  body: bigint;
  /** [m] body frame */
  point: Vec3<N>;
  /** surface's frame to body frame */
  orientation: Quat<N>;
  /** [N s/m], or [N s^2/m^2] of |v| v */
  tensor: Mat3<N>;
  low: Mat3<N>;
  high: Mat3<N>;
  /** [1] -1 to 1 */
  control: N;
  isQuadratic: boolean;
  /** a keel, a water rudder, a hydrofoil */
  isUnderWater: boolean;
}

export interface DampingZone<N = number> {
  shape: ZoneShapeName;
  /** of a sphere the position alone */
  pose: Pose<N>;
  /** [m] of a box; of a sphere x is the radius */
  half: Vec3<N>;
  /** [1/s] of velocities */
  linear: N;
  /** [1/s] of angular velocities */
  angular: N;
  /** categories: Filter */
  mask: number;
  priority: number;
  /** hides zones of lower priority from what it acts on */
  replaces: boolean;
}

export interface MaterialPair<N = number> {
  /** Material::kind, 1 or more */
  kindA: number;
  /** Material::kind, 1 or more */
  kindB: number;
  /** [1] of what slides */
  friction: N;
  /** [1] of what does not; below friction: the same */
  staticFriction: N;
  /** [1] 0..1 */
  restitution: N;
  /** [m] */
  rollingResistance: N;
  /** [m] */
  spinResistance: N;
}

export interface Breakable<N = number> {
  body: bigint;
  /** [kg m/s] */
  breakImpulse: N;
  pattern: BreakPatternName;
  /** 2 to 256; of eight_boxes 8 or more */
  mostPieces: number;
  /** how often: 1: its pieces do not break; 0: it does not, but may expire */
  depth: number;
  /** [1] of wood, in the shape's frame: unit length */
  grain: Vec3<N>;
  seed: bigint;
  /** [kg] pieces lighter than that are gone */
  smallMass: N;
  /** [steps] after so long; 0: all stay */
  lifetime: number;
  /** [steps] World::tick() from which break_bodies() takes it away; 0: never */
  expires: bigint;
  /** break_bodies() removes the shape along with it: pieces have shapes of their own */
  ownsShape: boolean;
}

export interface Character<N = number> {
  body: bigint;
  /** [m] that it climbs, and follows down */
  stepHeight: N;
  /** [1] of a normal that it stands on: the cosine of the steepest slope */
  leastUp: N;
  /** [m] that it keeps from what is in its way */
  skin: N;
  /** [kg] that its ground bears */
  mass: N;
  /** [N] */
  pushForce: N;
  /** [m/s^2] towards CharacterInput::move while it is in the air */
  airAcceleration: N;
  /** [1] */
  gravityScale: N;
  /** categories in its way, of those that its body's Filter collides with */
  mask: number;
}

export interface Vehicle<N = number> {
  body: bigint;
  /** [N m] at full throttle */
  engineTorque: N;
  /** [rad/s] at which it has no torque left */
  engineSpeed: N;
  /** [1] 0: neutral; below 0: reverse */
  gears: N[];
  /** [1] */
  finalDrive: N;
  /** [kg m^2] 0, or 2^-10 or more */
  engineInertia: N;
  /** [N m] at most, fully engaged */
  clutchTorque: N;
  /** [1] 0 to 1 */
  differentialLock: N;
  /** [N m] a wheel */
  brakeTorque: N;
  /** [N m] a wheel */
  handbrakeTorque: N;
  /** [1] 0 to 1 */
  ackermann: N;
  /** [1] 0 to 2 */
  trackSteer: N;
}

export interface Wheel<N = number> {
  body: bigint;
  /** [m] body frame: the wheel's middle at length 0 */
  hardPoint: Vec3<N>;
  /** [1] body frame, unit length: down */
  suspension: Vec3<N>;
  /** [1] body frame, unit length: to the left */
  axleDirection: Vec3<N>;
  /** [m] */
  freeLength: N;
  /** [m] */
  travel: N;
  /** [N/m] */
  stiffness: N;
  /** [N s/m] */
  damping: N;
  /** [m] */
  radius: N;
  /** [kg m^2] about the axle */
  inertia: N;
  /** [1] friction */
  gripAlong: N;
  /** [1] */
  gripAcross: N;
  /** [1] above 0 */
  peakSlip: N;
  /** [1] */
  peakGrip: N;
  /** [1] above peak_slip */
  slideSlip: N;
  /** [1] */
  slideGrip: N;
  /** [rad] at steer 1 */
  steerAngle: N;
  /** [1] of the torque, to those of the other wheels */
  driveShare: N;
  /** [1] */
  brakeShare: N;
  /** [1] */
  handbrakeShare: N;
  /** of the anti-roll bar */
  axle: number;
  /** [N/m] the larger of the two counts */
  antiRoll: N;
  /** 0: none */
  track: number;
}

export interface SurfaceVelocity<N = number> {
  body: bigint;
  /** [m/s] body frame */
  linear: Vec3<N>;
  /** [rad/s] body frame, about the body's origin, of a part's record too */
  angular: Vec3<N>;
  /** child of the body's shape */
  part: number;
}

export interface Ghost {
  a: bigint;
  b: bigint;
}

export interface OneWay<N = number> {
  body: bigint;
  /** [1] body frame, unit length */
  axis: Vec3<N>;
  /** [1] of the normal to the axis: 60 degrees */
  leastCosine: N;
}

export interface HitReport<N = number> {
  body: bigint;
  /** [m/s] along the normal, as the step begins in which they first press on each other */
  speed: N;
}

export interface ContactReport {
  body: bigint;
}

export interface JointLoad<N = number> {
  joint: bigint;
  /** [N] 0: no force breaks it */
  breakForce: N;
  /** [N m] 0: no torque breaks it */
  breakTorque: N;
}

export interface Coupling<N = number> {
  jointA: bigint;
  jointB: bigint;
  /** null: of two joints */
  jointC: bigint;
  /** [1] of an angle, a whole number up to kMostTeeth; [rad/m] of a length beside an angle */
  ratioA: N;
  ratioB: N;
  ratioC: N;
  /** [rad], of lengths alone [m] */
  lower: N;
  upper: N;
}

export interface AxisDrive<N = number> {
  joint: bigint;
  axis: JointAxisName;
  /** lower..upper holds */
  limited: boolean;
  motor: boolean;
  /** [m] or [rad] in (-pi, pi] */
  lower: N;
  upper: N;
  /** [m/s] or [rad/s] of b against a; 0: the motor is a brake, or friction */
  motorSpeed: N;
  /** [m] or [rad] */
  springTarget: N;
  /** [Hz] up to half the sub-step rate; 0: no spring */
  springFrequency: N;
  /** [1] ratio, 1 = critical */
  springDamping: N;
  /** [N] or [N m] most that the motor gives; without a motor the spring, 0: any */
  force: N;
  /** [kg] or [kg m^2] that springs and soft limits are made for; 0: what they feel */
  springMass: N;
  /** [Hz] of limits that yield, up to half the sub-step rate; 0: hard ones */
  limitFrequency: N;
  /** [1] ratio, 1 = critical */
  limitDamping: N;
}

export interface KindGhost {
  /** Material::kind, 1 or more */
  kindA: number;
  /** Material::kind, 1 or more */
  kindB: number;
}

export interface KindResponse<N = number> {
  /** Material::kind, 1 or more */
  kindA: number;
  /** Material::kind, 1 or more */
  kindB: number;
  /** [1] 0, or 2^-8 to 1; not both 0 */
  inverseMassScaleA: N;
  inverseMassScaleB: N;
  /** [1] 0 to 1, times those of the masses; 0: the contact does not turn the body */
  inverseInertiaScaleA: N;
  inverseInertiaScaleB: N;
  /** [N] along the normal; 0: any */
  maxForce: N;
}

export interface SensorMount<N = number> {
  sensor: bigint;
  /** the carrier: of any type */
  on: bigint;
  /** of the sensor's origin in the carrier's frame */
  frame: Pose<N>;
}

export interface BreakableInput<N = number> {
  /** [kg m/s] 0: whole */
  impulse: N;
  /** [m] body frame */
  point: Vec3<N>;
  /** [1] into the body, body frame */
  direction: Vec3<N>;
}

export interface CharacterInput<N = number> {
  /** [m/s] along the ground, world */
  move: Vec3<N>;
  /** [m/s] upwards; 0 again once it has left the ground */
  jump: N;
}

export interface VehicleInput<N = number> {
  /** [1] -1 to 1 */
  throttle: N;
  /** [1] 0: the engine runs alone, to 1: engaged */
  clutch: N;
  /** [1] 0 to 1 */
  brake: N;
  /** [1] 0 to 1 */
  handbrake: N;
  /** [1] -1 to 1 */
  steer: N;
  /** of VehicleSettings::gears */
  gear: number;
}

export interface CharacterState<N = number> {
  footing: FootingName;
  /** null: airborne, or put elsewhere since */
  ground: bigint;
  /** [steps] in a row in which it could not leave what it overlaps */
  stuck: number;
  /** [m] on the ground, in its body's frame */
  foot: Vec3<N>;
  /** [m] the same, world */
  footAt: Vec3<N>;
  /** [m/s] world */
  velocity: Vec3<N>;
  /** [1] of the ground */
  normal: Vec3<N>;
}

export interface VehicleState<N = number> {
  /** [rad/s] of its shaft, up to fastest_engine() */
  engineSpin: N;
  /** [N m] on the gears, in the last sub-step */
  clutchLoad: N;
}

export interface WheelState<N = number> {
  /** [rad/s] about the axle, seen from the body */
  spin: N;
  /** [rad] that it has turned, 0 to 2 pi */
  angle: N;
  /** [rad] from axle_direction, counter-clockwise seen from above */
  steered: N;
  /** [m] from the hard point to the wheel's middle */
  length: N;
  /** [1] of the tyre: the mean of this and earlier sub-steps, the last counts a half */
  slip: N;
  contactBody: bigint;
  /** [m] world */
  contactPoint: Vec3<N>;
  /** [1] of the ground, world */
  contactNormal: Vec3<N>;
  /** [N] along the normal */
  load: N;
  /** [N] on the body, forward */
  along: N;
  /** [N] on the body, normal x forward */
  across: N;
}

export interface JointLoadState<N = number> {
  /** [N] on body b, of all the joint does; held at the format's end */
  force: N;
  /** [N m] about b's origin of the joint; held at the format's end */
  torque: N;
}
