// Handle: an object in the engine's memory, freed by dispose(), by `using`, or when nothing in JavaScript knows it.
// SPDX-License-Identifier: MIT

import {IsostepError, kNotAlive} from './errors.js';

/** Frees forgotten objects. It comes neither soon nor surely: games dispose of large ones. */
const forgotten = new FinalizationRegistry(({module, at, destroy}) => {
  if (module.ended === null) module.call(destroy, at);
});

export class Handle {
  #at;
  /** `destroy`: the function of the module that frees what is at `at`; `keeps`: what it needs until then. */
  constructor(module, at, destroy, kind, keeps = []) {
    this.#at = at;
    Object.defineProperties(this, {module: {value: module}, destroy: {value: destroy}, kind: {value: kind}});
    forgotten.register(this, {module, at, destroy, keeps}, this);
  }

  /** Its address, for calls. */
  get at() {
    if (this.#at === 0) {
      throw new IsostepError({status: kNotAlive, reason: `the ${this.kind} has been disposed of`, command: this.kind});
    }
    return this.#at;
  }
  get disposed() { return this.#at === 0; }
  /** Frees the object; again it has no effect. */
  dispose() {
    if (this.#at === 0) return;
    const at = this.#at;
    this.#at = 0;
    forgotten.unregister(this);
    if (this.module.ended === null) this.module.call(this.destroy, at);
  }
}
if (Symbol.dispose !== undefined) Handle.prototype[Symbol.dispose] = Handle.prototype.dispose;
