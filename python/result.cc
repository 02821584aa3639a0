#include "corank/python/result.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "corank/certify/angle.h"
#include "corank/core/check.h"
#include "corank/python/bindings.h"
#include "corank/python/watched.h"
#include "corank/report/html/page.h"
#include "corank/report/html/set_view.h"
#include "corank/result/cuik/cuik_files.h"
#include "corank/result/files/result_file.h"
#include "corank/result/files/stored_list.h"
#include "corank/result/files/verification.h"
#include "corank/result/values/sentences.h"
#include "corank/result/values/summary.h"
#include "corank/result/values/tallies.h"
#include "corank/study/cut.h"
#include "corank/study/images.h"

namespace corank::python {

namespace {

template <class T>
using Member = std::pair<const char*, T (*)(const CoverBox&)>;
constexpr std::array kBytes{
    Member<std::uint8_t>{"verdict", [](const CoverBox& b) { return static_cast<std::uint8_t>(b.verdict); }},
    Member<std::uint8_t>{"reason", [](const CoverBox& b) { return static_cast<std::uint8_t>(b.reason); }},
    Member<std::uint8_t>{"types_proven", [](const CoverBox& b) { return b.types.proven; }},
    Member<std::uint8_t>{"types_excluded", [](const CoverBox& b) { return b.types.excluded; }},
    Member<std::uint8_t>{"passage", [](const CoverBox& b) { return static_cast<std::uint8_t>(b.passage); }}};
constexpr std::array kNumbers{Member<std::int32_t>{"kernel_at_most", [](const CoverBox& b) { return b.kernel_at_most; }},
                              Member<std::int32_t>{"region", [](const CoverBox& b) { return b.region; }},
                              Member<std::int32_t>{"point", [](const CoverBox& b) { return b.point; }},
                              Member<std::int32_t>{"part", [](const CoverBox& b) { return b.part; }}};

// A read-only array over memory that `owner` keeps alive.
template <class T>
py::array view(const std::shared_ptr<const BoxArrays>& owner, const std::vector<T>& data, std::vector<py::ssize_t> shape) {
  const py::capsule base(new std::shared_ptr<const BoxArrays>(owner),
                         [](void* p) { delete static_cast<std::shared_ptr<const BoxArrays>*>(p); });
  py::array_t<T> array(std::move(shape), data.data(), base);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::dict box_arrays(const std::shared_ptr<const BoxArrays>& a) {
  const auto n = static_cast<py::ssize_t>(a->size), m = static_cast<py::ssize_t>(a->variables);
  py::dict arrays;
  arrays["bounds"] = view(a, a->bounds, {n, m, 2});
  arrays["free"] = view(a, a->free, {n, m}).attr("view")("bool");
  for (const auto& [name, column] : a->bytes) arrays[name] = view(a, column, {n});
  for (const auto& [name, column] : a->numbers) arrays[name] = view(a, column, {n});
  return arrays;
}

py::array_t<bool> on_parts_of_sheets(const Result& r) {
  const std::vector<bool> list = result::on_parts_of_sheets(*r);
  py::array_t<bool> array(static_cast<py::ssize_t>(list.size()));
  std::ranges::copy(list, array.mutable_data());
  return array;
}

// n × 2, in radians: of each box the angles over its cosines and sines.
py::array_t<double> angle_enclosures(const Result& r, const std::string& name, bool of_points) {
  for (const Angle& angle : r->angles) {
    if (angle.name != name) continue;
    const std::vector<CoverBox>& boxes = of_points ? r->cover.points : r->cover.boxes;
    py::array_t<double> array({static_cast<py::ssize_t>(boxes.size()), py::ssize_t{2}});
    double* to = array.mutable_data();
    for (const CoverBox& b : boxes) {
      const Interval x = certify::angle_enclosure(b.box[angle.cosine], b.box[angle.sine], angle.range);
      *to++ = x.lo();
      *to++ = x.hi();
    }
    return array;
  }
  throw py::key_error(name);
}

std::vector<std::string> texts(const RationalPolynomial& polynomial) {
  std::vector<std::string> list;
  for (const ExactNumber& c : polynomial) list.push_back(c.text());
  return list;
}

// Its number t: coefficients, between which bounds; then each coordinate's coefficients, by name.
py::dict exact_point(const result::Result& r, const ExactPoint& p) {
  py::dict point, coordinates;
  for (std::size_t j = 0; j < p.coordinates.size() && j < r.variables.size(); ++j)
    if (!p.coordinates[j].empty()) coordinates[py::str(r.variables[j].name)] = texts(p.coordinates[j]);
  point["polynomial"] = texts(p.polynomial);
  point["between"] = py::make_tuple(p.lower.text(), p.upper.text());
  point["coordinates"] = coordinates;
  point["corank"] = p.corank;
  return point;
}

py::list exact_points(const Result& r) {
  py::list list;
  for (const ExactPoint& p : r->cover.exact_points) list.append(exact_point(*r, p));
  return list;
}

py::list variables(const Result& r) {
  static constexpr std::array kKinds{"length", "cosine", "sine", "kernel", "auxiliary", "parameter"};
  py::list list;
  for (const result::ResultVariable& v : r->variables)
    list.append(py::make_tuple(v.name, kKinds[static_cast<std::size_t>(v.kind)], v.domain.lo(), v.domain.hi()));
  return list;
}

py::list angles(const Result& r) {
  py::list list;
  for (const Angle& a : r->angles) list.append(py::make_tuple(a.name, a.cosine, a.sine, a.range.lo(), a.range.hi()));
  return list;
}

Result read(const std::filesystem::path& path) {
  const py::gil_scoped_release unlocked;
  result::Result result = result::read_result(path);
  const symbolic::Mechanism mechanism = result::model_of(result);
  result::describe_in_words(mechanism, result::system_of(mechanism, result), result);
  return Result(std::move(result));
}

void save(const Result& r, const std::filesystem::path& path) {
  const py::gil_scoped_release unlocked;
  if (path.extension() == ".sol") return result::write_text(path, result::to_sol(r.drawn()));
  result::write_result(path, *r);
}

py::tuple cut(const Result& r, const solve::Options& options, const py::object& progress) {
  return said(progress, within(options.time_limit, [shared = r.shared(), options](solve::Control& control) {
                return std::tuple(Result(study::cut(*shared, options, control)));
              }));
}

py::tuple verify(const Result& r, int threads, const py::object& progress) {
  return said(progress, [shared = r.shared(), threads](Watcher& watcher) {
    check::Options options{.threads = threads, .progress = {}, .ended = [&watcher] { return watcher.stop.load(); }};
    options.progress = [&watcher](const check::Progress& p) {
      const bool script = p.steps > 0;
      const double done = static_cast<double>(script ? p.steps : p.boxes),
                   all = static_cast<double>(script ? p.all_steps : p.all_boxes);
      watcher.show({script ? "the proof" : "the boxes", all > 0 ? done / all : -1, ""});
    };
    const result::Verification v = result::verify(*shared, options);
    return std::tuple(result::to_json(v), result::to_table(v, *shared));
  });
}

// What a report says of a set, in words.
py::dict words(const Result& r) {
  const symbolic::Mechanism mechanism = result::model_of(*r);
  const report::SetWords w = report::set_words(*r, report::components(*r), mechanism.has_own_velocity_equation());
  py::dict dict;
  dict["title"] = w.title;
  dict["meaning"] = w.meaning;
  dict["finding"] = w.finding;
  dict["proven"] = w.proven;
  dict["unproven"] = w.unproven;
  return dict;
}

}  // namespace

const result::Result& Result::cut(Cut& known, std::uint64_t most) const {
  std::call_once(known.once, [&] {
    if (study::is_whole(*value_)) known.value = study::cut_for_page(*value_, {.threads = 0}, most, {});
    if (auto images = study::with_images(known.value ? *known.value : *value_, most)) known.value = std::move(images);
  });
  return known.value ? *known.value : *value_;
}

const result::Result& Result::on_page() const { return cut(*on_page_, report::kPageBoxes); }

BoxArrays::BoxArrays(const std::vector<CoverBox>& boxes, std::size_t n) : size(boxes.size()), variables(n) {
  bounds.reserve(2 * size * n);
  free.assign(size * n, 0);
  for (const auto& [name, of] : kBytes) bytes.emplace_back(name, std::vector<std::uint8_t>()).second.reserve(size);
  for (const auto& [name, of] : kNumbers) numbers.emplace_back(name, std::vector<std::int32_t>()).second.reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    const CoverBox& b = boxes[i];
    CORANK_CHECK(b.box.size() == n);
    for (const Interval& side : b.box) bounds.insert(bounds.end(), {side.lo(), side.hi()});
    for (const int j : b.free) free[i * n + static_cast<std::size_t>(j)] = 1;
    for (std::size_t k = 0; k < kBytes.size(); ++k) bytes[k].second.push_back(kBytes[k].second(b));
    for (std::size_t k = 0; k < kNumbers.size(); ++k) numbers[k].second.push_back(kNumbers[k].second(b));
  }
}

void bind_result(py::module_& module) {
  py::class_<Result> type(module, "Result");
  type.def_property_readonly("model", [](const Result& r) { return r->model; });
  type.def_property_readonly("model_text", [](const Result& r) { return r->model_text; });
  type.def_property_readonly("constants", [](const Result& r) {
    std::vector<std::pair<std::string, std::string>> list;
    for (const auto& o : r->options.constants) list.emplace_back(o.name, o.expression);
    return list;
  });
  type.def_property_readonly("set", [](const Result& r) { return r->set; });
  type.def_property_readonly("part", [](const Result& r) { return r->part; });
  type.def_property_readonly("version", [](const Result& r) { return r->version; });
  type.def_property_readonly("system_text", [](const Result& r) { return r->system_text; });
  type.def_property_readonly("stopped", [](const Result& r) { return r->stopped; });
  type.def_property_readonly("assembled", [](const Result& r) { return result::assembled(*r); });
  type.def_property_readonly("sample", [](const Result& r) {
    std::optional<std::vector<std::tuple<std::string, double, double>>> list;
    if (const auto sample = result::sample(*r)) {
      list.emplace();
      for (const result::Value& v : result::values(*sample->of, sample->box, sample->of->configuration_size))
        list->emplace_back(v.name, v.value.lo(), v.value.hi());
    }
    return list;
  });
  type.def_property_readonly("nearly_solved", [](const Result& r) { return r->nearly_solved; });
  type.def_property_readonly("outputs", [](const Result& r) { return r->outputs; });
  type.def_property_readonly("dimension", [](const Result& r) { return r->cover.dimension; });
  type.def_property_readonly("complete", [](const Result& r) { return r->cover.complete(); });
  type.def_property_readonly("counts", [](const Result& r) { return r->cover.counts(); });
  type.def_property_readonly("has_proof", [](const Result& r) { return r->cover.proof != nullptr; });
  type.def_property_readonly("sigma",
                             [](const Result& r) { return py::make_tuple(r->cover.sigma.length, r->cover.sigma.angle); });
  type.def_property_readonly("configuration_size", [](const Result& r) { return r->configuration_size; });
  type.def_property_readonly("variables", &variables);
  type.def_property_readonly("angles", &angles);
  type.def_property_readonly("free_coordinates", [](const Result& r) { return r->free_coordinates; });
  type.def_property_readonly("motions", [](const Result& r) { return r->motions; });
  type.def_property_readonly("decimals", [](const Result& r) { return r->cover.decimals; });
  type.def_property_readonly("types_asked", [](const Result& r) { return r->cover.types.asked; });
  type.def_property_readonly("exact_points", &exact_points);
  type.def_property_readonly("parts", [](const Result& r) {
    std::vector<Result> parts;
    for (const result::Result& part : r->parts) parts.emplace_back(part);
    return parts;
  });
  type.def("boxes", [](const Result& r) { return box_arrays(r.boxes()); });
  type.def("points", [](const Result& r) { return box_arrays(r.points()); });
  type.def("on_parts_of_sheets", &on_parts_of_sheets);
  type.def("angle_enclosures", &angle_enclosures);
  type.def("table", [](const Result& r) { return result::to_table(*r); });
  type.def("json", [](const Result& r) { return result::to_json(*r); });
  type.def("words", &words);
  type.def("save", &save);
  type.def("cut", &cut);
  type.def("verify", &verify);
  module.def("read_result", &read);
  // With the process its memory goes at once: to free ten million boxes one by one takes seconds.
  module.def("keep_to_the_end", [](const py::object& result) { result.inc_ref(); });
  module.attr("verdicts") = py::tuple(py::cast(result::words_of<Verdict>(kVerdicts)));
  module.attr("reasons") = py::tuple(py::cast(result::words_of<Reason>(kReasons)));
  module.attr("types") = py::tuple(py::cast(result::type_names(kAllTypes)));
  module.attr("passages") = py::tuple(py::cast(result::words_of<Passage>(kPassages)));
}

}  // namespace corank::python
