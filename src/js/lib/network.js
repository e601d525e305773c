// The simulated network in virtual time, for tests and testbeds: endpoint 0 is the host, clients follow.
// SPDX-License-Identifier: MIT

import {Handle} from './handle.js';

/** A network between sessions of one engine; the fate of their packets depends on the seed alone. */
export class SimulatedNetwork extends Handle {
  #calls;
  static create(calls, seed) {
    calls.begin();
    const out = calls.take(4);
    calls.call('iso_network_create', BigInt.asUintN(64, BigInt(seed)), out);
    return new SimulatedNetwork(calls, calls.module.view.getUint32(out, true));
  }
  constructor(calls, at) {
    super(calls.module, at, 'iso_network_destroy', 'network');
    this.#calls = calls;
  }
  #run(name, ...words) { this.#calls.call(name, this.at, ...words); }

  /** Adds an endpoint on a line: 'wifi', 'latency=80,jitter=20,loss=5' ([ms], [ms], [%]); returns its number. */
  addClient(profile) {
    this.#calls.begin();
    const text = this.#calls.placeText(profile, 'profile'), out = this.#calls.take(4);
    this.#run('iso_network_add_client', text, out);
    return this.module.view.getUint32(out, true);
  }
  setProfile(client, profile) {
    this.#calls.begin();
    this.#run('iso_network_set_profile', client, this.#calls.placeText(profile, 'profile'));
  }
  connect(from, to = 0) { this.#run('iso_network_connect', from, to); }
  /** Cuts a connection; both sides hear it now. */
  cut(client) { this.#run('iso_network_cut', client); }
  /** Silences an endpoint, as if the cable were pulled. */
  setSilent(endpoint, silent) { this.#run('iso_network_set_silent', endpoint, silent ? 1 : 0); }
  /** Puts an endpoint on a side; those of different sides do not meet. */
  setSide(endpoint, side) { this.#run('iso_network_set_side', endpoint, side); }
  /** [us] Lets everything due until then happen. */
  advanceTo(now) { this.#run('iso_network_advance_to', BigInt(Math.floor(now))); }
  /** Deliver comes before, dispatch after a session's drive. */
  deliver(endpoint, session, now) { this.#run('iso_network_deliver', endpoint, session.at, BigInt(Math.floor(now))); }
  dispatch(endpoint, session, now) { this.#run('iso_network_dispatch', endpoint, session.at, BigInt(Math.floor(now))); }
}
