// In the page: fetches the program and its files, runs it, sends the server what it prints and how it ends.
// SPDX-License-Identifier: MIT

import {Wasi} from './wasi_shim.mjs';

const kChunk = 65536;  // bytes of output that wait at most

/// Synchronous, so that outputs arrive in their order while the program runs.
function post(path, body) {
  const request = new XMLHttpRequest();
  request.open('POST', path, false);
  request.send(body);
}

class Output {
  constructor(path) {
    this.path = path;
    this.pieces = [];
    this.size = 0;
  }
  write(bytes) {
    this.pieces.push(bytes);
    this.size += bytes.length;
    if (this.size >= kChunk) this.flush();
  }
  flush() {
    if (this.size !== 0) post(this.path, new Blob(this.pieces));
    this.pieces = [];
    this.size = 0;
  }
}

const bytesOf = async path => new Uint8Array(await (await fetch(path)).arrayBuffer());

async function run() {
  const {args, files} = await (await fetch('job')).json();
  const contents = new Map();
  for (const [i, name] of files.entries()) contents.set(name, await bytesOf(`file/${i}`));
  const outputs = {1: new Output('stdout'), 2: new Output('stderr')};
  const wasi = new Wasi(args, contents, (descriptor, bytes) => outputs[descriptor].write(bytes));
  try {
    const module = await WebAssembly.compile(await bytesOf('module'));
    return wasi.start(await WebAssembly.instantiate(module, wasi.imports()));
  } finally {
    outputs[1].flush();
    outputs[2].flush();
  }
}

run().then(code => post('exit', String(code)), error => post('failed', String(error.stack ?? error)));
