// The search: depth first, so that memory grows with the depth and the results; what happens to a box does not depend on any
// other box, so threads only share the work and the sorted result is the same for any number of them.
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "corank/core/check.h"
#include "corank/core/nearest_rounding.h"
#include "corank/core/rounding.h"
#include "corank/solve/box_processor.h"
#include "corank/solve/degeneracy.h"
#include "corank/solve/distinct_solutions.h"
#include "corank/solve/gathering.h"
#include "corank/solve/memory.h"
#include "corank/solve/merging.h"
#include "corank/solve/points.h"
#include "corank/solve/recorder.h"
#include "corank/solve/solve.h"
#include "corank/solve/work_list.h"

namespace corank::solve {
namespace {
using Clock = std::chrono::steady_clock;

constexpr double kPointGap = 1e-6;  // of the typical sizes: closer undecided boxes are of one point
// Boxes that resist proof next to a degenerate solution wait until the others are done, first of this size, then of the
// next.
constexpr double kFirstShare = 1.0 / 20, kNextShare = 1.0 / 4;

class Search {
 public:
  Search(const System& system, const certify::Reduction& reduction, const Options& options)
      : options_(options),
        control_(*options.control),
        problem_(system, reduction,
                 [this] {
                   report(false);
                   count_found(workers_.local());
                   return limit_reached();
                 }),
        workers_([this] {
          keep(memory_.of_thread());
          return Worker(problem_, options_.proof ? ++recorders_ : 0);
        }),
        memory_(reduction, control_.limits().later_bytes),
        threads_(options.threads > 0 ? options.threads : tbb::this_task_arena::max_concurrency()),
        allow_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_)),
        arena_(threads_) {}

  ~Search() { control_.keep(-kept_); }

  // Runs f where its parallel parts have the threads that the options allow.
  template <class F>
  void execute(F f) {
    arena_.execute(f);
  }

  const Problem& problem() const { return problem_; }
  const SelfMotions& motions() const { return motions_; }
  void set_sigma(const Sigma& sigma) { problem_.set_sigma(sigma); }

  // Finds sheets, and boxes that nothing can be proven of.
  void run(const certify::Reduction& reduction) {
    roots_ = roots_of(reduction);
    WorkList list(reduction.kept.size());
    for (std::size_t r = roots_.size(); r-- > 0;) list.push(roots_[r], 1.0 / static_cast<double>(roots_.size()), r);
    for (share_ = kFirstShare; !list.empty(); share_ *= kNextShare) {
      search(std::move(list));
      list = divide_postponed(reduction.system);
    }
  }

  // The sheets that were found, over all threads.
  std::vector<const Proven*> sheets() {
    std::vector<const Proven*> all;
    for (Worker& w : workers_)
      for (const Proven& sheet : w.processor.proven()) all.push_back(&sheet);
    return all;
  }

  // Cuts them to σ.
  void cut() {
    const std::vector<const Proven*> all = sheets();
    cutting_ = true;
    // A search that was long enough: what it has found is cut all the same. What another limit has ended is left uncut:
    // proven.
    const auto ending = control_.ending();
    const bool whole = ended_ && ending && ending->by != Limit::boxes && ending->by != Limit::solutions;
    if (!whole) ended_ = false;
    execute([&] {
      const auto cut_one = [&](std::size_t i) {
        const UpwardRounding rounding;
        Worker& worker = workers_.local();
        worker.processor.cut(*all[i], whole);
        count_found(worker);
      };
      if (threads_ == 1) {
        for (std::size_t i = 0; i < all.size(); ++i) cut_one(i);
      } else {
        tbb::parallel_for(std::size_t{0}, all.size(), cut_one);
      }
    });
  }

  // What all threads have found; it stays theirs. To be called once: it notes each box's leaf.
  std::vector<Found*> gather() {
    std::vector<Found*> all;
    for (Worker& w : workers_) {
      std::vector<Found>& found = w.processor.found();
      for (std::size_t i = 0; i < found.size(); ++i) {
        if (w.recorder) found[i].leaves.push_back(w.recorder->leaf(i));
        all.push_back(&found[i]);
      }
    }
    return all;
  }
  // The script; `found` are the boxes as the cover has them.
  std::shared_ptr<const Proof> proof(const std::vector<Found*>& found) {
    std::map<LeafId, int> place;
    for (std::size_t i = 0; i < found.size(); ++i)
      for (const LeafId leaf : found[i]->leaves) place[leaf] = static_cast<int>(i);
    std::vector<const Recorder*> recorders;
    for (Worker& w : workers_)
      if (w.recorder) recorders.push_back(w.recorder.get());
    std::vector<NodeId> nodes(roots_.size());
    std::iota(nodes.begin(), nodes.end(), NodeId{0});
    return std::make_shared<const Proof>(Recorder::assemble(recorders, roots_, nodes, place));
  }
  void merge(std::vector<Found*>& found) const {
    merge_regular(problem_, found, [this] { return control_.ended(); });
  }
  Statistics statistics() {
    Statistics sum;
    for (Worker& w : workers_) {
      const Statistics& s = w.processor.statistics();
      sum.processed += s.processed;
      sum.newton_steps += s.newton_steps;
      sum.proofs_tried += s.proofs_tried;
      sum.seconds_certify += s.seconds_certify / threads_;
    }
    return sum;
  }
  void report(bool last) {
    if (!options_.progress) return;
    std::unique_lock lock(progress_mutex_, std::try_to_lock);
    if (!lock.owns_lock()) return;
    const double now = seconds();
    if (!last && now - last_report_ < options_.progress_interval) return;
    last_report_ = now;
    Progress p;
    p.processed = processed_;
    p.waiting = waiting_;
    p.excluded = done_share_.load();
    for (int v = 0; v < kVerdicts; ++v) p.verdicts[v] = verdicts_[v];
    p.seconds = now;
    const NearestRounding nearest;  // the callback is not ours
    options_.progress(p);
  }
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  struct Worker {  // one per thread
    Worker(const Problem& problem, int number)
        : recorder(number > 0 ? std::make_unique<Recorder>(number) : nullptr), processor(problem, recorder.get()) {}
    std::unique_ptr<Recorder> recorder;
    BoxProcessor processor;
    std::size_t counted = 0, counted_sheets = 0, weighed = 0;  // of processor.found(), of proven(), of found()
    std::uint64_t recorded = 0;                                // bytes of the recorder
  };

  // The boxes to search, in the variables that are kept, within the domain.
  std::vector<Box> roots_of(const certify::Reduction& reduction) const {
    Box domain;
    for (const auto& v : reduction.system.variables) domain.push_back(v.domain);
    if (options_.roots.empty()) return {domain};
    std::vector<Box> roots;
    for (const Box& given : options_.roots) {
      Box root = domain;
      bool empty = false;
      for (std::size_t j = 0; j < root.size(); ++j)
        empty = empty || !root[j].intersect(given.at(static_cast<std::size_t>(reduction.kept[j])));
      if (!empty) roots.push_back(std::move(root));
    }
    return roots;
  }

  void search(WorkList list) {
    waiting_ = list.size();
    execute([&] {
      if (threads_ == 1) {
        work(std::move(list));
      } else {
        spawn(std::move(list));
        CORANK_CHECK(group_.wait() != tbb::canceled);  // else waiting boxes would be lost
      }
    });
  }

  // What is to be searched further of the boxes that were postponed; the others are given up.
  WorkList divide_postponed(const System& system) {
    std::vector<Postponed> all;
    for (Worker& w : workers_) {
      std::move(w.processor.postponed().begin(), w.processor.postponed().end(), std::back_inserter(all));
      w.processor.postponed().clear();
    }
    std::sort(all.begin(), all.end(), [](const Postponed& a, const Postponed& b) {
      return std::lexicographical_compare(a.x.begin(), a.x.end(), b.x.begin(), b.x.end(), [](const auto& x, const auto& y) {
        return std::pair(x.lo(), x.hi()) < std::pair(y.lo(), y.hi());
      });
    });
    WorkList list(static_cast<std::size_t>(problem_.compiled.variables()));
    const UpwardRounding rounding;
    Worker& worker = workers_.local();
    std::vector<Reason> reasons = motions_.prove(problem_, system, all, share_);
    if (limit_reached()) std::replace(reasons.begin(), reasons.end(), Reason::none, Reason::limit);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Postponed& box = all[i];
      if (all[i].proof.proven) {
        worker.processor.add_proven(all[i]);
        done_share_.fetch_add(box.share, std::memory_order_relaxed);
        count_found(worker);
        continue;
      }
      if (reasons[i] == Reason::none) {
        list.push(box.x, box.share, box.node);
        continue;
      }
      if (worker.recorder) worker.recorder->begin(box.node, box.x, problem_.compiled.variables());
      worker.processor.give_up(box.x, reasons[i]);
      done_share_.fetch_add(box.share, std::memory_order_relaxed);
      count_found(worker);
    }
    return list;
  }

  void spawn(WorkList list) {
    ++busy_;
    auto shared = std::make_shared<WorkList>(std::move(list));
    group_.run([this, shared] {
      work(std::move(*shared));
      --busy_;
    });
  }

  bool limit_reached() {
    if (ended_.load(std::memory_order_relaxed)) return true;
    if (cutting_) {
      const std::uint64_t most = control_.limits().memory;
      const bool full = most > 0 && control_.kept() > static_cast<std::int64_t>(most);
      if (full) control_.note(Limit::memory);
      if (full || control_.ended()) ended_ = true;
      return ended_;
    }
    const bool over =
        control_.search_ended() || (options_.max_boxes && processed_.load(std::memory_order_relaxed) >= options_.max_boxes);
    if (over) ended_ = true;
    return over;
  }

  void end(Limit by) {
    if (!ended_.exchange(true)) control_.note(by);
  }
  void keep(std::int64_t bytes) {
    kept_.fetch_add(bytes, std::memory_order_relaxed);
    control_.keep(bytes);
  }
  // Counts what this thread has kept since the last call.
  void weigh(Worker& worker) {
    if (control_.limits().memory == 0) return;
    std::int64_t bytes = 0;
    for (const auto& found = worker.processor.found(); worker.weighed < found.size(); ++worker.weighed)
      bytes += memory_.of(found[worker.weighed], worker.weighed > 0 ? &found[worker.weighed - 1] : nullptr);
    if (worker.recorder) {
      const std::uint64_t recorded = worker.recorder->bytes();
      bytes += memory_.of_script(recorded - worker.recorded);
      worker.recorded = recorded;
    }
    if (bytes > 0) keep(bytes);
  }

  // Counts what this thread has found since the last call: for the progress, and towards max_solutions.
  void count_found(Worker& worker) {
    weigh(worker);
    if (!options_.progress && options_.max_solutions == 0 && options_.max_found == 0 && control_.limits().memory == 0)
      return;
    count_sheets(worker);
    const std::vector<Found>& found = worker.processor.found();
    for (; worker.counted < found.size(); ++worker.counted) {
      const Found& f = found[worker.counted];
      ++verdicts_[static_cast<int>(f.box.verdict)];
      if (++found_ == options_.max_found) end(Limit::found);
      const bool proven = f.box.verdict != Verdict::undecided && f.box.verdict != Verdict::pending;
      if (cutting_ && proven && !f.box.free.empty() && ++cut_ == options_.max_solutions) end(Limit::solutions);
    }
  }

  // Sheets count before they are cut.
  void count_sheets(Worker& worker) {
    const std::vector<Proven>& sheets = worker.processor.proven();
    const std::size_t postponed = worker.processor.postponed().size();
    if (options_.max_found > 0 && sheets_ + postponed >= options_.max_found) end(Limit::found);
    for (; worker.counted_sheets < sheets.size(); ++worker.counted_sheets) {
      const certify::Sheet& sheet = sheets[worker.counted_sheets].sheet;
      keep(static_cast<std::int64_t>(3 * sheet.region.size() * sizeof(Interval)));
      if (++sheets_ == options_.max_found) end(Limit::found);
      if (options_.max_solutions == 0) continue;
      const std::lock_guard lock(solutions_mutex_);
      if (sheet.dependent.size() == sheet.region.size()) {
        isolated_.add(sheet);
      } else {
        ++pieces_;
      }
      if (pieces_ + isolated_.count() < options_.max_solutions) continue;
      end(Limit::solutions);
    }
  }

  // Counts a box that is about to be processed; false: there is to be none.
  bool count_one() {
    if (limit_reached() || !control_.count_box()) return false;
    const std::uint64_t before = processed_.fetch_add(1, std::memory_order_relaxed);
    if (options_.progress && before % 64 == 0) report(false);
    return true;
  }

  void work(WorkList list) {
    const UpwardRounding rounding;
    Worker& worker = workers_.local();
    BoxProcessor& processor = worker.processor;
    std::vector<Interval> x(problem_.compiled.variables());
    std::int64_t listed = 0;
    while (!list.empty()) {
      if (control_.limits().memory > 0) {
        const std::int64_t now = memory_.of_waiting(list.size());
        keep(now - std::exchange(listed, now));
      }
      if (!count_one()) break;
      const NodeId node = list.node();
      const double share = list.pop(x);
      if (worker.recorder) worker.recorder->begin(node, x, problem_.compiled.variables());
      const auto outcome = processor.process(x, share_);
      if (outcome == BoxProcessor::Outcome::split) {
        const int j = processor.split_variable();
        const Interval side = x[j];
        const double at = *split_point(side);
        NodeId lower = 0, upper = 0;
        if (worker.recorder) {
          lower = worker.recorder->new_node();
          upper = worker.recorder->new_node();
          worker.recorder->split(j, at, lower, upper);
        }
        x[j] = Interval(at, side.hi());
        list.push(x, share * (1 - kBisectionPoint), upper);
        x[j] = Interval(side.lo(), at);
        list.push(x, share * kBisectionPoint, lower);
        waiting_.fetch_add(1, std::memory_order_relaxed);
      } else {
        waiting_.fetch_sub(1, std::memory_order_relaxed);
      }
      if (outcome == BoxProcessor::Outcome::postponed) processor.postponed().back().share = share;
      if (outcome == BoxProcessor::Outcome::done) done_share_.fetch_add(share, std::memory_order_relaxed);
      count_found(worker);
      if (busy_.load(std::memory_order_relaxed) < threads_ && threads_ > 1 && list.size() > 1) spawn(list.split_off());
    }
    keep(-listed);
    while (!list.empty()) {
      const NodeId node = list.node();
      list.pop(x);
      if (worker.recorder) worker.recorder->begin(node, x, problem_.compiled.variables());
      processor.leave(x);
    }
  }

  const Options& options_;
  Control& control_;
  std::atomic<std::int64_t> kept_{0};  // bytes that this search has told the control of
  Problem problem_;
  tbb::enumerable_thread_specific<Worker> workers_;
  MemoryEstimate memory_;
  int threads_;
  tbb::global_control allow_;
  tbb::task_arena arena_;
  tbb::task_group group_;
  std::vector<Box> roots_;
  SelfMotions motions_;
  double share_ = kFirstShare;  // of the typical sizes: how small boxes are that may be postponed
  std::atomic<int> busy_{0}, recorders_{0};
  std::atomic<bool> ended_{false}, cutting_{false};
  std::atomic<std::uint64_t> processed_{0}, waiting_{0}, found_{0}, sheets_{0}, cut_{0};
  std::atomic<double> done_share_{0};
  std::array<std::atomic<std::uint64_t>, kVerdicts> verdicts_{};
  std::mutex solutions_mutex_;
  DistinctSolutions isolated_;
  std::uint64_t pieces_ = 0;  // proven boxes with free variables
  std::mutex progress_mutex_;
  double last_report_ = 0;
  Clock::time_point start_ = Clock::now();
};

std::string format(double x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

}  // namespace

certify::Reduction reduced(const System& system, Control& control) {
  const InStage stage(control, Stage::reduction);
  return certify::reduce(system, [&control] { return control.ended(); });
}

Control::Limits limits_of(const Options& options) {
  return {.time = options.time_limit, .boxes = options.max_boxes, .memory = options.memory_limit, .stop = options.stop};
}

double printed_tolerance(const System& system) {
  constexpr double kPrintedDecimals = 1e-6;
  return system.equations.size() > system.variables.size() ? kPrintedDecimals : 0;
}

Sigma smallest_sigma(const System& system) {
  Sigma largest;
  for (const auto& v : system.variables) {
    const SigmaClass kind = sigma_class(v);
    if (kind == SigmaClass::length) largest.length = std::max(largest.length, v.domain.mag());
    if (kind == SigmaClass::angle) largest.angle = std::max(largest.angle, v.domain.mag());
  }
  const double share = system.dimension() == 0 ? 1e-16 : 1e-10;
  return {share * largest.length, share * largest.angle};
}

namespace {

void check_sigma(const char* name, const std::optional<double>& sigma, double least) {
  if (!sigma) return;
  if (!(*sigma > 0) || !std::isfinite(*sigma)) throw std::invalid_argument(std::string(name) + " must be a positive number");
  if (*sigma < least)
    throw std::invalid_argument(std::string(name) + " is below " + format(least) +
                                ", what boxes of doubles resolve in this domain");
}

// The σ that is asked for, the others by default from the hull of a set.
Sigma chosen_sigma(const System& system, const Options& options, const Box& hull, int dimension) {
  const Sigma by_default = default_sigma(system, hull, dimension);
  const auto coarser = [&](double sigma) { return dimension == 0 ? sigma : sigma * options.coarser; };
  return {options.sigma_length.value_or(coarser(by_default.length)),
          options.sigma_angle.value_or(coarser(by_default.angle))};
}

// The hull of what has been found, in all variables; the domain where there is nothing.
Box hull_of(const System& system, const certify::Reduction& reduction, Search& search) {
  const UpwardRounding rounding;
  Box hull;
  for (const Proven* proven : search.sheets()) {
    Box sides = proven->sheet.image;
    for (std::size_t j = 0; j < sides.size(); ++j) sides[j].intersect(proven->x[j]);
    search.problem().append_values(sides);
    for (std::size_t j = 0; j < hull.size(); ++j) hull[j] = Interval::hull(hull[j], sides[j]);
    if (hull.empty()) hull = std::move(sides);
  }
  if (!hull.empty()) return reduction.lift(hull);
  for (const auto& v : system.variables) hull.push_back(v.domain);
  return hull;
}

// Of the sets found: self-motions are larger than expected.
int largest_dimension(int dimension, Search& search) {
  for (const Proven* proven : search.sheets())
    dimension = std::max(dimension, static_cast<int>(proven->sheet.region.size() - proven->sheet.dependent.size()));
  return dimension;
}

}  // namespace

Cover solve(const System& system, const Options& given) {
  if (!given.control) {
    Control control(limits_of(given));
    Options options = given;
    options.control = &control;
    options.max_boxes = 0;  // the control's
    return solve(system, options);
  }
  Control& control = *given.control;
  if (!given.reduction) {
    system.validate();
    const certify::Reduction reduction = reduced(system, control);
    Options options = given;
    options.reduction = &reduction;
    return solve(system, options);
  }
  const Options& options = given;
  const certify::Reduction& reduction = *options.reduction;
  const Sigma least = smallest_sigma(system);
  check_sigma("sigma of lengths", options.sigma_length, least.length);
  check_sigma("sigma of angles", options.sigma_angle, least.angle);

  const Ended overdue = [&control] { return control.overdue(); };
  Search search(system, reduction, options);
  Cover cover;
  cover.dimension = reduction.system.dimension();
  // What the tolerance of coefficients moves is no reason for narrower boxes, and such systems are searched by σ.
  Box domain;
  for (const auto& v : system.variables) domain.push_back(v.domain);
  const bool any_dimension = search.problem().tolerant && system.equations.size() > system.variables.size();
  cover.sigma = chosen_sigma(system, options, domain, any_dimension ? 1 : cover.dimension);
  search.set_sigma(cover.sigma);
  if (reduction.consistent) {
    const InStage stage(control, Stage::search);
    search.run(reduction);
    if (!search.problem().tolerant)
      cover.sigma =
          chosen_sigma(system, options, hull_of(system, reduction, search), largest_dimension(cover.dimension, search));
    search.set_sigma(cover.sigma);
    search.cut();
  }
  cover.reduction = reduction.steps;
  cover.statistics = search.statistics();
  std::vector<Found*> found = search.gather();
  bool some_partial = false;
  for (const Found* f : found) {
    if (f->box.verdict != Verdict::partial) continue;
    some_partial = true;
    cover.dimension = std::max(cover.dimension, static_cast<int>(f->box.free.size()));
  }
  if (reduction.tolerant || some_partial) cover.tolerance = reduction.system.coefficient_tolerance * kPartialTolerance;
  search.execute([&] {
    const UpwardRounding rounding;  // and subnormal numbers stay
    sort(found);
    if (cover.dimension == 0) {
      const InStage stage(control, Stage::points);
      merge_isolated(found, overdue);
      cover.regions = number_regions(reduction, found);
      cover.points = collect_points(found, search.problem().limits(kPointGap), overdue);
    } else {
      const InStage stage(control, Stage::merging);
      const std::size_t before = found.size();
      if (options.max_solutions == 0) search.merge(found);  // it might leave fewer than were asked for
      if (found.size() < before) sort(found);               // merged boxes have other sides
      cover.regions = number_regions(reduction, found);
    }
    for (const Found* f : found) cover.wider_than_sigma += f->region != nullptr && search.problem().excess(f->box.box) > 1;
    // A replay would have to find the self-motions again.
    const bool replayable = reduction.consistent && !reduction.tolerant && !some_partial && search.motions().none();
    if (options.proof && replayable) cover.proof = search.proof(found);
    cover.self_motions = search.motions().records(reduction);
    if (std::any_of(found.begin(), found.end(), [](const Found* f) { return f->box.reason == Reason::degenerate_set; }))
      cover.observed_dimension = search.motions().observed_dimension();
    for (CoverBox& point : cover.points) point = lifted(system, reduction, std::move(point));
    cover.boxes = lifted(system, reduction, found);
  });
  cover.statistics.seconds_total = search.seconds();
  cover.statistics.seconds_search = cover.statistics.seconds_total - cover.statistics.seconds_certify;
  search.report(true);
  return cover;
}

}  // namespace corank::solve
