// The words of the demo's program: demo, and the commands of which it is made.
// SPDX-License-Identifier: MIT
#include "tool/common/program.hpp"
#include "tool/demo/commands.hpp"
#include "tool/match/commands.hpp"
#include "tool/verify/commands.hpp"

namespace isostep::tool {
namespace {

class DemoCommands {
 public:
  explicit DemoCommands(CommandLine& line) : line_(line) {
    add_verify();
    add_peer();
    add_relay();
    add_demo();
  }

 private:
  void add_verify() {
    CLI::App* command =
        line_.add("verify", "replay files and compare every frame's hash", [this] { return command_verify(verify_); });
    CLI::Option* goldens = command->add_option("--goldens", verify_.goldens, "print every frame's hash of this scene");
    command->add_option("paths", verify_.paths, "replays, goldens.txt, or directories of them")->excludes(goldens);
    command->add_option("--jobs", verify_.jobs, "files at a time")->check(CLI::Range(1, 256))->capture_default_str();
    command->add_flag("--json", verify_.json, "one JSON object");
    command->add_option("--max-seconds", verify_.max_seconds, "stop after so long")
        ->check(CommandLine::number_between(0.001, 1e6));
    command->add_option("--max-memory", verify_.max_memory, "stop where replaying takes more MiB (Linux)")
        ->check(CLI::Range(1, 1 << 24));
    command->footer(
        "Exits with the worst: 0 verified, 1 diverged, 2 incompatible, 3 truncated, 4 corrupt, 5 stopped by a limit.");
  }
  void add_peer() {
    CLI::App* command =
        line_.add("peer", "one machine of a match over UDP, played by a bot", [this] { return command_peer(peer_); });
    command->add_option("--listen", peer_.listen, "on this UDP port (0: any): the host, with --migration all")
        ->check(CLI::Range(0, 65535));
    command->add_option("--connect", peer_.connect,
                        "HOST:PORT of the host; [ADDRESS]:PORT of IPv6, by a relay of its own");
    CommandLine::add_path(command, "--port-file", peer_.port_file, "write the port of who listens here");
    CLI::Option* migration =
        command
            ->add_option("--migration", peer_.migration,
                         "seconds of the host's silence after which the match goes on at another machine; all alike")
            ->check(CLI::Range(1, 60));
    command->add_option("--address", peer_.address, "IPv4 address at which the others reach this machine")
        ->check(CLI::ValidIPV4)
        ->needs(migration)
        ->capture_default_str();
    command->add_option("--players", peer_.players, "of the match")->check(CLI::Range(1, 8))->capture_default_str();
    command->add_flag("--spectate", peer_.spectate, "watch; a host that watches is a dedicated one");
    command->add_flag("--lockstep", peer_.lockstep, "wait for inputs instead of guessing them");
    CommandLine::add_scalar(command, peer_.scalar);
    command->add_option("--frames", peer_.frames, "leave when so many are final")
        ->check(CLI::Range(1, 1 << 24))
        ->capture_default_str();
    command->add_option("--window", peer_.window, "frames that may be guessed")
        ->check(CLI::Range(0, 30))
        ->capture_default_str();
    command->add_option("--delay", peer_.delay, "frames that an input waits, at first")
        ->check(CLI::Range(0, 20))
        ->capture_default_str();
    command->add_option("--pile", peer_.pile, "bodies in the arena")->check(CLI::Range(0, 4000))->capture_default_str();
    command->add_option("--match-seed", peer_.match_seed, "of the arena")->capture_default_str();
    command->add_option("--bot", peer_.bot, "seed of this peer's player")->capture_default_str();
    CommandLine::add_path(command, "--inputs", peer_.inputs,
                          "inputs instead of the bot's: push_x push_z buttons aim, a line a frame");
    command->add_option(
        "--profile", peer_.profile,
        "what this peer's line does: a name (lan wifi mobile severe ...) or latency=100,jitter=30,loss=5");
    CommandLine::add_path(command, "--hashes", peer_.hashes, "write the hash after each frame");
    CommandLine::add_path(command, "--record", peer_.record, "write a replay");
    CommandLine::add_path(command, "--bundle", peer_.bundle, "on a desync, write what `isostep diff` needs");
    command->add_flag("--trace", peer_.trace, "hash every stage, so that a bundle can name it");
    command->add_option("--fault", peer_.fault,
                        "fault injection: before this frame one bit of one body flips on this peer");
    command
        ->add_option("--patience", peer_.patience, "seconds until a silent peer is lost [5], no host is given up [20]")
        ->check(CLI::Range(1, 3600));
    command
        ->add_option("--replayed", peer_.replayed,
                     "frames that a late joiner steps itself; behind by more it is sent a snapshot [1200]")
        ->check(CLI::Range(0, 1 << 24));
    command->add_option("--reservation", peer_.reservation, "seconds that a host keeps a seat for who is gone [60]")
        ->check(CLI::Range(0, 3600));
    command->add_flag("--json", peer_.json, "one JSON object");
    command->footer("Exits with 0, or 1 after a desync, or 66 when there is no host.");
  }
  void add_relay() {
    CLI::App* command =
        line_.add("relay", "a bad network between real processes", [this] { return command_relay(relay_); });
    command->add_option("--listen", relay_.listen, "UDP port (0: any)")
        ->check(CLI::Range(0, 65535))
        ->capture_default_str();
    command->add_option("--bind", relay_.bind, "address to listen at; \"::\" is every one of IPv6 and IPv4")
        ->check(CommandLine::refuse_blank, "")
        ->capture_default_str();
    command->add_option("--target", relay_.target, "HOST:PORT or [IPV6]:PORT to which packets go on")->required();
    command->add_option("--profile", relay_.profile, "a name, or items like latency=100,jitter=30,loss=5")
        ->capture_default_str();
    command->add_option("--seed", relay_.seed, "of everything that goes wrong")->capture_default_str();
    CommandLine::add_path(command, "--port-file", relay_.port_file, "write the port here");
  }
  void add_demo() {
    CLI::App* command = line_.add("demo", "a match over a bad line and a few scenes, in every scalar",
                                  [this] { return command_demo(demo_); });
    CommandLine::add_path(command, "--out", demo_.out, "keep the recordings in this directory");
  }

  CommandLine& line_;
  VerifyOptions verify_;
  PeerOptions peer_;
  RelayOptions relay_;
  DemoOptions demo_;
};

}  // namespace

std::shared_ptr<void> add_demo_commands(CommandLine& line) { return std::make_shared<DemoCommands>(line); }

int run_demo(int argc, const char* const* argv) { return run_program(argc, argv, add_demo_commands); }

}  // namespace isostep::tool
