// What the tests of the package share: where it is, and checks that say what differs.
// SPDX-License-Identifier: MIT

import {existsSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

/** The folder into which npm has installed the package beside ws, node-datachannel and typescript. */
export const folder = resolve(process.argv[2] ?? '.');
const require = createRequire(join(folder, 'test.cjs'));

/** A package as a game that lies in the folder imports it. */
export async function packaged(name) {
  const [, scope, path = ''] = /^(isostep|[^/]+)(\/.*)?$/.exec(name);
  if (scope !== 'isostep') return require(name);
  const {exports} = require('isostep/package.json');
  return import(pathToFileURL(join(folder, 'node_modules/isostep', exports[`.${path}`].default)).href);
}
export const scalars = ['f32', 'f64', 'q16', 'q32'].filter(scalar =>
  existsSync(join(folder, `node_modules/isostep/wasm/isostep.${scalar}.wasm`)));
if (scalars.length === 0) throw new Error(`no module in ${folder}/node_modules/isostep/wasm`);
/** The exactest scalar that was built. */
export const exactest = scalars.at(-1);

let failures = 0;
export function check(is, what) {
  if (is) return;
  ++failures;
  console.error(`FAILED: ${what}`);
}
const shown = value => JSON.stringify(value, (_, one) => typeof one === 'bigint' ? `${one}n` : one);
export const equal = (found, expected, what) =>
  check(shown(found) === shown(expected), `${what}: ${shown(found)} instead of ${shown(expected)}`);
/** `call` throws what `matches` says of it. */
export function throws(call, expected, what) {
  try {
    call();
  } catch (error) {
    for (const [key, value] of Object.entries(expected)) {
      const is = value instanceof RegExp ? value.test(error[key]) : error[key] === value;
      check(is, `${what}: ${key} is ${error[key]} (${error})`);
    }
    return;
  }
  check(false, `${what} is not refused`);
}
/** To be called last. */
export function done(what) {
  console.log(failures === 0 ? what : `${failures} checks failed`);
  process.exit(failures === 0 ? 0 : 1);
}
