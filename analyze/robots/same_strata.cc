#include "corank/analyze/robots/same_strata.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>

#include "corank/solve/search/solve.h"

namespace corank::analyze {
namespace {

class StrataSearch {
 public:
  StrataSearch(const System& system, const std::vector<Polynomial>& functions, const SameStrataOptions& options,
               solve::Control& control)
      : system_(system), functions_(functions), options_(options), control_(control) {}

  std::string run(const std::vector<std::string>& own_ends) {
    const Cover cover = search(system_);
    std::string obstacle = obstacle_of(system_, cover, "the set itself");
    if (!obstacle.empty() || is_empty(cover)) return obstacle;
    limits_ = limits(system_, cover);
    const std::vector<certify::End> ends(limits_.begin(), limits_.end());
    strata_.emplace(system_, ends, 0);
    // Of a system that it does not understand it could not widen the domain.
    if (!limits_.empty() && !strata_->problem().empty()) return "limits: " + strata_->problem();
    for (const Limit& limit : limits_) {
      const bool of_domain = limit.with != certify::Contact::With::inequality;
      const Variable* v = of_domain ? &system_.variables[limit.index] : nullptr;
      differs_.push_back(v != nullptr && (v->auxiliary || v->kind != VariableKind::length ||
                                          std::ranges::find(own_ends, limit.name) != own_ends.end()));
    }
    return below({}, 0);
  }

 private:
  int size() const { return static_cast<int>(limits_.size() + functions_.size()); }
  bool is_limit(int k) const { return k < static_cast<int>(limits_.size()); }
  const std::string& name(int k) const { return is_limit(k) ? limits_[k].name : functions_[k - limits_.size()].source; }

  Cover search(const System& system) {
    const solve::Options how{.sigma = solve::kWhole, .threads = options_.threads};
    return solve::solve(solve::prepare(system, how, control_), control_, options_.most);
  }

  static bool is_empty(const Cover& cover) { return cover.boxes.empty() && cover.points.empty(); }

  // The hypothesis for one set A.
  std::string obstacle_of(const System& system, const Cover& cover, const std::string& what) const {
    if (control_.ended()) return "the analysis was ended by a limit";
    if (!cover.complete()) return fmt::format("the search for {} took more than {} boxes", what, options_.most);
    const System whole = with_single_values(system);
    const int free = whole.size() - static_cast<int>(whole.equations.size());
    const auto has_full_rank = [&](const CoverBox& b) {
      const bool proven = b.verdict == Verdict::regular || b.verdict == Verdict::boundary || b.verdict == Verdict::isolated;
      return proven && b.motion < 0 && std::ssize(b.free) == free && leaves_parameters_free(b);
    };
    if (std::ranges::all_of(cover.boxes, has_full_rank)) return "";
    const bool none = free < system.parameters();
    return fmt::format("{}: {}", what, none ? "not excluded for every robot" : "not shown to be smooth for every robot");
  }

  bool leaves_parameters_free(const CoverBox& b) const {
    for (int j = 0; j < system_.size(); ++j)
      if (system_.variables[j].is_parameter() && std::ranges::find(b.free, j) == b.free.end()) return false;
    return true;
  }

  System stratum(const std::vector<int>& chosen) const {
    std::vector<int> ends;
    for (const int k : chosen)
      if (is_limit(k)) ends.push_back(k);
    System system = ends.empty() ? system_ : strata_->closed(ends);
    for (const int k : chosen)
      if (!is_limit(k)) system.equations.push_back(functions_[k - limits_.size()]);
    return system;
  }

  bool are_opposite(int j, int k) const {
    if (!is_limit(j) || !is_limit(k)) return false;
    const auto of_inequality = [&](int i) { return limits_[i].with == certify::Contact::With::inequality; };
    return !of_inequality(j) && !of_inequality(k) && limits_[j].index == limits_[k].index;
  }

  // All sets that add to the chosen ones: where these have no point, none of them has.
  std::string below(const std::vector<int>& chosen, int first) {
    for (int k = first; k < size(); ++k) {
      if (std::ranges::any_of(chosen, [&](int j) { return are_opposite(j, k); })) continue;
      std::vector<int> next = chosen;
      next.push_back(k);
      std::vector<std::string> names;
      for (const int j : next) names.push_back(is_limit(j) ? name(j) : name(j) + " = 0");
      const System system = stratum(next);
      const Cover cover = search(system);
      const std::string what = fmt::format("where {}", fmt::join(names, " and "));
      std::string obstacle = obstacle_of(system, cover, what);
      if (!obstacle.empty()) return obstacle;
      if (is_empty(cover)) continue;
      if (is_limit(k) && differs_[k])
        return fmt::format("the set may come to the {}, which is not the same for all robots", name(k));
      obstacle = below(next, k + 1);
      if (!obstacle.empty()) return obstacle;
    }
    return "";
  }

  const System& system_;
  const std::vector<Polynomial>& functions_;
  const SameStrataOptions& options_;
  solve::Control& control_;
  std::vector<Limit> limits_;
  std::vector<bool> differs_;  // of the limits: are they no limits of all robots?
  std::optional<certify::Strata> strata_;
};

// The halves of the tolerance that is widest, relative to what it was; nothing where doubles divide it no further.
std::optional<std::array<System, 2>> halves(const System& system, const System& whole) {
  int widest = -1;
  const auto share = [&](int j) { return system.variables[j].domain.width() / whole.variables[j].domain.width(); };
  for (int j = 0; j < system.size(); ++j)
    if (system.variables[j].is_parameter() && (widest < 0 || share(j) > share(widest))) widest = j;
  if (widest < 0) return std::nullopt;
  std::array<System, 2> parts{system, system};
  const Variable& v = system.variables[widest];
  const ExactNumber middle = ExactNumber::dyadic(v.domain.mid());
  if ((middle - v.lower).sign() != 1 || (v.upper - middle).sign() != 1) return std::nullopt;
  for (std::size_t k = 0; k < 2; ++k) {
    Variable& part = parts[k].variables[widest];
    part = Variable(v.name, v.kind, k == 0 ? v.lower : middle, k == 0 ? middle : v.upper);
    part.auxiliary = v.auxiliary, part.size = v.size;
    part.lower_implied = part.upper_implied = true;
  }
  return parts;
}

}  // namespace

// The hypothesis is one about each point of M: so it may be proven over parts of P.
std::string obstacle_to_same_strata(const System& system, const std::vector<Polynomial>& functions,
                                    const std::vector<std::string>& own_ends, const SameStrataOptions& options,
                                    solve::Control& control) {
  std::vector<System> waiting{system};
  for (int parts = 1; !waiting.empty();) {
    const System now = std::move(waiting.back());
    waiting.pop_back();
    std::string obstacle = StrataSearch(now, functions, options, control).run(own_ends);
    if (obstacle.empty()) continue;
    if (control.ended() || ++parts > options.parts) return obstacle;
    auto both = halves(now, system);
    if (!both) return obstacle;
    for (System& half : *both) waiting.push_back(std::move(half));
  }
  return "";
}

}  // namespace corank::analyze
