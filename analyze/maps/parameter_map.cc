#include "corank/analyze/maps/parameter_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <mutex>
#include <tuple>
#include <utility>

#include "corank/analyze/aspects/aspects.h"
#include "corank/analyze/sets/fold_system.h"
#include "corank/analyze/topology/topology.h"
#include "corank/certify/requirement.h"
#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"
#include "corank/core/threads.h"
#include "corank/solve/reduction/reducer.h"
#include "corank/solve/search/solve.h"
#include "corank/solve/step/product_search.h"
#include "corank/symbolic/algebra/exact_value.h"
#include "corank/symbolic/sets/determinant_factors.h"

namespace corank::analyze {
namespace {

using symbolic::ModelError;

// As wide, in typical sizes, as a box next to a fold is left to the cell's parts, for a cell that is the whole region; at
// most, for the narrowest cells; and where that does not do, at last. Measured, see bench/HISTORY.md.
constexpr double kOpenShare = 4, kLastOpenShare = 0.1, kFinestOpenShare = 0.02;
constexpr double kCentreShare = 1e-6;  // the same of a centre
constexpr std::uint64_t kMostOfCell = 1'000, kMostOfLast = 50'000, kMostOfCentre = 4'000, kMostOfFolds = 200'000;
constexpr std::size_t kMostRoots = 4;  // of a cell's boxes that are searched for folds each; more are one
constexpr double kFoldWidth = 1;       // of a box of the curve, in edges of the narrowest cells

// The limits of one of several threads: its run ends when that of all does. Boxes are not limited.
solve::Control::Limits as_of(const solve::Control& all) {
  const solve::Control::Limits rest = all.rest(0, 0);
  return {.time = rest.time, .stop = rest.stop, .clock = rest.clock};
}

}  // namespace

struct ParameterMapper::Parts {
  /// Of MapAnswer::solutions.
  struct Family {
    std::vector<int> parameters;  // of the reduced system: two, then the constants within tolerances
    std::vector<std::pair<std::string, Interval>> tolerances;  // of the latter
    certify::Reduction reduction;
    std::unique_ptr<const solve::Problem> problem;
    std::unique_ptr<const solve::ProductProblem> product;
    int copies = 1;
    std::vector<Requirement> requirements;
    std::vector<int> kept_as, value_row;  // of each variable of the whole system one of the two, the other −1
    std::optional<solve::Prepared> folds;
  };

  MapQuestion question;
  ParameterMapOptions options;
  Box region;
  std::optional<Family> family;

  /// Of a tile.
  Box sides_of(int number) const {
    return {part_of(region[0], number % kTiles, kTiles), part_of(region[1], number / kTiles, kTiles)};
  }
  Box of_every_robot(Box sides) const {
    for (const auto& [name, tolerance] : family->tolerances) sides.push_back(tolerance);
    return sides;
  }
  int depth() const { return std::bit_width(static_cast<unsigned>(options.resolution / kTiles)) - 1; }
  void make_family();
  void make_folds();
  MapTile count(int number, solve::Control& control) const;
  MapTile sample(int number, solve::Control& control) const;
  void divide(solve::ProductSearch& search, solve::ProductCell cell, int level, MapTile& tile, std::vector<Box>& roots,
              solve::Control& control) const;
  void find_folds(std::vector<Box> roots, MapTile& tile, solve::Control& control) const;
  std::optional<int> answer_at(const Box& sides, solve::Control& control) const;
  std::vector<MapSheet> sheets_of(const std::vector<certify::Sheet>& solutions) const;
  std::optional<Standing> standing_of(const std::vector<certify::Sheet>& solutions) const;
};

void ParameterMapper::Parts::make_family() {
  const symbolic::Mechanism& model = question.question.model;
  const symbolic::SourceLocation place{model.name(), 0, 0};
  const study::Question& q = question.question;
  auto [system, parameters, copies, requirements] =
      symbolic::family_system(model, {q.set, q.kernel, q.corank, question.over, question.fixed});
  Family& f = family.emplace();
  f.copies = copies;
  f.requirements = std::move(requirements);
  f.reduction = solve::reduce(system, solve::Eliminate::exact, {}, parameters);
  for (const int p : parameters) {
    const auto kept = std::ranges::find(f.reduction.kept, p);
    CORANK_CHECK(kept != f.reduction.kept.end());
    f.parameters.push_back(static_cast<int>(kept - f.reduction.kept.begin()));
    if (f.parameters.size() > 2) f.tolerances.emplace_back(system.variables[p].name, system.variables[p].domain);
  }
  const auto given = static_cast<int>(system.equations.size()),
             unknowns = system.size() - static_cast<int>(parameters.size());
  const auto reduced = static_cast<int>(f.reduction.system.equations.size());
  if (f.reduction.consistent && reduced != f.reduction.system.size() - static_cast<int>(parameters.size()))
    throw ModelError(place,
                     "over fixed parameters " + std::to_string(given) + " equations have " + std::to_string(unknowns) +
                         " unknowns: there is no number of solutions to count",
                     "a set of isolated solutions, such as the configurations where all inputs are parameters or fixed");
  f.problem = std::make_unique<solve::Problem>(system, f.reduction, [] { return false; });
  f.product = std::make_unique<solve::ProductProblem>(f.reduction, f.parameters, system.kernel_vectors);
  f.kept_as.assign(system.size(), -1);
  f.value_row = f.kept_as;
  for (std::size_t k = 0; k < f.reduction.kept.size(); ++k) f.kept_as[f.reduction.kept[k]] = static_cast<int>(k);
  for (std::size_t k = 0; k < f.reduction.definitions.size(); ++k)
    f.value_row[f.reduction.definitions[k].variable] = f.problem->compiled.value_row(static_cast<int>(k));
  if (options.boundary && f.reduction.consistent) make_folds();
}

void ParameterMapper::Parts::make_folds() {
  const auto system = fold_system(family->reduction.system, family->parameters, family->problem->compiled.scales());
  if (!system) return;
  double edge = 0;
  for (const Interval& side : region) edge = std::max(edge, side.width() / options.resolution);
  solve::Control control;
  family->folds = solve::prepare(*system, {.sigma = kFoldWidth * edge}, control);
}

ParameterMapper::ParameterMapper(MapQuestion question, const ParameterMapOptions& options) {
  auto parts = std::make_unique<Parts>(Parts{std::move(question), options, {}, {}});
  const MapQuestion& q = parts->question;
  const symbolic::Mechanism& model = q.question.model;
  const symbolic::SourceLocation place{model.name(), 0, 0};
  if (q.over.size() != 2) throw ModelError(place, "a map has two parameters", "--over NAME=FROM:TO twice");
  if (options.resolution < kTiles || options.resolution > 1024 ||
      !std::has_single_bit(static_cast<unsigned>(options.resolution)))
    throw ModelError(place, "a map's resolution is a power of two", "one of 8, 16, 32 … 1024");
  for (const symbolic::Parameter& p : q.over) {
    parts->region.push_back(Interval::hull(symbolic::exact_value(model, p.lower, p.name).enclose(),
                                           symbolic::exact_value(model, p.upper, p.name).enclose()));
  }
  if (q.question.assembly) symbolic::check_conditions(model, q.question.assembly->conditions, q.over);
  if (q.answer == MapAnswer::solutions) {
    for (const symbolic::FixedCoordinate& f : q.fixed) study::require_exact_value(model, f.value, f.name);
    parts->make_family();
  } else {
    study::require_exact_constants(model, std::string("a map of ") + to_string(q.answer));
    if (!q.fixed.empty()) throw ModelError(place, "only solutions are counted over fixed coordinates", "no --fix");
    for (const symbolic::Parameter& p : q.over)
      if (!model.has_constant(p.name))
        throw ModelError(place, std::string(to_string(q.answer)) + " belong to all configurations together",
                         "constants; " + p.name + " is not one");
  }
  parts_ = std::move(parts);
}

ParameterMapper::~ParameterMapper() = default;
ParameterMapper::ParameterMapper(ParameterMapper&&) noexcept = default;

MapTile ParameterMapper::tile(int number, solve::Control& control) const {
  CORANK_CHECK(number >= 0 && number < tiles());
  return parts_->family ? parts_->count(number, control) : parts_->sample(number, control);
}

MapTile ParameterMapper::Parts::count(int number, solve::Control& control) const {
  MapTile tile{.number = number};
  const Box sides = sides_of(number);
  if (!family->reduction.consistent) {
    tile.cells.push_back({sides, MapCellAnswer::Kind::proven, 0});
    return tile;
  }
  std::vector<Box> roots;
  {
    const UpwardRounding rounding;
    solve::ProductSearch search(*family->product, *family->problem);
    divide(search, search.whole(of_every_robot(sides), family->reduction.system.domain()), 0, tile, roots, control);
    tile.processed = search.processed();
  }
  tile.boundary_known = family->folds.has_value();
  if (family->folds && !roots.empty()) find_folds(std::move(roots), tile, control);
  return tile;
}

void ParameterMapper::Parts::divide(solve::ProductSearch& search, solve::ProductCell cell, int level, MapTile& tile,
                                    std::vector<Box>& roots, solve::Control& control) const {
  const Box sides{cell.sides[0], cell.sides[1]};
  const bool last = level == depth();
  const double share = 1.0 / (kTiles << level);
  bool finished =
      search.refine(cell, last ? std::min(kLastOpenShare, kOpenShare * share) : kOpenShare * share, kMostOfCell, control);
  auto solutions = search.solutions(cell);
  if (last && finished && !solutions) {
    finished = search.refine(cell, kFinestOpenShare, kMostOfLast, control);
    solutions = search.solutions(cell);
  }
  const std::optional<Standing> standing = solutions ? standing_of(*solutions) : std::nullopt;
  if (solutions && (last || standing != Standing::open)) {
    const auto count = static_cast<int>(solutions->size());
    CORANK_CHECK(count % family->copies == 0);
    tile.cells.push_back({sides, MapCellAnswer::Kind::proven, count / family->copies, {}, standing});
    if (options.certificate) tile.cells.back().sheets = sheets_of(*solutions);
    return;
  }
  if (!finished) {
    tile.cells.push_back({sides, MapCellAnswer::Kind::pending});
    return;
  }
  if (!last) {
    for (int k = 0; k < 4; ++k) {
      const Box part{part_of(sides[0], k % 2, 2), part_of(sides[1], k / 2, 2)};
      divide(search, search.part(cell, of_every_robot(part)), level + 1, tile, roots, control);
    }
    return;
  }
  MapCellAnswer answer{sides, MapCellAnswer::Kind::undecided};
  solve::ProductCell centre = search.part(cell, of_every_robot({Interval(sides[0].mid()), Interval(sides[1].mid())}));
  search.refine(centre, kCentreShare, kMostOfCentre, control);
  if (const auto there = search.solutions(centre)) answer.at_centre = static_cast<int>(there->size()) / family->copies;
  tile.cells.push_back(std::move(answer));
  std::vector<Box> open = search.open(cell);
  if (open.size() > kMostRoots) {
    for (std::size_t k = 1; k < open.size(); ++k) include(open[0], open[k]);
    open.resize(1);
  }
  std::ranges::move(open, std::back_inserter(roots));
}

// The eliminated variables' values follow from the others'.
std::vector<MapSheet> ParameterMapper::Parts::sheets_of(const std::vector<certify::Sheet>& solutions) const {
  const certify::Reduction& r = family->reduction;
  const auto lifted = [&](const std::vector<Interval>& sides) {
    Box box(r.kept.size() + r.definitions.size(), Interval::whole());
    for (std::size_t j = 0; j < r.kept.size(); ++j) box[r.kept[j]] = sides[j];
    return box;
  };
  std::vector<MapSheet> sheets;
  for (const certify::Sheet& s : solutions) sheets.push_back({lifted(s.image), lifted(s.region)});
  return sheets;
}

std::optional<Standing> ParameterMapper::Parts::standing_of(const std::vector<certify::Sheet>& solutions) const {
  const Family& f = *family;
  if (f.requirements.empty() || solutions.empty()) return std::nullopt;
  const certify::CompiledSystem& system = f.problem->compiled;
  certify::NewtonWorkspace workspace;
  Standing all = Standing::satisfied;
  for (const certify::Sheet& sheet : solutions) {
    Box x = sheet.image;
    const auto tightened = [&] {
      const auto p = certify::midpoint_preconditioner(system, midpoint(x), sheet.dependent);
      return certify::tighten_sheet(system, p, x, workspace);
    };
    tightened();
    const certify::NewtonStep at = tightened();
    Box offsets;
    for (const int p : f.parameters) offsets.push_back(x[p] - Interval(at.center()[p]));
    const auto form = [&](int variable) {
      return f.kept_as[variable] >= 0 ? at.form_of_variable(f.kept_as[variable], x, f.parameters)
                                      : at.form_at_zeros(f.value_row[variable], x, f.parameters);
    };
    all = certify::both(all, certify::standing(f.requirements, form, offsets));
    if (all == Standing::violated) break;
  }
  return all;
}

void ParameterMapper::Parts::find_folds(std::vector<Box> roots, MapTile& tile, solve::Control& control) const {
  solve::Prepared prepared = *family->folds;
  for (Box& root : roots) {
    for (std::size_t j = root.size(); j < prepared.system.variables.size(); ++j)
      root.push_back(prepared.system.variables[j].domain);
    prepared.options.roots.push_back(std::move(root));
  }
  solve::Control own(as_of(control));
  const Cover cover = solve::solve(prepared, own, kMostOfFolds);
  tile.processed += cover.statistics.processed;
  tile.boundary_known = cover.complete();
  for (const CoverBox& box : cover.boxes) {
    Box sides;
    for (std::size_t k = 0; k < 2; ++k) sides.push_back(box.box[family->parameters[k]]);
    const bool proven = box.verdict == Verdict::regular || box.verdict == Verdict::boundary || box.verdict == Verdict::exact;
    tile.boundary.push_back({std::move(sides), proven});
  }
}

MapTile ParameterMapper::Parts::sample(int number, solve::Control& control) const {
  MapTile tile{.number = number};
  const int across = options.resolution / kTiles;
  const Box sides = sides_of(number);
  for (int k = 0; k < across * across; ++k) {
    MapCellAnswer cell{{part_of(sides[0], k % across, across), part_of(sides[1], k / across, across)}};
    if (!control.ended()) {
      cell.at_centre = answer_at(cell.sides, control);
      if (!control.ended()) cell.kind = MapCellAnswer::Kind::centre;
    }
    tile.cells.push_back(std::move(cell));
  }
  return tile;
}

std::optional<int> ParameterMapper::Parts::answer_at(const Box& sides, solve::Control& control) const {
  study::Question at = question.question;
  std::vector<result::ConstantOverride> constants;
  for (std::size_t k = 0; k < 2; ++k)
    constants.push_back({question.over[k].name, ExactNumber::dyadic(sides[k].mid()).text()});
  result::put_in(constants, at.model);
  solve::Control own(as_of(control));
  if (question.answer == MapAnswer::components) {
    const Components found = topology(at, {}, own).components;
    return found.exact() ? std::optional(found.at_least) : std::nullopt;
  }
  try {
    const Aspects found = aspects(at, {.requirements = false}, own);
    const Pieces& pieces = question.answer == MapAnswer::aspects          ? found.aspects
                           : question.answer == MapAnswer::assembly_modes ? found.assembly_modes
                                                                          : found.working_modes;
    return found.reason.empty() && pieces.exact() ? std::optional(pieces.at_least) : std::nullopt;
  } catch (const symbolic::DeterminantVanishes&) {  // here
    return std::nullopt;
  }
}

ParameterMap ParameterMapper::assemble(std::vector<MapTile> tiles) const {
  const Parts& p = *parts_;
  ParameterMap map;
  map.model = p.question.question.model.name();
  map.set = p.question.question.set ? symbolic::to_string(*p.question.question.set) : p.question.solutions;
  map.answer = p.question.answer;
  for (const symbolic::Parameter& over : p.question.over) map.names.push_back(over.name);
  map.region = p.region;
  for (const symbolic::FixedCoordinate& f : p.question.fixed) map.fixed.emplace_back(f.name, f.value.text());
  if (p.family) map.require = p.question.question.model.requirement_texts();
  if (p.family) map.tolerances = p.family->tolerances;
  map.resolution = p.options.resolution;
  std::vector<bool> there(ParameterMapper::tiles(), false);
  map.boundary_known = p.family.has_value();
  for (MapTile& tile : tiles) {
    CORANK_CHECK(!there.at(tile.number));
    there[tile.number] = true;
    std::move(tile.cells.begin(), tile.cells.end(), std::back_inserter(map.cells));
    std::move(tile.boundary.begin(), tile.boundary.end(), std::back_inserter(map.boundary));
    map.processed += tile.processed;
    map.boundary_known = map.boundary_known && tile.boundary_known;
  }
  for (int k = 0; k < ParameterMapper::tiles(); ++k)
    if (!there[k]) map.cells.push_back({p.sides_of(k)});
  const auto key = [](const Box& b) { return std::tuple(b[1].lo(), b[0].lo(), b[1].hi(), b[0].hi()); };
  std::ranges::sort(map.cells, [&](const auto& a, const auto& b) { return key(a.sides) < key(b.sides); });
  std::ranges::sort(map.boundary, [&](const auto& a, const auto& b) {
    return std::tuple(key(a.sides), a.proven) < std::tuple(key(b.sides), b.proven);
  });
  map.complete =
      std::ranges::none_of(map.cells, [](const MapCellAnswer& c) { return c.kind == MapCellAnswer::Kind::pending; });
  map.boundary_known = map.boundary_known && map.complete;
  if (p.options.certificate && p.family) {
    map.claims.emplace().reduction = p.family->reduction.steps;
    for (MapCellAnswer& c : map.cells)
      if (c.kind == MapCellAnswer::Kind::proven)
        map.claims->cells.push_back(
            {c.sides, c.count.value(), std::exchange(c.sheets, {}), c.standing.value_or(Standing::open)});
  }
  return map;
}

ParameterMap parameter_map(const MapQuestion& question, const ParameterMapOptions& options, solve::Control& control) {
  const auto start = std::chrono::steady_clock::now();
  const ParameterMapper mapper(question, options);
  const solve::InStage stage(control, solve::Stage::search);
  std::optional<CriticalPoints> critical;
  if (options.cusps) {
    const ParameterMap plane = mapper.assemble({});
    critical = critical_points(question.question, plane.names, plane.region, options.threads, control);
  }
  std::vector<MapTile> tiles;
  std::mutex mutex;
  ThreadArena arena(options.threads);
  arena.execute([&] {
    tbb::parallel_for(
        0, ParameterMapper::tiles(), 1,
        [&](int number) {
          if (control.ended()) return;
          MapTile tile = mapper.tile(number, control);
          const std::lock_guard lock(mutex);
          tiles.push_back(std::move(tile));
          if (options.progress) options.progress(tiles.size(), ParameterMapper::tiles());
        },
        tbb::simple_partitioner());
  });
  ParameterMap map = mapper.assemble(std::move(tiles));
  map.critical = std::move(critical);
  if (!map.complete) map.stopped = solve::stopped_by(control);
  map.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return map;
}

}  // namespace corank::analyze
