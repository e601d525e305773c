// The part of WASI (preview 1) that the engine's module asks for: libc's own start, and nothing that the engine uses.
// SPDX-License-Identifier: MIT
//
// Source: WASI preview 1, "wasi_snapshot_preview1" (witx). The engine opens no file, reads no clock and prints nothing:
// there are no files and no environment here. The text that libc writes as it aborts goes to console.error, and every
// other call is refused.

const kSuccess = 0, kBadDescriptor = 8, kNoSystemCall = 52;

/** The imports for a module; `memory()` is its memory, once it has one. */
export function wasiImports(memory) {
  const view = () => new DataView(memory().buffer);
  const nothing = (count, size) => {
    view().setUint32(count, 0, true);
    view().setUint32(size, 0, true);
    return kSuccess;
  };
  const calls = {
    args_sizes_get: nothing,
    environ_sizes_get: nothing,
    args_get: () => kSuccess,
    environ_get: () => kSuccess,
    fd_prestat_get: () => kBadDescriptor,
    fd_prestat_dir_name: () => kBadDescriptor,
    proc_exit(code) { throw new WebAssembly.RuntimeError(`isostep: the engine ended with ${code}`); },
    fd_write(descriptor, vectors, count, written) {
      if (descriptor !== 1 && descriptor !== 2) return kBadDescriptor;
      let size = 0, text = '';
      for (let i = 0; i < count; ++i) {
        const length = view().getUint32(vectors + 8 * i + 4, true);
        const at = view().getUint32(vectors + 8 * i, true);
        text += new TextDecoder().decode(new Uint8Array(memory().buffer, at, length));
        size += length;
      }
      console.error(text.trimEnd());
      view().setUint32(written, size, true);
      return kSuccess;
    }
  };
  return {wasi_snapshot_preview1: new Proxy(calls, {get: (known, name) => known[name] ?? (() => kNoSystemCall)})};
}
