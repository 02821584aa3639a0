#include "corank/solve/reduction/implied_equations.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "corank/solve/reduction/equation_multiples.h"

namespace corank::solve {
namespace {

constexpr int kRounds = 4;
constexpr std::size_t kMostTerms = 9;  // of an equation that is kept, but for its constant
constexpr std::size_t kMostFound = 100;
constexpr double kLargestInteger = 2;  // of the coefficients of equations that are multiplied

// A sum of multiples without products of degree three, as values of its terms and of the multiples' factors.
struct Sum {
  std::vector<mp_limb_t> terms, factors;
};

std::size_t weight(const std::vector<mp_limb_t>& terms) {  // the constant is the last
  return std::count_if(terms.begin(), terms.end() - 1, [](mp_limb_t c) { return c != 0; });
}

// s − q·t.
std::vector<mp_limb_t> difference(const std::vector<mp_limb_t>& s, mp_limb_t q, const std::vector<mp_limb_t>& t) {
  const nmod_t mod = PrimeMatrix::field();
  std::vector<mp_limb_t> result(s.size());
  for (std::size_t j = 0; j < s.size(); ++j) result[j] = nmod_sub(s[j], nmod_mul(q, t[j], mod), mod);
  return result;
}

void make_first_one(Sum& s) {
  const auto first = std::ranges::find_if(s.terms, [](mp_limb_t c) { return c != 0; });
  if (first == s.terms.end()) return;
  const nmod_t mod = PrimeMatrix::field();
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
        const mp_limb_t q = nmod_div(s.terms[k], other.terms[k], PrimeMatrix::field());
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
      if (f.degree() != 2 || !std::ranges::all_of(f.monomials, is_small)) continue;
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
    std::map<Powers, int> equations;      // how many have a product of degree two
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
      for (const int v : multipliers(row, neighbours)) multiples.emplace_back(equation, row, Powers{{v, 1}});
    }
    drop_lone(multiples, 3);
    if (multiples.empty()) return false;
    for (const auto& [equation, row] : equations_) multiples.emplace_back(equation, row, Powers{});
    if (multiples.size() > kMostRows || is_over(ended_)) return false;

    std::map<Powers, std::size_t> column;
    std::vector<Powers> products, low;
    for (const Multiple& m : multiples)
      for (const auto& [p, c] : m.row)
        if (column.try_emplace(p, 0).second) (degree(p) == 3 ? products : low).push_back(p);
    std::erase(low, Powers{});
    low.push_back({});  // the constant
    const std::size_t cubic = products.size(), width = cubic + low.size();
    products.insert(products.end(), low.begin(), low.end());
    for (std::size_t k = 0; k < width; ++k) column[products[k]] = k;
    PrimeMatrix matrix(multiples.size(), width + multiples.size());
    for (std::size_t i = 0; i < multiples.size(); ++i) {
      for (const auto& [p, c] : multiples[i].row) matrix.at(i, column[p]) = c;
      matrix.at(i, width + i) = 1;
    }
    if (!matrix.reduce(ended_)) return false;
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
  std::vector<Sum> in_reverse_order(const std::vector<Sum>& sums) const {
    if (sums.empty()) return {};
    const std::size_t width = sums[0].terms.size(), factors = sums[0].factors.size();
    PrimeMatrix matrix(sums.size(), width + factors);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      for (std::size_t k = 0; k < width; ++k) matrix.at(i, k) = sums[i].terms[(2 * width - 2 - k) % width];
      for (std::size_t k = 0; k < factors; ++k) matrix.at(i, width + k) = sums[i].factors[k];
    }
    if (!matrix.reduce(ended_)) return {};
    std::vector<Sum> result;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      Sum s;
      for (std::size_t k = 0; k < width; ++k) s.terms.push_back(matrix.at(i, (2 * width - 2 - k) % width));
      for (std::size_t k = 0; k < factors; ++k) s.factors.push_back(matrix.at(i, width + k));
      result.push_back(std::move(s));
    }
    return result;
  }

  // Sums of few terms: those given, and of each two, made as short as they get. Once the run has ended some are missing.
  std::vector<Sum> short_ones(std::vector<Sum> sums) const {
    for (Sum& s : sums) {
      if (is_over(ended_)) return {};
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
      for (std::size_t j = 0; j < i && !is_over(ended_); ++j)
        for (std::size_t k = 0; k + 1 < sums[i].terms.size(); ++k) {
          if (sums[i].terms[k] == 0 || sums[j].terms[k] == 0) continue;
          const mp_limb_t q = nmod_div(sums[i].terms[k], sums[j].terms[k], PrimeMatrix::field());
          Sum s{difference(sums[i].terms, q, sums[j].terms), difference(sums[i].factors, q, sums[j].factors)};
          shorten(s, sums);
          if (weight(s.terms) == 0 || weight(s.terms) > std::min(weight(sums[i].terms), weight(sums[j].terms))) continue;
          make_first_one(s);
          if (seen.insert(s.terms).second) sums.push_back(std::move(s));
        }
    return sums;
  }

  bool keep(const std::vector<Sum>& sums, const std::vector<Multiple>& multiples, const std::vector<Powers>& low) {
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
        if (usable) implied.parts.push_back(multiples[i].part(*factor));
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

}  // namespace

std::vector<ImpliedEquation> find_implied_equations(const System& system, const Ended& ended) {
  return Finder(system, ended).run();
}

}  // namespace corank::solve
