// What the types let through and what they refuse; compiled, never run.
// SPDX-License-Identifier: MIT

import {BodyFlags, Channel, deliver, dispatch, IsostepError, load, type Engine, type Game, type Input, type Vec3,
  type World} from 'isostep';
import {bridge} from 'isostep/bridge';
import {connectBySocket, DataChannelTransport} from 'isostep/data-channel';
import {EnetTransport} from 'isostep/enet';
import {WebSocketTransport} from 'isostep/websocket';
import {WebSocket, WebSocketServer} from 'ws';

export async function uses() {
  const iso: Engine = await load('q32');
  const raw: Engine<bigint> = await load('q16', {numbers: 'raw'});
  using world: World = iso.createWorld({gravity: new Float32Array(3), solver: 'soft_step'});
  const box = world.addShape('box', {halfExtents: [1, 1, 1]});
  const material = {friction: 0.5};
  const body: bigint = world.createBody({type: 'dynamic', shape: box, material, locks: BodyFlags.lockX});
  const position: Vec3 = world.body(body).pose.position;
  const rawPosition: Vec3<bigint> = raw.createWorld().body(0n).pose.position;
  const thruster: bigint = world.add('thruster', {body});
  const back: bigint = world.get('thruster', thruster).body;
  world.createJoint('hinge', {a: body, limit: {lower: -1, upper: 1}, motor: null});
  world.addCompound([{kind: 'sphere', shape: {radius: 1}, pose: {position}}, {blob: iso.createHull([position])}]);
  const all: Float32Array = world.poses(0.5).numbers;
  for (const {impulse, a} of world.contactBegins()) console.log(impulse * 2, a, all.length);

  const state = iso.createState({touches: 'u32', lives: ['i8', 4], total: 'u64'});
  state.touches += 1;
  state.lives[2] = 3;
  state.total += 1n;
  const game: Game = {world, state, step: (inputs: readonly Input[]) => void inputs[0].bytes};
  const session = iso.createSession({preset: 'fighting', players: 2, name: 'game', neutral: Uint8Array.of(0)}, game);
  const transport = WebSocketTransport.listen(new WebSocketServer({port: 1}));
  deliver(transport, session, 0);
  dispatch(EnetTransport.connect('127.0.0.1:1', {key: new Uint8Array(16)}), session, 0);
  bridge(transport, '127.0.0.1:1', {key: new Uint8Array(16)}).close();
  const goesOn: boolean = session.goOn(0);
  if (goesOn) bridge(transport, '127.0.0.1:1').close();
  await connectBySocket(new RTCPeerConnection(), new WebSocket('ws://127.0.0.1:1'), true);
  new DataChannelTransport().attach(new RTCPeerConnection(), false);
  session.receive(0, Channel.reliable, new Uint8Array(), 0);
  if (session.pollEvent()?.kind === 'joined') throw new IsostepError();

  // @ts-expect-error: no such member
  world.createBody({shape: box, colour: 3});
  // @ts-expect-error: no such kind
  world.addShape('torus', {});
  // @ts-expect-error: the member of another kind
  world.addShape('box', {radius: 1});
  // @ts-expect-error: an id is a BigInt
  world.applyImpulse(7, [0, 1, 0]);
  // @ts-expect-error: raw integers are BigInt
  raw.createWorld({gravity: [0, -10, 0]});
  // @ts-expect-error: floating scalars have none
  await load('f32', {numbers: 'raw'});
  // @ts-expect-error: no such enumerator
  world.useBroadPhase('magic');
  // @ts-expect-error: no such event
  if (session.pollEvent()?.kind === 'exploded') return;
  // @ts-expect-error: a list is taken anew, never replaced
  state.lives = new Int8Array(4);
  return [thruster, back, rawPosition];
}
