// The commands peer and relay: the options of each; each returns an exit status.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace isostep::tool {

struct PeerOptions {
  int listen = -1;                    // port, 0: any; -1: connect instead
  std::string connect;                // HOST:PORT; with migration such a peer listens as well
  std::string port_file;              // where who listens writes its port
  int migration = 0;                  // [s] of the host's silence after which the match goes on without it; 0: never
  std::string address = "127.0.0.1";  // with migration: where the others reach this machine
  int players = 2;
  bool spectate = false;
  bool lockstep = false;
  std::string scalar = "q32.32";
  int frames = 600;  // confirmed, then the peer leaves
  int window = 8, delay = 2;
  int pile = 40;                       // bodies of the match
  std::uint64_t match_seed = 1;        // of the match; all peers the same
  std::uint64_t bot = 1;               // seed of this peer's player
  std::string inputs;                  // file of inputs instead: one a line, "x z buttons aim"
  std::string profile;                 // what befalls this peer's packets
  std::string hashes, record, bundle;  // files, or empty
  bool trace = false;                  // stage hashes in bundles
  int fault = -1;                      // frame of an injected fault: one bit of one body is flipped
  int patience = 0;                    // [s] that a silent peer is waited for; 0: the session's and the transport's own
  int replayed = -1;                   // [frames] that a late joiner steps itself, at most; -1: the session's own
  int reservation = -1;                // [s] that a host keeps a seat for who is gone; -1: the session's own
  bool json = false;
};
int command_peer(const PeerOptions& options);

struct RelayOptions {
  int listen = 0;
  std::string bind = "127.0.0.1";
  std::string target;  // HOST:PORT
  std::string profile = "mobile";
  std::uint64_t seed = 1;
  std::string port_file;
};
int command_relay(const RelayOptions& options);

}  // namespace isostep::tool
