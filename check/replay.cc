#include "corank/check/replay.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "corank/check/search.h"

namespace corank::check {
namespace {

using Step = Proof::Step;

constexpr std::size_t kMostFailures = 100;
constexpr std::size_t kTaskSteps = 500;  // a smaller part is no task of its own
constexpr int kDeepest = 5000;

struct Cursor {
  std::size_t step = 0, integer = 0, real = 0;
};

struct Malformed {
  std::size_t step;
  std::string reason;
};

// The script's structure: where each part of a split or cut begins and where the last one ends; where each root begins.
class Script {
 public:
  Script(const Proof& proof, const Problem& problem, std::size_t boxes) : proof_(proof), problem_(problem), boxes_(boxes) {
    check_values();
    for (std::size_t r = 0; r < proof.roots.size(); ++r) {
      roots_.push_back(cursor_);
      scan_tree();
    }
    if (cursor_.step != proof.steps.size() || cursor_.integer != proof.integers.size() || cursor_.real != proof.reals.size())
      refuse("the script goes on after its last leaf");
  }

  Cursor root(std::size_t r) const { return roots_[r]; }
  Step step(const Cursor& at) const { return static_cast<Step>(proof_.steps[at.step]); }
  int integer(const Cursor& at, std::size_t k) const { return proof_.integers[at.integer + k]; }
  double real(const Cursor& at, std::size_t k) const { return proof_.reals[at.real + k]; }
  Cursor after(const Cursor& at) const {
    const auto [integers, reals] = arity(at);
    return {at.step + 1, at.integer + integers, at.real + reals};
  }
  /// Of a split or cut: the beginnings of its parts and the end of the last.
  const Cursor* parts(const Cursor& at) const {
    const auto found = std::ranges::lower_bound(branches_, std::make_pair(at.step, std::size_t{0}));
    return starts_.data() + found->second;
  }

 private:
  [[noreturn]] void refuse(const std::string& reason) const { throw Malformed{cursor_.step, reason}; }

  void check_values() const {
    const std::size_t n = problem_.size();
    for (const auto& root : proof_.roots)
      if (!is_box(root, n)) refuse("a root does not have one bounded side for each variable that was kept");
    const auto within = [](const std::vector<int>& list, std::size_t size) {
      return std::ranges::all_of(list, [&](int i) { return i >= 0 && static_cast<std::size_t>(i) < size; });
    };
    for (const Proof::Combination& c : proof_.combinations)
      if (c.equations.size() != c.dependent.size() || c.y.size() != c.dependent.size() * c.dependent.size() ||
          !within(c.equations, problem_.equations().size()) || !within(c.dependent, n) ||
          !std::ranges::all_of(c.y, [](float y) { return std::isfinite(y); }))
        refuse("a combination is malformed");
    if (std::ranges::any_of(proof_.reals, [](double x) { return std::isnan(x); })) refuse("a value is not a number");
  }

  std::size_t count(const Cursor& at, std::size_t k) const {
    if (at.integer + k >= proof_.integers.size()) refuse("the script ends early");
    const int c = proof_.integers[at.integer + k];
    if (c < 0) refuse("a count is negative");
    return c;
  }

  // Numbers of integers and reals that belong to the step.
  std::pair<std::size_t, std::size_t> arity(const Cursor& at) const {
    switch (step(at)) {
      case Step::row:
      case Step::newton:
      case Step::box:
      case Step::root: return {1, 0};
      case Step::keep: {
        const std::size_t c = count(at, 0);
        return {1 + c, c};
      }
      case Step::split: return {1, 1};
      case Step::cut: return {2, count(at, 1)};
      case Step::empty:
      case Step::elsewhere: return {0, 0};
    }
    refuse("an unknown step");
  }

  void check_step() const {
    const auto below = [&](std::size_t k, std::size_t size) {
      if (const int i = integer(cursor_, k); i < 0 || static_cast<std::size_t>(i) >= size)
        refuse("an index is out of range");
    };
    const std::size_t n = problem_.size();
    switch (step(cursor_)) {
      case Step::row:
        if (integer(cursor_, 0) < 0) {
          if (static_cast<std::size_t>(-1L - integer(cursor_, 0)) >= problem_.implied().size())
            refuse("an index is out of range");
        } else {
          below(0, problem_.equations().size() + problem_.conditions().size() + 1);
        }
        break;
      case Step::newton: below(0, proof_.combinations.size()); break;
      case Step::keep:
        for (std::size_t k = 0; k < count(cursor_, 0); ++k) below(1 + k, 2 * n);
        break;
      case Step::split: below(0, n); break;
      case Step::cut:
        below(0, n);
        for (std::size_t k = 1; k < count(cursor_, 1); ++k)
          if (!(real(cursor_, k - 1) <= real(cursor_, k))) refuse("the places of a cut do not ascend");
        break;
      case Step::box: below(0, boxes_); break;
      case Step::root:
        // The roots' scripts prove things about one another in one direction only.
        below(0, proof_.roots.size());
        if (static_cast<std::size_t>(integer(cursor_, 0)) < roots_.size())
          refuse("a root is referred to an earlier one or itself");
        break;
      case Step::empty:
      case Step::elsewhere: break;
    }
  }

  void scan_tree() {
    struct Open {
      std::size_t first, parts, next;
    };
    std::vector<Open> open;
    for (;;) {
      if (cursor_.step >= proof_.steps.size()) refuse("the script ends early");
      const auto [integers, reals] = arity(cursor_);
      if (integers > proof_.integers.size() - cursor_.integer || reals > proof_.reals.size() - cursor_.real)
        refuse("the script ends early");
      check_step();
      const Step kind = step(cursor_);
      const Cursor here = cursor_;
      cursor_ = {here.step + 1, here.integer + integers, here.real + reals};
      if (kind == Step::row || kind == Step::newton || kind == Step::keep) continue;
      if (kind == Step::split || kind == Step::cut) {
        const std::size_t parts = kind == Step::split ? 2 : reals + 1;
        if (open.size() > kDeepest) refuse("the script is too deep");
        branches_.emplace_back(here.step, starts_.size());
        open.push_back({starts_.size(), parts, 0});
        starts_.resize(starts_.size() + parts + 1);
        starts_[open.back().first] = cursor_;
        continue;
      }
      while (!open.empty()) {
        Open& top = open.back();
        starts_[top.first + ++top.next] = cursor_;
        if (top.next < top.parts) break;
        open.pop_back();
      }
      if (open.empty()) return;
    }
  }

  const Proof& proof_;
  const Problem& problem_;
  std::size_t boxes_;
  Cursor cursor_;
  std::vector<Cursor> roots_, starts_;
  std::vector<std::pair<std::size_t, std::size_t>> branches_;
};

class Replay {
 public:
  Replay(const Problem& problem, const Cover& cover, const std::function<bool(std::uint64_t)>& progress)
      : problem_(problem), cover_(cover), proof_(*cover.proof), progress_(progress), searches_([this] {
          return Search(problem_);
        }) {}

  Replayed run() {
    Replayed result;
    result.tally.present = true;
    result.tally.steps = proof_.steps.size();
    try {
      const Script script(proof_, problem_, cover_.boxes.size());  // refuses what is malformed, matrices among it
      using Y = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
      for (const auto& [equations, dependent, y] : proof_.combinations)
        combinations_.push_back(
            {equations, dependent, Y(y.data(), std::ssize(dependent), std::ssize(dependent)).cast<double>()});
      check_domain();
      tbb::task_group tasks;
      for (std::size_t r = 0; const std::vector<Interval>& root : proof_.roots)
        tasks.run([&, r = r++] { play(script, script.root(r), {Sides(root.begin(), root.end()), root, false}); });
      tasks.wait();
    } catch (const Malformed& fault) {
      fail(fault.step, fault.reason);
      result.malformed = true;
    } catch (const Stopped&) {
      stopped_ = true;
    }
    for (const Search& search : searches_) result.tally.searched += search.searched();
    result.tally.leaves = leaves_;
    std::ranges::stable_sort(failures_, [](const Failure& a, const Failure& b) { return a.index < b.index; });
    result.failures = std::move(failures_);
    result.interrupted = stopped_;
    result.tally.verified = result.failures.empty() && !stopped_;
    return result;
  }

 private:
  // x holds all solutions of the current box `kept`, and lies in it.
  struct State {
    Sides x;
    std::vector<Interval> kept;
    bool empty;
  };

  void fail(std::size_t step, const std::string& reason) {
    const std::lock_guard lock(mutex_);
    if (failures_.size() < kMostFailures) failures_.push_back({Failure::Place::step, step, reason});
  }

  void check_domain() {
    Sides domain = problem_.domain();
    Search& search = searches_.local();
    bool empty = problem_.contradiction() || !search.contract(domain);
    if (empty) return;
    if (proof_.roots.empty() || !search.confine(domain, proof_.roots[0], empty))
      fail(0, "the first root does not hold the search domain");
  }

  bool stopped(std::size_t step) {
    if (stopped_.load(std::memory_order_relaxed)) return true;
    if (++turns_ % 64 == 0 && progress_(step)) stopped_ = true;
    return stopped_;
  }

  void play(const Script& script, const Cursor& at, State state) {
    try {
      follow(script, at, std::move(state));
    } catch (const Stopped&) {
      stopped_ = true;
    }
  }

  void follow(const Script& script, Cursor at, State state) {
    const NearestRounding nearest;
    Search& search = searches_.local();
    for (;; at = script.after(at)) {
      if (stopped(at.step)) return;
      switch (script.step(at)) {
        case Step::row:
          state.empty = state.empty || !search.project(state.x, std::min(script.integer(at, 0), rows()));
          break;
        case Step::newton: state.empty = state.empty || !newton(search, state, script.integer(at, 0)); break;
        case Step::keep:
          if (!keep(search, script, at, state)) return;
          break;
        case Step::split:
        case Step::cut: branch(script, at, std::move(state)); return;
        case Step::empty:
        case Step::elsewhere:
          ++leaves_;
          if (!state.empty && !search.is_empty(std::move(state.x)))
            fail(at.step, "the box is not shown to have no solution");
          return;
        case Step::box: {
          ++leaves_;
          if (state.empty) return;
          if (!search.confine(state.x, bounds_of(script.integer(at, 0)), state.empty) ||
              (!state.empty && !holds_values(state.x, script.integer(at, 0))))
            fail(at.step, "its solutions are not shown to lie in box " + std::to_string(script.integer(at, 0) + 1));
          return;
        }
        case Step::root:
          ++leaves_;
          if (!state.empty && !search.confine(state.x, proof_.roots[script.integer(at, 0)], state.empty))
            fail(at.step, "it does not lie in the root that it is referred to");
          return;
      }
    }
  }

  // Does its verdict rest on a region? Then it is checked besides (check/sheets.h), with the sides of eliminated variables.
  static bool has_region(const CoverBox& box) {
    const bool claims =
        box.verdict == Verdict::regular || box.verdict == Verdict::isolated || box.verdict == Verdict::boundary;
    return claims && box.region >= 0;
  }

  // Do the box's sides of eliminated variables hold their values over x?
  bool holds_values(const Sides& x, int i) const {
    const CoverBox& box = cover_.boxes[i];
    if (has_region(box)) return true;
    return std::ranges::all_of(problem_.values(), [&](const Problem::Value& v) {
      const Variable& variable = problem_.system().variables[v.variable];
      Enclosure value = v.row.value(x);
      return !value.intersect(Enclosure::hull(Enclosure(variable.lower), Enclosure(variable.upper))) ||
             value.inside(box.box[v.variable]);
    });
  }

  // Between which bounds the solutions are to be shown that are said to lie in box i: the box, or what its own claim is
  // about, which is checked besides: for every value of its free variables there is one solution in its region, and it is in
  // the box. So a solution in the region with such values is in the box.
  std::vector<Interval> bounds_of(int i) const {
    const CoverBox& box = cover_.boxes[i];
    const bool sheet = has_region(box) && spans_free_sides(box, cover_.regions.at(box.region));
    const Box& dependent = sheet ? cover_.regions.at(box.region) : box.box;
    std::vector<Interval> bounds;
    for (const int j : problem_.kept()) {
      const bool is_free = std::ranges::find(box.free, j) != box.free.end();
      bounds.push_back((is_free ? box.box : dependent)[j]);
    }
    return bounds;
  }

  int rows() const { return static_cast<int>(problem_.equations().size()); }

  bool newton(Search& search, State& state, int k) const {
    std::vector<double> center;
    for (std::size_t j = 0; j < state.x.size(); ++j) {
      const double middle = 0.5 * state.kept[j].lo() + 0.5 * state.kept[j].hi();
      center.push_back(std::clamp(middle, state.x[j].lo(), state.x[j].hi()));
    }
    return search.newton(state.x, combinations_[k], center);
  }

  // False: not shown that the solutions lie between the bounds.
  bool keep(Search& search, const Script& script, const Cursor& at, State& state) {
    std::vector<Interval> kept = state.kept;
    for (int k = 0; k < script.integer(at, 0); ++k) {
      const int side = script.integer(at, 1 + k);
      Interval& bound = kept[side / 2];
      const double place = script.real(at, k);
      if (!bound.contains(place)) continue;  // outside the former box: says nothing
      bound = side % 2 == 1 ? Interval(bound.lo(), place) : Interval(place, bound.hi());
    }
    if (!state.empty && !search.confine(state.x, kept, state.empty)) {
      fail(at.step, "a slab that is cut off is not shown to have no solution");
      return false;
    }
    state.kept = std::move(kept);
    return true;
  }

  void branch(const Script& script, const Cursor& at, State state) {
    const std::size_t v = script.integer(at, 0);
    const bool is_split = script.step(at) == Step::split;
    const std::size_t places = is_split ? 1 : script.integer(at, 1);
    const Cursor* parts = script.parts(at);
    const Interval side = state.kept[v];
    tbb::task_group tasks;
    double from = side.lo();
    for (std::size_t k = 0; k <= places; ++k) {
      // The parts tile the side, whatever the places are.
      const double to = k == places ? side.hi() : std::clamp(script.real(at, k), from, side.hi());
      State part = state;
      part.kept[v] = Interval(from, to);
      if (!part.empty) part.empty = !part.x[v].intersect(Enclosure(from, to));
      if (parts[k + 1].step - parts[k].step >= kTaskSteps && k < places) {
        const auto own = std::make_shared<State>(std::move(part));
        tasks.run([this, &script, start = parts[k], own] { play(script, start, std::move(*own)); });
      } else {
        play(script, parts[k], std::move(part));
      }
      from = to;
    }
    tasks.wait();
  }

  const Problem& problem_;
  const Cover& cover_;
  const Proof& proof_;
  const std::function<bool(std::uint64_t)>& progress_;
  std::vector<LinearCombination> combinations_;
  tbb::enumerable_thread_specific<Search> searches_;
  std::atomic<std::uint64_t> leaves_{0}, turns_{0};
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;
  std::vector<Failure> failures_;
};

}  // namespace

Replayed replay(const Problem& problem, const Cover& cover, const std::function<bool(std::uint64_t)>& step) {
  return Replay(problem, cover, step).run();
}

}  // namespace corank::check
