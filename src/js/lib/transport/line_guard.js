// The frame of UDP packets around ENet's, and the handshake before, on the side that connects: no sockets, no clock.
// SPDX-License-Identifier: MIT
//
// Source: src/transport/line_guard.hpp, which has the layouts. Little-endian.

const kAsk = 0x81, kChallenge = 0x82, kOpen = 0x83, kVersion = 1;
const kWord = 29, kSigned = kWord - 8, kTag = 8;  // [bytes]
const kNumbers = 1 << 15;                         // that a packet tells apart
const kWindow = 1024;                             // [packets] behind the newest that may still come

const viewOf = bytes => new DataView(bytes.buffer, bytes.byteOffset, bytes.length);

/** Returns SipHash-2-4 of `bytes` by a key of four words as halves [low, high]. Words are the halves of v0 to v3. */
export function siphash(key, bytes) {
  let a = key[0] ^ 0x70736575, A = key[1] ^ 0x736f6d65, b = key[2] ^ 0x6e646f6d, B = key[3] ^ 0x646f7261;
  let c = key[0] ^ 0x6e657261, C = key[1] ^ 0x6c796765, d = key[2] ^ 0x79746573, D = key[3] ^ 0x74656462;
  const round = () => {
    let low = (a >>> 0) + (b >>> 0), t;
    a = low | 0, A = (A + B + (low > 0xffffffff)) | 0;
    t = (b << 13) | (B >>> 19), B = ((B << 13) | (b >>> 19)) ^ A, b = t ^ a;
    t = a, a = A, A = t;
    low = (c >>> 0) + (d >>> 0);
    c = low | 0, C = (C + D + (low > 0xffffffff)) | 0;
    t = (d << 16) | (D >>> 16), D = ((D << 16) | (d >>> 16)) ^ C, d = t ^ c;
    low = (a >>> 0) + (d >>> 0);
    a = low | 0, A = (A + D + (low > 0xffffffff)) | 0;
    t = (d << 21) | (D >>> 11), D = ((D << 21) | (d >>> 11)) ^ A, d = t ^ a;
    low = (c >>> 0) + (b >>> 0);
    c = low | 0, C = (C + B + (low > 0xffffffff)) | 0;
    t = (b << 17) | (B >>> 15), B = ((B << 17) | (b >>> 15)) ^ C, b = t ^ c;
    t = c, c = C, C = t;
  };
  const take = (low, high) => {
    d ^= low, D ^= high;
    round(), round();
    a ^= low, A ^= high;
  };
  const view = viewOf(bytes), whole = bytes.length & ~7;
  for (let at = 0; at < whole; at += 8) take(view.getInt32(at, true), view.getInt32(at + 4, true));
  const last = new Uint8Array(8);
  last.set(bytes.subarray(whole));
  last[7] = bytes.length;
  take(viewOf(last).getInt32(0, true), viewOf(last).getInt32(4, true));
  c ^= 0xff;
  for (let i = 0; i < 4; ++i) round();
  return [(a ^ b ^ c ^ d) >>> 0, (A ^ B ^ C ^ D) >>> 0];
}

export class LineGuard {
  /** `put(bytes)` sends; `show(packet)` has what is ENet's; key: 16 bytes, all zeros for none; nonce: 8 drawn ones. */
  constructor(put, show, {key, nonce}) {
    const view = viewOf(key);
    Object.assign(this, {put, show, nonce, key: [0, 4, 8, 12].map(at => view.getInt32(at, true))});
    const derived = use => siphash(this.key, Uint8Array.of(use, ...nonce));
    this.out = [...derived(0), ...derived(1)];
    this.in = [...derived(2), ...derived(3)];
    this.sent = 0;
    this.come = new Float64Array(kWindow).fill(-1);
    this.end = 0;                // one past the newest number that came
    this.connect = undefined;    // ENet's first packet, which waits for the challenge
    this.awaitsChallenge = false;
  }

  /** Sends one of ENet's packets. */
  send(packet) {
    if ((packet[0] & 0xf) === 0xf && packet[1] === 0xff) {  // to nobody's number: a CONNECT
      this.connect = packet.slice();
      this.awaitsChallenge = true;
      this.put(this.#ask());
    } else {
      this.put(this.#sealed(packet));
    }
  }
  receive(bytes) {
    if (bytes.length === 0) return;
    if ((bytes[0] & 0x80) !== 0) return this.#challenged(bytes);
    if (bytes.length >= kTag && this.#opens(bytes)) this.show(bytes.subarray(kTag));
  }

  #ask() {
    const word = new Uint8Array(kWord);
    word.set([kAsk, kVersion, ...this.nonce]);
    siphash(this.key, word.subarray(0, kSigned)).forEach((half, i) => viewOf(word).setUint32(kSigned + 4 * i, half, true));
    return word;
  }
  #challenged(word) {
    if (!this.awaitsChallenge || word.length !== kWord || word[0] !== kChallenge) return;
    const tag = siphash(this.key, word.subarray(0, kSigned));
    if (tag.some((half, i) => half !== viewOf(word).getUint32(kSigned + 4 * i, true))) return;
    if (this.nonce.some((byte, i) => byte !== word[1 + i])) return;
    this.awaitsChallenge = false;
    const packet = this.#sealed(this.connect);
    const open = new Uint8Array(kSigned + packet.length);
    open.set(word.subarray(0, kSigned));
    open[0] = kOpen;
    open.set(packet, kSigned);
    this.put(open);
  }
  #number(packet, number) {
    viewOf(packet).setUint32(0, number % 2 ** 32, true);
    viewOf(packet).setUint32(4, Math.floor(number / 2 ** 32), true);
  }
  #sealed(enets) {
    const packet = new Uint8Array(kTag + enets.length);
    packet.set(enets, kTag);
    this.#number(packet, this.sent);
    const [low, high] = siphash(this.out, packet);
    const view = viewOf(packet);
    view.setUint16(0, this.sent++ % kNumbers);
    view.setUint32(2, low, true);
    view.setUint16(6, high & 0xffff, true);
    return packet;
  }
  #opens(packet) {
    const view = viewOf(packet);
    const low = view.getUint32(2, true), high = view.getUint16(6, true);
    let number = this.end - this.end % kNumbers + view.getUint16(0);
    if (number + kNumbers / 2 < this.end) number += kNumbers;
    else if (number >= this.end + kNumbers / 2 && number >= kNumbers) number -= kNumbers;
    if (number < this.end && (this.end - number > kWindow || this.come[number % kWindow] === number)) return false;
    this.#number(packet, number);
    const tag = siphash(this.in, packet);
    if (tag[0] !== low || (tag[1] & 0xffff) !== high) return false;
    this.come[number % kWindow] = number;
    this.end = Math.max(this.end, number + 1);
    return true;
  }
}
