#include "corank/symbolic/determinant_factors.h"

#include <algorithm>
#include <map>

#include "corank/symbolic/ginac_bridge.h"
#include "corank/symbolic/ginac_lock.h"

namespace corank::symbolic {
namespace {

constexpr std::size_t kLargest = 12;

// Sines and cosines as symbols, and back.
class Atoms {
 public:
  GiNaC::ex hide(const GiNaC::ex& e) {
    if (GiNaC::is_a<GiNaC::function>(e)) {
      const auto [place, fresh] = symbol_of_.try_emplace(e);
      if (fresh) {
        place->second = GiNaC::realsymbol("f" + std::to_string(symbol_of_.size()));
        function_of_[place->second] = e;
      }
      return place->second;
    }
    Hide map(*this);
    return e.map(map);
  }
  GiNaC::ex show(const GiNaC::ex& e) const { return e.subs(function_of_); }

 private:
  struct Hide : GiNaC::map_function {
    explicit Hide(Atoms& owner) : atoms(owner) {}
    GiNaC::ex operator()(const GiNaC::ex& e) override { return atoms.hide(e); }
    Atoms& atoms;
  };
  std::map<GiNaC::ex, GiNaC::ex, GiNaC::ex_is_less> symbol_of_;
  GiNaC::exmap function_of_;
};

}  // namespace

std::vector<Expression> determinant_factors(const Mechanism& mechanism, const ExpressionMatrix& matrix) {
  const std::size_t n = matrix.rows.size();
  const SourceLocation where{mechanism.name(), 0, 0};
  if (n != matrix.columns.size())
    throw ModelError(
        where, "a matrix with " + std::to_string(n) + " rows and " + std::to_string(matrix.columns.size()) + " columns",
        "a square one");
  if (n > kLargest)
    throw ModelError(where, "a determinant of " + std::to_string(n) + " rows", "at most " + std::to_string(kLargest));
  const GinacLock lock;
  const GinacBridge bridge(mechanism);
  Atoms atoms;
  GiNaC::matrix m(static_cast<unsigned>(n), static_cast<unsigned>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      m(static_cast<unsigned>(i), static_cast<unsigned>(j)) = atoms.hide(bridge.to_ginac(matrix.rows[i][j], where));
  const GiNaC::ex determinant = GiNaC::factor(m.determinant().expand());
  if (determinant.is_zero())
    throw ModelError(where, "the determinant vanishes everywhere", "a mechanism with configurations that are not singular");
  GiNaC::exset factors;
  const auto add = [&](const GiNaC::ex& e) {
    const GiNaC::ex base = GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::posint) ? e.op(0) : e;
    const GiNaC::ex factor = atoms.show(base);
    if (bridge.mentions_coordinate(factor)) factors.insert(factor);
  };
  if (GiNaC::is_a<GiNaC::mul>(determinant)) {
    for (const GiNaC::ex& e : determinant) add(e);
  } else {
    add(determinant);
  }
  std::vector<Expression> result;
  // GiNaC's order and signs are its own: these are the text's.
  for (const GiNaC::ex& e : factors) {
    const Expression plus = bridge.to_expression(e), minus = bridge.to_expression(-e);
    result.push_back(
        std::make_pair(plus.text().size(), plus.text()) < std::make_pair(minus.text().size(), minus.text()) ? plus : minus);
  }
  std::sort(result.begin(), result.end(), [](const Expression& a, const Expression& b) { return a.text() < b.text(); });
  return result;
}

}  // namespace corank::symbolic
