// The layouts that generate.mjs makes: places are those of interface.json in every family:
// node interface_test.mjs REPOSITORY
// SPDX-License-Identifier: MIT

import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';

const js = join(process.argv[2], 'src/js');
const made = mkdtempSync(join(tmpdir(), 'isostep-js-'));
execFileSync(process.execPath, [join(js, 'generate.mjs'), made], {stdio: 'inherit'});
let failures = 0;
const fail = what => {
  ++failures;
  console.error(what);
};

const {interfaceSchema} = await import(pathToFileURL(join(made, 'lib/generated/interface.js')));
const {Layouts} = await import(pathToFileURL(join(js, 'lib/layout.js')));
const {numbersOf} = await import(pathToFileURL(join(js, 'lib/numbers.js')));
const {structs} = JSON.parse(readFileSync(join(process.argv[2], 'src/c/interface.json'), 'utf8'));
rmSync(made, {recursive: true});
const camel = name => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());

// Each number of a struct is written by its name, and read where C has it.
let members = 0;
for (const scalar of ['f32', 'f64', 'q16', 'q32']) {
  const numbers = numbersOf(scalar, false), layouts = new Layouts(interfaceSchema, numbers);
  for (const struct of structs.filter(({family}) => family === '' || family === scalar)) {
    const codec = layouts.of(struct.base);
    const isPart = ['vec3', 'unit_vec3', 'quat'].includes(struct.base);
    const size = struct.size32 ?? struct.size;  // pointers have four bytes
    if (codec.size !== size) fail(`${struct.name}: ${codec.size} bytes instead of ${size}`);
    for (const {name, kind, count, offset: wide, offset32: offset = wide} of isPart ? [] : struct.members) {
      const known = interfaceSchema.structs[struct.base].fields.some(([key]) => key === camel(name));
      if (!['number', 'unit', 'word', 'u32', 'i32'].includes(kind) || count !== undefined || !known) continue;
      const view = new DataView(new ArrayBuffer(struct.size));
      codec.write(view, 0, {[camel(name)]: 1});
      const found = kind === 'number' ? numbers.scalar.read(view, offset)
        : kind === 'unit' ? numbers.unit.read(view, offset) : view.getUint32(offset, true);
      if (found !== 1) fail(`${struct.name}.${name}: not at ${offset}`);
      ++members;
    }
  }
}
if (members < 500) fail(`${members} members are compared`);
console.log(failures === 0 ? `${members} members lie where C has them` : `${failures} failures`);
process.exit(failures === 0 ? 0 : 1);
