// Reads the sessions' structs and enumerations from isostep.h, where they are written by hand.
// SPDX-License-Identifier: MIT

const camel = name => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());
const kSizes = {uint8_t: 1, int8_t: 1, char: 1, uint16_t: 2, int16_t: 2, uint32_t: 4, int32_t: 4, uint64_t: 8, int64_t: 8};
const kKinds = {uint8_t: 'u8', uint16_t: 'u16', uint32_t: 'u32', int32_t: 'i32', uint64_t: 'u64', int64_t: 'i64'};

/** What the names of an enumeration begin with, where it is more than ISO_. */
const kPrefixes = {
  event_kind: 'ISO_EVENT_', phase: 'ISO_(PHASE_)?', proposal: 'ISO_VOTE_', recording: 'ISO_RECORD_', request_kind: 'ISO_(FRAME_)?'
};
/** Members that are truth values, which C says in comments alone. */
const kBools = {
  session_config: ['host', 'relays', 'repair', 'asks_admission', 'votes', 'players_set_tempo'],
  applicant: ['spectator'],
  outgoing: ['close']
};

function enumsOf(text) {
  const made = {};
  for (const [, name, body] of text.matchAll(/typedef uint32_t iso_(\w+);\s*enum \{([^}]*)\}/g)) {
    const prefix = new RegExp(`^${kPrefixes[name] ?? 'ISO_'}`);
    made[name] = {};
    let value = 0;
    for (const item of body.replace(/\/\*[^]*?\*\//g, '').split(',').map(one => one.trim()).filter(Boolean)) {
      const [word, number] = item.split('=').map(one => one.trim());
      if (number !== undefined) value = Number(number);
      made[name][word.replace(prefix, '').toLowerCase()] = value++;
    }
  }
  return made;
}

/** [{type, name, count, comment}] of a struct's body. */
function membersOf(body) {
  const members = [];
  for (const [, type, name, count, comment] of
    body.matchAll(/(\w+)\s+(\w+)(?:\[(\d+)\])?;[ \t]*(?:\/\*([^]*?)\*\/)?/g)) {
    members.push({type, name, count: count && Number(count), comment: comment?.replace(/\s+/g, ' ').trim()});
  }
  return members;
}

function layoutOf(name, members, enums) {
  let end = 0, align = 1;
  const places = new Map();
  for (const {type, name: member, count} of members) {
    const size = Object.hasOwn(enums, type.slice(4)) ? 4 : kSizes[type];
    if (size === undefined) throw new Error(`${name}.${member}: no size of ${type}`);
    end = Math.ceil(end / size) * size;
    align = Math.max(align, size);
    places.set(member, end);
    end += size * (count ?? 1);
  }
  const fields = members.map(({type, name: member, count}) => {
    const at = places.get(member), used = places.get(`${member}_size`);
    if (member === 'size' || member.startsWith('reserved')) return undefined;
    if (type === 'uint8_t' && count && used !== undefined) return [camel(member), 'bytes', at, count, used];
    if (member.endsWith('_size') && places.has(member.slice(0, -5))) return undefined;
    if (type === 'char') return [camel(member), 'text', at, count];
    const kind = kBools[name]?.includes(member) ? 'bool' : kKinds[type] ?? type.slice(4);
    return count ? [camel(member), kind, at, count] : [camel(member), kind, at];
  });
  return {size: Math.ceil(end / align) * align, sized: true, fields: fields.filter(Boolean)};
}

export function readSessions(header) {
  const text = /\/\* Sessions \*\/([^]*)\/\* End of sessions \*\//.exec(header)[1];
  const structs = {}, comments = {}, enums = enumsOf(text);
  for (const [, name, body] of text.matchAll(/typedef struct iso_(\w+) \{([^}]*)\}/g)) {
    if (name === 'game' || name === 'input') continue;  // pointers, and what is read in place: session.js
    const members = membersOf(body);
    structs[name] = layoutOf(name, members, enums);
    comments[name] = Object.fromEntries(members.map(one => [camel(one.name), one.comment]));
    if (new RegExp(`iso_${name}_init\\(`).test(text)) structs[name].init = `${name}_init`;
  }
  return {structs, enums, comments};
}
