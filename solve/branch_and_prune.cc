// The search: depth first, so that memory grows with the depth and the results; what happens to a box does not depend on any other
// box, so threads only share the work and the sorted result is the same for any number of them.
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
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

#include "corank/certify/check.h"
#include "corank/certify/rounding.h"
#include "corank/solve/box_processor.h"
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

using certify::Cover;
using certify::Interval;
using certify::Verdict;
using Clock = std::chrono::steady_clock;

class Search {
 public:
  Search(const certify::Reduction& reduction, const Options& options, double sigma)
      : options_(options),
        control_(*options.control),
        problem_(reduction, sigma,
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

  void run(const certify::Reduction& reduction) {
    roots_ = roots_of(reduction);
    WorkList all(reduction.kept.size());
    for (std::size_t r = roots_.size(); r-- > 0;) all.push(roots_[r].data(), 1.0 / static_cast<double>(roots_.size()), r);
    waiting_ = roots_.size();
    execute([&] {
      if (threads_ == 1) {
        work(std::move(all));
      } else {
        spawn(std::move(all));
        CORANK_CHECK(group_.wait() != tbb::canceled);  // else waiting boxes would be lost
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
  std::shared_ptr<const certify::Proof> proof(const std::vector<Found*>& found) {
    std::map<LeafId, int> place;
    for (std::size_t i = 0; i < found.size(); ++i)
      for (const LeafId leaf : found[i]->leaves) place[leaf] = static_cast<int>(i);
    std::vector<const Recorder*> recorders;
    for (Worker& w : workers_)
      if (w.recorder) recorders.push_back(w.recorder.get());
    std::vector<NodeId> nodes(roots_.size());
    std::iota(nodes.begin(), nodes.end(), NodeId{0});
    return std::make_shared<const certify::Proof>(Recorder::assemble(recorders, roots_, nodes, place));
  }
  void merge(std::vector<Found*>& found) const {
    merge_regular(problem_, found, [this] { return control_.ended(); });
  }
  certify::Statistics statistics() {
    certify::Statistics sum;
    for (Worker& w : workers_) {
      const certify::Statistics& s = w.processor.statistics();
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
    for (int v = 0; v < certify::kVerdicts; ++v) p.verdicts[v] = verdicts_[v];
    p.seconds = now;
    const certify::NearestRounding nearest;  // the callback is not ours
    options_.progress(p);
  }
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  struct Worker {  // one per thread
    Worker(const Problem& problem, int number)
        : recorder(number > 0 ? std::make_unique<Recorder>(number) : nullptr), processor(problem, recorder.get()) {}
    std::unique_ptr<Recorder> recorder;
    BoxProcessor processor;
    std::size_t counted = 0, weighed = 0;  // of processor.found()
    std::uint64_t recorded = 0;            // bytes of the recorder
  };

  // The boxes to search, in the variables that are kept, within the domain.
  std::vector<certify::Box> roots_of(const certify::Reduction& reduction) const {
    certify::Box domain;
    for (const auto& v : reduction.system.variables) domain.push_back(v.domain);
    if (options_.roots.empty()) return {domain};
    std::vector<certify::Box> roots;
    for (const certify::Box& given : options_.roots) {
      certify::Box root = domain;
      bool empty = false;
      for (std::size_t j = 0; j < root.size(); ++j)
        empty = empty || !root[j].intersect(given.at(static_cast<std::size_t>(reduction.kept[j])));
      if (!empty) roots.push_back(std::move(root));
    }
    return roots;
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
    if (!options_.progress && options_.max_solutions == 0 && options_.max_found == 0) return;
    const std::vector<Found>& found = worker.processor.found();
    for (; worker.counted < found.size(); ++worker.counted) {
      const Found& f = found[worker.counted];
      ++verdicts_[static_cast<int>(f.box.verdict)];
      if (++found_ == options_.max_found) end(Limit::found);
      if (options_.max_solutions == 0 || f.box.verdict == Verdict::undecided || f.box.verdict == Verdict::pending) continue;
      const std::lock_guard lock(solutions_mutex_);
      if (f.sheet) {
        isolated_.add(*f.sheet);
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
    const certify::UpwardRounding rounding;
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
      const double share = list.pop(x.data());
      if (worker.recorder) worker.recorder->begin(node, x.data(), problem_.compiled.variables());
      const auto outcome = processor.process(x.data());
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
        list.push(x.data(), share * (1 - kBisectionPoint), upper);
        x[j] = Interval(side.lo(), at);
        list.push(x.data(), share * kBisectionPoint, lower);
        waiting_.fetch_add(1, std::memory_order_relaxed);
      } else {
        waiting_.fetch_sub(1, std::memory_order_relaxed);
      }
      if (outcome == BoxProcessor::Outcome::done) done_share_.fetch_add(share, std::memory_order_relaxed);
      count_found(worker);
      if (busy_.load(std::memory_order_relaxed) < threads_ && threads_ > 1 && list.size() > 1) spawn(list.split_off());
    }
    keep(-listed);
    while (!list.empty()) {
      const NodeId node = list.node();
      list.pop(x.data());
      if (worker.recorder) worker.recorder->begin(node, x.data(), problem_.compiled.variables());
      processor.leave(x.data());
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
  std::vector<certify::Box> roots_;
  std::atomic<int> busy_{0}, recorders_{0};
  std::atomic<bool> ended_{false};
  std::atomic<std::uint64_t> processed_{0}, waiting_{0}, found_{0};
  std::atomic<double> done_share_{0};
  std::array<std::atomic<std::uint64_t>, certify::kVerdicts> verdicts_{};
  std::mutex solutions_mutex_;
  DistinctSolutions isolated_;
  std::uint64_t pieces_ = 0;  // proven boxes with free variables
  std::mutex progress_mutex_;
  double last_report_ = 0;
  Clock::time_point start_ = Clock::now();
};

certify::Reduction reduced(const certify::System& system, Control& control) {
  const InStage stage(control, Stage::reduction);
  return certify::reduce(system, [&control] { return control.ended(); });
}

std::string format(double x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

}  // namespace

Control::Limits limits_of(const Options& options) {
  return {.time = options.time_limit, .boxes = options.max_boxes, .memory = options.memory_limit, .stop = options.stop};
}

double default_sigma(const certify::System& system) { return default_sigma(system, certify::reduce(system)); }

double default_sigma(const certify::System& system, const certify::Reduction& reduction) {
  // An over-determined system with a tolerance may have a set of any dimension.
  const bool over_determined = system.equations.size() > system.variables.size() && system.coefficient_tolerance > 0;
  constexpr double kCurves = 0.1, kPoints = 1e-6;
  if (over_determined || reduction.system.dimension() > 0) return kCurves;
  return std::clamp(std::sqrt(system.coefficient_tolerance), kPoints, kCurves);
}

double printed_tolerance(const certify::System& system) {
  constexpr double kPrintedDecimals = 1e-6;
  return system.equations.size() > system.variables.size() ? kPrintedDecimals : 0;
}

double smallest_sigma(const certify::System& system) {
  double largest = 0;
  for (const auto& v : system.variables) largest = std::max(largest, v.domain.mag());
  return (system.dimension() == 0 ? 1e-16 : 1e-10) * largest;
}

Cover solve(const certify::System& system, const Options& given) {
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
  const double sigma = options.sigma ? *options.sigma : default_sigma(system, reduction);
  if (!(sigma > 0) || !std::isfinite(sigma)) throw std::invalid_argument("sigma must be a positive number");
  if (const double least = smallest_sigma(system); sigma < least)
    throw std::invalid_argument("sigma is below " + format(least) + ", what boxes of doubles resolve in this domain");

  const certify::Ended overdue = [&control] { return control.overdue(); };
  Search search(reduction, options, sigma);
  if (reduction.consistent) {
    const InStage stage(control, Stage::search);
    search.run(reduction);
  }

  Cover cover;
  cover.dimension = reduction.system.dimension();
  cover.sigma = sigma;
  cover.reduction = reduction.steps;
  cover.statistics = search.statistics();
  std::vector<Found*> found = search.gather();
  bool some_partial = false;
  for (const Found* f : found) {
    if (f->box.verdict != Verdict::partial) continue;
    some_partial = true;
    cover.dimension = std::max(cover.dimension, static_cast<int>(f->box.free.size()));
  }
  if (reduction.tolerant || some_partial)
    cover.tolerance = reduction.system.coefficient_tolerance * certify::kPartialTolerance;
  search.execute([&] {
    const certify::UpwardRounding rounding;  // and subnormal numbers stay
    sort(found);
    if (cover.dimension == 0) {
      const InStage stage(control, Stage::points);
      merge_isolated(found, overdue);
      cover.regions = number_regions(reduction, found);
      cover.points = collect_points(found, sigma, overdue);
    } else {
      const InStage stage(control, Stage::merging);
      const std::size_t before = found.size();
      search.merge(found);
      if (found.size() < before) sort(found);  // merged boxes have other sides
      cover.regions = number_regions(reduction, found);
    }
    if (options.proof && reduction.consistent && !reduction.tolerant && !some_partial) cover.proof = search.proof(found);
    for (certify::CoverBox& point : cover.points) point = lifted(system, reduction, std::move(point));
    cover.boxes = lifted(system, reduction, found);
  });
  cover.statistics.seconds_total = search.seconds();
  cover.statistics.seconds_search = cover.statistics.seconds_total - cover.statistics.seconds_certify;
  search.report(true);
  return cover;
}

}  // namespace corank::solve
