// Decoding of what the tool packed (recording.cpp): for every frame who is there and where.
// SPDX-License-Identifier: MIT
'use strict';

const kGone = 0, kAwake = 1, kAsleep = 2;

function bytesOf(base64) {
  const text = atob(base64.trim()), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

// Little-endian numbers, one after another.
class ByteReader {
  constructor(bytes) {
    this.view = new DataView(bytes.buffer);
    this.at = 0;
  }
  u8() {
    return this.view.getUint8(this.at++);
  }
  i8() {
    return this.view.getInt8(this.at++);
  }
  u16() {
    this.at += 2;
    return this.view.getUint16(this.at - 2, true);
  }
  i16() {
    this.at += 2;
    return this.view.getInt16(this.at - 2, true);
  }
  u32() {
    this.at += 4;
    return this.view.getUint32(this.at - 4, true);
  }
  i32() {
    this.at += 4;
    return this.view.getInt32(this.at - 4, true);
  }
  f32() {
    this.at += 4;
    return this.view.getFloat32(this.at - 4, true);
  }
  hash() {
    const low = this.u32(), high = this.u32();
    return high.toString(16).padStart(8, '0') + low.toString(16).padStart(8, '0');
  }
}

// A list of floats that grows.
class Floats {
  constructor() {
    this.all = new Float32Array(1 << 16);
    this.size = 0;
  }
  room(count) {
    if (this.size + count <= this.all.length) return;
    const more = new Float32Array(2 * this.all.length + count);
    more.set(this.all);
    this.all = more;
  }
  push(x) {
    this.all[this.size++] = x;
  }
}

// A run: `about` is what the page says of it. place(frame, actor) leads into `poses`, seven numbers each: position,
// quaternion. A body that did not move has the place that it had.
class DecodedRun {
  constructor(about, base64) {
    this.about = about;
    this.actors = about.actors;
    this.count = about.frames;
    const n = this.actors.length;
    this.places = new Uint32Array(n * this.count);
    this.states = new Uint8Array(n * this.count);
    this.poses = new Floats();
    this.frames = [];
    this.read(new ByteReader(bytesOf(base64)), n);
  }
  state(frame, actor) {
    return this.states[frame * this.actors.length + actor];
  }
  place(frame, actor) {
    return this.places[frame * this.actors.length + actor];
  }
  // Where it is first.
  firstPlace(actor) {
    let frame = 0;
    while (frame + 1 < this.count && this.state(frame, actor) === kGone) ++frame;
    return this.place(frame, actor);
  }

  read(reader, n) {
    const place = new Uint32Array(n), state = new Uint8Array(n), at = new Int32Array(3 * n);
    let pushes = new Float32Array(4 * this.about.effects.length);
    this.poses.room(7);
    for (const x of [0, 0, 0, 0, 0, 0, 1]) this.poses.push(x);
    for (let f = 0; f < this.count; ++f) {
      const frame = {
        tick: reader.u32() + 4294967296 * reader.u32(),
        hash: reader.hash(),
        energy: reader.f32(),
        depth: reader.f32()
      };
      for (let left = reader.u32(); left > 0; --left) {
        const word = reader.u32();
        state[word >>> 2] = word & 3;
      }
      this.readPoses(reader, place, at);
      if (pushes.length > 0) pushes = this.readPushes(reader, pushes);
      frame.pushes = pushes;
      this.readPoints(reader, frame);
      this.frames.push(frame);
      this.places.set(place, f * n);
      this.states.set(state, f * n);
    }
  }

  readPoses(reader, place, at) {
    const grid = this.about.grid, turns = !this.about.particles;
    const put = (actor) => {
      this.poses.room(7);
      place[actor] = this.poses.size / 7;
      for (let i = 0; i < 3; ++i) this.poses.push(at[3 * actor + i] * grid);
      if (turns)
        this.readTurn(reader);
      else
        for (let i = 0; i < 4; ++i) this.poses.push(i === 3 ? 1 : 0);
    };
    for (let left = reader.u32(); left > 0; --left) {
      const actor = reader.u32();
      for (let i = 0; i < 3; ++i) at[3 * actor + i] = reader.i32();
      put(actor);
    }
    const mask = [];
    for (let left = reader.u32(); left > 0; --left) mask.push(reader.u8());
    for (let byte = 0; byte < mask.length; ++byte) {
      for (let bit = 0; bit < 8; ++bit) {
        if (!(mask[byte] >> bit & 1)) continue;
        const actor = 8 * byte + bit;
        for (let i = 0; i < 3; ++i) at[3 * actor + i] += reader.i16();
        put(actor);
      }
    }
  }

  // The smallest three parts of a unit quaternion; the one left out is positive.
  readTurn(reader) {
    const words = [reader.u16(), reader.u16(), reader.u16()];
    const largest = words[0] >> 15 | words[1] >> 15 << 1;
    let left = 1, k = 0;
    const q = [0, 0, 0, 0];
    for (let i = 0; i < 4; ++i) {
      if (i === largest) continue;
      q[i] = ((words[k++] & 32767) / 32767 * 2 - 1) * Math.SQRT1_2;
      left -= q[i] * q[i];
    }
    q[largest] = Math.sqrt(Math.max(0, left));
    for (const x of q) this.poses.push(x);
  }

  // Four numbers an effect: newtons, control. What did not change is as it was.
  readPushes(reader, before) {
    const count = reader.u32(), pushes = count > 0 ? before.slice() : before;
    for (let left = count; left > 0; --left) {
      const at = 4 * reader.u32();
      for (let i = 0; i < 3; ++i) pushes[at + i] = reader.i16() / 32767 * this.about.strongest;
      pushes[at + 3] = reader.i16() / 32767;
    }
    return pushes;
  }

  // Seven numbers a point: position, normal, newtons.
  readPoints(reader, frame) {
    const count = reader.u32(), low = this.about.points_low, size = this.about.points_size;
    frame.points = new Float32Array(7 * count);
    for (let p = 0; p < count; ++p) {
      for (let i = 0; i < 3; ++i) frame.points[7 * p + i] = low[i] + size[i] * reader.u16() / 65535;
      for (let i = 0; i < 3; ++i) frame.points[7 * p + 3 + i] = reader.i8() / 127;
      frame.points[7 * p + 6] = Math.pow(2, reader.u8() / 16) - 1;
    }
  }

  // The frame whose contact points are the newest known at a frame.
  pointsFrame(frame) {
    return frame - frame % this.about.points_every;
  }
}
