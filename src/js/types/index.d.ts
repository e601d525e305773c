// isostep for JavaScript and TypeScript. The comments of structs are the C++ headers' own: generated.d.ts.
// SPDX-License-Identifier: MIT

/// <reference lib="esnext.disposable" />

import type {
  Applicant, BlobHomeName, BodyDefinition, BodyFlagsBits, BodyMass, BodyPair, BodyProperties, BodyState, BodyTypeName,
  BoxQuery, BreakReport, BroadPhaseName, Broke, Child, ClosestBody, ContactBegin, ContactHit, ContactPoint, Filter,
  GenreName, JointAxisName, JointBroke, JointFlagsBits, JointProperties, Joints, JointTypeName, Material, OverlapHit,
  OverlapQuery, PartFlagsBits, PhaseName, PlayerStats, PointQuery, Pose, Primitive, ProposalName, RagdollBone, RagdollSettings,
  RayCast, RayHit, RecordingName, RecordInputs, RecordKinds, RecordStates, RenderPose, ReplayInfo, ReplayResult,
  SelfcheckResult, SensorEvent,
  SessionConfig,
  SessionEvent, SessionStats, Settings, ShapeCast, ShapeHit, Shapes, ShapeTypeName, StepReport, Vec3, WorldCounts,
  ZoneEffectsBits
} from './generated.js';
import type {Endpoint} from './transport.js';

export * from './generated.js';

export type Scalar = 'f32' | 'f64' | 'q16' | 'q32';

/** What a function takes for a struct: members that are not named have their defaults. */
export type Given<T> = T extends readonly unknown[] ? ArrayLike<T[number]>
  : T extends Uint8Array ? T : T extends object ? {readonly [K in keyof T]?: Given<T[K]>} : T;

/** A refused call. */
export class IsostepError extends Error {
  /** Above 0: the world's fault. Below 0: misuse; -100: a value that JavaScript refuses to write. */
  readonly status: number;
  /** "body_create"; empty where none is known. */
  readonly command: string;
  /** "material.friction"; empty: no field alone. */
  readonly field: string;
  /** "0 to 16" */
  readonly expected: string;
}

export interface LoadOptions {
  /** Where the module is, if not in the package. */
  source?: string | URL | Response | BufferSource | WebAssembly.Module;
}
/** Starts an engine in a memory of its own. Numbers are SI as Number; `raw`: fixed point's integers as BigInt. */
export function load(scalar: Scalar, options?: LoadOptions & {numbers?: 'si'}): Promise<Engine>;
export function load(scalar: 'q16' | 'q32', options: LoadOptions & {numbers: 'raw'}): Promise<Engine<bigint>>;

export const BodyFlags: BodyFlagsBits;
export const PartFlags: PartFlagsBits;
export const JointFlags: JointFlagsBits;
export const ZoneEffects: ZoneEffectsBits;
export const Channel: {readonly datagram: 0, readonly reliable: 1};

/** What lies in the engine's memory. Freed by dispose(), by `using`, or some time after nothing refers to it. */
interface Owned {
  readonly disposed: boolean;
  dispose(): void;
  [Symbol.dispose](): void;
}

export class Engine<N = number> {
  private constructor();
  readonly scalar: Scalar;
  readonly version: string;
  /** Engines of one behaviour version promise each other's hashes: what lobbies compare. */
  readonly behaviourVersion: bigint;
  /** [bytes] */
  readonly memorySize: number;
  selfcheck(): SelfcheckResult;

  createWorld(settings?: Given<Settings<N>>): World<N>;
  /** A game's own state in the engine's memory, all of it 0 at first. */
  createState<F extends StateFields>(fields: F): State<F>;
  createSession(config: GivenConfig, game: Game<N>, file?: Uint8Array): Session;
  createNetwork(seed?: bigint): SimulatedNetwork;

  /** The hull of points [m]. */
  createHull(points: readonly ArrayLike<N>[], home?: BlobHomeName): Blob;
  createMesh(mesh: MeshData, home?: BlobHomeName): Blob;
  createHeightField(field: HeightFieldData, home?: BlobHomeName): Blob;
  /** A file of `isostep bake`, or what Blob.write gave. */
  readBlob(bytes: Uint8Array, home?: BlobHomeName): Blob;

  createTape(): Tape;
  openReplay(bytes: Uint8Array): Replay<N>;
  /** What `isostep verify` says. */
  verifyReplay(bytes: Uint8Array, options?: {mostFrames?: number | bigint}): ReplayResult;
}

type Numbers = readonly (readonly number[])[] | ArrayLike<number>;
export interface SurfaceMaterials {
  /** One a triangle or cell. 254: a ghost, 255: a hole of a height field. */
  numbers?: ArrayLike<number>;
  /** What the numbers 0, 1 ... stand for; beyond: the body's own. */
  table?: readonly {friction: number, restitution: number}[];
}
export interface MeshData {
  /** [m] three numbers each, nested or flat */
  points: Numbers;
  /** three corners each, counter-clockwise seen from outside */
  triangles: Numbers;
  materials?: SurfaceMaterials;
}
export interface HeightFieldData {
  columns: number;
  rows: number;
  /** [m] between columns, and between rows */
  pitch: number;
  /** [m] columns times rows, by rows */
  heights: Numbers;
  materials?: SurfaceMaterials;
}

/** Points of a hull, triangles of a mesh, heights of a field. Worlds that use its content keep that. */
export interface Blob extends Owned {
  readonly type: ShapeTypeName;
  /** The hash of its content. */
  readonly name: bigint;
  write(): Uint8Array;
}

/** Records as they were when they were asked for: a copy, which outlives their world. */
export interface Records<T, A extends ArrayLike<unknown> = ArrayLike<unknown>> extends Iterable<T> {
  readonly length: number;
  at(i: number): T | undefined;
  /** Word w of record i is at [i * stride + w]. */
  readonly numbers: A;
  readonly stride: number;
  /** The same in words of 64 bits, for ids. */
  readonly ids: BigUint64Array;
  readonly idStride: number;
}

type Part<N> = {[K in keyof Shapes<N>]: {kind: K, shape?: Given<Shapes<N>[K]>, blob?: undefined}}[keyof Shapes<N>]
  | {blob: Blob, kind?: undefined, shape?: undefined};

export interface World<N = number> extends Owned {
  /** Of the whole state: the same on every machine. */
  readonly hash: bigint;
  /** Steps taken. */
  readonly tick: number;
  readonly settings: Settings<N>;
  readonly counts: WorldCounts;
  /** One step of 1 / hz seconds. */
  step(): StepReport;
  setGravity(gravity: ArrayLike<N>): void;

  addShape<K extends keyof Shapes<N>>(kind: K, shape?: Given<Shapes<N>[K]>): bigint;
  addBlob(blob: Blob, options?: {radius?: N}): bigint;
  addCompound(parts: readonly (Part<N> & Given<Omit<Child<N>, 'primitive'>>)[]): bigint;
  /** A shape as queries take it. */
  primitive<K extends keyof Shapes<N>>(kind: K, shape?: Given<Shapes<N>[K]>): Primitive<N>;
  removeShape(shape: bigint): void;
  hasShape(shape: bigint): boolean;
  addAsset(blob: Blob): void;
  setHeights(shape: bigint, child: number, patch: {column: number, row: number, columns: number, rows: number,
    heights: ArrayLike<number>, materials?: ArrayLike<number>}): void;

  createBody(definition: Given<BodyDefinition<N>>): bigint;
  destroyBody(body: bigint): void;
  destroyBodies(bodies: readonly bigint[]): number;
  hasBody(body: bigint): boolean;
  bodies(): bigint[];
  body(body: bigint): BodyState<N>;
  bodyProperties(body: bigint): BodyProperties<N>;
  children(body: bigint): Child<N>[];
  velocityAt(body: bigint, point: ArrayLike<N>): Vec3<N>;
  inertia(body: bigint, axis: ArrayLike<N>): N;
  wake(body: bigint): void;
  sleep(body: bigint): void;
  setEnabled(body: bigint, enabled: boolean): void;
  setFilter(body: bigint, filter: Given<Filter>): void;
  setUserData(body: bigint, userData: bigint | number): void;
  setPose(body: bigint, pose: Given<Pose<N>>): void;
  setVelocity(body: bigint, linear: ArrayLike<N>, angular?: ArrayLike<N>): void;
  setMaterial(body: bigint, material: Given<Material<N>>): void;
  setMotion(body: bigint, motion?: {gravityScale?: N, linearDamping?: N, angularDamping?: N, locks?: number}): void;
  setType(body: bigint, type: BodyTypeName, mass?: Given<BodyMass<N>>): void;
  setMass(body: bigint, mass: Given<BodyMass<N>>): void;
  setShape(body: bigint, shape: bigint, mass?: Given<BodyMass<N>>): void;
  moveTo(body: bigint, pose: Given<Pose<N>>): void;
  /** [N], [N m] over the next step. */
  applyForce(body: bigint, force: ArrayLike<N>, torque?: ArrayLike<N>): void;
  applyForceAt(body: bigint, force: ArrayLike<N>, point: ArrayLike<N>): void;
  /** [kg m/s], [kg m^2/s] at once. */
  applyImpulse(body: bigint, impulse: ArrayLike<N>, angular?: ArrayLike<N>): void;
  applyImpulseAt(body: bigint, impulse: ArrayLike<N>, point: ArrayLike<N>): void;

  createJoint<K extends keyof Joints<N>>(kind: K, joint: Given<Joints<N>[K]>): bigint;
  /** A joint whose frames lie where `frame` is now. Add limits, motor, spring; then createJointOf. */
  jointAt(type: JointTypeName, a: bigint, b: bigint, frame: Given<Pose<N>>): JointProperties<N>;
  jointBetween(type: JointTypeName, a: bigint, frameA: Given<Pose<N>>, b: bigint, frameB: Given<Pose<N>>):
    JointProperties<N>;
  createJointOf(properties: Given<JointProperties<N>>): bigint;
  setJoint(joint: bigint, properties: Given<JointProperties<N>>): void;
  setLimits(joint: bigint, lower: N, upper: N): void;
  setMotor(joint: bigint, speed: N, torque: N): void;
  setSpring(joint: bigint, frequency: N, damping: N): void;
  setTarget(joint: bigint, target: N): void;
  destroyJoint(joint: bigint): void;
  hasJoint(joint: bigint): boolean;
  joints(): bigint[];
  joint(joint: bigint): JointProperties<N>;
  jointError(joint: bigint): N;
  jointPosition(joint: bigint, axis?: JointAxisName): N;
  axisDrive(joint: bigint, axis: JointAxisName): bigint;
  addRagdoll(bones: readonly Given<RagdollBone<N>>[], settings?: Given<RagdollSettings<N>>):
    {bodies: bigint[], joints: bigint[]};

  /** Records: what acts from step to step. */
  add<K extends keyof RecordKinds<N>>(kind: K, record: Given<RecordKinds<N>[K]>): bigint;
  /** These members of it; the others stay, bit for bit. */
  set<K extends keyof RecordKinds<N>>(kind: K, record: bigint, changes: Given<RecordKinds<N>[K]>): void;
  /** What a game asks of it, until it asks something else. */
  setInput<K extends keyof RecordInputs<N>>(kind: K, record: bigint, changes: Given<RecordInputs<N>[K]>): void;
  input<K extends keyof RecordInputs<N>>(kind: K, record: bigint): RecordInputs<N>[K];
  /** How the last step left it. */
  state<K extends keyof RecordStates<N>>(kind: K, record: bigint): RecordStates<N>[K];
  get<K extends keyof RecordKinds<N>>(kind: K, record: bigint): RecordKinds<N>[K];
  remove(kind: keyof RecordKinds<N>, record: bigint): void;
  breakBodies(most: number): BreakReport;

  castRay(ray: Given<RayCast<N>>): RayHit<N> | null;
  castRayAll(ray: Given<RayCast<N>>): RayHit<N>[];
  castRays(rays: readonly Given<RayCast<N>>[], each?: number): RayHit<N>[][];
  castShape(cast: Given<ShapeCast<N>>): ShapeHit<N> | null;
  castShapeAll(cast: Given<ShapeCast<N>>): ShapeHit<N>[];
  castShapes(casts: readonly Given<ShapeCast<N>>[], each?: number): ShapeHit<N>[][];
  closestPoint(query: Given<PointQuery<N>>): ClosestBody<N> | null;
  overlapFirst(query: Given<OverlapQuery<N>>): OverlapHit | null;
  overlapShape(query: Given<OverlapQuery<N>>): OverlapHit[];
  overlapBox(query: Given<BoxQuery<N>>): bigint[];

  /** Of all moving bodies, interpolated between the last two steps: [id, id, x, y, z, qx, qy, qz, qw, 0] each. */
  poses(alpha?: number): Records<RenderPose, Float32Array>;
  contactBegins(): Records<ContactBegin<N>>;
  contactEnds(): Records<BodyPair>;
  sensorBegins(): Records<SensorEvent>;
  sensorEnds(): Records<SensorEvent>;
  brokeEvents(): Records<Broke<N>>;
  jointBrokeEvents(): Records<JointBroke<N>>;
  contactHits(): Records<ContactHit<N>>;
  contactPoints(): Records<ContactPoint<N>>;
  contactsOf(body: bigint): ContactPoint<N>[];
  fellAsleep(): BigUint64Array;
  woke(): BigUint64Array;

  createSnapshot(): Snapshot;
  save(snapshot: Snapshot): void;
  /** Same ids, same future. */
  load(snapshot: Snapshot): void;
  write(): Uint8Array;
  read(bytes: Uint8Array): void;
  apply(commands: Uint8Array): void;
  keepLog(on: boolean): void;
  log(): Uint8Array;
  clearLog(): void;
  record(tape: Tape, scene: string): void;

  useBroadPhase(name: BroadPhaseName): void;
  readonly broadPhase: BroadPhaseName;
  readonly simdName: string;
}

export interface Snapshot extends Owned {
  /** [bytes] */
  readonly byteLength: number;
}
export interface Tape extends Owned {
  endFrame(): void;
  keyframe(): void;
  /** All frames so far are in bytes(): kept, a crash costs none of them. Else it costs a second. */
  flush(): void;
  finish(): void;
  bytes(): Uint8Array;
}
export interface Replay<N = number> extends Owned {
  readonly info: ReplayInfo;
  createWorld(): World<N>;
  frame(number: number | bigint): {commands: Uint8Array, hash: bigint};
}

// ---- sessions

type StateType = 'u8' | 'u16' | 'u32' | 'i8' | 'i16' | 'i32' | 'f32' | 'f64' | 'u64' | 'i64';
export type StateFields = Readonly<Record<string, StateType | readonly [StateType, number]>>;
interface StateArrays {
  u8: Uint8Array; u16: Uint16Array; u32: Uint32Array; u64: BigUint64Array; f32: Float32Array;
  i8: Int8Array; i16: Int16Array; i32: Int32Array; i64: BigInt64Array; f64: Float64Array;
}
type StateValue<T> = T extends readonly [infer E extends StateType, number] ? StateArrays[E]
  : T extends 'u64' | 'i64' ? bigint : number;
/** Named numbers; an array is a typed array that shows the memory itself: take it anew after each step. */
export type State<F extends StateFields = StateFields> = Owned & {readonly byteLength: number} &
  {-readonly [K in keyof F as F[K] extends string ? K : never]: StateValue<F[K]>} &
  {readonly [K in keyof F as F[K] extends string ? never : K]: StateValue<F[K]>};

export interface Input {
  bytes: Uint8Array;
  /** A game may look at 'disconnected', and at nothing else. */
  status: 'confirmed' | 'predicted' | 'disconnected';
}
/** What a session plays. `step` depends on the world, the state, the inputs' bytes and who is disconnected. */
export interface Game<N = number> {
  world?: World<N>;
  state?: Owned & {readonly byteLength: number};
  step(inputs: readonly Input[], frame: number): void;
  /** The state is again that before `frame`. */
  rolledBack?(frame: number): void;
  /** The state is one that arrived from elsewhere, before `frame`. */
  restarted?(frame: number): void;
  /** `frame` is final: once each, ascending. `hash`: of the state after it. */
  confirmed?(frame: number, hash: bigint): void;
}
/** `preset`: settings that suit a genre, which the others replace. */
export type GivenConfig = Given<SessionConfig> & {preset?: GenreName};

/** Times are microseconds since any moment and never run backwards. What returns a boolean says whether it was done. */
export interface Session extends Owned {
  /** Why the last call was refused. */
  readonly problem: string;
  /** Plays what is due; how many frames were stepped, those again included. */
  drive(now: number): number;
  addLocalInput(player: number, bytes: Uint8Array): boolean;
  wantsInput(player: number): boolean;
  /** [us] until the next frame is due. */
  wait(now: number): number;

  connected(peer: number, now: number, incoming?: boolean): void;
  disconnected(peer: number, now: number): void;
  receive(peer: number, channel: 0 | 1, bytes: Uint8Array, now: number): void;
  /** `bytes` is a view, until the next call. */
  pollSend(now: number): {peer: number, channel: 0 | 1, bytes: Uint8Array, close: boolean} | null;
  pollConnect(): string | null;

  pollEvent(): SessionEvent | null;
  readonly phase: PhaseName;
  readonly current: number;
  readonly confirmed: number;
  readonly localPlayer: number;
  readonly localPlayers: number;
  readonly token: bigint;
  readonly stats: SessionStats;
  playerStats(player: number): PlayerStats;
  input(frame: number, player: number): Input;
  snapshotProgress(peer?: number): {arrived: number, size: number};

  start(now: number): boolean;
  resync(): boolean;
  /** With `migration`: a match that stands goes on with those who are here, if the others play nowhere else. */
  goOn(now: number): boolean;
  pause(): boolean;
  unpause(): boolean;
  setSpeed(eighths: number): boolean;
  propose(player: number, proposal: ProposalName, subject?: number): boolean;
  vote(player: number, yes: boolean): boolean;
  pollApplicant(): Applicant | null;
  admit(applicant: bigint): boolean;
  refuse(applicant: bigint, reason: string): boolean;
  kick(player: number, reason: string): boolean;
  kickPeer(peer: number, reason: string): boolean;
  peerOf(player: number): number;

  saveMatch(): Uint8Array;
  record(kind: RecordingName, scene?: string): boolean;
  /** What is new of the file since the last such call: appended, it survives a crash. */
  flushRecording(kind: RecordingName): Uint8Array;
  recorded(kind: RecordingName): Uint8Array;
}

/** What has arrived at the endpoint goes into the session: before drive. */
export function deliver(endpoint: Endpoint, session: Session, now: number): void;
/** What the session has to say goes out: after it. */
export function dispatch(endpoint: Endpoint, session: Session, now: number): void;

/** Between sessions of one engine, in virtual time: endpoint 0 is the host, clients follow. */
export interface SimulatedNetwork extends Owned {
  /** 'wifi', 'latency=80,jitter=20,loss=5' ([ms], [ms], [%]) */
  addClient(profile: string): number;
  setProfile(client: number, profile: string): void;
  connect(from: number, to?: number): void;
  cut(client: number): void;
  setSilent(endpoint: number, silent: boolean): void;
  setSide(endpoint: number, side: number): void;
  /** [us] */
  advanceTo(now: number): void;
  deliver(endpoint: number, session: Session, now: number): void;
  dispatch(endpoint: number, session: Session, now: number): void;
}
