// The exception that the package throws: one class, with the engine's own words for the place and the rule.
// SPDX-License-Identifier: MIT

/** A refused call. `status` is the C interface's: above 0 the world's fault, below 0 misuse. */
export class IsostepError extends Error {
  /** @param {{status: number, reason: string, command?: string, field?: string, expected?: string}} report */
  constructor({status, reason, command = '', field = '', expected = ''}) {
    const place = [command, field].filter(Boolean).join(': ');
    super(`${place}${place && ': '}${reason}${expected && `; expected ${expected}`}`);
    this.name = 'IsostepError';
    this.status = status;
    this.command = command;
    this.field = field;
    this.expected = expected;
  }
}

/** Misuse that is found before the engine is called. The numbers are those of isostep.h. */
export const kBadEnum = -8, kNotAlive = -9, kBadArgument = -100;

/** A value that cannot be written into `field`. The command is added where it is known. */
export function badValue(field, expected, value) {
  const shown = typeof value === 'bigint' ? `${value}n` : typeof value === 'string' ? `"${value}"` : String(value);
  return new IsostepError({status: kBadArgument, reason: `${shown} is not that`, field, expected});
}

/** Runs `write`; an error that it throws names the command too. */
export function within(command, write) {
  try {
    return write();
  } catch (error) {
    if (!(error instanceof IsostepError) || error.command !== '') throw error;
    const {status, field, expected, message} = error;
    const reason = message.slice(field ? field.length + 2 : 0).replace(/; expected .*$/, '');
    throw new IsostepError({status, reason, command, field, expected});
  }
}
