#include "corank/study/search_steps.h"

#include "corank/certify/pairs.h"
#include "corank/core/check.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/cusps_and_nodes.h"
#include "corank/symbolic/sets/kernel_scale.h"

namespace corank::study {
namespace {

constexpr std::size_t kMostPairs = 200'000, kMostBoxes = 20'000;  // of a surface there are too many

using symbolic::SingularitySet;

// The locus with the kernel's scales and half-space of the doubled system.
System locus_of(const symbolic::Mechanism& mechanism, SingularitySet nodes) {
  const SingularitySet locus = nodes == SingularitySet::forward_nodes ? SingularitySet::forward : SingularitySet::inverse;
  std::vector<std::string> scales = symbolic::kernel_scales(mechanism, nodes);
  if (!scales.empty()) scales.pop_back();
  return symbolic::algebrize(symbolic::singularity_system(mechanism, locus, symbolic::KernelSide::right, scales));
}

// By names: an angle's sine and cosine are those of the second angle.
certify::PairLayout layout_of(const symbolic::Mechanism& mechanism, const System& locus, const System& doubled) {
  certify::PairLayout layout;
  const int q = locus.configuration_size, kernel = locus.size() - q;
  const auto second_of = [&](int v) {
    for (const Angle& a : locus.angles) {
      if (a.cosine != v && a.sine != v) continue;
      for (const Angle& b : doubled.angles)
        if (b.name == symbolic::second_name(mechanism, a.name)) return a.cosine == v ? b.cosine : b.sine;
      return v;
    }
    const int second = doubled.find(symbolic::second_name(mechanism, locus.variables[v].name));
    return second >= 0 ? second : v;
  };
  for (int v = 0; v < q; ++v) {
    CORANK_CHECK(locus.variables[v].name == doubled.variables[v].name);
    layout.first.push_back(v);
    layout.second.push_back(second_of(v));
  }
  for (int k = 0; k < kernel; ++k) {
    layout.first.push_back(doubled.configuration_size + k);
    layout.second.push_back(doubled.configuration_size + kernel + k);
  }
  return layout;
}

}  // namespace

NodeSearch node_search(const Question& question, const System& system, const solve::Options& options,
                       solve::Control& control) {
  NodeSearch result;
  const symbolic::Mechanism mechanism = question.model.without_rates();
  const System locus = locus_of(mechanism, *question.set);
  // Functions of lengths have variables of their own behind the kernel's.
  if (locus.variables.back().kind != VariableKind::kernel || locus.parameters() > 0) return result;
  solve::Options search;
  search.threads = options.threads;
  const Cover cover = solve::solve(solve::prepare(locus, search, control), control);
  result.processed = cover.statistics.processed;
  if (!cover.complete() || cover.boxes.size() > kMostBoxes) return result;
  const certify::PairLayout layout = layout_of(mechanism, locus, system);
  auto roots = certify::pairs(cover.boxes, system, layout, kMostPairs);
  if (!roots) return result;
  result.roots = std::move(*roots);
  if (result.roots.empty()) {  // a search with nothing to search: a box beside the domain
    Box beside = system.domain();
    beside[0] = Interval(beside[0].hi() + 1, beside[0].hi() + 2);
    result.roots.push_back(std::move(beside));
  }
  return result;
}

}  // namespace corank::study
