// InputDelay: for how many frames an input waits before it is played, so that it reaches the others in time.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// Adapts the input delay to how early our inputs reach the others: late ones raise it at once, early ones lower it
/// slowly. A longer delay is felt by one player; a late input costs everybody a rollback or a wait. Up to `most` the
/// delay gives inputs the wanted slack. Beyond it, up to `limit`, inputs come just early enough to count.
class InputDelay {
 public:
  struct Settings {
    Frame start = 2, least = 0, most = 12;  // [frames]; least == most: fixed
    Frame wanted_slack = 0;                 // [frames] negative: a rollback of so many is welcome
    Frame limit = most;                     // [frames] `most` or more
    Frame latest_slack = wanted_slack;      // [frames] at most wanted_slack
  };
  explicit InputDelay(const Settings& settings) : settings_(settings), delay_(settings.start) {}

  Frame frames() const { return delay_; }
  /// Raises the delay for inputs that travel for `way` frames, before anything is observed.
  void expect(Frame way) { raise(way + settings_.wanted_slack, way + settings_.latest_slack); }
  /// Raises the delay by `by`, because inputs will come so much later from now on.
  void grow(Frame by) {
    raise(delay_ + by, 0);
    disregard();
  }
  /// The speed changes from `before` to `after`: a frame takes `before` / `after` of its time. Rescales the delay.
  void rescale(int before, int after) {
    const Frame same = (delay_ * after + before - 1) / before;
    delay_ = same < settings_.least ? settings_.least : same > settings_.limit ? settings_.limit : same;
    disregard();
  }
  /// A player who may have needed the delay is gone: the next decision gives up all spare delay at once.
  void reconsider() {
    disregard();
    reconsiders_ = true;
  }
  bool is_at_most() const { return delay_ >= settings_.most; }
  /// Limits the delay to `most` from now on, because nobody replaces our inputs.
  void keep_to_most() {
    settings_.limit = settings_.most;
    settings_.latest_slack = settings_.wanted_slack;
    if (delay_ > settings_.most) delay_ = settings_.most;
  }
  /// Takes how early the latest of our inputs of a second came, over all peers. Call it once per frame of time.
  void observe(Frame slack) {
    if (++observed_ <= 0) return;
    if (slack < worst_) worst_ = slack;
    if (observed_ < kPeriod) return;
    const Frame before = delay_, spare = worst_ - settings_.wanted_slack, room = worst_ - settings_.latest_slack;
    // Beyond `most` the delay is no longer than it has to be.
    const Frame excess = delay_ > settings_.most ? room : spare;
    calm_ = excess < kSpare ? 0 : calm_ + 1;
    raise(delay_ - spare, delay_ - room);
    if (calm_ >= kCalm) --delay_;
    if (reconsiders_ && excess > 1) delay_ = before - excess + 1;
    if (delay_ < settings_.least) delay_ = settings_.least;
    reconsiders_ = false;
    observed_ = delay_ == before ? 0 : -kSettling;
    if (delay_ != before) calm_ = 0;
    worst_ = kNothing;
  }
  /// Ignores reports for some time, because they describe the past.
  void disregard() {
    observed_ = -kSettling;
    worst_ = kNothing;
    calm_ = 0;
  }
  static constexpr Frame kSettling = 90;  // [frames] until reports speak of the new delay: two buckets and a round trip

 private:
  static constexpr Frame kPeriod = 30;  // [frames] of reports for one decision
  static constexpr Frame kSpare = 2;    // [frames] of spare that are left alone
  static constexpr Frame kCalm = 4;     // periods in a row with spare before the delay shrinks
  static constexpr Frame kNothing = 1 << 20;

  /// Raises the delay to `wanted`, at most to `most`, and to `needed`, at most to `limit`.
  void raise(Frame wanted, Frame needed) {
    if (wanted > settings_.most) wanted = settings_.most;
    if (needed > settings_.limit) needed = settings_.limit;
    if (needed > wanted) wanted = needed;
    if (wanted > delay_) delay_ = wanted;
  }

  Settings settings_;
  Frame delay_;
  Frame worst_ = kNothing;       // of this period
  Frame observed_ = -kSettling;  // at first, clocks still find each other
  bool reconsiders_ = false;
  int calm_ = 0;  // periods in a row with spare
};

/// The minimum of a quantity over the last one or two buckets of time, and how far it is below the smoothed value.
class RecentLeast {
 public:
  void add(Frame value) {
    if (value < current_) current_ = value;
    usual_ = has_usual_ ? usual_ + (value * kFine - usual_) / kSmoothing : value * kFine;
    has_usual_ = true;
  }
  Frame spread() const { return value() == kNothing ? 0 : usual_ / kFine - value(); }
  /// Call it once per frame of time.
  void tick(Frame bucket_frames) {
    if (++age_ < bucket_frames) return;
    age_ = 0;
    previous_ = current_;
    current_ = kNothing;
  }
  /// Returns the minimum; kNothing if nothing was added.
  Frame value() const { return current_ < previous_ ? current_ : previous_; }
  static constexpr Frame kNothing = 127;

 private:
  static constexpr Frame kFine = 256;      // parts of a frame
  static constexpr Frame kSmoothing = 16;  // values: a quarter of a second of inputs

  Frame current_ = kNothing, previous_ = kNothing, age_ = 0;
  Frame usual_ = 0;  // [1/256 frame] smoothed
  bool has_usual_ = false;
};

}  // namespace isostep
