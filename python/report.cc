// Pages, portraits and the geometry of plots, of results.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

#include <functional>

#include "corank/python/bindings.h"
#include "corank/python/result.h"
#include "corank/python/watched.h"
#include "corank/report/html/family_page.h"
#include "corank/report/html/page.h"
#include "corank/report/html/path_page.h"
#include "corank/report/pictures/figures.h"
#include "corank/report/pictures/picture.h"
#include "corank/report/pictures/portrait.h"
#include "corank/result/files/verification.h"
#include "corank/study/cut.h"

namespace corank::python {
namespace {

std::vector<report::SetView> views_of(const symbolic::Mechanism& mechanism, const std::vector<Result>& results) {
  std::vector<report::SetView> views;
  for (const Result& r : results) {
    System system = result::system_of(mechanism, *r);
    views.push_back(report::set_view(mechanism, r.on_page(), std::move(system)));
    if (study::is_whole(*r)) say_cut(r->cover.boxes.size(), views.back());
  }
  return views;
}

// The model as the results have it: with its constants.
symbolic::Mechanism mechanism_of(const std::vector<Result>& results) {
  if (results.empty()) throw std::invalid_argument("there is no result to show");
  for (const Result& r : results)
    if (r->model_text != results.front()->model_text || r->options.constants != results.front()->options.constants)
      throw std::invalid_argument("the results are of different models, or with different constants");
  return result::model_of(*results.front());
}

using Aspects = std::shared_ptr<report::PageAspects>;

// Within the time; with what ended it early.
py::tuple page_aspects(const std::vector<Result>& results, int threads, double time_limit, const py::object& progress) {
  const auto work = [results, question = study::Question{.model = mechanism_of(results)}, threads,
                     time_limit](solve::Control& control) {
    std::vector<const result::Result*> list;
    for (const Result& r : results) list.push_back(&*r);
    auto found = report::page_aspects(question, list, threads, fmt::format("{} s, the time limit", time_limit), control);
    return std::tuple(found ? std::make_shared<report::PageAspects>(std::move(*found)) : Aspects());
  };
  return said(progress, within(time_limit, work));
}

std::string page(const std::vector<Result>& results, const std::string& command, const std::vector<std::string>& figures,
                 const std::vector<std::string>& files, const Aspects& aspects) {
  const py::gil_scoped_release unlocked;
  const symbolic::Mechanism mechanism = mechanism_of(results);
  report::PageOptions options{command, figures, files};
  if (aspects) options.aspects = *aspects;
  return report::report_page(mechanism, views_of(mechanism, results), options);
}

std::string path_page(const PathPicture& path, const std::vector<Result>& results, const std::vector<std::string>& missing,
                      const std::string& command) {
  const py::gil_scoped_release unlocked;
  if (!results.empty() && mechanism_of(results).source_text() != path.mechanism.source_text())
    throw std::invalid_argument("the results are of another model than the path");
  return report::path_page(path.mechanism, path.view, views_of(path.mechanism, results),
                           {.command = command, .missing = missing});
}

using Members = std::vector<std::tuple<std::string, std::vector<Result>, std::vector<std::string>>>;

std::string family_page(const Members& members, const std::string& constant, const std::array<std::string, 2>& axes,
                        std::size_t asked, const std::string& command, const std::string& report_command,
                        const std::vector<std::string>& figures) {
  const py::gil_scoped_release unlocked;
  std::vector<report::FamilyMember> list;
  for (const auto& [value, results, files] : members) {
    symbolic::Mechanism mechanism = mechanism_of(results);
    std::vector<report::SetView> views = views_of(mechanism, results);
    list.push_back({value, std::move(mechanism), std::move(views), files});
  }
  report::FamilyOptions options;
  options.constant = constant;
  options.axes = axes;
  options.asked = asked;
  options.command = command;
  options.report_command = report_command;
  options.figures = figures;
  return report::family_page(list, options);
}

std::vector<report::PictureSource> sources_of(const std::vector<Result>& results, auto boxes_of) {
  std::vector<report::PictureSource> sources;
  for (const Result& r : results) sources.push_back(report::picture_view(boxes_of(r), r->set));
  return sources;
}

report::Picture picture(const std::vector<Result>& results, const std::vector<std::string>& axes, const std::string& color) {
  report::PictureOptions options;
  options.axes = axes;
  if (color != "set" && color != "verdict" && color != "plain")
    throw std::invalid_argument("color is set, verdict or plain, not '" + color + "'");
  options.color = color == "set"       ? report::ColorScheme::set
                  : color == "verdict" ? report::ColorScheme::verdict
                                       : report::ColorScheme::plain;
  return report::make_picture(sources_of(results, std::mem_fn(&Result::drawn)), options);
}

py::array_t<double> sides(const report::PictureLayer& layer, std::size_t axes) {
  py::array_t<double> array({static_cast<py::ssize_t>(layer.boxes.size()), static_cast<py::ssize_t>(axes), py::ssize_t{2}});
  double* to = array.mutable_data();
  for (const report::PictureBox& box : layer.boxes)
    for (std::size_t k = 0; k < axes; ++k) {
      *to++ = box.sides[k].lo();
      *to++ = box.sides[k].hi();
    }
  return array;
}

// The axes as (name, function of it, is it an angle), the layers as (label, colour, opacity, n × axes × 2, box numbers), the
// hatches as (from, direction).
py::tuple geometry(const std::vector<Result>& results, const std::vector<std::string>& axes, const std::string& color) {
  report::Picture p;
  {
    const py::gil_scoped_release unlocked;
    p = picture(results, axes, color);
  }
  py::list names, layers, hatches;
  for (const report::PictureAxis& a : p.axes) names.append(py::make_tuple(a.name, a.function, a.angle));
  for (const report::PictureLayer& layer : p.layers) {
    py::array_t<int> numbers(static_cast<py::ssize_t>(layer.boxes.size()));
    int* to = numbers.mutable_data();
    for (const report::PictureBox& box : layer.boxes) *to++ = box.number;
    layers.append(py::make_tuple(layer.label, py::make_tuple(layer.color.red, layer.color.green, layer.color.blue),
                                 layer.opacity, sides(layer, p.axes.size()), numbers));
  }
  for (const report::PictureHatch& h : p.hatches) hatches.append(py::make_tuple(h.from, h.direction));
  return py::make_tuple(names, layers, hatches);
}

void write_portrait(const std::filesystem::path& path, const std::vector<Result>& results,
                    const std::vector<std::string>& axes, const std::string& color, const std::string& title,
                    double width_mm) {
  const py::gil_scoped_release unlocked;
  report::PortraitOptions options;
  options.title = title;
  options.width_mm = width_mm;
  report::write_portrait(path, picture(results, axes, color), options);
}

std::vector<std::string> write_figures(const std::filesystem::path& folder, const std::vector<Result>& results) {
  const py::gil_scoped_release unlocked;
  if (results.empty()) return {};
  return report::write_figures(folder, mechanism_of(results), sources_of(results, std::mem_fn(&Result::on_page)), {}).files;
}

std::vector<std::string> write_family_figures(const std::filesystem::path& folder,
                                              const std::vector<std::vector<Result>>& members,
                                              const std::vector<std::string>& axes, const std::vector<std::string>& titles) {
  const py::gil_scoped_release unlocked;
  std::vector<std::vector<report::PictureSource>> sources;
  for (const std::vector<Result>& results : members) sources.push_back(sources_of(results, std::mem_fn(&Result::on_page)));
  return report::write_family_figures(folder, sources, axes, titles, {}).files;
}

}  // namespace

void bind_report(py::module_& module) {
  py::class_<PathPicture, std::shared_ptr<PathPicture>>(module, "PathPicture");
  py::class_<report::PageAspects, Aspects>(module, "PageAspects");
  module.attr("page_limits") = py::make_tuple(report::kPageBoxes, report::kPageSeconds, report::kPageDigits);
  module.attr("family_coarser") = report::kFamilyCoarser;
  module.def("page_aspects", &page_aspects);
  module.def("report_page", &page);
  module.def("path_page", &path_page);
  module.def("family_page", &family_page);
  module.def("geometry", &geometry);
  module.def("write_portrait", &write_portrait);
  module.def("write_figures", &write_figures);
  module.def("write_family_figures", &write_family_figures);
  module.def("member_file", &report::member_file);
}

}  // namespace corank::python
