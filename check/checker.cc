#include "corank/check/checker.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <random>
#include <stdexcept>

#include "corank/check/distinct.h"
#include "corank/check/exact_points.h"
#include "corank/check/kernel.h"
#include "corank/check/parallel.h"
#include "corank/check/passage.h"
#include "corank/check/replay.h"
#include "corank/check/self_motion.h"
#include "corank/check/sheets.h"
#include "corank/check/types.h"
#include "corank/core/box.h"
#include "corank/core/threads.h"

namespace corank::check {
namespace {

using Place = Failure::Place;

bool same(const CoverBox& a, const CoverBox& b) {
  return a.box == b.box && a.verdict == b.verdict && a.free == b.free && a.region == b.region && a.point == b.point &&
         a.kernel_at_most == b.kernel_at_most && a.types == b.types;
}

class Checker {
 public:
  Checker(const System& system, const Cover& cover, const Options& options, const VelocityBlocks* blocks)
      : system_(system), cover_(cover), options_(options), blocks_(blocks), stop_(options.ended), arena_(options.threads) {}

  Report run() {
    report_.interrupted = !finishes([&] { check_all(); }) || report_.interrupted;
    if (report_.interrupted) report_.stage = stage_;
    std::ranges::stable_sort(report_.failures, [](const Failure& a, const Failure& b) {
      return a.place != b.place ? a.place < b.place : a.index < b.index;
    });
    return std::move(report_);
  }

 private:
  void check_all() {
    try {
      kernel_ = std::make_unique<const KernelCheck>(system_, stop_);
      passage_ = std::make_unique<const PassageCheck>(system_, stop_);
      if (blocks_) types_ = std::make_unique<const TypeCheck>(system_, *blocks_, stop_);
      problem_.emplace(system_, cover_.reduction, stop_);
    } catch (const std::invalid_argument& error) {
      system_.validate();  // that is for the caller
      fail(Place::cover, 0, error.what());
    } catch (const std::domain_error& error) {  // coefficients that sums have made too long
      fail(Place::cover, 0, std::string("the reduction: ") + error.what());
    }
    check_shapes();
    if (!problem_ || !report_.failures.empty()) return;  // nothing below has a meaning
    try {
      for (const SelfMotionRecord& record : cover_.self_motions)
        motions_.push_back(std::make_unique<const MotionCheck>(*problem_, record));
    } catch (const std::domain_error& error) {  // numbers of too many bits
      return fail(Place::cover, 0, std::string("a self-motion: ") + error.what());
    }
    check_order();
    check_parameters();
    check_asked_types();
    exact_ = std::make_unique<ExactPoints>(system_, cover_, types_.get(), stop_);
    enter("the exact points");
    check_exact_points();
    enter("the boxes");
    check_boxes();
    enter("the points");
    check_points();
    check_distinct();
    if (!cover_.proof || options_.sample > 0) return;
    enter("the proof of completeness");
    check_proof();
  }

  void enter(const char* stage) {
    stage_ = stage;
    stop_.poll();
  }

  void fail(Place place, std::size_t index, const std::string& reason) {
    report_.failures.push_back({place, index, reason});
  }

  // What every later step relies on.
  void check_shapes() {
    const std::size_t n = system_.variables.size();
    if (!(cover_.sigma.length > 0 && cover_.sigma.angle > 0)) fail(Place::cover, 0, "sigma is not a positive number");
    const auto valid = [&](const CoverBox& b) {
      return is_box(b.box, n) && b.region >= -1 && b.region < static_cast<int>(cover_.regions.size()) && b.point >= -1 &&
             b.point < static_cast<int>(cover_.exact_points.size()) && b.motion >= -1 &&
             b.motion < static_cast<int>(cover_.self_motions.size()) && b.kernel_at_most >= -1 &&
             b.kernel_at_most <= static_cast<int>(n);
    };
    const std::string fault =
        "it does not have one bounded side for each variable, or names a region or a point that does not exist";
    for (std::size_t i = 0; i < cover_.boxes.size(); ++i)
      if (!valid(cover_.boxes[i])) fail(Place::box, i, fault);
    for (std::size_t i = 0; i < cover_.points.size(); ++i)
      if (!valid(cover_.points[i])) fail(Place::point, i, fault);
    for (const Box& region : cover_.regions)
      if (!is_box(region, n)) fail(Place::cover, 0, "a region does not have one bounded side for each variable");
  }

  // Each of them would be one robot's.
  void check_parameters() {
    if (system_.parameters() > 0 && !(cover_.exact_points.empty() && cover_.self_motions.empty()))
      fail(Place::cover, 0, "constants have tolerances, but it has exact points or self-motions");
  }

  void check_asked_types() {
    const CoverTypes& said = cover_.types;
    if (said.asked != 0 && !(blocks_ && said.asked == blocks_->asked && said.of_set == blocks_->of_set))
      fail(Place::cover, 0, "the requested types are not those of the mechanism's set");
    const bool tolerant = system_.coefficient_tolerance > 0;
    const auto labelled = [](const CoverBox& b) { return b.types != TypeLabels{}; };
    if ((said.asked == 0 || tolerant) && std::ranges::any_of(cover_.boxes, labelled))
      fail(Place::cover, 0, "boxes have types that were not requested");
  }

  void check_order() {
    for (std::size_t i = 1; i < cover_.boxes.size(); ++i)
      if (out_of_order(cover_.boxes[i - 1].box, cover_.boxes[i].box))
        fail(Place::box, i, "it is not in the order of the sides");
    std::vector<unsigned char> used(cover_.regions.size(), 0);
    for (const CoverBox& b : cover_.boxes)
      if (b.region >= 0) used[b.region] = 1;
    if (std::ranges::find(used, 0) != used.end()) fail(Place::cover, 0, "a region belongs to no box");
    if (!cover_.regions.empty() && problem_->contradiction()) fail(Place::cover, 0, "the equations contradict each other");
    if (problem_->contradiction()) return;
    const int dimension =
        std::max(0, problem_->size() - static_cast<int>(problem_->equations().size()) - system_.parameters());
    if (cover_.count(Verdict::partial) == 0 && cover_.dimension != dimension)
      fail(Place::cover, 0,
           "the set has dimension " + std::to_string(dimension) + ", not " + std::to_string(cover_.dimension));
  }

  bool out_of_order(const Box& a, const Box& b) const {
    for (const int j : problem_->kept()) {
      const std::size_t v = j;
      if (a[v].lo() != b[v].lo()) return a[v].lo() > b[v].lo();
      if (a[v].hi() != b[v].hi()) return a[v].hi() > b[v].hi();
    }
    return false;
  }

  void check_exact_points() {
    for (std::size_t i = 0; i < cover_.exact_points.size(); ++i) {
      const std::string& reason = exact_->check_next();
      if (!reason.empty()) fail(Place::exact_point, i, reason);
      ++(reason.empty() ? report_.exact_points.verified : report_.exact_points.failed);
    }
  }

  // What could not be shown of the box; nothing where all was, or where there is nothing to check (`checkable`).
  std::string check_box(const CoverBox& box, bool& checkable) const {
    std::string reason = check_verdict(box, checkable);
    if (reason.empty() && box.kernel_at_most >= 0 && !kernel_->is_at_most(box.kernel_at_most, box.box))
      reason = "a kernel of a dimension above " + std::to_string(box.kernel_at_most) + " is not excluded";
    if (reason.empty()) reason = passage_->fault(box);
    if (reason.empty() && box.types != TypeLabels{}) reason = check_types(box);
    checkable = checkable || !reason.empty();
    return reason;
  }

  // A box whose only solution is known exactly has that point's types; else they are shown all over the box.
  std::string check_types(const CoverBox& box) const {
    if (!types_) return "it has types, but the file does not say of which ranks";
    const bool at_point = (box.verdict == Verdict::exact || box.verdict == Verdict::isolated) && box.point >= 0;
    if (at_point && exact_->has_types(box.point, box.types)) return {};
    return types_->of_box(box.types, box.box);
  }

  // A piece of a self-motion: one zero of its relations and what they leave, and no other of the equations themselves.
  std::string check_on_motion(const MotionCheck& motion, const CoverBox& box, const Box& region) const {
    if (!motion.fault().empty()) return "its self-motion is not shown to be one: " + motion.fault();
    std::string reason = check_sheet(*problem_, motion.rows(), box, region);
    return reason.empty() ? motion.unique(box, region) : reason;
  }

  std::string check_verdict(const CoverBox& box, bool& checkable) const {
    checkable = true;
    switch (box.verdict) {
      case Verdict::regular:
      case Verdict::isolated:
      case Verdict::boundary: {
        // Of an over-determined system with a tolerance the checker knows the written coefficients only.
        if (cover_.tolerance > 0 && system_.equations.size() > system_.variables.size()) {
          checkable = false;
          return {};
        }
        if (box.region < 0) return "the file has no region for it";
        const Box& region = cover_.regions[box.region];
        std::string reason = box.motion < 0 ? check_sheet_or_part(*problem_, box, region)
                                            : check_on_motion(*motions_[box.motion], box, region);
        // A solution, or a configuration in the box whose kernel is larger.
        if (reason.empty() && box.point >= 0) reason = exact_->fault_in(box, box.verdict != Verdict::isolated);
        return reason;
      }
      case Verdict::exact:
        if (box.motion >= 0) return "it names a self-motion but is not a piece of it";  // and would be missing in the points
        return exact_->fault_in(box, false);
      case Verdict::undecided:
        if (box.region >= 0) return "it names a region";
        if (box.point >= 0) return exact_->fault_in(box, true);
        checkable = false;
        return {};
      case Verdict::partial:
      case Verdict::pending: checkable = false; return {};
    }
    return {};
  }

  // All boxes, or the sample: any two samples have the same probability.
  std::vector<std::size_t> chosen() const {
    std::vector<std::size_t> all(cover_.boxes.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    if (options_.sample == 0 || options_.sample >= all.size()) return all;
    std::vector<std::size_t> some;
    std::sample(all.begin(), all.end(), std::back_inserter(some), options_.sample, std::mt19937_64(options_.seed));
    return some;
  }

  void check_boxes() {
    const std::vector<std::size_t> places = chosen();
    const std::size_t n = places.size();
    report_.left_out = cover_.boxes.size() - n;
    std::map<std::size_t, std::string> reasons;
    std::mutex adding;
    std::vector<unsigned char> checkable(n, 0), done(n, 0);
    std::atomic<std::uint64_t> count{0};
    const bool finished = parallel(arena_, n, [&](std::size_t i) {
      stop_.poll();
      bool can = false;
      std::string reason = check_box(cover_.boxes[places[i]], can);
      if (!reason.empty()) {
        const std::scoped_lock lock(adding);
        reasons[i] = std::move(reason);
      }
      checkable[i] = can;
      done[i] = 1;
      const std::uint64_t so_far = ++count;
      if (so_far % 32 == 0) progress(so_far, 0);
    });
    tally_boxes(places, reasons, checkable, done);
    if (!finished) throw Stopped{};
  }

  void tally_boxes(const std::vector<std::size_t>& places, const std::map<std::size_t, std::string>& reasons,
                   const std::vector<unsigned char>& checkable, const std::vector<unsigned char>& done) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      Tally& tally = report_.boxes[index(cover_.boxes[places[i]].verdict)];
      if (!done[i] || !checkable[i]) {
        ++tally.unchecked;
      } else if (!reasons.contains(i)) {
        ++tally.verified;
      } else {
        ++tally.failed;
        fail(Place::box, places[i], reasons.at(i));
      }
    }
  }

  // For sets of dimension 0: every proven box is a point and every proven point a box; every other box is inside a point.
  void check_points() {
    if (cover_.dimension != 0) {
      for (std::size_t i = 0; i < cover_.points.size(); ++i) fail(Place::point, i, "the set does not consist of points");
      return;
    }
    const auto by_box = [](const CoverBox& b) { return b.verdict != Verdict::undecided && b.verdict != Verdict::pending; };
    std::vector<unsigned char> claimed(cover_.points.size(), 0);
    std::size_t next = 0;  // points have the order of the boxes: look there first
    for (std::size_t i = 0; i < cover_.boxes.size(); ++i) {
      const CoverBox& box = cover_.boxes[i];
      if (box.verdict == Verdict::pending) continue;
      // Pieces of self-motions are no points, and what lies along a set claims nothing.
      if (box.motion >= 0 || (box.verdict == Verdict::undecided && box.reason == Reason::degenerate_set)) continue;
      stop_.poll();
      bool found = false;
      for (std::size_t turn = 0; turn < cover_.points.size() && !found; ++turn) {
        const std::size_t k = (next + turn) % cover_.points.size();
        const CoverBox& point = cover_.points[k];
        found =
            by_box(box) && by_box(point) ? !claimed[k] && same(box, point) : !by_box(box) && contains(point.box, box.box);
        found = found || (box.verdict == Verdict::exact && point.verdict == Verdict::exact && box.point == point.point);
        if (found) claimed[k] = 1, next = k + 1;
      }
      if (!found) fail(Place::box, i, "the list of points has no entry for it");
    }
    for (std::size_t k = 0; k < cover_.points.size(); ++k) {
      const CoverBox& point = cover_.points[k];
      std::string reason;
      if (!claimed[k]) reason = "there is no box for it";
      if (reason.empty() && point.verdict == Verdict::pending) reason = "a point cannot be pending";
      // An exact or undecided entry is not always one of the boxes, which have been checked.
      if (bool can = false; reason.empty() && (point.verdict == Verdict::exact || point.verdict == Verdict::undecided))
        reason = check_box(point, can);
      if (!reason.empty()) fail(Place::point, k, reason);
      const bool open = point.verdict == Verdict::undecided && point.point < 0;
      if (open && reason.empty()) ++report_.points_without_claim;
      ++(!reason.empty()                             ? report_.points.failed
         : open || point.verdict == Verdict::partial ? report_.points.unchecked
                                                     : report_.points.verified);
    }
  }

  // Each of the isolated and exact points is counted once.
  void check_distinct() {
    constexpr std::size_t kMostFailures = 100;
    std::vector<const Box*> boxes;
    std::vector<std::size_t> indices;
    for (std::size_t k = 0; k < cover_.points.size(); ++k) {
      const Verdict verdict = cover_.points[k].verdict;
      if (verdict != Verdict::isolated && verdict != Verdict::exact && verdict != Verdict::boundary) continue;
      boxes.push_back(&cover_.points[k].box);
      indices.push_back(k);
    }
    const auto apart = [&](std::size_t a, std::size_t b) {
      stop_.poll();
      return exact_->told_apart(cover_.points[indices[a]], cover_.points[indices[b]]);
    };
    for (const auto& [a, b] : meeting_pairs(boxes, apart, kMostFailures)) {
      fail(Place::point, indices[b], "it may be the same solution as point " + std::to_string(indices[a] + 1));
    }
  }

  void check_proof() {
    const auto step = [this](std::uint64_t number) {
      progress(cover_.boxes.size() - report_.left_out, number);
      return stop_.is_set();
    };
    Replayed result = arena_.execute([&] { return replay(*problem_, cover_, step); });
    report_.proof = result.tally;
    report_.proof.open = !result.tally.verified && !result.malformed && !result.interrupted && !cover_.self_motions.empty();
    if (report_.proof.open) return;
    report_.interrupted = report_.interrupted || result.interrupted;
    report_.failures.insert(report_.failures.end(), result.failures.begin(), result.failures.end());
  }

  void progress(std::uint64_t boxes, std::uint64_t steps) {
    if (!options_.progress) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock.owns_lock())
      options_.progress(
          {boxes, cover_.boxes.size() - report_.left_out, steps, cover_.proof ? cover_.proof->steps.size() : 0});
  }

  const System& system_;
  const Cover& cover_;
  const Options& options_;
  const VelocityBlocks* blocks_;
  StopFlag stop_;
  const char* stage_ = "the reduction";
  ThreadArena arena_;
  std::unique_ptr<const KernelCheck> kernel_;
  std::unique_ptr<const PassageCheck> passage_;
  std::unique_ptr<const TypeCheck> types_;
  std::optional<Problem> problem_;
  std::vector<std::unique_ptr<const MotionCheck>> motions_;
  std::unique_ptr<ExactPoints> exact_;
  std::mutex mutex_;
  Report report_;
};

}  // namespace

bool Report::confirmed() const {
  if (!consistent() || (proof.present && !proof.verified && !proof.open) || points.unchecked > points_without_claim)
    return false;
  for (int v = 0; v < kVerdicts; ++v) {
    const auto verdict = static_cast<Verdict>(v);
    const bool claims = verdict != Verdict::undecided && verdict != Verdict::pending;
    if (const Tally& t = boxes[v]; t.failed > 0 || (claims && t.unchecked > 0)) return false;
  }
  return true;
}

bool Report::verified() const { return left_out == 0 && confirmed(); }

bool Report::complete() const {
  const Tally& pending = boxes[index(Verdict::pending)];
  return verified() && proof.present && proof.verified && pending == Tally{};
}

Report check(const System& system, const Cover& cover, const Options& options, const VelocityBlocks* blocks) {
  return Checker(system, cover, options, blocks).run();
}

}  // namespace corank::check
