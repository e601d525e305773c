// A sweep: threads that each take the longest run that is left.
// SPDX-License-Identifier: MIT
#include "sweep.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <thread>

#include "progress.hpp"
#include "run_point.hpp"
#include "store.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool::lab {
namespace {

/// A scene with its reference, which is run when the first of its points is.
struct Bench {
  Subject subject;
  std::once_flag once;
  Reference reference;
};

class Sweep {
 public:
  Sweep(const std::vector<LabPoint>& points, const SweepOptions& options)
      : points_(points), options_(options), store_(options.out), results_(points.size()) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      Bench& bench = bench_of(points[i].scene);
      const LabResult* known = options.fresh ? nullptr : store_.find(points[i], wanted(bench.subject, points[i]));
      if (known != nullptr) results_[i] = *known;
      else if (work(i) > options.limit) results_[i] = left_out(i);
      else left_.push_back(i);
    }
    std::stable_sort(left_.begin(), left_.end(), [&](std::size_t a, std::size_t b) { return work(b) < work(a); });
  }

  std::vector<LabResult> run() {
    const double all =
        std::accumulate(left_.begin(), left_.end(), 0.0, [&](double sum, std::size_t i) { return sum + work(i); });
    Progress progress(options_.progress, left_.size(), all);
    const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    const int jobs = options_.jobs > 0 ? options_.jobs : cores;
    std::vector<std::thread> threads;
    for (int i = 1; i < jobs; ++i) threads.emplace_back([&] { take_runs(progress); });
    take_runs(progress);
    for (std::thread& thread : threads) thread.join();
    if (failure_) std::rethrow_exception(failure_);
    if (interrupted()) fail_interrupted();
    return results_;
  }

 private:
  Bench& bench_of(const std::string& scene) {
    std::unique_ptr<Bench>& bench = benches_[scene];
    if (!bench) {
      bench = std::make_unique<Bench>();
      bench->subject = subject_of(scene);
    }
    return *bench;
  }
  Wanted wanted(const Subject& subject, const LabPoint& point) const {
    return {subject.version, frames_at(subject.scene, options_.frames, point.hz)};
  }
  double work(std::size_t i) const {
    const Subject& subject = benches_.at(points_[i].scene)->subject;
    return work_of(subject, points_[i], wanted(subject, points_[i]).frames);
  }
  /// It is not kept: another limit, another answer.
  LabResult left_out(std::size_t i) const {
    LabResult result;
    result.point = points_[i];
    result.state = kLeftOut;
    result.reason = too_long(work(i));
    return result;
  }

  void take_runs(Progress& progress) {
    const Cancel cancel = [this] { return interrupted() || failed_; };
    try {
      for (std::size_t next = taken_++; next < left_.size() && !cancel(); next = taken_++) {
        const std::size_t i = left_[next];
        Bench& bench = *benches_.at(points_[i].scene);
        std::call_once(bench.once, [&] {
          bench.reference = reference_of(
              bench.subject, frames_at(bench.subject.scene, options_.frames, bench.subject.scene.hz), cancel);
        });
        const int frames = wanted(bench.subject, points_[i]).frames;
        keep(i, run_point(bench.subject, points_[i], bench.reference, frames, cancel), progress);
      }
    } catch (const Cancelled&) {
      return;
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!failed_) failure_ = std::current_exception();
      failed_ = true;
    }
  }
  void keep(std::size_t i, LabResult result, Progress& progress) {
    const std::lock_guard<std::mutex> lock(mutex_);
    store_.append({result, benches_.at(points_[i].scene)->subject.version});
    results_[i] = std::move(result);
    ++kept_;
    progress.done(work(i), name_of(points_[i]));
  }

  [[noreturn]] void fail_interrupted() const {
    std::string text = "interrupted with " + std::to_string(kept_ + points_.size() - left_.size()) + " of " +
                       std::to_string(points_.size()) + " runs done";
    if (!store_.path().empty()) text += ", kept in " + store_.path() + ": the same command goes on from there";
    throw ToolError(exit_status::kInterrupted, text);
  }

  const std::vector<LabPoint>& points_;
  const SweepOptions& options_;
  ResultStore store_;
  std::map<std::string, std::unique_ptr<Bench>> benches_;
  std::vector<LabResult> results_;
  std::vector<std::size_t> left_;  // places in points_, the longest first
  std::atomic<std::size_t> taken_ = 0;
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;  // of all below, and of store_ and results_
  std::size_t kept_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

std::vector<LabResult> sweep(const std::vector<LabPoint>& points, const SweepOptions& options) {
  return Sweep(points, options).run();
}

}  // namespace isostep::tool::lab
