// EventLog<E>: reports what happened in a game that steps its frames more than once, so that a sound plays only once.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include "isostep/scalar/platform.hpp"
#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// An event of the game. `==` is true for the same happening: {what, who}. What a misprediction changes a little, such
/// as a strength or a place, belongs into the event but not into its `==`.
template <class E>
concept LoggedEvent = std::is_trivially_copyable_v<E> && std::equality_comparable<E>;

enum class NoticeKind : std::uint8_t {
  predicted,  // it happened here, with inputs that may yet turn out otherwise
  confirmed,  // it happened, everywhere
  retracted   // it was predicted and has not happened
};

/// Each happening is reported as `predicted`, then as `confirmed` or `retracted`. If its frame was confirmed before
/// anyone polled (in lockstep on the host), it is reported as `confirmed` alone.
///
///     sounds, sparks                 if (notice.first) play(notice.event)
///     long ones, to be cut short     if (notice.kind == retracted) fade_out(playing[notice.happening])
///     scores, kills on a screen      if (notice.kind == confirmed) show(notice.event)
template <class E> struct Notice {
  NoticeKind kind;
  bool first;               // of its happening: the moment to play it
  Frame frame;              // a confirmed one's is final; a retracted one's is where it was seen last
  std::uint32_t happening;  // one number for all notices of it, counted on this machine only
  E event;                  // as of this notice
};

struct EventLogConfig {
  std::uint32_t frames = 64;  // [frames] between what was polled and what is stepped: the window and a drive's steps
  std::uint32_t events = 32;  // in one frame
  Frame reach = 4;            // [frames] an event may move in a rollback and still be the same happening
};

/// Counts events that were not reported. Both are zero if all were reported.
struct EventLoss {
  std::uint64_t crowded = 0;   // past the `events` of a confirmed frame: equal on every peer
  std::uint64_t homeless = 0;  // told between frames, or while `frames` full ones wait: this machine's own
};

/// An observer of `drive`. While the game steps, it tells the log of events that others should hear of.
///
/// The confirmed notices are those of a run without rollbacks, frame for frame and in order, and equal on every peer.
/// Predictions and retractions are this machine's own. Nothing is decided during a rollback: `poll` compares the
/// reported events with those that exist when it is called, so poll after `drive` until nothing is left. When a frame
/// is stepped again, a reported event is matched with an equal one of that frame, else with the nearest equal one
/// within `reach` frames; each event is matched once. So a retraction waits until `reach` frames after the event were
/// stepped without it.
///
///     for (const auto& touch : world.events().contact_begin) log->tell({touch.a, touch.b});  // after world.step()
///     drive(session, game, now, log);
///     while (const auto notice = log.poll()) if (notice->first) play(notice->event);
///
/// A late joiner also hears of the frames that it catches up with; play a sound only if its frame is near the present.
/// The log is never part of the state: games hold a pointer to it. It allocates when it is made, not later.
template <LoggedEvent E> class EventLog {
 public:
  using Event = E;

  ISO_INLINE explicit EventLog(const EventLogConfig& config = {})
      : capacity_(std::size_t{config.frames} * config.events), events_(config.events), reach_(config.reach) {
    ISO_ASSERT(config.frames > 0 && config.events > 0 && config.reach >= 0 && config.reach < kLastFrame);
    records_.reserve(capacity_);
    missing_.reserve(2 * capacity_);
  }
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  /// Tells an event of the frame that is being stepped. Returns false if it is lost, see `lost`.
  ISO_INLINE bool tell(const E& event) {
    if (frame_ != kNoFrame && frame_ <= confirmed_) return true;  // reported or waiting to be, and final
    if (frame_ != kNoFrame && in_frame_ == events_) {
      ++records_.back().crowded;
      return false;
    }
    if (frame_ == kNoFrame || records_.size() == capacity_) {
      ++lost_.homeless;
      return false;
    }
    records_.push_back({event, frame_, 0, 0, false});
    ++in_frame_;
    return true;
  }

  /// Returns the next notice: retractions, then confirmed and predicted events by frame, in the order of `tell`.
  ISO_INLINE std::optional<Notice<E>> poll() {
    if (changed_) settle();
    for (std::size_t i = 0; i < missing_.size(); ++i) {
      // The second bound keeps room for all that is reported: each poll leaves at most `capacity_` missing.
      if (missing_[i].frame + reach_ >= next_ && missing_.size() <= capacity_) continue;
      const Record gone = missing_[i];
      missing_.erase(missing_.begin() + static_cast<std::ptrdiff_t>(i));
      return Notice<E>{NoticeKind::retracted, false, gone.frame, gone.happening, gone.event};
    }
    while (cursor_ < records_.size()) {
      Record& record = records_[cursor_++];
      const bool first = !record.reported;
      const bool final = record.frame <= confirmed_;
      if (!first && !final) continue;
      if (first) record.happening = happenings_++;
      record.reported = true;
      if (final) {
        done_ = cursor_;
        lost_.crowded += record.crowded;
      }
      const NoticeKind kind = final ? NoticeKind::confirmed : NoticeKind::predicted;
      return Notice<E>{kind, first, record.frame, record.happening, record.event};
    }
    return std::nullopt;
  }

  ISO_INLINE const EventLoss& lost() const { return lost_; }

  // What `drive` calls; netcode of one's own calls the same.
  ISO_INLINE void before_step(Frame frame) {
    rolled_back(frame);
    records_.erase(records_.begin(), records_.begin() + static_cast<std::ptrdiff_t>(done_));
    done_ = 0;
    frame_ = frame;
    in_frame_ = 0;
  }
  ISO_INLINE void after_step(Frame frame) {
    frame_ = kNoFrame;
    next_ = frame + 1;
  }
  ISO_INLINE void rolled_back(Frame frame) {
    changed_ = true;
    std::size_t kept = records_.size();
    while (kept > done_ && records_[kept - 1].frame >= frame && records_[kept - 1].frame > confirmed_) --kept;
    for (std::size_t i = kept; i < records_.size(); ++i) {
      if (records_[i].reported) missing_.push_back(records_[i]);
    }
    records_.erase(records_.begin() + static_cast<std::ptrdiff_t>(kept), records_.end());
    next_ = frame;
  }
  ISO_INLINE void confirmed(Frame frame, std::uint64_t) {
    changed_ = true;
    if (frame > confirmed_) confirmed_ = frame;
  }
  /// Predicted events that are not told again soon after `frame` are retracted, since this machine cannot know.
  ISO_INLINE void restarted(Frame frame) {
    rolled_back(confirmed_ + 1);
    next_ = frame;
  }
  /// Call it when no frame follows: retracts the events that are still predicted.
  ISO_INLINE void finish() {
    rolled_back(confirmed_ + 1);
    next_ = std::numeric_limits<Frame>::max();
  }

 private:
  struct Record {
    E event;
    Frame frame;
    std::uint32_t happening;
    std::uint32_t crowded;  // events of its frame after it that found no room
    bool reported;
  };

  /// Matches missing events with equal ones that were told again, in their own frame or else in the nearest.
  ISO_INLINE void settle() {
    for (Frame distance = 0; distance <= reach_ && !missing_.empty(); ++distance) {
      std::size_t left = 0;
      for (std::size_t i = 0; i < missing_.size(); ++i) {
        if (!find_again(missing_[i], distance)) missing_[left++] = missing_[i];
      }
      missing_.erase(missing_.begin() + static_cast<std::ptrdiff_t>(left), missing_.end());
    }
    cursor_ = done_;
    changed_ = false;
  }
  ISO_INLINE bool find_again(const Record& gone, Frame distance) {
    for (std::size_t i = done_; i < records_.size(); ++i) {
      Record& record = records_[i];
      if (record.reported || (record.frame != gone.frame - distance && record.frame != gone.frame + distance)) continue;
      if (!(record.event == gone.event)) continue;
      record.reported = true;
      record.happening = gone.happening;
      return true;
    }
    return false;
  }

  std::size_t capacity_;
  std::uint32_t events_;
  Frame reach_;
  std::vector<Record> records_;  // by frame: those before done_ are over, then the confirmed ones, then the predicted
  std::vector<Record> missing_;  // reported as predicted, and not in what was stepped since
  std::size_t done_ = 0;
  std::size_t cursor_ = 0;      // of poll
  Frame frame_ = kNoFrame;      // under way
  Frame next_ = 0;              // all before it are stepped
  Frame confirmed_ = kNoFrame;  // the newest
  std::uint32_t in_frame_ = 0;  // events of the frame under way
  std::uint32_t happenings_ = 0;
  bool changed_ = false;  // since the last poll
  EventLoss lost_;
};

}  // namespace isostep
