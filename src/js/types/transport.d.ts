// Ways from session to session: isostep/websocket, isostep/data-channel, isostep/enet.
// SPDX-License-Identifier: MIT

export type Arrival = {kind: 'connected', peer: number, incoming: boolean} | {kind: 'disconnected', peer: number}
  | {kind: 'message', peer: number, channel: 0 | 1, bytes: Uint8Array};

/** What deliver and dispatch take; a game may bring its own. */
export interface Endpoint {
  /** False: not connected, or too large. */
  send(peer: number, channel: 0 | 1, bytes: Uint8Array): boolean;
  receive(): Arrival | null;
  disconnect(peer: number): void;
  /** Where a session names other machines: one more connection. */
  connectTo?(address: string): void;
}
interface Transport extends Endpoint {
  /** Ends all connections. */
  close(): void;
}

/** A browser's WebSocket, or one of the package `ws`. */
interface SocketLike {
  readonly readyState: number;
  readonly bufferedAmount: number;
  send(data: Uint8Array): void;
  close(code?: number): void;
  addEventListener(type: string, listener: (event: any) => void): void;
}
export interface WebSocketOptions {
  maxPeers?: number;
  /** In Node before 22: that of the package `ws`. */
  WebSocket?: new (address: string) => any;
}
export class WebSocketTransport implements Transport {
  constructor(options?: WebSocketOptions);
  /** Accepts the connections of a `ws` WebSocketServer. */
  static listen(server: {on(event: 'connection', listener: (socket: any) => void): unknown},
    options?: WebSocketOptions): WebSocketTransport;
  static connect(address: string, options?: WebSocketOptions): WebSocketTransport;
  connectTo(address: string): void;
  /** A socket of the game's own. */
  attach(socket: SocketLike, incoming: boolean): void;
  send(peer: number, channel: 0 | 1, bytes: Uint8Array): boolean;
  receive(): Arrival | null;
  disconnect(peer: number): void;
  close(): void;
}

/** As much of RTCPeerConnection as is used: a browser's own, or node-datachannel/polyfill's. */
interface ConnectionLike {
  readonly connectionState: string;
  createDataChannel(label: string,
    options: {negotiated: boolean, id: number, ordered?: boolean, maxRetransmits?: number}): any;
  addEventListener(type: any, listener: (event: any) => void): void;
  close(): void;
}
export class DataChannelTransport implements Transport {
  constructor(options?: {maxPeers?: number});
  /** On both sides, before the offer or answer is made. `incoming`: the other side asked for it. */
  attach(connection: ConnectionLike, incoming: boolean): void;
  send(peer: number, channel: 0 | 1, bytes: Uint8Array): boolean;
  receive(): Arrival | null;
  disconnect(peer: number): void;
  close(): void;
}
/** Offer, answer and candidates as JSON over an open WebSocket. `offers`: on one side of the two. */
export function connectBySocket(connection: ConnectionLike, socket: SocketLike, offers: boolean): Promise<void>;

export interface EnetOptions {
  maxPeers?: number;
  timeout?: number;
  key?: Uint8Array;
}
/** In Node alone: to native hosts over UDP, as their own clients. */
export class EnetTransport implements Transport {
  /** timeout: [ms] without a word until a peer is gone; key: the host's EnetSettings::key, 16 bytes. */
  constructor(options?: EnetOptions);
  /** "192.0.2.7:4000" */
  static connect(address: string, options?: EnetOptions): EnetTransport;
  connectTo(address: string): number | undefined;
  send(peer: number, channel: 0 | 1, bytes: Uint8Array): boolean;
  receive(): Arrival | null;
  disconnect(peer: number): void;
  close(): void;
}

/** In Node alone: clients of `listener` play with the native host at `address`, each by a connection of its own. key:
 * the host's EnetSettings::key, 16 bytes. */
export function bridge(listener: WebSocketTransport | DataChannelTransport, address: string,
  options?: {key?: Uint8Array}): {close(): void};
