// A native C++ host and a peer in Node play 3600 frames on a line of 150 +-40 ms that loses 5 %, in virtual time:
// node native_match_test.mjs FOLDER NATIVE_HOST SCALAR
// SPDX-License-Identifier: MIT

import {spawn} from 'node:child_process';

import {check, done, equal, packaged} from './checks.mjs';
import {createPucks, kConfig, push} from './pucks.mjs';

const kFrames = 3600, kTurn = 8000;  // [us]
const kKinds = ['connected', 'disconnected', 'message'];
const [, , , program, scalar] = process.argv;
const {load} = await packaged('isostep');
const iso = await load(scalar);

const host = spawn(program, ['latency=150,jitter=40,loss=5', String(kFrames)], {stdio: ['pipe', 'pipe', 'inherit']});
const ended = new Promise(resolve => host.on('close', resolve));

/** Reads as much as is asked for. */
let buffer = Buffer.alloc(0), wake = () => {}, over = false;
host.stdout.on('data', data => {
  buffer = Buffer.concat([buffer, data]);
  wake();
});
host.stdout.on('end', () => {
  over = true;
  wake();
});
async function read(size) {
  while (buffer.length < size) {
    if (over) throw new Error('the native host has ended');
    await new Promise(resolve => { wake = resolve; });
  }
  const bytes = buffer.subarray(0, size);
  buffer = buffer.subarray(size);
  return bytes;
}
async function readLine() {
  let line = '';
  for (let c; (c = (await read(1)).toString()) !== '\n';) line += c;
  return line;
}

function write(now, messages) {
  const head = Buffer.alloc(12);
  head.writeBigUInt64LE(BigInt(now));
  head.writeUInt32LE(messages.length, 8);
  const parts = messages.flatMap(({channel, bytes}) => {
    const start = Buffer.alloc(5);
    start.writeUInt8(channel);
    start.writeUInt32LE(bytes.length, 1);
    return [start, bytes];
  });
  host.stdin.write(Buffer.concat([head, ...parts]));
}
async function readTurn(hashes) {
  const isDone = (await read(1))[0] === 1;
  const arrivals = [];
  for (let left = (await read(4)).readUInt32LE(); left > 0; --left) {
    const head = await read(6);
    const bytes = new Uint8Array(await read(head.readUInt32LE(2)));
    arrivals.push({kind: kKinds[head[0]], channel: head[1], bytes});
  }
  for (let left = (await read(4)).readUInt32LE(); left > 0; --left) {
    const final = await read(12);
    hashes.set(final.readUInt32LE(), final.readBigUInt64LE(4));
  }
  return {isDone, arrivals};
}

const native = new Map(), here = new Map();
const game = {...createPucks(iso), confirmed: (frame, hash) => here.set(frame, hash)};
const inputSchema = BigInt(await readLine());
const session = iso.createSession({...kConfig, inputSchema}, game);
const events = [];
let messages = [];
for (let now = 0;; now += kTurn) {
  if (now > 200e6) throw new Error('the match does not end');
  write(now, messages);
  const {isDone, arrivals} = await readTurn(native);
  for (const {kind, channel, bytes} of arrivals) {
    if (kind === 'connected') session.connected(0, now, false);
    else if (kind === 'disconnected') session.disconnected(0, now);
    else session.receive(0, channel, bytes, now);
  }
  session.addLocalInput(1, push(Math.floor(session.current / 17) % 3 - 1));
  session.drive(now);
  messages = [];
  for (let out; (out = session.pollSend(now)) !== null;) {
    messages.push({channel: out.channel, bytes: out.bytes.slice()});
  }
  for (let event; (event = session.pollEvent()) !== null;) events.push(event);
  if (isDone && session.confirmed >= kFrames) break;
}
host.stdin.end();
equal(await ended, 0, 'the native host ends with');
let differs = 0;
for (let frame = 0; frame < kFrames; ++frame) {
  if (native.get(frame) === undefined || native.get(frame) !== here.get(frame)) ++differs;
}
equal(differs, 0, 'frames that differ');
equal(events.filter(({kind}) => ['desync', 'refused', 'lost_host', 'misuse'].includes(kind)), [], 'bad events');
check(game.state.touches > 1, 'the pucks do not touch');
const again = Number(session.stats.steps) - session.current;
check(again > 1000, `${again} frames were stepped again here`);
done(`${kFrames} frames are equal natively and in Node; ${again} were stepped again here`);
