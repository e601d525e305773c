// Recordings, packed.
// SPDX-License-Identifier: MIT
#include "recording.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "byte_writer.hpp"

namespace isostep::tool::page {
namespace {

constexpr std::size_t kPointBytes = 10;

/// Frames one after another: a pose is told by its distance from the one before where sixteen bits hold that.
class Packer {
 public:
  Packer(const Recording& recording, Packed& packed)
      : recording_(recording),
        packed_(packed),
        out_(packed.bytes),
        last_(recording.actors.size()),
        pushed_(recording.effects.size()) {}

  void pack_frame(const Frame& frame, bool with_points) {
    out_.u64(frame.tick);
    out_.u64(frame.hash);
    out_.f32(frame.energy);
    out_.f32(frame.depth);
    out_.count(frame.changed.size());
    for (const Changed& changed : frame.changed) out_.u32(changed.actor << 2 | static_cast<std::uint32_t>(changed.to));
    pack_poses(frame);
    if (!recording_.effects.empty()) pack_pushes(frame);
    out_.count(with_points ? frame.points.size() : 0);
    if (!with_points) return;
    for (const ContactPoint& point : frame.points) pack_point(point);
  }

 private:
  struct Known {
    bool is = false;
    Pose pose;
  };
  using Rounded = std::array<std::int16_t, 4>;  // force and control

  void pack_poses(const Frame& frame) {
    std::vector<const Moved*> whole, near;
    for (const Moved& moved : frame.moved) (is_near(moved) ? near : whole).push_back(&moved);
    out_.count(whole.size());
    for (const Moved* moved : whole) {
      out_.u32(moved->actor);
      for (const std::int32_t x : moved->pose.at) out_.u32(static_cast<std::uint32_t>(x));
      pack_turn_of(moved->pose);
    }
    std::vector<std::uint8_t> mask(near.empty() ? 0 : near.back()->actor / 8 + 1);
    for (const Moved* moved : near) mask[moved->actor / 8] |= static_cast<std::uint8_t>(1u << moved->actor % 8);
    out_.count(mask.size());
    for (const std::uint8_t bits : mask) out_.u8(bits);
    for (const Moved* moved : near) {
      for (int i = 0; i < 3; ++i)
        out_.u16(static_cast<std::uint16_t>(moved->pose.at[i] - last_[moved->actor].pose.at[i]));
      pack_turn_of(moved->pose);
    }
    for (const Moved& moved : frame.moved) last_[moved.actor] = {true, moved.pose};
  }
  bool is_near(const Moved& moved) const {
    const Known& known = last_[moved.actor];
    if (!known.is) return false;
    for (int i = 0; i < 3; ++i) {
      const std::int64_t step = std::int64_t{moved.pose.at[i]} - known.pose.at[i];
      if (step < -32768 || step > 32767) return false;
    }
    return true;
  }
  void pack_turn_of(const Pose& pose) {
    if (recording_.particles) return;
    for (const std::uint16_t x : pose.turn) out_.u16(x);
  }
  /// Those that changed.
  void pack_pushes(const Frame& frame) {
    std::vector<const Push*> changed;
    for (const Push& push : frame.pushes) {
      if (Rounded& known = pushed_[push.effect]; known != rounded(push)) {
        known = rounded(push);
        changed.push_back(&push);
      }
    }
    out_.count(changed.size());
    for (const Push* push : changed) {
      out_.u32(push->effect);
      for (const std::int16_t x : pushed_[push->effect]) out_.u16(static_cast<std::uint16_t>(x));
    }
  }
  Rounded rounded(const Push& push) const {
    const auto part = [](float x, float most) {
      return static_cast<std::int16_t>(most > 0 ? std::lround(std::clamp(x / most, -1.0f, 1.0f) * 32767) : 0);
    };
    const float most = packed_.strongest;
    return {part(push.force[0], most), part(push.force[1], most), part(push.force[2], most), part(push.control, 1)};
  }
  void pack_point(const ContactPoint& point) {
    for (int i = 0; i < 3; ++i) {
      const float size = packed_.points_size[i];
      const float part = size > 0 ? (point.at[i] - packed_.points_low[i]) / size : 0;
      out_.u16(static_cast<std::uint32_t>(std::clamp(part, 0.0f, 1.0f) * 65535 + 0.5f));
    }
    for (const std::int8_t x : point.normal) out_.u8(static_cast<std::uint8_t>(x));
    out_.u8(point.force);
  }

  const Recording& recording_;
  Packed& packed_;
  ByteWriter out_;
  std::vector<Known> last_;
  std::vector<Rounded> pushed_;  // as told last, by effect
};

void bound_points(const Recording& recording, Packed& packed) {
  constexpr float kFar = std::numeric_limits<float>::max();
  std::array<float, 3> low = {kFar, kFar, kFar}, high = {-kFar, -kFar, -kFar};
  for (const Frame& frame : recording.frames) {
    for (const ContactPoint& point : frame.points) {
      for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], point.at[i]);
        high[i] = std::max(high[i], point.at[i]);
      }
    }
  }
  for (int i = 0; i < 3; ++i) {
    packed.points_low[i] = low[i] == kFar ? 0 : low[i];
    packed.points_size[i] = low[i] == kFar ? 0 : high[i] - low[i];
  }
}

float strongest_push(const Recording& recording) {
  float most = 0;
  for (const Frame& frame : recording.frames) {
    for (const Push& push : frame.pushes) {
      for (const float x : push.force) most = std::max(most, std::fabs(x));
    }
  }
  return most;
}

/// The least n for which the points of every n-th frame fit.
std::uint32_t least_stride(const Recording& recording, std::size_t room) {
  for (std::uint32_t every = 1;; ++every) {
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < recording.frames.size(); i += every)
      bytes += recording.frames[i].points.size() * kPointBytes;
    if (bytes <= room || every >= recording.frames.size()) return every;
  }
}

}  // namespace

std::array<std::uint16_t, 3> pack_turn(const float (&q)[4]) {
  int largest = 0;
  for (int i = 1; i < 4; ++i) {
    if (std::fabs(q[i]) > std::fabs(q[largest])) largest = i;
  }
  const double sign = q[largest] < 0 ? -1 : 1;
  std::array<std::uint16_t, 3> packed = {};
  int place = 0;
  for (int i = 0; i < 4; ++i) {
    if (i == largest) continue;
    const double part = std::clamp(sign * q[i] * 1.4142135623730951 * 0.5 + 0.5, 0.0, 1.0);  // of -1/sqrt 2..1/sqrt 2
    packed[static_cast<std::size_t>(place++)] = static_cast<std::uint16_t>(part * 32767 + 0.5);
  }
  packed[0] = static_cast<std::uint16_t>(packed[0] | (largest & 1) << 15);
  packed[1] = static_cast<std::uint16_t>(packed[1] | (largest >> 1) << 15);
  return packed;
}

Packed pack(const Recording& recording, std::size_t room) {
  Packed packed;
  bound_points(recording, packed);
  packed.points_every = least_stride(recording, room);
  packed.strongest = strongest_push(recording);
  Packer packer(recording, packed);
  for (std::size_t i = 0; i < recording.frames.size(); ++i)
    packer.pack_frame(recording.frames[i], i % packed.points_every == 0);
  return packed;
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < left ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= left ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace isostep::tool::page
