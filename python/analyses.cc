// Topology, aspects, clearance: each as its JSON text, its table, and what ended it early.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include "corank/analyze/area_by_boundary.h"
#include "corank/analyze/aspects.h"
#include "corank/analyze/best_center.h"
#include "corank/analyze/claims.h"
#include "corank/analyze/clearance_map.h"
#include "corank/analyze/path.h"
#include "corank/analyze/topology.h"
#include "corank/analyze/workspace_area.h"
#include "corank/python/bindings.h"
#include "corank/python/model.h"
#include "corank/python/path_picture.h"
#include "corank/python/result.h"
#include "corank/python/watched.h"
#include "corank/result/path_file.h"
#include "corank/result/pieces_file.h"

namespace corank::python {
namespace {

using symbolic::Expression;

struct Texts {
  std::string json, table;
};

template <class Work>
py::tuple said(const py::object& progress, Work work) {
  auto [texts, raised] = run_for(progress, std::move(work));
  return py::make_tuple(texts.json, texts.table, raised);
}

template <class File>
py::tuple verify(const File& file, int threads, const py::object& progress) {
  return said(progress, [file, threads](Watcher& watcher) {
    check::Options options;
    options.threads = threads;
    options.ended = [&watcher] { return watcher.stop.load(); };
    const auto report = result::verify(file, options);
    return Texts{to_json(report, file), to_table(report, file)};
  });
}

// The sets are ignored: a question about all configurations.
study::Question configurations(const Model& model) {
  if (model.mechanism().is_plain_system()) return question_of(model, std::nullopt);
  return question_of(model, "cspace");
}

py::tuple topology(const Model& model, const analyze::TopologyOptions& options, double time_limit,
                   const py::object& progress) {
  return said(progress, [question = configurations(model), options, time_limit](Watcher& watcher) {
    solve::Control control({.time = time_limit, .stop = &watcher.stop});
    watcher.follow(control);
    const analyze::Topology t = analyze::topology(question, options, control);
    return Texts{to_json(question, t, !control.ended()), to_text(question, t)};
  });
}

// With what others can check, where options.certificate asks for it and something is known.
py::tuple aspects(const Model& model, analyze::AspectsOptions options, bool areas, double time_limit,
                  const py::object& progress) {
  if (model.mechanism().is_plain_system())
    throw std::invalid_argument(model.mechanism().name() + " has no inputs and outputs: a plain system has no aspects");
  const study::Question question = configurations(model);
  if (areas && question.model.outputs().size() != 2)
    throw std::invalid_argument(model.mechanism().name() + ": areas need two outputs");
  if (areas) options.images = question.model.outputs();
  struct Said {
    Texts texts;
    std::shared_ptr<result::PiecesFile> file;
  };
  auto [said, raised] = run_for(progress, [question, options, time_limit](Watcher& watcher) {
    solve::Control control({.time = time_limit, .stop = &watcher.stop});
    watcher.follow(control);
    const analyze::Aspects a = analyze::aspects(question, options, control);
    Said result{{to_json(question, a, !control.ended()), to_text(question, a)}, {}};
    if (a.cover && !control.ended()) result.file = std::make_shared<result::PiecesFile>(to_file(question, a));
    return result;
  });
  return py::make_tuple(said.texts.json, said.texts.table, said.file, raised);
}

constexpr std::string_view kAvoids[] = {"forward", "inverse", "both"};  // in the order of analyze::Avoid

using Values = std::vector<std::pair<std::string, Expression>>;
using Ranges = std::vector<std::tuple<std::string, Expression, Expression>>;

std::vector<analyze::NamedRange> ranges_of(const Ranges& ranges) {
  std::vector<analyze::NamedRange> list;
  for (const auto& [name, lower, upper] : ranges) list.push_back({name, lower, upper});
  return list;
}

analyze::BallOptions ball(const Values& at, const std::vector<std::string>& in, const Ranges& ranges,
                          const std::optional<Expression>& orientation_range, const std::optional<std::string>& orientation,
                          const std::string& orientation_of) {
  analyze::BallOptions options;
  for (const auto& [name, value] : at) options.at.push_back({name, value});
  options.in = in;
  options.ranges = ranges_of(ranges);
  options.orientation_range = orientation_range;
  if (orientation) options.orientation = analyze::parse_rotation(*orientation);
  options.orientation_of = orientation_of;
  return options;
}

std::string radius_text(double lower, const std::optional<double>& upper) {
  return upper ? fmt::format("radius in [{:.5g}, {:.5g}]", lower, *upper) : fmt::format("radius at least {:.5g}", lower);
}

// With `claims`: the results that prove both bounds again, where they could be made.
py::tuple clearance(const Model& model, const std::optional<std::string>& set, const analyze::BallOptions& about,
                    double precision, bool claims, const solve::Options& search, const py::object& progress) {
  search.validate();
  struct Said {
    Texts texts;
    std::optional<Result> free, nearest;
  };
  const auto work = [question = question_of(model, set), about, precision, claims, search](Watcher& watcher) {
    solve::Control control(limits_of(search, &watcher.stop));
    analyze::ClearanceOptions options{.precision = precision};
    options.progress = [&watcher](double lower, std::optional<double> upper, std::uint64_t processed) {
      watcher.show({"clearance", -1, fmt::format("{}, {} boxes", radius_text(lower, upper), processed)});
    };
    const analyze::Clearance c = analyze::clearance(question, about, options, search, control);
    Said result{{to_json(c), to_table(c)}, {}, {}};
    if (!claims) return result;
    result.free.emplace(claim_free(c, search, control));
    if (c.nearest.upper)
      if (auto nearest = claim_nearest(c, control)) result.nearest.emplace(std::move(*nearest));
    return result;
  };
  auto [result, raised] = run_for(progress, work);
  return py::make_tuple(result.texts.json, result.texts.table, result.free, result.nearest, raised);
}

py::tuple best_center(const Model& model, const std::optional<std::string>& set, const analyze::BallOptions& about,
                      const Ranges& region, double precision, const solve::Options& search, const py::object& progress) {
  search.validate();
  return said(progress, [question = question_of(model, set), about, region, precision, search](Watcher& watcher) {
    solve::Control control(limits_of(search, &watcher.stop));
    analyze::BestOptions options{.precision = precision};
    options.progress = [&watcher](double lower, std::optional<double> upper, std::uint64_t cells) {
      watcher.show({"clearance", -1, fmt::format("{}, {} cells", radius_text(lower, upper), cells)});
    };
    const analyze::Best best = analyze::best_center(question, about, ranges_of(region), options, search, control);
    return Texts{to_json(best), to_table(best)};
  });
}

py::tuple clearance_map(const Model& model, const std::optional<std::string>& set, const analyze::BallOptions& about,
                        const Ranges& region, int grid, double precision, const solve::Options& search,
                        const py::object& progress) {
  search.validate();
  return said(progress, [question = question_of(model, set), about, region, grid, precision, search](Watcher& watcher) {
    solve::Control control(limits_of(search, &watcher.stop));
    analyze::MapOptions options{.grid = grid, .precision = precision};
    options.progress = [&watcher](std::size_t done, std::size_t all) {
      watcher.show(
          {"clearance", static_cast<double>(done) / static_cast<double>(all), fmt::format("{} of {} cells", done, all)});
    };
    const analyze::ClearanceMap map = analyze::clearance_map(question, about, ranges_of(region), options, search, control);
    return Texts{to_json(map), to_csv(map)};
  });
}

struct End {
  Values values;
  int mode = 0;
};

// With the path's file, where there is a path, and what a page shows of it.
py::tuple path(const Model& model, const End& from, const End& to, const std::string& avoid, double radius, int threads,
               std::uint64_t max_boxes, double time_limit, const py::object& progress) {
  if (model.mechanism().is_plain_system())
    throw std::invalid_argument(model.mechanism().name() +
                                " has no inputs and outputs: a plain system has no singularities");
  analyze::PathOptions options{.radius = radius, .threads = threads};
  const auto which = std::find(std::begin(kAvoids), std::end(kAvoids), avoid);
  if (which == std::end(kAvoids)) throw std::invalid_argument("avoid: expected \"forward\", \"inverse\" or \"both\"");
  options.avoid = static_cast<analyze::Avoid>(which - std::begin(kAvoids));
  if (max_boxes > 0) options.max_boxes = max_boxes;
  struct Said {
    Texts texts;
    std::shared_ptr<result::PathFile> file;
    std::shared_ptr<PathPicture> picture;
  };
  auto [said, raised] =
      run_for(progress, [question = configurations(model), from, to, options, time_limit](Watcher& watcher) {
        solve::Control control({.time = time_limit, .stop = &watcher.stop});
        watcher.follow(control);
        analyze::PathFinder finder(question, options);
        std::vector<Box> ends;
        for (const auto& [end, name] : {std::pair(&from, "start"), std::pair(&to, "end")}) {
          std::vector<analyze::NamedValue> values;
          for (const auto& [coordinate, value] : end->values) values.push_back({coordinate, value});
          ends.push_back(finder.end(values, end->mode, name, control));
        }
        const analyze::Path found = finder.find(ends[0], ends[1], control);
        Said result{{to_json(finder, found), to_text(finder, found)}, {}, {}};
        result.picture = std::make_shared<PathPicture>(finder.question().model, report::path_view(finder, found));
        if (found.tube) result.file = std::make_shared<result::PathFile>(to_file(finder, found));
        return result;
      });
  return py::make_tuple(said.texts.json, said.texts.table, said.file, said.picture, raised);
}

// Bounds of the area of the workspace in the plane of two lengths, from its boundary; with `anyway` by dividing the
// plane where the boundary does not give them. None where there are none.
std::optional<std::pair<double, double>> area(const Model& model, const std::vector<std::string>& outputs, int threads,
                                              double time_limit, bool anyway, const py::object& progress) {
  study::Question question = question_of(model, "boundary", {}, 1, outputs);
  const std::vector<std::string> names = question.model.outputs();
  if (names.size() != 2) throw std::invalid_argument("an area needs two outputs");
  return run_whole(progress, [question = std::move(question), names, threads, time_limit, anyway](Watcher& watcher) {
    using Bounds = std::optional<std::pair<double, double>>;
    solve::Control control({.time = time_limit, .stop = &watcher.stop});
    watcher.follow(control);
    if (const auto bounds = analyze::area_by_boundary(question, {.threads = threads}, control))
      return Bounds({bounds->lo, bounds->hi});
    const System system = symbolic::configurations(question.model);
    const int x = system.find(names[0]), y = system.find(names[1]);
    if (!anyway || x < 0 || y < 0) return Bounds();
    const analyze::AreaBounds bounds =
        analyze::workspace_area(system, x, y, {.stop = [&control] { return control.ended(); }});
    return Bounds({bounds.lo, bounds.hi});
  });
}

}  // namespace

void bind_analyses(py::module_& module) {
  py::class_<analyze::BallOptions>(module, "Ball").def(py::init(&ball));
  module.def("topology", [](const Model& m, int threads, int refinements, double time_limit, const py::object& progress) {
    return topology(m, {.threads = threads, .refinements = refinements}, time_limit, progress);
  });
  py::class_<result::PiecesFile, std::shared_ptr<result::PiecesFile>>(module, "PiecesFile")
      .def("write", [](const result::PiecesFile& file, const std::string& path) { result::write_pieces(path, file); });
  module.def("aspects", [](const Model& m, int threads, int halvings, int rounds, bool cusps, bool areas, bool certificate,
                           double time_limit, const py::object& progress) {
    return aspects(m,
                   {.threads = threads, .halvings = halvings, .rounds = rounds, .cusps = cusps, .certificate = certificate},
                   areas, time_limit, progress);
  });
  module.def("verify_pieces", &verify<result::PiecesFile>);
  module.def("clearance", &clearance);
  module.def("best_center", &best_center);
  module.def("clearance_map", &clearance_map);
  module.def("declared_ranges",
             [](const Model& m, const std::optional<std::string>& set, const std::vector<std::string>& names) {
               std::vector<std::tuple<std::string, Expression, Expression>> list;
               for (const analyze::NamedRange& r : analyze::declared_ranges(question_of(m, set), names))
                 list.emplace_back(r.name, r.lower, r.upper);
               return list;
             });
  module.def("area", &area);
  py::class_<result::PathFile, std::shared_ptr<result::PathFile>>(module, "PathFile")
      .def("write", [](const result::PathFile& file, const std::string& path) { result::write_path(path, file); });
  module.def("path",
             [](const Model& m, const Values& from, int from_mode, const Values& to, int to_mode, const std::string& avoid,
                double radius, int threads, std::uint64_t max_boxes, double time_limit, const py::object& progress) {
               return path(m, {from, from_mode}, {to, to_mode}, avoid, radius, threads, max_boxes, time_limit, progress);
             });
  module.def("verify_path",
             [](const result::PathFile& file, const py::object& progress) { return verify(file, 1, progress); });
}

}  // namespace corank::python
