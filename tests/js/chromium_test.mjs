// Every frame of hello in headless Chromium has Node's hash: node chromium_test.mjs FOLDER. 77: there is no Chromium.
// SPDX-License-Identifier: MIT

import {spawn} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, rmSync, statSync} from 'node:fs';
import {createServer} from 'node:http';
import {tmpdir} from 'node:os';
import {delimiter, dirname, join, normalize} from 'node:path';
import {fileURLToPath} from 'node:url';

import {done, equal, folder, packaged, scalars} from './checks.mjs';
import {playHello} from './hello.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const places = ['chromium', 'chromium-browser', 'google-chrome'].flatMap(name =>
  (process.env.PATH ?? '').split(delimiter).map(path => join(path, name)));
const browser = process.env.CHROMIUM ?? places.find(existsSync);
if (browser === undefined) {
  console.error('no Chromium');
  process.exit(77);
}

const page = `<!doctype html><meta charset="utf-8"><title>hello</title><script type="module">
const send = said => fetch('/said', {method: 'POST', body: JSON.stringify(said)});
try {
  const {load} = await import('/isostep/lib/index.js');
  const {playHello} = await import('/hello.mjs');
  const hashes = {};
  for (const scalar of ${JSON.stringify(scalars)}) hashes[scalar] = playHello(await load(scalar)).hashes;
  send({hashes});
} catch (error) {
  send({error: String(error.stack ?? error)});
}
</script>`;
const types = {'.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm'};

/** What the page says: served to this machine alone, on a port of its own. */
const said = await new Promise((resolve, reject) => {
  const profile = mkdtempSync(join(tmpdir(), 'isostep-chromium-'));
  let child, messages = '';
  const server = createServer((request, response) => {
    if (request.method === 'POST') {
      const pieces = [];
      request.on('data', piece => pieces.push(piece));
      request.on('end', () => {
        response.end();
        child.once('close', () => rmSync(profile, {recursive: true, force: true, maxRetries: 5}));
        child.kill();
        server.closeAllConnections();
        server.close();
        resolve(JSON.parse(Buffer.concat(pieces)));
      });
      return;
    }
    const path = normalize(request.url);
    const file = path.startsWith('/isostep/') ? join(folder, 'node_modules', path) : join(here, path);
    const found = path !== '/' && existsSync(file) && statSync(file).isFile();
    const type = path === '/' ? 'text/html' : types[/\.\w+$/.exec(path)?.[0]] ?? 'text/plain';
    response.writeHead(path === '/' || found ? 200 : 404, {'Content-Type': type});
    response.end(path === '/' ? page : found ? readFileSync(file) : '');
  });
  server.listen(0, '127.0.0.1', () => {
    child = spawn(browser, [
      '--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--no-first-run',
      '--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1', `--user-data-dir=${profile}`,
      `http://127.0.0.1:${server.address().port}/`
    ], {stdio: ['ignore', 'ignore', 'pipe']});
    child.stderr.on('data', text => { messages = (messages + text).slice(-2000); });
    child.on('error', reject);
    child.on('exit', code => code !== null && reject(new Error(`the browser ends with ${code}: ${messages}`)));
  });
});

equal(said.error, undefined, 'the page');
const {load} = await packaged('isostep');
for (const scalar of scalars) {
  equal(said.hashes?.[scalar], playHello(await load(scalar)).hashes, `${scalar} in Chromium`);
}
done(`360 frames of ${scalars.join(', ')} in Chromium are Node's`);
