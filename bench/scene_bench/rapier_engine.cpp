// Rapier (float, WebAssembly) in the scene benchmark: Node runs rapier.mjs in a process of its own and is asked over a
// socket. Steps are timed there; everything else is measured here, as for the other peers.
// SPDX-License-Identifier: MIT
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "peer.hpp"

extern char** environ;

namespace isostep::bench {
namespace {

using Json = nlohmann::json;

static_assert(std::endian::native == std::endian::little, "rapier.mjs answers in little-endian doubles");

constexpr char kScript[] = ISOSTEP_BENCH_SOURCE_DIR "/scene_bench/rapier.mjs";

std::string package_directory(const char* package) {
  return std::string(ISOSTEP_BENCH_NPM_DIR "/node_modules/@dimforge/") + package;
}

/// A process that answers lines with doubles. It ends when its socket does.
class NodeProcess {
 public:
  explicit NodeProcess(std::string package) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) throw scenes::SceneError("", "no socket");
    socket_ = ends[0];
    std::string words[] = {"node", "--no-liftoff", kScript, std::move(package)};  // optimised before the first step
    char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, ends[1], 0);
    posix_spawn_file_actions_adddup2(&files, ends[1], 1);
    const int failed = posix_spawnp(&pid_, "node", &files, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&files);
    close(ends[1]);
    if (failed == 0) return;
    close(socket_);
    throw scenes::SceneError("", "node does not start");
  }
  ~NodeProcess() {
    close(socket_);
    waitpid(pid_, nullptr, 0);
  }
  NodeProcess(const NodeProcess&) = delete;
  NodeProcess& operator=(const NodeProcess&) = delete;

  std::vector<double> ask(const Json& request, std::size_t count) {
    const std::string line = request.dump() + "\n";
    for (std::size_t sent = 0; sent < line.size();) {
      sent += bytes_of(send(socket_, line.data() + sent, line.size() - sent, MSG_NOSIGNAL));
    }
    std::vector<double> answer(count);
    const std::size_t size = count * sizeof(double);
    for (std::size_t got = 0; got < size;) {
      got += bytes_of(recv(socket_, reinterpret_cast<char*>(answer.data()) + got, size - got, 0));
    }
    return answer;
  }

 private:
  static std::size_t bytes_of(ssize_t count) {
    if (count <= 0) throw scenes::SceneError("", "rapier.mjs has ended; what it said is above");
    return static_cast<std::size_t>(count);
  }

  int socket_ = -1;
  pid_t pid_ = 0;
};

Json json_of(Vec3<double> v) { return {v.x, v.y, v.z}; }
Json json_of(Quat<double> q) { return {q.x, q.y, q.z, q.w}; }

Json json_of(const PeerPart& part) {
  Json points = Json::array();
  for (const Vec3<double>& point : part.points) points.push_back(json_of(point));
  return {{"type", kShapeNames[static_cast<std::size_t>(part.type)]},
          {"points", points},
          {"half_extents", json_of(part.half_extents)},
          {"radius", part.radius},
          {"half_height", part.half_height},
          {"normal", json_of(part.normal)},
          {"offset", part.offset},
          {"position", json_of(part.position)},
          {"orientation", json_of(part.orientation)}};
}
Json json_of(const PeerBody& body) {
  if (body.group > 15) throw scenes::SceneError("", "Rapier has no more than 16 groups");
  const char* type = body.type == BodyType::static_     ? "fixed"
                     : body.type == BodyType::kinematic ? "kinematic"
                                                        : "dynamic";
  Json json = {{"type", type},
               {"position", json_of(body.position)},
               {"orientation", json_of(body.orientation)},
               {"velocity", json_of(body.velocity)},
               {"angular_velocity", json_of(body.angular_velocity)},
               {"mass", body.mass},
               {"inertia", json_of(body.inertia)},
               {"friction", body.friction},
               {"restitution", body.restitution},
               {"gravity_scale", body.gravity_scale},
               {"linear_damping", body.linear_damping},
               {"angular_damping", body.angular_damping},
               {"group", body.group},
               {"collide", body.collide},
               {"parts", Json::array()}};
  for (const PeerPart& part : body.parts) json["parts"].push_back(json_of(part));
  return json;
}

Json json_of(const PeerEnd& end) { return {{"anchor", json_of(end.position)}, {"axes", json_of(end.orientation)}}; }
/// The names that rapier.mjs knows. A rod is no joint of Rapier's.
const char* name_of(const PeerJoint& joint) {
  if (joint.type != JointType::distance) return kJointNames[static_cast<std::size_t>(joint.type)];
  if (!joint.is_spring && joint.lower > 0) throw scenes::SceneError("", "Rapier has no rod");
  return joint.is_spring ? "spring" : "rope";
}
Json json_of(const PeerJoint& joint) {
  return {{"type", name_of(joint)},
          {"rest", joint.rest},
          {"stiffness", joint.stiffness},
          {"damping", joint.damping},
          {"limits", joint.is_limited ? Json{joint.lower, joint.upper} : Json()},
          {"a", joint.a},
          {"b", joint.b},
          {"on_a", json_of(joint.on_a)},
          {"on_b", json_of(joint.on_b)},
          {"length", joint.upper},
          {"collide", joint.collide}};
}
/// Pairs mix as ours where surfaces differ; where they do not, Rapier's own rule says the same.
bool is_uniform(const std::vector<PeerBody>& bodies) {
  for (const PeerBody& body : bodies) {
    if (body.friction != bodies.front().friction) return false;
  }
  return true;
}

class RapierEngine : public Peer {
 public:
  RapierEngine(const scenes::Scene& scene, const char* package)
      : Peer(scene), package_(package), node_(package_directory(package)) {
    Json built = {{"gravity", json_of(gravity())},
                  {"allow_sleep", allow_sleep()},
                  {"uniform", is_uniform(bodies())},
                  {"bodies", Json::array()},
                  {"joints", Json::array()}};
    for (const PeerBody& body : bodies()) built["bodies"].push_back(json_of(body));
    for (const PeerJoint& joint : joints()) built["joints"].push_back(json_of(joint));
    node_.ask({{"scene", built}}, 1);
  }

  void step() override { timed_steps(1); }
  double timed_steps(int count) override {
    state_.clear();
    return node_.ask({{"steps", count}}, 1).front();
  }

  std::string settings() const override { return std::string(package_) + ", 4 iterations"; }

 protected:
  Motion motion(std::size_t i) const override {
    const double* m = state().data() + kNumbers * i;
    return {{m[0], m[1], m[2]},
            {m[7], m[8], m[9]},
            {m[10], m[11], m[12]},
            normalise(Quat<double>{m[3], m[4], m[5], m[6]}),
            m[13] != 0};
  }
  void replace(std::size_t i, const PeerBody& by) override {
    state_.clear();
    node_.ask({{"replace", {i, json_of(by)}}}, 1);
  }
  void launch(std::size_t i, Vec3<double> velocity) override {
    state_.clear();
    node_.ask({{"launch", {i, json_of(velocity)}}}, 1);
  }
  void drive(int) override {}  // Rapier moves kinematic bodies by their velocity

 private:
  static constexpr std::size_t kNumbers = 14;  // a body

  /// Asked for once a step.
  const std::vector<double>& state() const {
    if (state_.empty()) state_ = node_.ask({{"state", 0}}, kNumbers * bodies().size());
    return state_;
  }

  const char* package_;
  mutable NodeProcess node_;
  mutable std::vector<double> state_;
};

constexpr char kSimd[] = "rapier3d-simd-compat", kDeterministic[] = "rapier3d-deterministic-compat";

template <const char* package> std::unique_ptr<Engine> make_rapier(const scenes::Scene& scene, const EngineOptions&) {
  return std::make_unique<RapierEngine>(scene, package);
}

}  // namespace

std::vector<Maker> rapier_makers() {
  std::vector<Maker> found;
  const auto is_there = [](const char* package) {
    return std::filesystem::exists(package_directory(package) + "/dist");
  };
  const bool simd = is_there(kSimd), deterministic = is_there(kDeterministic);
  if ((!simd && !deterministic) || std::system("node --version >/dev/null 2>&1") != 0) return found;
  if (simd) found.push_back({"rapier-simd", false, make_rapier<kSimd>});
  if (deterministic) found.push_back({"rapier-det", false, make_rapier<kDeterministic>});
  return found;
}

}  // namespace isostep::bench
