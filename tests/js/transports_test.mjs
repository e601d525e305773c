// Short matches in real time over WebSockets, data channels, and by the bridge with a native host over UDP:
// node transports_test.mjs FOLDER ENET_HOST SCALAR
// SPDX-License-Identifier: MIT
//
// Time is real, and nothing here depends on how much of it passes: a slow machine plays longer.

import {spawn} from 'node:child_process';
import {createInterface} from 'node:readline';

import {check, done, equal, packaged, throws} from './checks.mjs';
import {createPucks, kConfig, pushOf} from './pucks.mjs';

const kFrames = 200;
const kKey = Uint8Array.from({length: 16}, (_, i) => 3 + 17 * i);
const [, , , program, scalar] = process.argv;
const {deliver, dispatch, load} = await packaged('isostep');
const {WebSocketTransport} = await packaged('isostep/websocket');
const {DataChannelTransport, connectBySocket} = await packaged('isostep/data-channel');
const {EnetTransport} = await packaged('isostep/enet');
const {bridge} = await packaged('isostep/bridge');
const {WebSocket, WebSocketServer} = await packaged('ws');
const {RTCPeerConnection} = await packaged('node-datachannel/polyfill');
const iso = await load(scalar);
const kPatient = {...kConfig, silence: 60_000_000n, patience: 60_000_000n};  // of machines that stall nobody has left

/** Takes turns until `isOver` says so; final hashes by frame. */
function play(transport, config, isOver) {
  const hashes = new Map();
  const game = {...createPucks(iso), confirmed: (frame, hash) => hashes.set(frame, hash)};
  const session = iso.createSession({...kPatient, ...config}, game);
  return new Promise((resolve, reject) => {
    const loop = setInterval(() => {
      try {
        const now = performance.now() * 1000;
        deliver(transport, session, now);
        const player = session.localPlayer;
        if (player >= 0) session.addLocalInput(player, pushOf(session.current, player));
        session.drive(now);
        dispatch(transport, session, now);
        for (let event; (event = session.pollEvent()) !== null;) {
          if (['refused', 'desync', 'lost_host'].includes(event.kind)) throw new Error(`${event.kind} ${event.key}`);
        }
        if (!isOver(session)) return;
        clearInterval(loop);
        resolve(hashes);
      } catch (error) {
        clearInterval(loop);
        reject(error);
      }
    }, 2);
  });
}
function compare(a, b, what) {
  let same = 0;
  for (let frame = 0; frame < kFrames; ++frame) if (a.get(frame) !== undefined && a.get(frame) === b.get(frame)) ++same;
  equal(same, kFrames, `${what}: equal frames`);
}
/** Two of them; each goes on until both have all frames, for what one does not send the other waits for. */
async function match(hostTransport, clientTransport, what) {
  const seen = [0, 0];
  const both = mine => session => {
    seen[mine] = session.confirmed;
    return Math.min(...seen) >= kFrames;
  };
  const [host, client] = await Promise.all([
    play(hostTransport, {host: true, seed: 5n}, both(0)), play(clientTransport, {}, both(1))
  ]);
  compare(host, client, what);
}
const serverOf = options => new Promise(resolve => {
  const server = new WebSocketServer({host: '127.0.0.1', port: 0, ...options}, () => resolve(server));
});
const addressOf = server => `ws://127.0.0.1:${server.address().port}`;

async function webSockets() {
  const server = await serverOf();
  const host = WebSocketTransport.listen(server), client = WebSocketTransport.connect(addressOf(server), {WebSocket});
  await match(host, client, 'WebSocket');

  // What no session sends ends the connection, and a client that leaves is told of.
  const stranger = new WebSocket(addressOf(server));
  await new Promise(resolve => stranger.once('open', resolve));
  const closed = new Promise(resolve => stranger.once('close', code => resolve(code)));
  stranger.send(Uint8Array.of(9, 1, 2, 3));
  equal(await closed, 1007, 'WebSocket: a malformed message ends with');
  client.close();
  host.close();
  server.close();
}

async function dataChannels() {
  const server = await serverOf();
  const host = new DataChannelTransport(), client = new DataChannelTransport();
  const [there, here] = [new RTCPeerConnection(), new RTCPeerConnection()];
  host.attach(there, true);
  client.attach(here, false);
  server.once('connection', socket => connectBySocket(there, socket, false));
  const socket = new WebSocket(addressOf(server));
  await new Promise(resolve => socket.once('open', resolve));
  await connectBySocket(here, socket, true);
  await match(host, client, 'data channel');
  socket.close();
  client.close();
  host.close();
  server.close();
}

/** The native host prints its schema and port, then final hashes, and ends after its frames. */
async function native(connect, what, key) {
  const words = key === undefined ? [] : [Buffer.from(key).toString('hex')];
  const host = spawn(program, [String(kFrames), ...words], {stdio: ['pipe', 'pipe', 'inherit']});
  const lines = createInterface({input: host.stdout})[Symbol.asyncIterator]();
  const [schema, port] = (await lines.next()).value.split(' ');
  const address = `127.0.0.1:${port}`;
  const strangers = [{key: kKey.map(byte => byte ^ 1)}, ...(key === undefined ? [] : [{}])]
    .map(options => EnetTransport.connect(address, options));
  const {transport, close} = await connect(address, key);
  let ended = false;
  const there = new Map();
  const reading = (async () => {
    for (let line; !(line = await lines.next()).done;) {
      const [frame, hash] = line.value.split(' ');
      there.set(Number(frame), BigInt(`0x${hash}`));
      ended = there.size >= kFrames;
    }
  })();
  const here = await play(transport, {inputSchema: BigInt(schema)}, session => ended && session.confirmed >= kFrames);
  compare(here, there, what);
  for (const stranger of strangers) {
    for (let arrival; (arrival = stranger.receive()) !== null;) {
      check(arrival.kind === 'disconnected', `${what}: who lacks the key hears ${arrival.kind}`);
    }
    stranger.close();
  }
  host.stdin.end();
  await reading;
  close();
}
const direct = async (address, key) => {
  const transport = EnetTransport.connect(address, {key});
  return {transport, close: () => transport.close()};
};
const bridged = async (address, key) => {
  const server = await serverOf();
  const between = bridge(WebSocketTransport.listen(server), address, {key});
  const transport = WebSocketTransport.connect(addressOf(server), {WebSocket});
  return {transport, close() {
    transport.close();
    between.close();
    server.close();
  }};
};

await webSockets();
await dataChannels();
await native(direct, 'UDP');
await native(bridged, 'WebSocket and bridge');
await native(direct, 'UDP with a key', kKey);
await native(bridged, 'bridge with a key', kKey);
throws(() => EnetTransport.connect('127.0.0.1:9', {key: kKey.slice(1)}), {message: /15 bytes/}, 'a key that is none');
check(iso.memorySize > 0, 'the engine lives');
done(`${kFrames} frames each over WebSockets, data channels, UDP, and bridge are equal on both sides, keyed too`);
