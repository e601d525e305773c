// Fault injection for `isostep diff --stages`: a recording, a survey of all that stages leave, a bit of any of that.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "isostep/replay/world_kinds.hpp"
#include "isostep/state/replay_format.hpp"
#include "tool/diff/stage_side.hpp"

namespace isostep::test {

/// "prepared[3].normals[0].row.impulse" -> "prepared[].normals[]"; "report.stopped" -> "report".
inline std::string array_of(const std::string& path) {
  std::string array;
  std::size_t end = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] == '[') {
      array += "[]";
      i = path.find(']', i);
      end = array.size();
    } else {
      array += path[i];
    }
  }
  return end != 0 ? array.substr(0, end) : array.substr(0, array.find('.'));
}

/// The field takes no fault: it is shared, or says how much there is to look at.
inline bool is_read_only(const std::string& path) {
  const auto begins = [&](const char* name) { return path.rfind(name, 0) == 0; };
  const bool length = path.size() > 6 && path.compare(path.size() - 6, 6, ".count") == 0;
  const bool slots = path.find("_slots") != std::string::npos && !begins("start_slots");
  return length || slots || path == "settings.solver" || begins("sleeping[") || begins("particles");
}

struct Found {
  std::uint64_t frame;
  NamedField field;
};
/// Every array of every stage: where it first has a field, and the last one that it has then.
using Survey = std::map<std::pair<std::string, std::string>, Found>;

template <class W> class Surveyor {
 public:
  Survey survey(Bytes file) {
    const ReplayReader replay(file);
    Reader reader(replay.state());
    EXPECT_TRUE(world_.read_portable(reader).ok());
    for (frame_ = 0; frame_ < replay.frame_count(); ++frame_) {
      const Result<void> played = play_commands<typename W::EveryCommand>(
          replay.frame(frame_).input, [&](const auto& command) { return static_cast<bool>(world_.apply(command)); },
          [&] {
            look("commands", world_.state_fields());
            world_.step({&Surveyor::after, this});
          });
      EXPECT_TRUE(played.ok());
    }
    return survey_;
  }

 private:
  template <class Stage> static void after(void* user, Stage stage, const StageView& left) {
    static_cast<Surveyor*>(user)->look(WorldTraits<W>::kStages[static_cast<std::size_t>(stage)], left);
  }
  void look(const char* stage, const StageView& view) {
    stage_ = stage;
    const FieldSink sink = {[](void* user, const PathPart& path, FieldFormat format, std::uint64_t bits) {
                              static_cast<Surveyor*>(user)->take({path_text(path), format, bits});
                            },
                            this};
    view.visit(sink);
  }
  void take(NamedField field) {
    if (is_read_only(field.path)) return;
    const auto [place, fresh] = survey_.try_emplace({stage_, array_of(field.path)}, Found{frame_, field});
    if (place->second.frame == frame_) place->second.field = std::move(field);
  }

  W world_;
  Survey survey_;
  std::uint64_t frame_ = 0;
  std::string stage_;
};

/// The side that is in order: its trace is the same whatever is done to the other.
class OrderlySide : public tool::StageSide {
 public:
  explicit OrderlySide(const tool::Input& input) : side_(tool::played_here(input)), trace_(side_->trace()) {}
  std::vector<tool::TracePoint> trace() const override { return trace_; }
  tool::FieldList fields_at(const StagePoint& at) const override { return side_->fields_at(at); }

 private:
  std::unique_ptr<tool::StageSide> side_;
  std::vector<tool::TracePoint> trace_;
};

/// A bit whose turning moves any value by a power of two of steps: not the sign's.
inline std::uint32_t bit_of(const NamedField& field) {
  if (field.format.kind == FieldKind::truth) return 0;
  return static_cast<std::uint32_t>((field.bits ^ field.bits >> 17 ^ field.path.size()) % (8 * field.format.size - 1));
}
/// "bodies[3].velocity.x: 1.5 | 1.25 (0x3fc00000 | 0x3fa00000), 2097152 ulp apart"
inline std::string difference_of(const NamedField& field, std::uint32_t bit) {
  const std::uint64_t other = field.bits ^ std::uint64_t{1} << bit;
  const char* unit = field.format.kind != FieldKind::scalar ? "" : field.format.scalar_id >> 16 == 1 ? " ulp" : " lsb";
  return field.path + ": " + value_text(field.format, field.bits) + " | " + value_text(field.format, other) + " (" +
         bits_text(field.format, field.bits) + " | " + bits_text(field.format, other) + "), " +
         std::to_string(std::uint64_t{1} << bit) + unit + " apart";
}

inline std::string said(const tool::Input& input, const tool::StageSide& a, const tool::StageSide& b, int expected) {
  testing::internal::CaptureStdout();
  try {
    EXPECT_EQ(tool::print_first_difference(input, a, input, b), expected);
  } catch (const std::exception& refused) {
    ADD_FAILURE() << refused.what();
  }
  std::fflush(stdout);
  return testing::internal::GetCapturedStdout();
}

/// Turns a bit of what the survey found, looks, turns it back: exactly this field must be named, after this stage.
/// `owner_kind`: how what stands in brackets begins; empty: there is none; "*": whatever there is.
inline void expect_named(const tool::Input& input, const OrderlySide& orderly, const std::string& stage,
                         const Found& found, const std::string& owner_kind) {
  const StageFault fault = {{found.frame, 1, stage}, found.field.path, bit_of(found.field), true};
  StagedReplay how;
  how.frames = found.frame + 1;
  how.fault = &fault;
  const std::string out = said(input, orderly, *tool::played_here(input, how), 1);
  const std::string expected =
      "frame " + std::to_string(found.frame) + ", stage " + stage + "\n  " + difference_of(found.field, fault.bit);
  EXPECT_EQ(out.substr(0, expected.size()), expected);
  if (out.size() < expected.size()) return;
  const std::string rest = out.substr(expected.size());
  if (owner_kind != "*") {
    EXPECT_EQ(rest.rfind(owner_kind.empty() ? "\n" : " [" + owner_kind, 0), 0u) << out;
  }
  EXPECT_NE(rest.find("\n  1 of "), std::string::npos) << out;
  EXPECT_EQ(rest.find('\n', rest.find(" fields differ")), rest.size() - 1) << out;
}

}  // namespace isostep::test
