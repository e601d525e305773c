// The engine's module: finds it, starts it, and calls it; its memory as views, texts and room for arguments.
// SPDX-License-Identifier: MIT

import {IsostepError, kNotAlive} from './errors.js';
import {wasiImports} from './wasi.js';

/** The files; their names are literal, so that bundlers find them. */
const kFiles = {
  f32: new URL('../wasm/isostep.f32.wasm', import.meta.url),
  f64: new URL('../wasm/isostep.f64.wasm', import.meta.url),
  q16: new URL('../wasm/isostep.q16.wasm', import.meta.url),
  q32: new URL('../wasm/isostep.q32.wasm', import.meta.url)
};
const compiled = new Map();  // promises of modules by their addresses

async function compileResponse(response) {
  if (!response.ok) throw new Error(`isostep: ${response.url}: ${response.status} ${response.statusText}`);
  const type = response.headers.get('Content-Type') ?? '';
  return type.startsWith('application/wasm') ? WebAssembly.compileStreaming(response)
                                             : WebAssembly.compile(await response.arrayBuffer());
}
async function compileAddress(url) {
  if (url.protocol !== 'file:') return compileResponse(await fetch(url));
  const {readFile} = await import(/* webpackIgnore: true */ /* @vite-ignore */ 'node:fs/promises');
  return WebAssembly.compile(await readFile(url));
}
function compileOnce(url) {
  let module = compiled.get(url.href);
  if (module === undefined) {
    compiled.set(url.href, module = compileAddress(url));
    module.catch(() => compiled.delete(url.href));
  }
  return module;
}
async function compile(scalar, source) {
  if (source === undefined) return compileOnce(kFiles[scalar]);
  if (source instanceof WebAssembly.Module) return source;
  if (typeof source === 'string' || source instanceof URL) return compileOnce(new URL(source, import.meta.url));
  if (typeof Response !== 'undefined' && source instanceof Response) return compileResponse(source);
  return WebAssembly.compile(source);
}

/** The smallest module with an instruction of SIMD128. Source: WebAssembly 2.0, binary format. */
const kSimdProbe = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0,
  65, 0, 253, 15, 253, 98, 11]);

/** An instance of the engine, in a memory of its own. */
export class Module {
  static async start(scalar, source) {
    if (!Object.hasOwn(kFiles, scalar)) {
      throw new IsostepError({status: -100, reason: `"${scalar}" is no scalar`, field: 'scalar',
        expected: Object.keys(kFiles).join(', ')});
    }
    if (!WebAssembly.validate(kSimdProbe)) {
      throw new Error('isostep: no SIMD128 here: Node 18, Chrome 91, Firefox 89, Safari 16.4 and later have it');
    }
    let exports;
    const imports = wasiImports(() => exports.memory);
    ({exports} = await WebAssembly.instantiate(await compile(scalar, source), imports));
    exports._initialize();
    return new Module(exports);
  }

  constructor(exports) {
    this.exports = exports;
    this.ended = null;  // what the engine ended with
    this.dataView = new DataView(exports.memory.buffer);
  }

  /** A view of the memory as it is now: a call that allocates may replace it. */
  get view() {
    if (this.dataView.buffer !== this.exports.memory.buffer) this.dataView = new DataView(this.exports.memory.buffer);
    return this.dataView;
  }
  bytes(at, size) { return new Uint8Array(this.exports.memory.buffer, at, size); }

  /** Calls a function of the C interface. Out of memory or broken, the engine ends, and so do all of its worlds. */
  call(name, ...words) {
    if (this.ended !== null) this.#refuse(name);
    try {
      return this.exports[name](...words);
    } catch (error) {
      if (error instanceof WebAssembly.RuntimeError) {
        this.ended = error;
        this.#refuse(name);
      }
      throw error;
    }
  }
  #refuse(command) {
    const reason = `the engine has ended: ${this.ended.message}`;
    throw Object.assign(new IsostepError({status: kNotAlive, reason, command}), {cause: this.ended});
  }

  /** Allocates room that the caller frees. */
  allocate(size) {
    const at = this.call('malloc', size);
    if (at === 0) throw new IsostepError({status: -7, reason: `no memory for ${size} bytes`});
    return at >>> 0;
  }

  /** A text that ends with a zero byte. */
  text(at) {
    if (at === 0) return '';
    const bytes = this.bytes(at, this.exports.memory.buffer.byteLength - at);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }
}

/** WebAssembly's 64-bit results are signed; hashes and ids are not. */
export const unsigned = word => BigInt.asUintN(64, word);
