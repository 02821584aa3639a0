#include "corank/symbolic/regular_locus.h"

#include <algorithm>

#include "corank/certify/compiled_system.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/kernel_vector.h"
#include "corank/symbolic/singularity_system.h"

namespace corank::symbolic {
namespace {

enum class Entry { zero, nonzero, either };

std::vector<std::vector<Entry>> entries_of(const Mechanism& mechanism, const ExpressionMatrix& m) {
  const TrigonometricSystem trigonometric = plain_system(mechanism);
  std::vector<Expression> expressions;
  for (const auto& row : m.rows) expressions.insert(expressions.end(), row.begin(), row.end());
  const System system = algebrize(trigonometric);
  const std::vector<Polynomial> values = polynomials(trigonometric, expressions);
  const certify::CompiledSystem compiled(system, values);
  const UpwardRounding rounding;
  const std::vector<Interval> domain = system.domain();
  std::vector<std::vector<Entry>> result;
  for (std::size_t i = 0, k = 0; i < m.rows.size(); ++i) {
    result.emplace_back();
    for (std::size_t j = 0; j < m.columns.size(); ++j, ++k) {
      const bool zero = values[k].monomials.empty();
      const bool away = !zero && compiled.evaluate(compiled.value_row(static_cast<int>(k)), domain).mig() > 0;
      result.back().push_back(zero ? Entry::zero : away ? Entry::nonzero : Entry::either);
    }
  }
  return result;
}

}  // namespace

bool is_regular_everywhere(const Mechanism& mechanism, SingularitySet set) {
  const Mechanism plain = mechanism.without_rates();
  const ExpressionMatrix m = kernel_question(plain, set, KernelSide::right).matrix;
  std::vector<std::vector<Entry>> rows = entries_of(plain, m);
  std::vector<bool> taken(m.columns.size(), false);
  // A row with one entry left, which is 0 nowhere: it and its column go.
  for (std::size_t left = m.columns.size(); left > 0; --left) {
    const auto sole = [&](const std::vector<Entry>& row) -> std::optional<std::size_t> {
      std::optional<std::size_t> at;
      for (std::size_t j = 0; j < row.size(); ++j) {
        if (taken[j] || row[j] == Entry::zero) continue;
        if (at) return std::nullopt;
        at = j;
      }
      return at && row[*at] == Entry::nonzero ? at : std::nullopt;
    };
    const auto row = std::find_if(rows.begin(), rows.end(), sole);
    if (row == rows.end()) return false;
    taken[*sole(*row)] = true;
    rows.erase(row);
  }
  return true;
}

SingularitySet nodes_of(const Mechanism& mechanism) {
  const bool forward = !is_regular_everywhere(mechanism, SingularitySet::forward_nodes),
             inverse = !is_regular_everywhere(mechanism, SingularitySet::inverse_nodes);
  if (forward != inverse) return forward ? SingularitySet::forward_nodes : SingularitySet::inverse_nodes;
  throw ModelError(
      model_place(mechanism), forward ? "both of its loci may have nodes" : "neither of its loci holds a configuration",
      std::string(to_string(SingularitySet::forward_nodes)) + " or " + to_string(SingularitySet::inverse_nodes));
}

}  // namespace corank::symbolic
