// Mechanisms and questions about them.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "corank/python/bindings.h"
#include "corank/report/pictures/figures.h"
#include "corank/report/pictures/set_look.h"
#include "corank/study/model.h"
#include "corank/study/question.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/symbolic/sets/cusps_and_nodes.h"
#include "corank/symbolic/writing/printer.h"

namespace corank::python {
namespace {

using symbolic::Expression;
using symbolic::Mechanism;
using symbolic::ModelError;

// With what it takes to make it anew with other constants, or in another process.
struct Origin {
  study::ModelText model;
  std::optional<study::ModelText> loops;  // of a URDF file: its companion
};
struct Model {
  std::optional<Origin> origin;  // nothing: built, or changed, by the functions of Mechanism
  study::Model value;
  std::vector<result::ConstantOverride> constants;  // that were put in
  std::vector<std::string> requirements{};          // likewise, beside the model's own

  const symbolic::Mechanism& mechanism() const { return value.mechanism; }
  symbolic::Mechanism& changed() {
    if (value.assembly)
      throw ModelError({mechanism().name(), 0, 0}, "its equations come from its links and joints",
                       "a change of these, in their text");
    origin.reset();
    return value.mechanism;
  }
};

Model make_model(Origin origin, std::vector<result::ConstantOverride> constants) {
  study::Model value = study::parse_model(origin.model, constants, origin.loops);
  return {std::move(origin), std::move(value), std::move(constants)};
}

Model with_requirements(Model model, const std::vector<std::string>& texts) {
  study::require(texts, model.value);
  model.requirements.insert(model.requirements.end(), texts.begin(), texts.end());
  return model;
}

using Text = std::tuple<std::string, std::string, std::string>;  // its text, file, folder
using Constants = std::vector<std::pair<std::string, std::string>>;

study::ModelText text_of(const Text& text) {
  study::ModelText result{std::get<0>(text), std::get<1>(text)};
  if (!std::get<2>(text).empty()) result.folder = std::get<2>(text);
  return result;
}

Text tuple_of(const study::ModelText& text) { return {text.text, text.file, text.folder.value_or("").string()}; }

std::vector<result::ConstantOverride> overrides(const Constants& constants) {
  std::vector<result::ConstantOverride> list;
  for (const auto& [name, value] : constants) list.push_back({name, value});
  return list;
}

Constants pairs(const std::vector<result::ConstantOverride>& overrides) {
  Constants list;
  for (const auto& o : overrides) list.emplace_back(o.name, o.expression);
  return list;
}

Model load(const std::filesystem::path& path, const std::optional<std::filesystem::path>& loops,
           const Constants& constants) {
  Origin origin{study::read_text(path), {}};
  if (loops) origin.loops = study::read_text(*loops);
  return make_model(std::move(origin), overrides(constants));
}

Model parse(const Text& model, const std::optional<Text>& loops, const Constants& constants) {
  Origin origin{text_of(model), {}};
  if (loops) origin.loops = text_of(*loops);
  return make_model(std::move(origin), overrides(constants));
}

// The later one of two values for a constant counts.
Model with_constants(const Model& model, const Constants& constants) {
  std::vector<result::ConstantOverride> all = model.constants;
  for (const result::ConstantOverride& o : overrides(constants)) {
    std::erase_if(all, [&](const auto& former) { return former.name == o.name; });
    all.push_back(o);
  }
  if (model.origin) return with_requirements(make_model(*model.origin, all), model.requirements);
  Model other = model;
  other.constants = std::move(all);
  result::put_in(other.constants, other.value.mechanism);
  return other;
}

py::tuple state(const Model& model) {
  Origin origin = model.origin.value_or(Origin{{}, {}});
  if (!model.origin) origin.model = {symbolic::to_model(model.mechanism()), model.mechanism().name() + ".cuik"};
  std::optional<Text> loops;
  if (origin.loops) loops = tuple_of(*origin.loops);
  // A text that was written anew has them.
  return py::make_tuple(tuple_of(origin.model), loops, pairs(model.constants),
                        model.origin ? model.requirements : std::vector<std::string>());
}

const char* word(symbolic::CoordinateKind kind) { return kind == symbolic::CoordinateKind::angle ? "angle" : "length"; }

py::list coordinates(const Model& model) {
  py::list list;
  for (const symbolic::Coordinate& c : model.mechanism().coordinates())
    list.append(py::make_tuple(c.name, word(c.kind), c.has_range ? py::cast(c.lower) : py::none(),
                               c.has_range ? py::cast(c.upper) : py::none()));
  return list;
}

std::vector<std::string> texts(const std::vector<symbolic::Constraint>& constraints) {
  std::vector<std::string> list;
  for (const symbolic::Constraint& c : constraints) list.push_back(c.relation.text());
  return list;
}

// Near the constants' values.
py::dict constant_values(const Model& model) {
  std::map<std::string, double> values;
  py::dict known;
  for (const symbolic::Constant& c : model.mechanism().constants())
    known[py::str(c.name)] = values[c.name] = symbolic::evaluate(c.value, values);
  return known;
}

const char* sign_in_latex(symbolic::Relation::Kind kind) {
  return kind == symbolic::Relation::Kind::equal        ? " = "
         : kind == symbolic::Relation::Kind::less_equal ? " \\le "
                                                        : " \\ge ";
}

std::vector<std::string> equations_in_latex(const Model& model) {
  std::vector<std::string> list;
  for (const symbolic::Constraint& c : model.mechanism().constraints())
    list.push_back(c.relation.lhs.latex() + sign_in_latex(c.relation.kind) + c.relation.rhs.latex());
  return list;
}

void bind_building(py::class_<Model>& type) {
  type.def("constant",
           [](Model& m, const std::string& name, const Expression& value) { return m.changed().constant(name, value); });
  type.def("length", [](Model& m, const std::string& name, const std::optional<Expression>& lower,
                        const std::optional<Expression>& upper) {
    if (lower.has_value() != upper.has_value()) throw py::type_error("a length has both ends of its range, or none");
    return lower ? m.changed().length(name, *lower, *upper) : m.changed().length_without_range(name);
  });
  type.def("angle", [](Model& m, const std::string& name, const Expression& lower, const Expression& upper) {
    return m.changed().angle(name, lower, upper);
  });
  type.def("unit_vector", [](Model& m, const std::string& name) { return m.changed().unit_vector(name); });
  type.def("rotation", [](Model& m, const std::string& name) { return m.changed().rotation(name); });
  type.def("constrain", [](Model& m, const symbolic::Relation& r) { m.changed().constrain(r); });
  type.def("imply", [](Model& m, const symbolic::Relation& r) { m.changed().imply(r); });
  type.def("velocity", [](Model& m, const symbolic::Relation& r) { m.changed().velocity(r); });
  type.def("add_inputs", [](Model& m, const std::vector<Expression>& symbols) { m.changed().inputs(symbols); });
  type.def("add_outputs", [](Model& m, const std::vector<Expression>& symbols) { m.changed().outputs(symbols); });
  type.def("limit", [](Model& m, const std::string& name, const Expression& lower, const Expression& upper) {
    m.changed().limit(name, lower, upper);
  });
  type.def("rate", [](Model& m, const std::string& name, bool angle, const std::string& role) {
    for (const symbolic::Role r : {symbolic::Role::input, symbolic::Role::output, symbolic::Role::passive})
      if (role == to_string(r))
        return m.changed().rate(name, angle ? symbolic::CoordinateKind::angle : symbolic::CoordinateKind::length, r);
    throw py::value_error("the role of a rate is input, output or passive");
  });
}

// A question about the model, validated, whose text is the one that results keep. `set`: a name of a set, "nodes", or
// nothing for a plain system. Throws std::invalid_argument where the model has no such set.
study::Question question_of(const Model& model, const std::optional<std::string>& set,
                            const std::optional<std::string>& kernel, int corank, const std::vector<std::string>& outputs,
                            const std::optional<double>& tolerance) {
  study::Question q{.model = model.mechanism(),
                    .corank = corank,
                    .constants = model.constants,
                    .outputs = outputs,
                    .tolerance = tolerance};
  q.assembly = model.value.assembly;
  q.model.validate();
  if (!model.origin) q.model.set_source_text(symbolic::to_model(q.model));
  result::put_in(outputs, q.model);
  if (kernel == "none") {
    q.in_parts = true;
  } else if (kernel) {
    q.kernel = symbolic::kernel_side_from_string(*kernel);
    if (!q.kernel) throw std::invalid_argument("the kernel's side is right, left or none, not '" + *kernel + "'");
  }
  if (q.model.is_plain_system()) {
    if (set)
      throw std::invalid_argument(q.model.name() + " has no inputs and outputs: a plain system has no sets to choose");
    if (corank != 1)
      throw std::invalid_argument(q.model.name() + " has no inputs and outputs: a plain system has no corank");
    return q;
  }
  if (!set) throw std::invalid_argument(q.model.name() + " is a mechanism: its set is " + symbolic::names_of_sets());
  q.set = *set == "nodes" ? symbolic::nodes_of(q.model) : symbolic::singularity_set_from_string(*set);
  if (!q.set) throw std::invalid_argument("there is no set '" + *set + "'; expected " + symbolic::names_of_sets());
  const bool of_parts = symbolic::definition(q.set).of_parts;
  if (of_parts && (corank != 1 || kernel)) throw std::invalid_argument("the set " + *set + " takes no corank and no kernel");
  if (!of_parts && !outputs.empty()) throw std::invalid_argument("outputs are chosen for the set boundary only");
  return q;
}

}  // namespace

void bind_model(py::module_& module) {
  py::class_<Model> type(module, "Model");
  type.def(py::init([](const std::string& name) { return Model{{}, {Mechanism(name), {}, {}}, {}}; }), py::arg("name"));
  bind_building(type);
  type.def_property_readonly("name", [](const Model& m) { return m.mechanism().name(); });
  type.def_property_readonly("inputs", [](const Model& m) { return m.mechanism().inputs(); });
  type.def_property_readonly("outputs", [](const Model& m) { return m.mechanism().outputs(); });
  type.def_property_readonly("coordinates", &coordinates);
  type.def_property_readonly("constants", [](const Model& m) {
    py::dict values;
    for (const symbolic::Constant& c : m.mechanism().constants()) values[py::str(c.name)] = c.value;
    return values;
  });
  type.def_property_readonly("constant_values", &constant_values);
  type.def_property_readonly("constraints", [](const Model& m) { return texts(m.mechanism().constraints()); });
  type.def_property_readonly("equations_in_latex", &equations_in_latex);
  type.def_property_readonly("notices", [](const Model& m) { return m.value.notices; });
  type.def_property_readonly("robot", [](const Model& m) -> std::optional<std::string> {
    if (!m.value.assembly) return std::nullopt;
    return study::describe(*m.value.assembly);
  });
  type.def_property_readonly("plain", [](const Model& m) { return m.mechanism().is_plain_system(); });
  type.def("portrait_axes", [](const Model& m) { return report::portrait_axes(m.mechanism(), m.mechanism().outputs()); });
  type.def("validate", [](const Model& m) { m.mechanism().validate(); });
  type.def("text", [](const Model& m) { return symbolic::to_model(m.mechanism()); });
  type.def("with_constants", &with_constants);
  type.def("with_requirements", &with_requirements);
  type.def_property_readonly("requirements", [](const Model& m) { return m.mechanism().requirement_texts(); });
  type.def("copy", [](const Model& m) { return m; });
  type.def(py::pickle(&state, [](const py::tuple& s) {
    return with_requirements(parse(s[0].cast<Text>(), s[1].cast<std::optional<Text>>(), s[2].cast<Constants>()),
                             s[3].cast<std::vector<std::string>>());
  }));
  py::class_<study::Question>(module, "Question")
      .def(py::init(&question_of), py::arg("model"), py::arg("set") = py::none(), py::arg("kernel") = py::none(),
           py::arg("corank") = 1, py::arg("outputs") = std::vector<std::string>(), py::arg("tolerance") = py::none());
  module.def("load", &load, py::arg("path"), py::arg("loops"), py::arg("constants"));
  module.def("parse", &parse, py::arg("model"), py::arg("loops"), py::arg("constants"));
  py::list sets;
  for (const symbolic::SetDefinition& set : symbolic::set_definitions())
    sets.append(py::make_tuple(set.name, report::look(set).title, report::look(set).meaning, set.is_usual(),
                               set.has_kernel(), set.of_parts));
  module.attr("sets") = sets;
}

}  // namespace corank::python
