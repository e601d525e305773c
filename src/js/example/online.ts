// The game between two processes: node online.js host PORT, then node online.js ws://127.0.0.1:PORT
// SPDX-License-Identifier: MIT
//
// Both end after the frames that are played, and print the hash of the last: it is the same.

import {deliver, dispatch, load} from 'isostep';
import {WebSocketTransport} from 'isostep/websocket';
import {WebSocket, WebSocketServer} from 'ws';

import {config, createPucks, push} from './pucks.js';

const kFrames = 300;
const [, , where, port] = process.argv;
const host = where === 'host';
const iso = await load('q32');
const transport = host ? WebSocketTransport.listen(new WebSocketServer({port: Number(port)}))
                       : WebSocketTransport.connect(where, {WebSocket});

let last = 0n;
const game = {
  ...createPucks(iso),
  confirmed(frame: number, hash: bigint) { if (frame === kFrames - 1) last = hash; }
};
const seed = host ? crypto.getRandomValues(new BigUint64Array(1))[0] : 0n;  // 64 secret bits, anew for every match
const session = iso.createSession({...config, host, seed}, game);

const loop = setInterval(() => {
  const now = performance.now() * 1000;
  deliver(transport, session, now);
  for (let event; (event = session.pollEvent()) !== null;) console.error(event.kind, event.key);
  if (session.localPlayer >= 0) {
    session.addLocalInput(session.localPlayer, push(Math.floor(session.current / 11) % 3 - 1));
  }
  session.drive(now);
  dispatch(transport, session, now);
  if (last === 0n || session.confirmed < kFrames + 60) return;  // a second more, so that the other side has it too
  clearInterval(loop);
  console.log(last.toString(16).padStart(16, '0'));
  process.exit(0);
}, 4);
