// Topology, aspects, clearance, area, paths: each as its JSON text, its table, and what ended it early.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include "corank/analyze/aspects/aspects.h"
#include "corank/analyze/aspects/aspects_factor.h"
#include "corank/analyze/clearance/best_center.h"
#include "corank/analyze/clearance/clearance.h"
#include "corank/analyze/clearance/clearance_map.h"
#include "corank/analyze/clearance/tolerance_factor.h"
#include "corank/analyze/maps/area_by_boundary.h"
#include "corank/analyze/paths/path.h"
#include "corank/analyze/paths/path_factor.h"
#include "corank/analyze/postures/cuspidal.h"
#include "corank/analyze/postures/postures.h"
#include "corank/analyze/topology/topology.h"
#include "corank/python/bindings.h"
#include "corank/python/result.h"
#include "corank/python/watched.h"
#include "corank/result/values/claim_files.h"

namespace corank::python {
namespace {

using study::Question;
using symbolic::Expression;

void refuse_plain_system(const Question& question, const char* what) {
  if (question.model.is_plain_system())
    throw std::invalid_argument(question.model.name() + " has no inputs and outputs: a plain system has no " + what);
}

py::tuple topology(const Question& question, int threads, int refinements, double time_limit, const py::object& progress) {
  return said(progress, within(time_limit, [question, threads, refinements](solve::Control& control) {
                const analyze::Topology t =
                    analyze::topology(question, {.threads = threads, .refinements = refinements}, control);
                return std::tuple(to_json(question, t), to_text(question, t));
              }));
}

// With what others can check, where `certificate` asks for it and something is known.
py::tuple aspects(const Question& question, int threads, int halvings, int rounds, bool cusps, bool areas, bool certificate,
                  double time_limit, const py::object& progress) {
  analyze::AspectsOptions options{
      .threads = threads, .halvings = halvings, .rounds = rounds, .cusps = cusps, .certificate = certificate};
  refuse_plain_system(question, "aspects");
  if (areas && question.model.outputs().size() != 2)
    throw std::invalid_argument(question.model.name() + ": areas need two outputs");
  if (areas) options.images = question.model.outputs();
  return said(progress, within(time_limit, [question, options](solve::Control& control) {
                const analyze::Aspects a = analyze::aspects(question, options, control);
                std::shared_ptr<result::PiecesFile> file;
                if (a.cover && a.stopped.empty()) file = std::make_shared<result::PiecesFile>(to_file(question, a));
                return std::tuple(to_json(question, a), to_text(question, a), file);
              }));
}

using Values = std::vector<std::pair<std::string, Expression>>;
using Ranges = std::vector<std::tuple<std::string, Expression, Expression>>;

std::vector<analyze::NamedValue> values_of(const Values& values) {
  std::vector<analyze::NamedValue> list;
  for (const auto& [name, value] : values) list.push_back({name, value});
  return list;
}

std::vector<analyze::NamedRange> ranges_of(const Ranges& ranges) {
  std::vector<analyze::NamedRange> list;
  for (const auto& [name, lower, upper] : ranges) list.push_back({name, lower, upper});
  return list;
}

analyze::BallOptions ball(const Values& at, const std::vector<std::string>& in, const Ranges& ranges,
                          const std::optional<Expression>& orientation_range, const std::optional<std::string>& orientation,
                          const std::string& orientation_of) {
  analyze::BallOptions options;
  options.at = values_of(at);
  options.in = in;
  options.ranges = ranges_of(ranges);
  options.orientation_range = orientation_range;
  if (orientation) options.orientation = analyze::parse_rotation(*orientation);
  options.orientation_of = orientation_of;
  return options;
}

// The work under a control with a search's limits; it says itself how far it is.
template <class Work>
py::tuple searched(const solve::Options& search, const py::object& progress, Work work) {
  search.validate();
  return said(progress, [search, work = std::move(work)](Watcher& watcher) {
    solve::Control control(limits_of(search, &watcher.stop));
    return work(search, control, watcher);
  });
}

auto shown_radius(Watcher& watcher, const char* what) {
  return [&watcher, what](double lower, std::optional<double> upper, std::uint64_t count) {
    watcher.show({"clearance", -1, analyze::progress_text(lower, upper, count, what)});
  };
}

// With `claims`: the results that prove both bounds again, where they could be made.
py::tuple clearance(const Question& question, const analyze::BallOptions& about, double precision, bool claims,
                    const solve::Options& search, const py::object& progress) {
  return searched(
      search, progress,
      [question, about, precision, claims](const solve::Options& limits, solve::Control& control, Watcher& watcher) {
        const analyze::Clearance c = analyze::clearance(
            question, about, {.precision = precision, .progress = shown_radius(watcher, "boxes")}, limits, control);
        std::optional<Result> free, nearest;
        if (claims) free.emplace(claim_free(c, limits, control));
        if (claims && c.nearest.upper)
          if (auto claim = claim_nearest(c, control)) nearest.emplace(std::move(*claim));
        return std::tuple(to_json(c), to_table(c), free, nearest);
      });
}

py::tuple best_center(const Question& question, const analyze::BallOptions& about, const Ranges& region, double precision,
                      const solve::Options& search, const py::object& progress) {
  return searched(
      search, progress,
      [question, about, region, precision](const solve::Options& limits, solve::Control& control, Watcher& watcher) {
        const analyze::Best best =
            analyze::best_center(question, about, ranges_of(region),
                                 {.precision = precision, .progress = shown_radius(watcher, "cells")}, limits, control);
        return std::tuple(to_json(best), to_table(best));
      });
}

py::tuple clearance_map(const Question& question, const analyze::BallOptions& about, const Ranges& region, int grid,
                        double precision, const solve::Options& search, const py::object& progress) {
  return searched(
      search, progress,
      [question, about, region, grid, precision](const solve::Options& limits, solve::Control& control, Watcher& watcher) {
        analyze::MapOptions options{.grid = grid, .precision = precision};
        options.progress = [&watcher](std::size_t done, std::size_t all) {
          watcher.show(
              {"clearance", static_cast<double>(done) / static_cast<double>(all), fmt::format("{} of {} cells", done, all)});
        };
        const analyze::ClearanceMap map =
            analyze::clearance_map(question, about, ranges_of(region), options, limits, control);
        return std::tuple(to_json(map), to_csv(map));
      });
}

py::tuple tolerance_factor(const Question& question, const analyze::BallOptions& about, double radius, double precision,
                           const solve::Options& search, const py::object& progress) {
  return searched(
      search, progress,
      [question, about, radius, precision](const solve::Options& limits, solve::Control& control, Watcher& watcher) {
        analyze::ToleranceFactorOptions options{.radius = radius, .precision = precision, .progress = {}};
        options.progress = [&watcher](double lower, std::optional<double> upper) {
          watcher.show({"tolerance", -1, analyze::factor_words(lower, upper)});
        };
        const analyze::ToleranceFactor f = analyze::tolerance_factor(question, about, options, limits, control);
        return std::tuple(to_json(f), to_table(f));
      });
}

py::tuple aspects_factor(const Question& question, double precision, int threads, double time_limit,
                         const py::object& progress) {
  refuse_plain_system(question, "aspects");
  return said(progress, within(time_limit, [question, precision, threads](solve::Control& control) {
                const analyze::AspectsFactor f =
                    analyze::aspects_factor(question, {.precision = precision, .threads = threads, .progress = {}}, control);
                return std::tuple(to_json(question, f), to_table(question, f));
              }));
}

py::tuple path_factor(const Question& question, const result::PathFile& path, double precision, double time_limit,
                      const py::object& progress) {
  refuse_plain_system(question, "paths");
  return said(progress, within(time_limit, [question, path, precision](solve::Control& control) {
                const analyze::PathFactor f =
                    analyze::path_factor(question, path, {.precision = precision, .progress = {}}, control);
                return std::tuple(to_json(question, f), to_table(question, f));
              }));
}

// Of the quaternion's four numbers as texts, or of a product of turns; none where both are empty.
py::tuple postures(const Question& question, const Values& at, const std::optional<std::string>& turns,
                   const std::optional<std::array<std::string, 4>>& quaternion, const std::string& orientation_of,
                   int threads, double time_limit, const py::object& progress) {
  std::optional<analyze::Rotation> orientation;
  if (turns) orientation = analyze::parse_rotation(*turns);
  if (quaternion) {
    std::array<ExactNumber, 4> q;
    for (std::size_t k = 0; k < 4; ++k) q[k] = ExactNumber::rational((*quaternion)[k]);
    orientation = analyze::rotation_of(q);
  }
  analyze::PostureQuestion asked{.question = question, .given = {}, .orientation = orientation.has_value()};
  asked.orientation_of = orientation_of;
  std::vector<Expression> values;
  for (const auto& [name, value] : at) asked.given.push_back(name), values.push_back(value);
  return said(progress, within(time_limit, [asked, values, orientation, threads](solve::Control& control) {
                const analyze::PostureFinder finder(asked);
                const analyze::Postures found = finder.find(values, orientation, control, threads);
                return std::tuple(to_json(finder, found), to_table(finder, found));
              }));
}

// JSON, text, the path's file, where there is a path, and what a page shows of it.
using FoundPath = std::tuple<std::string, std::string, std::shared_ptr<result::PathFile>, std::shared_ptr<PathPicture>>;

FoundPath found_path(const analyze::PathFinder& finder, const analyze::Path& found, report::PathView view) {
  std::shared_ptr<result::PathFile> file;
  if (found.tube) file = std::make_shared<result::PathFile>(to_file(finder, found));
  return {to_json(finder, found), to_text(finder, found), file,
          std::make_shared<PathPicture>(finder.question().model, std::move(view))};
}

py::tuple cuspidal(const Question& question, const std::optional<std::string>& of, int poses, int threads, double time_limit,
                   const py::object& progress) {
  analyze::CuspidalOptions options{.poses = poses, .threads = threads, .progress = {}};
  if (of) {
    options.of = analyze::avoid_from_string(*of);
    if (!options.of) throw std::invalid_argument("of: expected \"forward\" or \"inverse\"");
  }
  return said(progress, within(time_limit, [question, options](solve::Control& control) {
                const analyze::Cuspidality found = analyze::cuspidality(question, options, control);
                std::optional<FoundPath> path;
                if (found.path) path = found_path(*found.finder, *found.path, report::cuspidal_view(found));
                const std::string name = question.model.name();
                return std::tuple(to_json(found, name, ""), to_text(found, name), path);
              }));
}

Ranges declared_ranges(const Question& question, const std::vector<std::string>& names) {
  Ranges list;
  for (const analyze::NamedRange& r : analyze::declared_ranges(question, names)) list.emplace_back(r.name, r.lower, r.upper);
  return list;
}

py::tuple path(const Question& question, const Values& from, int from_mode, const Values& to, int to_mode,
               const std::string& avoid, double radius, int threads, std::uint64_t max_boxes, double time_limit,
               const py::object& progress) {
  refuse_plain_system(question, "singularities");
  analyze::PathOptions options{.radius = radius, .threads = threads};
  const std::optional<analyze::Avoid> which = analyze::avoid_from_string(avoid);
  if (!which) throw std::invalid_argument("avoid: expected \"forward\", \"inverse\", \"both\" or \"requirements\"");
  options.avoid = *which;
  if (max_boxes > 0) options.max_boxes = max_boxes;
  const auto work = [question, start = values_of(from), from_mode, end = values_of(to), to_mode,
                     options](solve::Control& control) {
    analyze::PathFinder finder(question, options);
    const Box first = finder.end(start, from_mode, "start", control), last = finder.end(end, to_mode, "end", control);
    const analyze::Path found = finder.find(first, last, control);
    return found_path(finder, found, report::path_view(finder, found));
  };
  return said(progress, within(time_limit, work));
}

// Bounds of the area of the workspace in the plane of two lengths; None where there are none.
std::optional<std::pair<double, double>> area(const Question& question, int threads, double time_limit, bool anyway,
                                              const py::object& progress) {
  if (question.model.outputs().size() != 2) throw std::invalid_argument("an area needs two outputs");
  const std::optional<Interval> bounds =
      run_whole(progress, within(time_limit, [question, threads, anyway](solve::Control& control) {
                  return analyze::area(question, threads, anyway, control);
                }));
  return bounds ? std::optional(std::pair(bounds->lo(), bounds->hi())) : std::nullopt;
}

}  // namespace

void bind_analyses(py::module_& module) {
  bind_certificate<result::PiecesFile>(module, "PiecesFile", &result::write_pieces);
  bind_certificate<result::PathFile>(module, "PathFile", &result::write_path);
  py::class_<analyze::BallOptions>(module, "Ball").def(py::init(&ball));
  module.def("topology", &topology);
  module.def("aspects", &aspects);
  module.def("clearance", &clearance);
  module.def("best_center", &best_center);
  module.def("clearance_map", &clearance_map);
  module.def("tolerance_factor", &tolerance_factor);
  module.def("aspects_factor", &aspects_factor);
  module.def("path_factor", &path_factor);
  module.def("postures", &postures);
  module.def("cuspidal", &cuspidal);
  module.def("declared_ranges", &declared_ranges);
  module.def("area", &area);
  module.def("path", &path);
}

}  // namespace corank::python
