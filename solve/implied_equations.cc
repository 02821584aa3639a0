#include "corank/solve/implied_equations.h"

#include <flint/fmpq.h>
#include <flint/fmpq_mat.h>
#include <flint/fmpz.h>
#include <flint/nmod_mat.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "corank/certify/implied_equation.h"
#include "corank/certify/polynomial_algebra.h"
#include "corank/core/rounding.h"

namespace corank::solve {
namespace {

constexpr mp_limb_t kPrime = 2305843009213693951;  // 2^61 − 1
constexpr int kRounds = 4;
constexpr std::size_t kMostRows = 1200;         // of an elimination
constexpr std::size_t kMostMultiples = 20'000;  // before those are dropped that serve nothing
constexpr std::size_t kMostTerms = 9;           // of an equation that is kept, but for its constant
constexpr std::size_t kMostFound = 100;
constexpr double kLargestInteger = 2;  // of the coefficients of equations that are multiplied

using Product = std::vector<std::pair<int, int>>;  // variable, power; ascending
using Row = std::map<Product, mp_limb_t>;

nmod_t field() {
  nmod_t mod;
  nmod_init(&mod, kPrime);
  return mod;
}

std::optional<mp_limb_t> modulo_prime(const ExactNumber& x) {
  if (!x.is_rational()) return std::nullopt;
  fmpq_t q;
  fmpq_init(q);
  std::optional<mp_limb_t> result;
  if (fmpq_set_str(q, x.text().c_str(), 10) == 0) {
    const mp_limb_t numerator = fmpz_fdiv_ui(fmpq_numref(q), kPrime), denominator = fmpz_fdiv_ui(fmpq_denref(q), kPrime);
    if (denominator != 0) result = nmod_div(numerator, denominator, field());
  }
  fmpq_clear(q);
  return result;
}

// The fraction of small numerator and denominator that x stands for.
std::optional<ExactNumber> fraction_of(mp_limb_t x) {
  fmpq_t q;
  fmpz_t a, p;
  fmpq_init(q);
  fmpz_init_set_ui(a, x);
  fmpz_init_set_ui(p, kPrime);
  std::optional<ExactNumber> result;
  if (fmpq_reconstruct_fmpz(q, a, p)) {
    const std::unique_ptr<char, void (*)(void*)> text(fmpq_get_str(nullptr, 10, q), flint_free);
    result = ExactNumber::rational(text.get());
  }
  fmpz_clear(p);
  fmpz_clear(a);
  fmpq_clear(q);
  return result;
}

class Matrix {
 public:
  Matrix(std::size_t rows, std::size_t columns) {
    nmod_mat_init(m_, static_cast<slong>(rows), static_cast<slong>(columns), kPrime);
  }
  ~Matrix() { nmod_mat_clear(m_); }
  Matrix(const Matrix&) = delete;
  Matrix& operator=(const Matrix&) = delete;
  mp_limb_t& at(std::size_t i, std::size_t j) { return nmod_mat_entry(m_, i, j); }
  void reduce() { nmod_mat_rref(m_); }

 private:
  nmod_mat_t m_;
};

int degree(const Product& p) {
  int sum = 0;
  for (const auto& [variable, power] : p) sum += power;
  return sum;
}

Product times(Product p, const Product& q) {
  std::map<int, int> powers(p.begin(), p.end());
  for (const auto& [variable, power] : q) powers[variable] += power;
  return {powers.begin(), powers.end()};
}

Product product_of(const Monomial& m) {
  Product p;
  for (const Factor& x : m.factors) p.emplace_back(x.variable, x.power);
  return p;
}

// Nothing where a coefficient is not rational, or there is a sine or cosine.
std::optional<Row> row_of(const Polynomial& f) {
  Row row;
  for (const Monomial& m : f.monomials) {
    const auto c = modulo_prime(m.coefficient);
    if (!c || m.is_trigonometric()) return std::nullopt;
    row[product_of(m)] = *c;
  }
  return row;
}

// A row of the elimination: equation `equation` times a product.
struct Multiple {
  int equation;
  Product product;
  Row row;
};

Multiple multiple_of(int equation, const Row& row, const Product& product) {
  Multiple m{equation, product, {}};
  for (const auto& [p, c] : row) m.row[times(p, product)] = c;
  return m;
}

ImpliedEquation::Part part_of(const Multiple& multiple, const ExactNumber& factor) {
  ImpliedEquation::Part part{multiple.equation, factor, {}};
  for (const auto& [variable, power] : multiple.product) part.product.push_back({variable, power});
  return part;
}

// Drops the multiples that have a product of at least that degree which neither another nor the target has: nothing cancels
// it.
void drop_lone(std::vector<Multiple>& multiples, int of_degree, const Row& target = {}) {
  for (std::size_t before = 0; before != multiples.size();) {
    before = multiples.size();
    std::map<Product, int> uses;
    for (const Multiple& m : multiples)
      for (const auto& [p, c] : m.row)
        if (degree(p) >= of_degree) ++uses[p];
    for (const auto& [p, c] : target) ++uses[p];
    std::erase_if(multiples, [&](const Multiple& m) {
      return std::any_of(m.row.begin(), m.row.end(),
                         [&](const auto& t) { return degree(t.first) >= of_degree && uses[t.first] == 1; });
    });
  }
}

// A sum of multiples without products of degree three, as values of its terms and of the multiples' factors.
struct Sum {
  std::vector<mp_limb_t> terms, factors;
};

std::size_t weight(const std::vector<mp_limb_t>& terms) {  // the constant is the last
  return static_cast<std::size_t>(std::count_if(terms.begin(), terms.end() - 1, [](mp_limb_t c) { return c != 0; }));
}

// s − q·t.
std::vector<mp_limb_t> difference(const std::vector<mp_limb_t>& s, mp_limb_t q, const std::vector<mp_limb_t>& t) {
  const nmod_t mod = field();
  std::vector<mp_limb_t> result(s.size());
  for (std::size_t j = 0; j < s.size(); ++j) result[j] = nmod_sub(s[j], nmod_mul(q, t[j], mod), mod);
  return result;
}

void make_first_one(Sum& s) {
  const auto first = std::find_if(s.terms.begin(), s.terms.end(), [](mp_limb_t c) { return c != 0; });
  if (first == s.terms.end()) return;
  const nmod_t mod = field();
  const mp_limb_t inverse = nmod_inv(*first, mod);
  for (auto* list : {&s.terms, &s.factors})
    for (mp_limb_t& c : *list) c = nmod_mul(c, inverse, mod);
}

// Adds multiples of others as long as that leaves fewer terms.
void shorten(Sum& s, const std::vector<Sum>& others) {
  for (bool gained = true; gained;) {
    gained = false;
    for (const Sum& other : others)
      for (std::size_t k = 0; k + 1 < s.terms.size() && !gained; ++k) {
        if (s.terms[k] == 0 || other.terms[k] == 0) continue;
        const mp_limb_t q = nmod_div(s.terms[k], other.terms[k], field());
        std::vector<mp_limb_t> terms = difference(s.terms, q, other.terms);
        const std::size_t w = weight(terms);
        if (w == 0 || w >= weight(s.terms)) continue;
        s = {std::move(terms), difference(s.factors, q, other.factors)};
        gained = true;
      }
  }
}

class Finder {
 public:
  Finder(const System& system, const Ended& ended) : ended_(ended), given_(static_cast<int>(system.equations.size())) {
    for (std::size_t i = 0; i < system.equations.size(); ++i) {
      const Polynomial& f = system.equations[i];
      if (f.degree() != 2 || !std::all_of(f.monomials.begin(), f.monomials.end(), is_small)) continue;
      if (auto row = row_of(f)) add(static_cast<int>(i), std::move(*row));
    }
  }

  std::vector<ImpliedEquation> run() {
    for (int round = 0; round < kRounds && step() && found_.size() < kMostFound; ++round) {
    }
    return is_over(ended_) ? std::vector<ImpliedEquation>() : std::move(found_);
  }

 private:
  static bool is_small(const Monomial& m) {
    return m.coefficient.is_rational() && m.enclosure.is_point() && m.enclosure.mag() <= kLargestInteger &&
           std::nearbyint(m.enclosure.lo()) == m.enclosure.lo();
  }

  // False: it is there already.
  bool add(int equation, Row row) {
    Sum normal;
    for (const auto& [p, c] : row) normal.terms.push_back(c);
    make_first_one(normal);
    Row key;
    std::size_t k = 0;
    for (const auto& [p, c] : row) key[p] = normal.terms[k++];
    if (!known_.insert(std::move(key)).second) return false;
    for (const auto& [p, c] : row)
      if (degree(p) == 2)
        for (const auto& [variable, power] : p) variables_.insert(variable);
    equations_.push_back({equation, std::move(row)});
    return true;
  }

  struct Neighbours {
    std::map<Product, int> equations;     // how many have a product of degree two
    std::map<int, std::set<int>> beside;  // of each variable: those that stand in such products with it
  };
  Neighbours find_neighbours() const {
    Neighbours found;
    for (const auto& [equation, row] : equations_)
      for (const auto& [p, c] : row) {
        if (degree(p) != 2) continue;
        ++found.equations[p];
        const int a = p.front().first, b = p.back().first;
        found.beside[a].insert(b);
        found.beside[b].insert(a);
      }
    return found;
  }

  // All variables but such as leave a multiple that drop_lone() drops: where no other equation has its product ab, another
  // multiple has abv only if some equation has av or bv.
  const std::set<int>& multipliers(const Row& row, const Neighbours& neighbours) {
    for (const auto& [p, c] : row) {
      if (degree(p) != 2 || neighbours.equations.at(p) > 1) continue;
      few_.clear();
      for (const auto& [v, power] : p) few_.insert(neighbours.beside.at(v).begin(), neighbours.beside.at(v).end());
      return few_;
    }
    return variables_;
  }

  // False: nothing new.
  bool step() {
    std::vector<Multiple> multiples;
    const Neighbours neighbours = find_neighbours();
    for (const auto& [equation, row] : equations_) {
      if (is_over(ended_)) return false;
      for (const int v : multipliers(row, neighbours)) multiples.push_back(multiple_of(equation, row, {{v, 1}}));
    }
    drop_lone(multiples, 3);
    if (multiples.empty()) return false;
    for (const auto& [equation, row] : equations_) multiples.push_back(multiple_of(equation, row, {}));
    if (multiples.size() > kMostRows || is_over(ended_)) return false;

    std::map<Product, std::size_t> column;
    std::vector<Product> products, low;
    for (const Multiple& m : multiples)
      for (const auto& [p, c] : m.row)
        if (column.try_emplace(p, 0).second) (degree(p) == 3 ? products : low).push_back(p);
    std::erase(low, Product{});
    low.push_back({});  // the constant
    const std::size_t cubic = products.size(), width = cubic + low.size();
    products.insert(products.end(), low.begin(), low.end());
    for (std::size_t k = 0; k < width; ++k) column[products[k]] = k;
    Matrix matrix(multiples.size(), width + multiples.size());
    for (std::size_t i = 0; i < multiples.size(); ++i) {
      for (const auto& [p, c] : multiples[i].row) matrix.at(i, column[p]) = c;
      matrix.at(i, width + i) = 1;
    }
    matrix.reduce();
    std::vector<Sum> sums;
    for (std::size_t i = 0; i < multiples.size(); ++i) {
      std::size_t pivot = 0;
      while (pivot < width && matrix.at(i, pivot) == 0) ++pivot;
      if (pivot < cubic || pivot == width) continue;
      Sum s;
      for (std::size_t k = cubic; k < width; ++k) s.terms.push_back(matrix.at(i, k));
      for (std::size_t k = 0; k < multiples.size(); ++k) s.factors.push_back(matrix.at(i, width + k));
      sums.push_back(std::move(s));
    }
    std::vector<Sum> reversed = short_ones(in_reverse_order(sums));
    sums = short_ones(std::move(sums));
    sums.insert(sums.end(), reversed.begin(), reversed.end());
    return keep(sums, multiples, low);
  }

  // Another basis of the same sums: the last products are eliminated first.
  static std::vector<Sum> in_reverse_order(const std::vector<Sum>& sums) {
    if (sums.empty()) return {};
    const std::size_t width = sums[0].terms.size(), factors = sums[0].factors.size();
    Matrix matrix(sums.size(), width + factors);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      for (std::size_t k = 0; k < width; ++k) matrix.at(i, k) = sums[i].terms[(2 * width - 2 - k) % width];
      for (std::size_t k = 0; k < factors; ++k) matrix.at(i, width + k) = sums[i].factors[k];
    }
    matrix.reduce();
    std::vector<Sum> result;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      Sum s;
      for (std::size_t k = 0; k < width; ++k) s.terms.push_back(matrix.at(i, (2 * width - 2 - k) % width));
      for (std::size_t k = 0; k < factors; ++k) s.factors.push_back(matrix.at(i, width + k));
      result.push_back(std::move(s));
    }
    return result;
  }

  // Sums of few terms: those given, and of each two, made as short as they get.
  static std::vector<Sum> short_ones(std::vector<Sum> sums) {
    for (Sum& s : sums) {
      std::vector<Sum> others;
      for (const Sum& t : sums)
        if (&t != &s) others.push_back(t);
      shorten(s, others);
      make_first_one(s);
    }
    std::erase_if(sums, [](const Sum& s) { return weight(s.terms) == 0 || weight(s.terms) > kMostTerms; });
    std::set<std::vector<mp_limb_t>> seen;
    for (const Sum& s : sums) seen.insert(s.terms);
    const std::size_t basis = sums.size();
    for (std::size_t i = 0; i < basis; ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (std::size_t k = 0; k + 1 < sums[i].terms.size(); ++k) {
          if (sums[i].terms[k] == 0 || sums[j].terms[k] == 0) continue;
          const mp_limb_t q = nmod_div(sums[i].terms[k], sums[j].terms[k], field());
          Sum s{difference(sums[i].terms, q, sums[j].terms), difference(sums[i].factors, q, sums[j].factors)};
          shorten(s, sums);
          if (weight(s.terms) == 0 || weight(s.terms) > std::min(weight(sums[i].terms), weight(sums[j].terms))) continue;
          make_first_one(s);
          if (seen.insert(s.terms).second) sums.push_back(std::move(s));
        }
    return sums;
  }

  bool keep(const std::vector<Sum>& sums, const std::vector<Multiple>& multiples, const std::vector<Product>& low) {
    const std::size_t before = found_.size();
    for (const Sum& s : sums) {
      Row row;
      for (std::size_t k = 0; k < low.size(); ++k)
        if (s.terms[k] != 0) row[low[k]] = s.terms[k];
      ImpliedEquation implied;
      bool usable = true, multiplied = false;
      for (std::size_t i = 0; i < multiples.size() && usable; ++i) {
        if (s.factors[i] == 0) continue;
        const auto factor = fraction_of(s.factors[i]);
        usable = factor.has_value();
        multiplied = multiplied || !multiples[i].product.empty();
        if (usable) implied.parts.push_back(part_of(multiples[i], *factor));
      }
      if (!usable || !multiplied || found_.size() >= kMostFound) continue;
      if (add(given_ + static_cast<int>(found_.size()), std::move(row))) found_.push_back(std::move(implied));
    }
    return found_.size() > before;
  }

  struct Equation {
    int index;
    Row row;
  };
  const Ended& ended_;
  const int given_;
  std::vector<Equation> equations_;
  std::set<Row> known_;  // each made 1 in its first term
  std::set<int> variables_, few_;
  std::vector<ImpliedEquation> found_;
};

// All products of at most that degree of the variables, 1 the first.
std::vector<Product> products_up_to(int most, const std::set<int>& variables) {
  std::vector<Product> all{{}};
  for (std::size_t begin = 0; most > 0; --most) {
    const std::size_t end = all.size();
    for (std::size_t k = begin; k < end; ++k)
      for (const int v : variables)
        if (all[k].empty() || v >= all[k].back().first) all.push_back(times(all[k], {{v, 1}}));
    begin = end;
    if (all.size() > kMostRows) break;
  }
  return all;
}

class Expression {
 public:
  // Of h and the equations all that is needed; nothing to be found where h is no polynomial in rational numbers.
  Expression(const Polynomial& h, const System& system, const Ended& ended) : h_(h), system_(system), ended_(ended) {
    const auto row = row_of(h);
    if (!row) return;
    target_ = *row;
    for (const auto* list : {&system.equations, &system.implied})
      for (const Polynomial& f : *list) {
        if (auto terms = row_of(f)) equations_.emplace_back(static_cast<int>(polynomials_.size()), std::move(*terms));
        polynomials_.push_back(&f);
      }
    note_variables(target_);
    for (const auto& [i, f] : equations_) note_variables(f);
  }

  std::optional<ImpliedEquation> find() const {
    for (int excess = 0; excess <= kMostExcess && !target_.empty(); ++excess) {
      if (is_over(ended_)) break;
      if (auto found = find(h_.degree() + excess)) return found;
    }
    return std::nullopt;
  }

 private:
  static constexpr int kMostExcess = 2;

  void note_variables(const Row& row) {
    for (const auto& [p, c] : row)
      for (const auto& [variable, power] : p) variables_.insert(variable);
  }

  std::optional<ImpliedEquation> find(int most) const {
    std::vector<Multiple> multiples;
    for (const auto& [i, f] : equations_) {
      const int own = polynomials_[static_cast<std::size_t>(i)]->degree();
      if (own > most) continue;
      for (const Product& p : products_up_to(most - own, variables_)) {
        multiples.push_back(multiple_of(i, f, p));
        if (multiples.size() > kMostMultiples) return std::nullopt;
      }
    }
    drop_lone(multiples, 0, target_);
    if (multiples.empty() || multiples.size() > kMostRows) return std::nullopt;
    return combination(multiples);
  }

  // Which multiples have a part in it, modulo the prime; their factors in rational numbers; and the sum itself, exactly.
  std::optional<ImpliedEquation> combination(const std::vector<Multiple>& multiples) const {
    std::map<Product, std::size_t> place;
    for (const Multiple& m : multiples)
      for (const auto& [p, c] : m.row) place.try_emplace(p, place.size());
    const std::size_t n = multiples.size();
    Matrix matrix(place.size(), n + 1);
    for (std::size_t k = 0; k < n; ++k)
      for (const auto& [p, c] : multiples[k].row) matrix.at(place[p], k) = c;
    for (const auto& [p, c] : target_) {
      if (!place.contains(p)) return std::nullopt;
      matrix.at(place[p], n) = c;
    }
    matrix.reduce();
    std::vector<const Multiple*> used;
    for (std::size_t i = 0; i < place.size(); ++i) {
      std::size_t pivot = 0;
      while (pivot <= n && matrix.at(i, pivot) == 0) ++pivot;
      if (pivot == n) return std::nullopt;  // h is no such sum
      if (pivot < n && matrix.at(i, n) != 0) used.push_back(&multiples[pivot]);
    }
    return rational_combination(used, place);
  }

  // The factors with which the multiples sum up to h.
  std::optional<ImpliedEquation> rational_combination(const std::vector<const Multiple*>& used,
                                                      const std::map<Product, std::size_t>& place) const {
    fmpq_mat_t a, b, x;
    const slong rows = static_cast<slong>(place.size()), columns = static_cast<slong>(used.size());
    fmpq_mat_init(a, rows, columns);
    fmpq_mat_init(b, rows, 1);
    fmpq_mat_init(x, columns, 1);
    for (std::size_t k = 0; k < used.size(); ++k)
      for (const Monomial& m : polynomials_[static_cast<std::size_t>(used[k]->equation)]->monomials)
        set(fmpq_mat_entry(a, static_cast<slong>(place.at(times(product_of(m), used[k]->product))), static_cast<slong>(k)),
            m.coefficient);
    for (const Monomial& m : h_.monomials)
      set(fmpq_mat_entry(b, static_cast<slong>(place.at(product_of(m))), 0), m.coefficient);
    std::optional<ImpliedEquation> result;
    if (fmpq_mat_can_solve(x, a, b)) {
      result.emplace();
      for (std::size_t k = 0; k < used.size(); ++k) {
        const std::unique_ptr<char, void (*)(void*)> text(
            fmpq_get_str(nullptr, 10, fmpq_mat_entry(x, static_cast<slong>(k), 0)), flint_free);
        result->parts.push_back(part_of(*used[k], ExactNumber::rational(text.get())));
      }
    }
    fmpq_mat_clear(x);
    fmpq_mat_clear(b);
    fmpq_mat_clear(a);
    if (result && !is_h(*result)) return std::nullopt;
    return result;
  }

  bool is_h(const ImpliedEquation& of) const {
    const UpwardRounding rounding;
    return certify::sum(certify::implied_equation(system_, of), -1, h_).monomials.empty();
  }

  static void set(fmpq* entry, const ExactNumber& x) { fmpq_set_str(entry, x.text().c_str(), 10); }

  const Polynomial& h_;
  const System& system_;
  const Ended& ended_;
  Row target_;
  std::vector<const Polynomial*> polynomials_;  // by the numbers of equations
  std::vector<std::pair<int, Row>> equations_;
  std::set<int> variables_;
};

// h in the variables that are kept.
Polynomial reduced(Polynomial h, const certify::Reduction& reduction) {
  std::vector<int> place(reduction.kept.size() + reduction.definitions.size(), -1);
  for (std::size_t j = 0; j < reduction.kept.size(); ++j)
    place[static_cast<std::size_t>(reduction.kept[j])] = static_cast<int>(j);
  // A value is in kept variables, by their new indices: those of h get them first, apart from the eliminated ones.
  const int beyond = static_cast<int>(place.size());
  for (Monomial& m : h.monomials) {
    for (Factor& x : m.factors) {
      const int kept = place[static_cast<std::size_t>(x.variable)];
      x.variable = kept >= 0 ? kept : beyond + x.variable;
    }
    std::sort(m.factors.begin(), m.factors.end(), [](const Factor& a, const Factor& b) { return a.variable < b.variable; });
  }
  for (const auto& definition : reduction.definitions)
    h = certify::substitute(h, beyond + definition.variable, definition.value);
  return h;
}

}  // namespace

std::vector<ImpliedEquation> find_implied_equations(const System& system, const Ended& ended) {
  return Finder(system, ended).run();
}

std::optional<ImpliedEquation> express_by_equations(const Polynomial& h, const System& system, const Ended& ended) {
  return Expression(h, system, ended).find();
}

std::vector<std::size_t> add_implied_equations(const std::vector<Polynomial>& claimed, certify::Reduction& reduction,
                                               const Ended& ended) {
  std::vector<std::size_t> unproven;
  if (!reduction.consistent || reduction.tolerant) return unproven;
  const UpwardRounding rounding;
  const std::vector<ImpliedEquation> found = find_implied_equations(reduction.system, ended);
  for (std::size_t k = 0; k < found.size(); ++k)
    certify::add_implied(reduction, found[k], "implied equation " + std::to_string(k + 1));
  for (std::size_t k = 0; k < claimed.size(); ++k) {
    const Polynomial& claim = claimed[k];
    const bool is_polynomial =
        std::none_of(claim.monomials.begin(), claim.monomials.end(), [](const Monomial& m) { return m.is_trigonometric(); });
    const Polynomial h = is_polynomial ? reduced(claim, reduction) : claim;
    const auto is_known = [&](const Polynomial& f) { return certify::proportional(f, h).has_value(); };
    if (h.monomials.empty() || std::any_of(reduction.system.equations.begin(), reduction.system.equations.end(), is_known) ||
        std::any_of(reduction.system.implied.begin(), reduction.system.implied.end(), is_known))
      continue;
    if (const auto of = express_by_equations(h, reduction.system, ended)) {
      certify::add_implied(reduction, *of, claim.source);
    } else {
      unproven.push_back(k);
    }
  }
  return unproven;
}

}  // namespace corank::solve
