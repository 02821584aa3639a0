// Any bytes may come as a model: parse_model either returns a mechanism or throws ModelError. What it returns prints and
// parses back to the same expressions.
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "corank/symbolic/model/model_file.h"

namespace {

using corank::symbolic::Constant;
using corank::symbolic::Constraint;
using corank::symbolic::Coordinate;
using corank::symbolic::Expression;
using corank::symbolic::Mechanism;

void require(bool condition, const char* what) {
  if (!condition) throw std::logic_error(what);
}

void round_trip(const Expression& e) {
  const std::string text = e.text();
  require(same_tree(corank::symbolic::parse_expression(text), e), "a printed expression parses to another tree");
  require(!e.latex().empty(), "an expression without LaTeX");
}

void check(const Mechanism& mechanism) {
  for (const Constant& c : mechanism.constants()) round_trip(c.value);
  for (const Coordinate& c : mechanism.coordinates()) {
    round_trip(c.lower);
    round_trip(c.upper);
  }
  for (const Constraint& c : mechanism.constraints()) {
    round_trip(c.relation.lhs);
    round_trip(c.relation.rhs);
  }
  for (const corank::symbolic::DrawingPoint& p : mechanism.drawing().points) {
    for (const Expression& e : p.coordinates) round_trip(e);
  }
  for (const corank::symbolic::DrawingPart& p : mechanism.drawing().parts) {
    if (p.has_radius()) round_trip(p.radius);
  }
  mechanism.validate();
}

void check_message(const corank::symbolic::ModelError& error) {
  const std::string_view message = error.what();
  require(message.starts_with("fuzzed.cuik:"), "an error without its place");
  require(message.find('\n') == std::string_view::npos, "a message of more than one line");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  Mechanism mechanism;
  try {
    mechanism = corank::symbolic::parse_model(text, "fuzzed.cuik");
  } catch (const corank::symbolic::ModelError& error) {
    check_message(error);
    return 0;
  }
  check(mechanism);
  return 0;
}
