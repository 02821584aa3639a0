// Expressions and relations of the model language, with Python's operators.
#include <pybind11/operators.h>
#include <pybind11/stl.h>

#include "corank/python/bindings.h"
#include "corank/symbolic/model/expression.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::python {
namespace {

using symbolic::Expression;
using symbolic::Relation;

// What Python calls a number, a text, a fraction or an expression of SymPy: corank/expression.py knows how.
Expression from_python(const py::object& value) {
  return py::module_::import("corank.expression").attr("as_expression")(value).cast<Expression>();
}

Expression from_fraction(const std::string& numerator, const std::string& denominator) {
  const Expression n = symbolic::parse_anonymous_expression(numerator);
  return denominator == "1" ? n : n / symbolic::parse_anonymous_expression(denominator);
}

template <class Make>
auto binary(Make make) {
  return [make](const Expression& a, const Expression& b) { return make(a, b); };
}

template <class Make>
auto reflected(Make make) {
  return [make](const Expression& a, const Expression& b) { return make(b, a); };
}

template <class Make>
void bind_operator(py::class_<Expression>& type, const std::string& name, Make make) {
  type.def(("__" + name + "__").c_str(), binary(make), py::is_operator());
  type.def(("__r" + name + "__").c_str(), reflected(make), py::is_operator());
}

}  // namespace

void bind_expression(py::module_& module) {
  py::class_<Relation> relation(module, "Relation", "An equation or an inequality; made by ==, <= and >=.");
  py::class_<Expression> type(module, "Expression", "An exact expression of the model language.");
  type.def(py::init(&from_python), py::arg("value"));
  py::implicitly_convertible<py::object, Expression>();
  type.attr("__array_ufunc__") = py::none();  // 2.0 * x is an expression, whatever NumPy makes of 2.0
  bind_operator(type, "add", [](const Expression& a, const Expression& b) { return a + b; });
  bind_operator(type, "sub", [](const Expression& a, const Expression& b) { return a - b; });
  bind_operator(type, "mul", [](const Expression& a, const Expression& b) { return a * b; });
  bind_operator(type, "truediv", [](const Expression& a, const Expression& b) { return a / b; });
  bind_operator(type, "pow", [](const Expression& a, const Expression& b) { return pow(a, b); });
  type.def("__neg__", [](const Expression& a) { return -a; });
  type.def("__pos__", [](const Expression& a) { return a; });
  type.def(
      "__eq__", [](const Expression& a, const Expression& b) { return a == b; }, py::is_operator());
  type.def(
      "__le__", [](const Expression& a, const Expression& b) { return a <= b; }, py::is_operator());
  type.def(
      "__ge__", [](const Expression& a, const Expression& b) { return a >= b; }, py::is_operator());
  type.def("__hash__", [](const Expression& a) { return py::hash(py::str(a.text())); });
  type.def("__str__", &Expression::text);
  type.def("__repr__",
           [](const Expression& a) { return "Expression(" + py::repr(py::str(a.text())).cast<std::string>() + ")"; });
  type.def(
      "same_as", [](const Expression& a, const Expression& b) { return same_tree(a, b); },
      "Is it the same expression, as written? (== makes an equation.)");
  type.def("mentions", &Expression::mentions, py::arg("name"), "Does the name occur?");
  type.def_property_readonly("latex", &Expression::latex, "The expression in LaTeX.");
  type.def("_repr_latex_", [](const Expression& a) { return "$\\displaystyle " + a.latex() + "$"; });
  type.def(py::pickle([](const Expression& a) { return a.text(); },
                      [](const std::string& text) { return symbolic::parse_anonymous_expression(text); }));
  relation.def(py::init([](const Expression& left, const std::string& sign, const Expression& right) {
                 const auto kind = sign == "="    ? Relation::Kind::equal
                                   : sign == "<=" ? Relation::Kind::less_equal
                                   : sign == ">=" ? Relation::Kind::greater_equal
                                                  : throw py::value_error("the sign of a relation is =, <= or >=");
                 return Relation{left, kind, right};
               }),
               py::arg("left"), py::arg("sign"), py::arg("right"));
  relation.def_readonly("left", &Relation::lhs).def_readonly("right", &Relation::rhs);
  relation.def("__str__", &Relation::text);
  relation.def("__repr__",
               [](const Relation& r) { return "Relation(" + py::repr(py::str(r.text())).cast<std::string>() + ")"; });
  relation.def("__bool__", [](const Relation& r) -> bool {
    throw py::type_error("'" + r.text() + "' is a relation, neither true nor false; same_as() compares expressions");
  });

  module.def(
      "parse_expression", [](const std::string& text) { return symbolic::parse_anonymous_expression(text); },
      py::arg("text"));
  module.def(
      "symbol", [](const std::string& name) { return Expression::symbol(name); }, py::arg("name"));
  module.def("fraction", &from_fraction, py::arg("numerator"), py::arg("denominator"));
  module.def(
      "function", [](const std::string& name, const Expression& x) { return Expression::function(name, x); },
      py::arg("name"), py::arg("argument"));
}

}  // namespace corank::python
