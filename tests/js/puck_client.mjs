// A client of a match in Node: see tests/match/host.cpp for what it reads and writes. Between the simulated network and
// its session is a WebSocket of the package's, both ends of it in this process:
// node puck_client.mjs FOLDER SCALAR
// SPDX-License-Identifier: MIT
//
// Each turn waits until the socket has brought what was given to it, and so is the same however long that takes.

import {packaged} from './checks.mjs';
import {createPucks, kConfig, pushOf} from './pucks.mjs';

const kOver = 2n ** 64n - 1n, kPeer = 0;
const [, , , scalar] = process.argv;
const {deliver, dispatch, load} = await packaged('isostep');
const {WebSocketTransport} = await packaged('isostep/websocket');
const {WebSocket, WebSocketServer} = await packaged('ws');

// ---- the host's bytes

let buffer = Buffer.alloc(0), wake = () => {}, over = false;
process.stdin.on('data', data => {
  buffer = Buffer.concat([buffer, data]);
  wake();
});
process.stdin.on('end', () => {
  over = true;
  wake();
});
async function read(size) {
  while (buffer.length < size) {
    if (over) throw new Error('the host has ended');
    await new Promise(resolve => { wake = resolve; });
  }
  const bytes = buffer.subarray(0, size);
  buffer = buffer.subarray(size);
  return bytes;
}
const u32 = value => {
  const bytes = Buffer.alloc(4);
  bytes.writeUInt32LE(value);
  return bytes;
};
const write = parts => new Promise(resolve => process.stdout.write(Buffer.concat(parts), resolve));

// ---- the WebSocket: `far` is the end at the network, `near` the session's

const server = await new Promise(resolve => {
  const made = new WebSocketServer({host: '127.0.0.1', port: 0}, () => resolve(made));
});
const far = WebSocketTransport.listen(server), near = new WebSocketTransport({WebSocket});
async function until(is) {
  while (!is()) await new Promise(setImmediate);
}
/** What the network brings this turn: waits until all of it has arrived at the near end. */
async function takeArrivals() {
  for (let left = (await read(4)).readUInt32LE(); left > 0; --left) {
    const head = await read(6), bytes = new Uint8Array(await read(head.readUInt32LE(2)));
    const had = near.arrivals.inbox.length;
    if (head[0] === 0) near.connectTo(`ws://127.0.0.1:${server.address().port}`);
    if (head[0] === 1) far.disconnect(kPeer);
    if (head[0] === 2 && !far.send(kPeer, head[1], bytes)) throw new Error('the WebSocket does not take a message');
    await until(() => near.arrivals.inbox.length > had);
    if (head[0] === 0) {
      await until(() => far.arrivals.inbox.length > 0);
      far.receive();
    }
  }
}
/** The near end for a session, and how much it sent. */
const sessionEnd = {
  sent: 0,
  receive: () => near.receive(),
  disconnect: peer => near.disconnect(peer),
  send(peer, channel, bytes) {
    if (near.send(peer, channel, bytes)) ++this.sent;
  }
};
/** What the session has sent this turn, once it has arrived at the far end. */
async function messages() {
  await until(() => far.arrivals.inbox.length >= sessionEnd.sent);
  sessionEnd.sent = 0;
  const parts = [];
  let count = 0;
  for (let arrival; (arrival = far.receive()) !== null; ++count) {
    parts.push(Buffer.of(arrival.channel), u32(arrival.bytes.length), arrival.bytes);
  }
  return [u32(count), ...parts];
}

// ---- the match

const inputSchema = (await read(8)).readBigUInt64LE(), players = (await read(4)).readUInt32LE();
const iso = await load(scalar);
const finals = [];
let rollbacks = 0;
const game = {
  ...createPucks(iso, players),
  rolledBack() { ++rollbacks; },
  confirmed(frame, hash) {
    const bytes = Buffer.alloc(12);
    bytes.writeUInt32LE(frame);
    bytes.writeBigUInt64LE(hash, 4);
    finals.push(bytes);
  }
};
const session = iso.createSession({...kConfig, players, inputSchema}, game);
if (!session.record('world', 'pucks')) throw new Error('the world is not recorded');
for (let now; (now = (await read(8)).readBigUInt64LE()) !== kOver;) {
  const time = Number(now);
  await takeArrivals();
  deliver(sessionEnd, session, time);
  const player = session.localPlayer;
  if (player >= 0) session.addLocalInput(player, pushOf(session.current, player));
  session.drive(time);
  dispatch(sessionEnd, session, time);
  for (let event; (event = session.pollEvent()) !== null;) {
    if (['refused', 'desync', 'lost_host'].includes(event.kind)) throw new Error(`${event.kind} ${event.key}`);
  }
  const told = finals.splice(0);
  await write([...await messages(), u32(told.length), ...told]);
}
const recording = session.recorded('world');
await write([u32(rollbacks), u32(recording.length), recording]);
process.exit(0);
