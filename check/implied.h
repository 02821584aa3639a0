// What the equations imply about single variables: bounds that hold at all of their real solutions, in rational arithmetic.
#pragma once

#include <map>
#include <vector>

#include "corank/check/terms.h"

namespace corank::check {

/// Lemma (squares): Σ aᵢxᵢ² = b with every aᵢ > 0 implies a_y y² ≤ b.
/// Lemma (products; Cauchy–Schwarz): a y = Σ bₖ uₖ vₖ + b₀ with distinct uₖ, Σ eᵢuᵢ² ≤ U, and distinct vₖ, Σ fᵢvᵢ² ≤ V,
/// implies (|a y| − |b₀|)² ≤ max bₖ² · U V/(min e · min f) where |a y| ≥ |b₀|.
/// Lemma (sums): a y = Σ bᵢ tᵢ + b₀, each tᵢ a sine, a cosine or a variable with a bound known for the side in question,
/// implies the bound of the right side. For bounds of variables the ends of their domains are taken, where these are implied
/// in turn, or at or beyond ±1 for a variable that is known to be in [-1, 1] (Variable::within_one). The equations are
/// those given, and f − q·g for two that are linear where that has fewer terms than one of them.
class Implied {
 public:
  Implied() = default;
  Implied(const System& system, const std::vector<Terms>& equations);

  /// Is y ≤ end (sign 1), y ≥ end (sign −1) implied? No says nothing.
  bool holds(int y, const ExactNumber& end, int sign) const;

 private:
  struct Squares {  // Σ of[i] xᵢ² ≤ bound
    std::map<int, ExactNumber> of;
    ExactNumber bound;
  };
  struct Domain {
    ExactNumber end[2];  // lower, upper
    bool rational[2] = {}, implied[2] = {};
  };

  void add_shorter_sums();
  void index(std::size_t variables);
  void spread();
  bool by_squares(int y, const ExactNumber& h) const;
  bool by_products(const Terms& f, int y, const ExactNumber& h) const;
  bool by_sum(const Terms& f, int y, const ExactNumber& end, int sign) const;
  std::optional<ExactNumber> extreme(const Factors& factors, const ExactNumber& c, int sign) const;
  static std::optional<ExactNumber> product_bound(const std::vector<std::pair<int, int>>& products, const Squares& u,
                                                  const Squares& v);

  std::vector<Terms> equations_;  // with rational, exact coefficients
  std::vector<Squares> squares_;
  std::vector<std::vector<std::size_t>> equations_of_, squares_of_;  // in which a variable stands
  std::vector<Domain> domains_;
};

}  // namespace corank::check
