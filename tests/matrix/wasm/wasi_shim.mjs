// As much of WASI (preview 1) as a program needs that reads files, prints and ends: for pages, which have none of it.
// SPDX-License-Identifier: MIT
//
// Source: WASI preview 1, "wasi_snapshot_preview1" (witx): argument order, record layouts, error numbers. Files are
// bytes in memory under the names that the arguments give them; nothing can be written but stdout and stderr. Every
// call that is not here answers ENOSYS.

const kSuccess = 0, kBadDescriptor = 8, kInvalid = 28, kNoEntry = 44, kNoSystemCall = 52;
const kCharacterDevice = 2, kDirectory = 3, kRegularFile = 4;
const kFolder = 3;  // the descriptor of the one folder, "/", in which every file is
const kAllRights = 0xffffffffffffffffn;

/// What proc_exit throws.
export class Exit {
  constructor(code) { this.code = code; }
}

const plain = name => name.replace(/^(\.?\/)+/, '');

export class Wasi {
  /// args: words, the program's name first. files: name -> Uint8Array, "-" is stdin. write(descriptor, bytes).
  constructor(args, files, write) {
    this.args = args.map(word => new TextEncoder().encode(word + '\0'));
    this.files = new Map([...files].map(([name, bytes]) => [plain(name), bytes]));
    this.write = write;
    const stdin = {kind: kCharacterDevice, bytes: files.get('-') ?? new Uint8Array(), at: 0};
    this.open = [stdin, {kind: kCharacterDevice}, {kind: kCharacterDevice}, {kind: kDirectory}];
  }

  imports() {
    const known = {};
    for (const name of Object.getOwnPropertyNames(Wasi.prototype)) {
      if (/^(args|clock|environ|fd|path|proc|random)_/.test(name)) known[name] = this[name].bind(this);
    }
    return {wasi_snapshot_preview1: new Proxy(known, {get: (calls, name) => calls[name] ?? (() => kNoSystemCall)})};
  }

  /// Runs _start; what main returns or exit was given.
  start(instance) {
    this.memory = instance.exports.memory;
    try {
      instance.exports._start();
    } catch (thrown) {
      if (thrown instanceof Exit) return thrown.code;
      throw thrown;
    }
    return 0;
  }

  get view() { return new DataView(this.memory.buffer); }
  set32(at, value) { this.view.setUint32(at, value, true); }
  set64(at, value) { this.view.setBigUint64(at, BigInt(value), true); }
  bytes(at, size) { return new Uint8Array(this.memory.buffer, at, size); }
  /// The pieces of a vector of buffers.
  pieces(at, count) {
    return Array.from({length: count}, (_, i) =>
      this.bytes(this.view.getUint32(at + 8 * i, true), this.view.getUint32(at + 8 * i + 4, true)));
  }

  args_sizes_get(count, size) {
    this.set32(count, this.args.length);
    this.set32(size, this.args.reduce((sum, word) => sum + word.length, 0));
    return kSuccess;
  }
  args_get(pointers, text) {
    for (const [i, word] of this.args.entries()) {
      this.set32(pointers + 4 * i, text);
      this.bytes(text, word.length).set(word);
      text += word.length;
    }
    return kSuccess;
  }
  environ_sizes_get(count, size) {
    this.set32(count, 0);
    this.set32(size, 0);
    return kSuccess;
  }
  environ_get() { return kSuccess; }
  clock_res_get(clock, result) {
    this.set64(result, 1000000);
    return kSuccess;
  }
  clock_time_get(clock, precision, result) {
    const milliseconds = clock === 0 ? Date.now() : performance.now();
    this.set64(result, Math.round(milliseconds * 1e6));
    return kSuccess;
  }
  proc_exit(code) { throw new Exit(code); }

  fd_write(descriptor, vectors, count, written) {
    if (descriptor !== 1 && descriptor !== 2) return kBadDescriptor;
    let size = 0;
    for (const piece of this.pieces(vectors, count)) {
      this.write(descriptor, piece.slice());
      size += piece.length;
    }
    this.set32(written, size);
    return kSuccess;
  }
  fd_read(descriptor, vectors, count, read) {
    const file = this.open[descriptor];
    if (file?.bytes === undefined) return kBadDescriptor;
    let size = 0;
    for (const piece of this.pieces(vectors, count)) {
      const part = file.bytes.subarray(file.at, file.at + piece.length);
      piece.set(part);
      file.at += part.length;
      size += part.length;
    }
    this.set32(read, size);
    return kSuccess;
  }
  fd_seek(descriptor, offset, whence, result) {
    const file = this.open[descriptor];
    if (file?.kind !== kRegularFile) return kBadDescriptor;
    const from = [0, file.at, file.bytes.length][whence];
    if (from === undefined || from + Number(offset) < 0) return kInvalid;
    file.at = from + Number(offset);
    this.set64(result, file.at);
    return kSuccess;
  }
  fd_close(descriptor) {
    if (this.open[descriptor] === undefined) return kBadDescriptor;
    this.open[descriptor] = undefined;
    return kSuccess;
  }
  fd_fdstat_get(descriptor, result) {
    const file = this.open[descriptor];
    if (file === undefined) return kBadDescriptor;
    this.bytes(result, 24).fill(0);
    this.view.setUint8(result, file.kind);
    this.set64(result + 8, kAllRights);
    this.set64(result + 16, kAllRights);
    return kSuccess;
  }
  fd_filestat_get(descriptor, result) {
    const file = this.open[descriptor];
    if (file === undefined) return kBadDescriptor;
    this.bytes(result, 64).fill(0);
    this.view.setUint8(result + 16, file.kind);
    this.set64(result + 32, file.bytes?.length ?? 0);
    return kSuccess;
  }
  fd_prestat_get(descriptor, result) {
    if (descriptor !== kFolder) return kBadDescriptor;
    this.set32(result, 0);
    this.set32(result + 4, 1);
    return kSuccess;
  }
  fd_prestat_dir_name(descriptor, text, size) {
    if (descriptor !== kFolder || size < 1) return kBadDescriptor;
    this.bytes(text, 1)[0] = '/'.charCodeAt(0);
    return kSuccess;
  }
  path_open(folder, lookup, text, size, flags, rights, inheriting, descriptorFlags, result) {
    const bytes = this.files.get(plain(new TextDecoder().decode(this.bytes(text, size).slice())));
    if (folder !== kFolder) return kBadDescriptor;
    if (bytes === undefined) return kNoEntry;
    this.set32(result, this.open.push({kind: kRegularFile, bytes, at: 0}) - 1);
    return kSuccess;
  }
}
