#include "corank/solve/cutting/cut_planner.h"

#include <algorithm>
#include <cmath>

#include "corank/solve/step/heuristics.h"

namespace corank::solve {
void CutPlanner::measure_steepness(const certify::NewtonStep& step, const std::vector<int>& free, const Box& piece,
                                   const std::vector<double>& sigmas) {
  const auto& system = problem_.compiled;
  const std::size_t n = system.variables(), r = step.dependent().size();
  steepness_.clear();
  slope_.resize(system.entries());
  for (std::size_t a = 0; a < r; ++a) {
    const double sigma = sigmas[step.dependent()[a]];
    if (!std::isfinite(sigma)) continue;
    for (int f : free) steepness_.push_back(std::fabs(step.derivative(static_cast<int>(a), f)) / sigma);
  }
  for (int k = 0; k < system.values(); ++k) {
    const double sigma = sigmas[n + k];
    if (!std::isfinite(sigma)) continue;
    const int row = system.value_row(k);
    system.slopes(row, piece, step.center().data(), slope_);
    gradient_.assign(n, 0.0);
    for (int e = system.row_begin(row); e < system.row_begin(row + 1); ++e) gradient_[system.column(e)] = slope_[e].mid();
    for (int f : free) {
      double slope = gradient_[f];
      for (std::size_t a = 0; a < r; ++a) slope += gradient_[step.dependent()[a]] * step.derivative(static_cast<int>(a), f);
      steepness_.push_back(std::fabs(slope) / sigma);
    }
  }
}

std::vector<double> CutPlanner::widened_sigma(const certify::NewtonStep& step, const Box& piece) {
  std::vector<double> sigma = problem_.sigma;
  const std::vector<int>& parameters = problem_.compiled.parameters();
  measure_steepness(step, parameters, piece, problem_.sigma);
  auto steepness = steepness_.begin();
  const auto widen = [&](std::size_t variable) {
    if (!std::isfinite(sigma[variable])) return;
    double moved = 0;  // in σ
    for (const int p : parameters) moved += *steepness++ * piece[p].width();
    sigma[variable] *= std::max(1.0, kToleranceRoom * moved);
  };
  for (const int dependent : step.dependent()) widen(dependent);
  for (int k = 0; k < problem_.compiled.values(); ++k) widen(problem_.compiled.variables() + k);
  return sigma;
}

std::vector<int> CutPlanner::parts(const certify::NewtonStep& step, const std::vector<int>& free, const Box& piece,
                                   const std::vector<double>& sigma) {
  measure_steepness(step, free, piece, sigma);
  constexpr double kMostParts = 1 << 20;
  const std::size_t k = free.size();
  std::vector<double> parts(k, 1.0);
  const auto width = [&](std::size_t f) { return piece[free[f]].width(); };
  const auto sigma_of_free = [&](std::size_t f) { return sigma[free[f]]; };
  for (std::size_t f = 0; f < k; ++f) parts[f] = std::clamp(std::ceil(width(f) / sigma_of_free(f)), 1.0, kMostParts);
  // The width of a, in its σ, is Σ_f |∂a/∂f| w_f / parts_f.
  for (int round = 0; round < 1000; ++round) {
    double worst = kCutMargin;
    std::size_t grow = k;
    for (std::size_t a = 0; a * k < steepness_.size(); ++a) {
      double sum = 0, best = 0;
      std::size_t best_free = 0;
      for (std::size_t f = 0; f < k; ++f) {
        const double share = steepness_[a * k + f] * width(f) / parts[f];
        sum += share;
        // One part more takes share/(parts + 1) off at the price of a factor (parts + 1)/parts in cells.
        if (const double gain = share * parts[f] / (parts[f] + 1); gain > best) best = gain, best_free = f;
      }
      if (sum > worst && best > 0) worst = sum, grow = best_free;
    }
    if (grow == k) break;
    parts[grow] = std::min(std::max(parts[grow] + 1, std::floor(parts[grow] * 1.1)), kMostParts);
  }
  return {parts.begin(), parts.end()};
}

std::size_t CutPlanner::longest(const Box& piece, const std::vector<int>& free, const std::vector<int>& parts) const {
  std::size_t along = 0;
  const auto relative_width = [&](std::size_t f) {
    const std::size_t j = free[f];
    return piece[j].width() / problem_.compiled.scales()[j];
  };
  for (std::size_t f = 1; f < free.size(); ++f) {
    const bool wider = relative_width(f) > relative_width(along);
    if (parts[f] > parts[along] || (parts[f] == parts[along] && wider)) along = f;
  }
  return along;
}

std::vector<std::vector<double>> CutPlanner::places(const Box& piece, const std::vector<int>& free,
                                                    std::vector<int> parts) const {
  const std::size_t along = longest(piece, free, parts);
  parts[along] = std::max(parts[along], 2);
  std::vector<double> shares(free.size(), 0.0);
  if (parts[along] > kMostSlabs) {
    // Many: two groups of slabs first, since the sheet's steepness changes.
    shares[along] = static_cast<double>(parts[along] / 2) / parts[along];
    parts.assign(free.size(), 1);
    parts[along] = 2;
  }
  int at_once = parts[along];
  for (std::size_t f = 0; f < free.size(); ++f) {
    if (f == along) continue;
    if (parts[f] > kMostPartsAtOnce / at_once) parts[f] = 1;
    at_once *= parts[f];
  }
  std::vector<std::vector<double>> places(free.size());
  for (std::size_t f = 0; f < free.size(); ++f) {
    const Interval& side = piece[free[f]];
    for (int k = 1; k < parts[f]; ++k) {
      const double share = shares[f] > 0 ? shares[f] : static_cast<double>(k) / parts[f];
      places[f].push_back(std::min(side.lo() + side.width() * share, side.hi()));
    }
  }
  return places;
}

}  // namespace corank::solve
