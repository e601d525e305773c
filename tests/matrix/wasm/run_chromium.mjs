// Runs a WASI program in headless Chromium: node run_chromium.mjs [--seconds N] MODULE.wasm ARGUMENTS...
// SPDX-License-Identifier: MIT
//
// Serves the page, the module, every argument that names a file and standard input, where it is a file or named "-", on
// a port of its own, to this machine alone. The page sends back what the program prints, which appears here on stdout
// and stderr, and its exit code, which is handed on. Time is real: a browser's virtual time would end a long run early.
// 64: usage; 69: no Chromium; 70: the browser or the module fails, or N seconds (600 unless told) pass.

import {spawn} from 'node:child_process';
import {existsSync, fstatSync, mkdtempSync, readFileSync, rmSync, statSync} from 'node:fs';
import {createServer} from 'node:http';
import {tmpdir} from 'node:os';
import {delimiter, dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const words = process.argv.slice(2);
let seconds = 600;
if (words[0] === '--seconds') seconds = Number(words.splice(0, 2)[1]);
const [module, ...rest] = words;
if (module === undefined || !(seconds > 0)) {
  console.error('usage: node run_chromium.mjs [--seconds N] MODULE.wasm ARGUMENTS...');
  process.exit(64);
}

const names = ['chromium', 'chromium-browser', 'google-chrome', 'chrome'];
const folders = (process.env.PATH ?? '').split(delimiter);
const places = names.flatMap(name => folders.map(folder => join(folder, name)));
const browser = process.env.CHROMIUM ?? places.find(existsSync);
if (browser === undefined) {
  console.error('no Chromium');
  process.exit(69);
}

/// A terminal or a pipe that nobody closes would be waited for.
function inputIsFile() {
  try {
    return fstatSync(0).isFile();
  } catch {
    return false;
  }
}
const isFile = name => name === '-' || (existsSync(name) && statSync(name).isFile());
const files = [...new Set(rest.filter(isFile))];
if (!files.includes('-') && inputIsFile()) files.push('-');
const served = new Map();
try {
  served.set('/', ['text/html', readFileSync(join(here, 'page.html'))]);
  for (const name of ['/worker.mjs', '/wasi_shim.mjs']) {
    served.set(name, ['text/javascript', readFileSync(join(here, name))]);
  }
  served.set('/job', ['application/json', JSON.stringify({args: [module, ...rest], files})]);
  served.set('/module', ['application/wasm', readFileSync(module)]);
  for (const [i, name] of files.entries()) {
    served.set(`/file/${i}`, ['application/octet-stream', readFileSync(name === '-' ? 0 : name)]);
  }
} catch (error) {
  console.error(error.message);
  process.exit(70);
}

const received = {
  '/stdout': bytes => process.stdout.write(bytes),
  '/stderr': bytes => process.stderr.write(bytes),
  '/exit': bytes => end(Number(bytes)),
  '/failed': bytes => fail(bytes.toString()),
};

const server = createServer((request, response) => {
  const pieces = [];
  request.on('data', piece => pieces.push(piece));
  request.on('end', () => {
    if (request.method === 'POST') {
      response.end();
      received[request.url]?.(Buffer.concat(pieces));
      return;
    }
    const [type, content] = served.get(request.url) ?? [];
    response.writeHead(type === undefined ? 404 : 200, {'Content-Type': type ?? 'text/plain'});
    response.end(content);
  });
});

const profile = mkdtempSync(join(tmpdir(), 'isostep-chromium-'));
let child, timer, messages = '';

/// The browser first, for its profile can be removed only when nothing writes there any more.
function end(code) {
  clearTimeout(timer);
  process.exitCode = code;
  child.once('close', () => {
    rmSync(profile, {recursive: true, force: true, maxRetries: 5});
    server.closeAllConnections();
    server.close();
  });
  child.kill();
}
function fail(message) {
  console.error(`${module} in ${browser}: ${message}`);
  end(70);
}

server.listen(0, '127.0.0.1', () => {
  child = spawn(browser, [
    '--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--no-first-run',
    '--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1', `--user-data-dir=${profile}`,
    `http://127.0.0.1:${server.address().port}/`
  ], {stdio: ['ignore', 'ignore', 'pipe']});
  child.stderr.on('data', text => messages = (messages + text).slice(-2000));
  child.on('error', error => fail(error.message));
  child.on('exit', code => {
    if (code !== null && process.exitCode === undefined) fail(`the browser ends with ${code}: ${messages}`);
  });
  timer = setTimeout(() => fail(`no end within ${seconds} seconds`), 1000 * seconds);
});
