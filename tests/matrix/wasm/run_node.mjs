// Runs a WASI program in Node: node --no-warnings run_node.mjs MODULE.wasm ARGUMENTS...
// SPDX-License-Identifier: MIT
//
// Standard input and output are this process's, the program's exit code is handed on, and it may open what is in the
// current folder or in the folder of a file that an argument names absolutely. 64: called without a module; 70: the
// module does not run.

import {existsSync} from 'node:fs';
import {readFile} from 'node:fs/promises';
import {dirname, isAbsolute} from 'node:path';
import {setFlagsFromString} from 'node:v8';
import {WASI} from 'node:wasi';

// Node's WASI may collect garbage within a fast call, where V8 allows none: a program that ran for long then crashes as
// it returns (nodejs/node#46777).
setFlagsFromString('--no-turbo-fast-api-calls');

const [path, ...words] = process.argv.slice(2);
if (path === undefined) {
  console.error('usage: node run_node.mjs MODULE.wasm ARGUMENTS...');
  process.exit(64);
}
const folders = ['.', ...words.filter(word => isAbsolute(word) && existsSync(word)).map(dirname)];
const preopens = Object.fromEntries(folders.map(folder => [folder, folder]));
try {
  const wasi = new WASI({version: 'preview1', args: [path, ...words], preopens, returnOnExit: true});
  const module = await WebAssembly.compile(await readFile(path));
  process.exitCode = wasi.start(await WebAssembly.instantiate(module, wasi.getImportObject()));
} catch (error) {
  console.error(`${path}: ${error.stack ?? error}`);
  process.exitCode = 70;
}
