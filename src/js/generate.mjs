// Writes lib/generated/interface.js and types/generated.d.ts from src/c/interface.json into a copy of this folder:
// node generate.mjs FOLDER. build.sh makes them for the package.
// SPDX-License-Identifier: MIT

import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const to = process.argv[2];
if (to === undefined) {
  console.error('usage: node generate.mjs FOLDER');
  process.exit(64);
}
const described = JSON.parse(readFileSync(join(here, '../c/interface.json'), 'utf8'));

const camel = name => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());
const pascal = name => camel(`_${name}`);
const bare = name => name.replace(/^iso_((f32|f64|q16|q32)_)?/, '');

// ---- layouts

/** What C's names of enumerators begin with where the enumeration says it already. */
const kPrefixes = {
  event_kind: 'event_', phase: 'phase_', proposal: 'vote_', recording: 'record_', request_kind: 'frame_'
};
/** Members of a byte that are truth values, which C says in comments alone. */
const kBools = {
  session_config: ['host', 'relays', 'repair', 'asks_admission', 'votes', 'players_set_tempo'],
  applicant: ['spectator'],
  outgoing: ['close']
};

/** Places of the families with numbers of four bytes and of eight: one number where they are the same. */
function place(pick) {
  const [four, same, eight, equal] = ['f32', 'q16', 'f64', 'q32'].map(pick);
  if (four !== same || eight !== equal) throw new Error('families of one size differ');
  return four === eight ? four : [four, eight];
}

/** [key, kind, place, count, partner's place] of a member; undefined: it is not JavaScript's concern. */
function member(struct, i, offset) {
  const {name, of, count} = struct.members[i];
  const kind = kBools[struct.base]?.includes(name) ? 'bool' : struct.members[i].kind;
  const find = other => struct.members.findIndex(one => one.name === other);
  if (kind === 'reserved' || /^reserved\d*$/.test(name) || (struct.sized && i === 0)) return undefined;
  const used = find(`${name}_size`);  // bytes of which so many count
  if (kind === 'u8' && count && used >= 0) return [camel(name), 'bytes', offset(i), count, offset(used)];
  if (kind !== 'word' && name.endsWith('_size') && find(name.slice(0, -5)) >= 0) return undefined;
  if (kind === 'bool' && name.startsWith('has_') && find(name.slice(4)) >= 0) return undefined;
  const isList = kind === 'pointer' && of !== 'iso_text';
  const element = ['struct', 'enum'].includes(kind) ? bare(of) : isList ? 'list' : kind;
  const has = find(`has_${name}`);
  if (has >= 0) return [camel(name), `optional ${element}`, offset(i), undefined, offset(has)];
  if (element === 'list') {
    const size = find(`${name}_count`);
    if (struct.base !== 'query_filter') return [camel(name), 'pointer', offset(i)];
    return [camel(name), 'list', offset(i), undefined, offset(size)];
  }
  if (/_count$/.test(name) && struct.base === 'query_filter') return undefined;
  if (kind === 'char') return [camel(name), 'text', offset(i), count];
  return count ? [camel(name), element, offset(i), count] : [camel(name), element, offset(i)];
}

const functions = new Set(described.functions.map(one => one.name));
function layouts() {
  const made = {};
  for (const struct of described.structs) {
    if (struct.family !== '' && struct.family !== 'f32') continue;
    const versions = Object.fromEntries(['f32', 'f64', 'q16', 'q32'].map(family => [family, struct.family === ''
      ? struct : described.structs.find(one => one.base === struct.base && one.family === family)]));
    const offset = i => place(family => {  // padding differs, so by name; pointers have four bytes
      const {offset, offset32} = versions[family].members.find(({name}) => name === struct.members[i].name);
      return offset32 ?? offset;
    });
    const init = `${struct.family === '' ? '' : 'P_'}${struct.base}_init${struct.sized ? '_sized' : ''}`;
    made[struct.base] = {
      size: place(family => versions[family].size32 ?? versions[family].size), sized: struct.sized,
      init: functions.has(`iso_${init.replace('P_', 'f32_')}`) ? init : undefined,
      fields: struct.members.map((_, i) => member(struct, i, offset)).filter(Boolean)
    };
  }
  return made;
}

/** Names that functions exist for, in the header's order. */
const named = pattern => described.functions.map(one => pattern.exec(one.name)?.[1]).filter(Boolean);
const flags = Object.fromEntries(described.enums.filter(one => one.flags).map(one =>
  [`${camel(bare(one.name))}s`, Object.fromEntries(one.values.map(({base, value}) => [camel(base), value]))]));
const enums = Object.fromEntries(described.enums.filter(one => !one.flags).map(one => {
  const name = bare(one.name), prefix = new RegExp(`^${kPrefixes[name] ?? ''}`);
  return [name, Object.fromEntries(one.values.map(({base, value}) => [base.replace(prefix, ''), value]))];
}));
const lists = {
  shapes: named(/^iso_f32_(.*)_primitive$/),
  joints: named(/^iso_f32_create_(.*)$/),
  records: named(/^iso_f32_set_(.*)$/).filter(name => !name.endsWith('_input')),
  inputs: named(/^iso_f32_set_(.*)_input$/),
  states: named(/^iso_f32_get_(.*)_state$/)
};
const schema = {abi: described.abi, ...lists, flags, enums, structs: layouts()};

/** As JavaScript, a line each member of what is named. */
function literal(value) {
  if (Array.isArray(value)) return `[${value.map(literal).join(', ')}]`;
  if (value === undefined) return 'undefined';
  if (value === null || typeof value !== 'object') return JSON.stringify(value);
  const members = Object.entries(value).filter(([, one]) => one !== undefined);
  return `{${members.map(([key, one]) => `${key}: ${literal(one)}`).join(', ')}}`;
}
const trimmed = field => field.slice(0, field.findLastIndex(one => one !== undefined) + 1);
const structLine = ([name, {size, sized, init, fields}]) => {
  const rows = fields.map(field => `    ${literal(trimmed(field))}`).join(',\n');
  return `  ${name}: {${literal({size, sized, init}).slice(1, -1)}, fields: [\n${rows}\n  ]}`;
};
const lines = value => Object.entries(value).map(([key, one]) => `    ${key}: ${literal(one)}`).join(',\n');
const warning = '// Written by generate.mjs from src/c: change nothing here.\n// SPDX-License-Identifier: MIT\n';
const code = `// The structs and enumerations of the C interface, as layout.js reads them.
${warning}
export const interfaceSchema = {
  abi: ${schema.abi},
  shapes: ${literal(schema.shapes)},
  joints: ${literal(schema.joints)},
  records: ${literal(schema.records)},
  inputs: ${literal(schema.inputs)},
  states: ${literal(schema.states)},
  flags: {\n${lines(schema.flags)}\n  },
  enums: {\n${lines(schema.enums)}\n  },
  structs: {
${Object.entries(schema.structs).map(structLine).join(',\n').replace(/^/gm, '  ')}
  }
};
`;

// ---- types

const plainTypes = {
  number: 'N', unit: 'N', bool: 'boolean', id: 'bigint', u64: 'bigint', i64: 'bigint', text: 'string',
  bytes: 'Uint8Array',
  vec3: 'Vec3<N>', unit_vec3: 'Vec3<N>', quat: 'Quat<N>'
};
const internal = new Set(['fault_report', 'height_patch', 'height_sheet', 'triangles', 'surface_materials', 'vec3',
  'unit_vec3', 'quat', 'outgoing', 'request', 'game', 'input']);
const isOfNumbers = name => Object.hasOwn(schema.structs, name) &&
  schema.structs[name].fields.some(([, kind]) => usesNumber(kind));
const usesNumber = kind => ['number', 'unit', 'vec3', 'unit_vec3', 'quat'].includes(kind.replace('optional ', '')) ||
  isOfNumbers(kind.replace('optional ', ''));
function typeOf(kind, count) {
  if (kind.startsWith('optional ')) return `${typeOf(kind.slice(9))} | null`;
  if (kind === 'list') return 'readonly (bigint | number)[]';
  if (kind === 'text' || kind === 'bytes') return plainTypes[kind];
  if (Object.hasOwn(plainTypes, kind)) return count ? `${plainTypes[kind]}[]` : plainTypes[kind];
  const one = Object.hasOwn(schema.enums, kind) ? `${pascal(kind)}Name`
    : Object.hasOwn(schema.structs, kind) ? `${pascal(kind)}${isOfNumbers(kind) ? '<N>' : ''}` : 'number';
  return count ? `${one}[]` : one;
}
const commentsOf = name => {
  const {members} = described.structs.find(one => one.base === name);
  return key => members.find(one => camel(one.name) === key)?.comment;
};
function interfaceOf([name, {fields}]) {
  const comment = commentsOf(name);
  const rows = fields.map(([key, kind, , count]) => {
    const says = comment(key);
    return `${says ? `  /** ${says.replace(/ISO_[A-Z]+_FLAG_|ISO_/g, '')} */\n` : ''}  ${key}: ${typeOf(kind, count)};`;
  });
  return `export interface ${pascal(name)}${isOfNumbers(name) ? '<N = number>' : ''} {\n${rows.join('\n')}\n}`;
}
const mapOf = (name, kinds, end = '') => `export interface ${name}<N = number> {\n${kinds.map(kind =>
  `  ${kind}: ${pascal(kind + end)}${isOfNumbers(kind + end) ? '<N>' : ''};`).join('\n')}\n}`;
const types = `// The structs and enumerations of the C interface as TypeScript's.
${warning}
export type Vec3<N = number> = [x: N, y: N, z: N];
export type Quat<N = number> = [x: N, y: N, z: N, w: N];

${Object.entries(schema.enums).map(([name, values]) =>
  `export type ${pascal(name)}Name = ${Object.keys(values).map(word => `'${word}'`).join(' | ')};`).join('\n')}

${Object.entries(schema.flags).map(([name, bits]) => `export interface ${pascal(name)}Bits {\n${
  Object.keys(bits).map(word => `  readonly ${word}: number;`).join('\n')}\n}`).join('\n')}

${mapOf('Shapes', schema.shapes)}
${mapOf('Joints', schema.joints)}
${mapOf('RecordKinds', schema.records)}
${mapOf('RecordInputs', schema.inputs, '_input')}
${mapOf('RecordStates', schema.states, '_state')}

${Object.entries(schema.structs).filter(([name]) => !internal.has(name)).map(interfaceOf).join('\n\n')}
`;

for (const [path, text] of [['lib/generated/interface.js', code], ['types/generated.d.ts', types]]) {
  mkdirSync(dirname(join(to, path)), {recursive: true});
  writeFileSync(join(to, path), text);
}
