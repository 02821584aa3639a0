#include "corank/report/result.h"

#include <algorithm>

#include "corank/certify/exact_verification.h"
#include "corank/solve/corank_system.h"

namespace corank::report {

std::string version() { return CORANK_VERSION; }

void describe_system(const certify::System& system, Result& result) {
  result.variables.clear();
  for (const certify::Variable& v : system.variables) result.variables.push_back({v.name, v.kind, v.domain});
  result.angles = system.angles;
  result.configuration_size = system.configuration_size;
  result.equations = static_cast<int>(system.equations.size());
  result.inequalities = static_cast<int>(system.inequalities.size());
}

void describe_corank(const certify::System& system, Result& result) {
  constexpr double kSmall = 0.02;              // relative to the largest: boxes are a few hundredths of typical sizes wide
  constexpr std::size_t kMostLookedAt = 1000;  // more say the same
  result.seems_of_corank = 0;
  std::vector<const certify::CoverBox*> boxes;
  for (const certify::CoverBox& box : result.cover.boxes)
    if (box.verdict == certify::Verdict::undecided && box.reason == certify::Reason::degenerate_set) boxes.push_back(&box);
  const certify::KernelMatrix matrix = certify::kernel_matrix(system);
  if (boxes.empty() || matrix.rows.empty()) return;
  const std::size_t n = std::min(boxes.size(), kMostLookedAt);
  std::vector<std::size_t> of_corank(matrix.unknowns.size() + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> x;
    for (const certify::Interval& side : boxes[i * boxes.size() / n]->box) x.push_back(side.mid());
    const std::vector<double> s = solve::singular_values(matrix, x);
    for (std::size_t c = 0; c < s.size() && s[s.size() - 1 - c] < kSmall * s[0]; ++c) ++of_corank[c + 1];
  }
  for (std::size_t c = 1; c < of_corank.size(); ++c)
    if (2 * of_corank[c] > n && static_cast<int>(c) > result.options.corank) result.seems_of_corank = static_cast<int>(c);
}

}  // namespace corank::report
