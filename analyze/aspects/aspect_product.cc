#include "corank/analyze/aspects/aspect_product.h"

#include <algorithm>
#include <cmath>

#include "corank/analyze/aspects/divided_space.h"
#include "corank/certify/compiled_system.h"
#include "corank/core/rounding.h"
#include "corank/result/values/claim_files.h"

namespace corank::analyze {
namespace {

constexpr std::size_t kMostRepresentatives = 10'000;

// Why nothing is known; empty where something is.
std::string count_pieces(const PartEquations& equations, const AspectsOptions& options, solve::Control& control,
                         AspectsPart& part, std::vector<std::string>& reached) {
  part.coordinates = equations.coordinates;
  const DividedSpace space = divided_space(equations.system, options, control);
  if (!space.reason.empty()) return space.reason;
  part.system = space.system;
  part.cover = space.cover;
  reached.insert(reached.end(), space.limits.begin(), space.limits.end());
  for (std::size_t k = 0; k < part.lists.size(); ++k) {
    for (const Polynomial& f : equations.functions[k]) part.factors[k].push_back(f.source);
    if (k > 0 && part.factors[k] == part.factors[0]) {
      part.lists[k] = part.lists[0];
      continue;
    }
    SignCells cells = cells_of(space, equations.functions[k], options, control);
    part.lists[k] = pieces(cells, control);
  }
  return "";
}

// The configuration over values of free coordinates, those of one representative of each part.
class Lifting {
 public:
  Lifting(const ProductEquations& product, const System& system)
      : system_(system), compiled_(system, product.values), given_(product.given) {
    for (const Variable& v : system.variables) middle_.push_back(Interval(v.domain.mid()));
    for (const Angle& a : system.angles) {
      const double middle = a.range.mid();
      constexpr double kRounding = 1e-15;
      middle_[a.cosine] = std::cos(middle) + Interval(-kRounding, kRounding);
      middle_[a.sine] = std::sin(middle) + Interval(-kRounding, kRounding);
    }
  }

  Box configuration(const std::vector<std::pair<const System*, const Box*>>& parts) const {
    Box box = middle_;
    for (const auto& [system, at] : parts) {
      for (const Angle& a : system->angles) {
        const auto own = std::ranges::find(system_.angles, a.name, &Angle::name);
        box[own->cosine] = (*at)[a.cosine];
        box[own->sine] = (*at)[a.sine];
      }
      for (int j = 0; j < system->size(); ++j)
        if (system->variables[j].kind == VariableKind::length) box[system_.find(system->variables[j].name)] = (*at)[j];
    }
    for (std::size_t k = 0; k < given_.size(); ++k)
      box[given_[k]] = compiled_.evaluate(compiled_.value_row(static_cast<int>(k)), box);
    return box;
  }

 private:
  const System& system_;
  certify::CompiledSystem compiled_;
  std::vector<int> given_;
  Box middle_;
};

Pieces product(const std::vector<AspectsPart>& parts, const AspectEquations& equations, std::size_t list,
               const Lifting& lifting) {
  Pieces result;
  result.at_least = 1;
  result.at_most = 1;
  std::size_t representatives = 1;
  for (const AspectsPart& part : parts) {
    const Pieces& p = part.lists[list];
    result::multiply(result, p);
    result.cells += p.cells;
    if (result.reason.empty()) result.reason = p.reason;
    representatives = std::min(kMostRepresentatives, representatives * p.representatives.size());
  }
  const UpwardRounding rounding;
  for (std::size_t number = 0; number < representatives; ++number) {
    std::size_t rest = number;
    std::vector<std::pair<const System*, const Box*>> at;
    std::vector<int> signs(equations.functions[list].size(), 0);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Pieces& p = parts[k].lists[list];
      const std::size_t own = rest % p.representatives.size();
      rest /= p.representatives.size();
      at.emplace_back(&parts[k].system, &p.representatives[own]);
      for (std::size_t i = 0; i < p.signs[own].size(); ++i)
        signs[equations.product->parts[k].places[list][i]] = p.signs[own][i];
    }
    result.representatives.push_back(lifting.configuration(at));
    result.signs.push_back(std::move(signs));
  }
  return result;
}

}  // namespace

void count_in_free_coordinates(const AspectEquations& equations, const AspectsOptions& options, solve::Control& control,
                               Aspects& result) {
  for (const PartEquations& part : equations.product->parts) {
    result.reason = count_pieces(part, options, control, result.product_of.emplace_back(), result.limits);
    if (!result.reason.empty()) return;
  }
  if (options.certificate) result.cover = result.product_of.front().cover;
  const Lifting lifting(*equations.product, equations.system);
  result.aspects = product(result.product_of, equations, 0, lifting);
  result.assembly_modes = product(result.product_of, equations, 1, lifting);
  result.working_modes = product(result.product_of, equations, 2, lifting);
}

}  // namespace corank::analyze
