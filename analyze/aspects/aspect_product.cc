#include "corank/analyze/aspects/aspect_product.h"

#include <algorithm>
#include <cmath>

#include "corank/analyze/aspects/divided_space.h"
#include "corank/certify/compiled_system.h"
#include "corank/core/rounding.h"
#include "corank/result/values/claim_files.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/free_coordinates.h"

namespace corank::analyze {
namespace {

constexpr std::size_t kMostRepresentatives = 10'000;

// Of each list the places of the part's functions among those of the list.
using Places = std::array<std::vector<std::size_t>, 3>;

// Why nothing is known; empty where something is.
std::string count_pieces(const symbolic::TrigonometricSystem& equations,
                         const std::array<std::vector<symbolic::Expression>, 3>& functions, const AspectsOptions& options,
                         solve::Control& control, AspectsPart& part, std::vector<std::string>& reached) {
  const DividedSpace space = divided_space(symbolic::algebrize(equations), options, control);
  if (!space.reason.empty()) return space.reason;
  part.system = space.system;
  part.cover = space.cover;
  reached.insert(reached.end(), space.limits.begin(), space.limits.end());
  for (std::size_t k = 0; k < part.lists.size(); ++k) {
    for (const symbolic::Expression& f : functions[k]) part.factors[k].push_back(f.text());
    if (k > 0 && part.factors[k] == part.factors[0]) {
      part.lists[k] = part.lists[0];
      continue;
    }
    SignCells cells = cells_of(space, symbolic::polynomials(equations, functions[k]), options, control);
    part.lists[k] = pieces(cells, control);
  }
  return "";
}

// The configuration over values of free coordinates, those of one representative of each part.
class Lifting {
 public:
  Lifting(const symbolic::TrigonometricSystem& equations, const System& system, const symbolic::FreeCoordinates& free)
      : system_(system), compiled_(system, values(equations, free)) {
    for (const symbolic::Relation& r : free.given) given_.push_back(system.find(r.lhs.name()));
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
  static std::vector<Polynomial> values(const symbolic::TrigonometricSystem& equations,
                                        const symbolic::FreeCoordinates& free) {
    std::vector<symbolic::Expression> list;
    for (const symbolic::Relation& r : free.given) list.push_back(r.rhs);
    return symbolic::polynomials(equations, list);
  }

  const System& system_;
  certify::CompiledSystem compiled_;
  std::vector<int> given_;
  Box middle_;
};

Pieces product(const std::vector<AspectsPart>& parts, const std::vector<Places>& places, std::size_t list,
               std::size_t functions, const Lifting& lifting) {
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
    std::vector<int> signs(functions, 0);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Pieces& p = parts[k].lists[list];
      const std::size_t own = rest % p.representatives.size();
      rest /= p.representatives.size();
      at.emplace_back(&parts[k].system, &p.representatives[own]);
      for (std::size_t i = 0; i < p.signs[own].size(); ++i) signs[places[k][list][i]] = p.signs[own][i];
    }
    result.representatives.push_back(lifting.configuration(at));
    result.signs.push_back(std::move(signs));
  }
  return result;
}

}  // namespace

bool count_in_free_coordinates(const study::Question& question, const symbolic::TrigonometricSystem& equations,
                               const symbolic::Loci& loci, const AspectsOptions& options, solve::Control& control,
                               Aspects& result) {
  const std::vector<symbolic::Coordinate>& coordinates = question.model.coordinates();
  const auto fixed = static_cast<std::size_t>(std::ranges::count_if(coordinates, symbolic::is_fixed));
  if (coordinates.size() - fixed <= question.model.equations().size() + 2) return false;
  const std::optional<symbolic::FreeCoordinates> free = symbolic::free_coordinates(question.model);
  if (!free) return false;
  const auto parts = symbolic::independent_parts(*free, loci.all_factors);
  if (!parts) return false;
  const Places all = loci.lists();
  std::vector<Places> places;
  for (const symbolic::IndependentPart& part : *parts) {
    AspectsPart& counted = result.product_of.emplace_back();
    Places& own = places.emplace_back();
    std::array<std::vector<symbolic::Expression>, 3> functions;
    for (std::size_t k = 0; k < all.size(); ++k)
      for (std::size_t i = 0; i < all[k].size(); ++i) {
        if (std::ranges::find(part.functions, all[k][i]) == part.functions.end()) continue;
        own[k].push_back(i);
        functions[k].push_back(loci.all_factors[all[k][i]]);
      }
    for (const symbolic::Coordinate& c : part.system.coordinates) counted.coordinates.push_back(c.name);
    result.reason = count_pieces(part.system, functions, options, control, counted, result.limits);
    if (!result.reason.empty()) return true;
  }
  if (options.certificate) result.cover = result.product_of.front().cover;
  const Lifting lifting(equations, result.system, *free);
  result.aspects = product(result.product_of, places, 0, all[0].size(), lifting);
  result.assembly_modes = product(result.product_of, places, 1, all[1].size(), lifting);
  result.working_modes = product(result.product_of, places, 2, all[2].size(), lifting);
  return true;
}

}  // namespace corank::analyze
