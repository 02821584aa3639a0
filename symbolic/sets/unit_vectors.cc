#include "corank/symbolic/sets/unit_vectors.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "corank/symbolic/algebra/remembered.h"
#include "corank/symbolic/velocity/exact_matrix.h"

namespace corank::symbolic {
namespace {

// By equations, and by constants' values, whose squares may be rational; wherever the ranges are.
bool has_same_vectors(const Mechanism& a, const Mechanism& b) {
  const auto coordinates = [](const Coordinate& x, const Coordinate& y) {
    return x.name == y.name && x.kind == y.kind && x.auxiliary == y.auxiliary;
  };
  const auto constants = [](const Constant& x, const Constant& y) {
    return x.name == y.name && same_tree(x.value, y.value);
  };
  return std::ranges::equal(a.coordinates(), b.coordinates(), coordinates) &&
         std::ranges::equal(a.constants(), b.constants(), constants) &&
         std::ranges::equal(residuals(a), residuals(b), same_tree);
}

// Dot and triple products of vectors, as polynomials that they are at every solution of Φ. A vector that Φ gives as Σ p·a +
// Σ p·(a × b), where the p hold no vectors, has the sums of the products of these, by
//   (a × b)·c = det(a, b, c),  (a × b)·(c × d) = (a·c)(b·d) − (a·d)(b·c);
// other vectors have the products of their components.
class VectorProducts {
 public:
  explicit VectorProducts(const Mechanism& mechanism);

  /// Of the vectors whose length is shown to be 1.
  std::set<std::string> unit_components() {
    std::set<std::string> result;
    for (std::size_t v = 0; v < vectors_.size(); ++v)
      if (has_length_one(v)) result.insert(vectors_[v].names.begin(), vectors_[v].names.end());
    return result;
  }

 private:
  struct Vector {
    std::vector<std::string> names;          // of the components
    std::vector<std::size_t> unknowns;       // these are
    std::vector<RationalPolynomial> values;  // by Φ
    std::vector<std::pair<RationalPolynomial, std::size_t>> sum;
    std::vector<std::pair<RationalPolynomial, std::pair<std::size_t, std::size_t>>> cross_products;
    bool is_sum() const { return !sum.empty() || !cross_products.empty(); }
  };

  RationalPolynomial zero() const { return RationalPolynomial(exact_.ring()); }
  RationalPolynomial unknown(std::size_t index) const { return RationalPolynomial::unknown(exact_.ring(), index); }
  std::vector<RationalPolynomial> components(std::size_t v) const {
    std::vector<RationalPolynomial> result;
    for (const std::size_t k : vectors_[v].unknowns) result.push_back(unknown(k));
    return result;
  }
  RationalPolynomial reduced(const RationalPolynomial& f) const {
    constexpr std::size_t kLongest = 5000;
    if (f.size() > kLongest) throw DeterminantTooLarge({}, "a product of vectors with many terms", "shorter vectors");
    return exact_.modulo_circles(f);
  }

  // f is linear in it; what stands beside.
  RationalPolynomial coefficient(const RationalPolynomial& f, std::size_t component) const {
    return *(f - f.with(component, 1, zero())).divided_by(unknown(component));
  }
  RationalPolynomial without_vectors(RationalPolynomial f) const {
    for (const Vector& v : vectors_)
      for (const std::size_t component : v.unknowns) f = f.with(component, 1, zero());
    return f;
  }
  void put_as_sum(std::size_t v);

  bool has_length_one(std::size_t v) {
    try {
      return dot(v, v) == RationalPolynomial::number(exact_.ring(), "1");
    } catch (const DeterminantTooLarge&) {
      return false;
    }
  }

  RationalPolynomial dot(std::size_t v, std::size_t w);
  RationalPolynomial triple(std::array<std::size_t, 3> v);

  const ExactMatrix exact_;
  std::vector<Vector> vectors_;  // in the order in which Φ gives them
  std::map<std::pair<std::size_t, std::size_t>, RationalPolynomial> dots_;
  std::map<std::array<std::size_t, 3>, RationalPolynomial> triples_;
};

VectorProducts::VectorProducts(const Mechanism& mechanism) : exact_(mechanism, {}, residuals(mechanism)) {
  std::map<std::string, std::size_t> places;
  for (const Relation& r : exact_.given()) places.emplace(r.lhs.name(), places.size());
  std::map<std::string, Vector> vectors;  // "u_link2": of "u_link2_x" …
  for (const Coordinate& c : mechanism.coordinates()) {
    const auto place = places.find(c.name);
    if (!c.auxiliary || c.kind != CoordinateKind::length || place == places.end()) continue;
    const ExactMatrix::Explicit& given = exact_.given_polynomials()[place->second];
    Vector& v = vectors[c.name.substr(0, c.name.rfind('_'))];
    v.names.push_back(c.name);
    v.unknowns.push_back(given.unknown);
    v.values.push_back(given.value);
  }
  for (auto& [stem, vector] : vectors) vectors_.push_back(std::move(vector));
  std::ranges::stable_sort(vectors_, {}, [&](const Vector& v) { return places.at(v.names.back()); });
  for (std::size_t v = 0; v < vectors_.size(); ++v) put_as_sum(v);
}

// Where the coefficients of its first component are those of the others, too.
void VectorProducts::put_as_sum(std::size_t v) {
  constexpr std::size_t kDimension = 3;
  Vector& own = vectors_[v];
  if (own.names.size() != kDimension) return;
  Vector read = own;
  for (std::size_t a = 0; a < v; ++a) {
    const std::vector<std::size_t>& x = vectors_[a].unknowns;
    if (x.size() != kDimension) continue;
    if (const auto p = without_vectors(coefficient(own.values[0], x[0])); !p.is_zero()) read.sum.emplace_back(p, a);
    const RationalPolynomial by_second = coefficient(own.values[0], x[1]);
    for (std::size_t b = a + 1; b < v && !by_second.is_zero(); ++b) {
      if (vectors_[b].unknowns.size() != kDimension) continue;
      const auto p = without_vectors(coefficient(by_second, vectors_[b].unknowns[2]));
      if (!p.is_zero()) read.cross_products.emplace_back(p, std::pair(a, b));
    }
  }
  for (std::size_t i = 0; i < kDimension; ++i) {
    RationalPolynomial rest = own.values[i];
    for (const auto& [p, a] : read.sum) rest = rest - p * unknown(vectors_[a].unknowns[i]);
    for (const auto& [p, pair] : read.cross_products) {
      const auto a = components(pair.first), b = components(pair.second);
      const std::size_t j = (i + 1) % kDimension, k = (i + 2) % kDimension;
      rest = rest - p * (a[j] * b[k] - a[k] * b[j]);
    }
    if (!rest.is_zero()) return;
  }
  own = std::move(read);
}

RationalPolynomial VectorProducts::dot(std::size_t v, std::size_t w) {
  if (v < w) std::swap(v, w);
  if (const auto known = dots_.find({v, w}); known != dots_.end()) return known->second;
  RationalPolynomial result = zero();
  if (!vectors_[v].is_sum() && !vectors_[w].is_sum()) {
    const auto x = components(v), y = components(w);
    for (std::size_t i = 0; i < x.size(); ++i) result = result + x[i] * y[i];
    result = exact_.in_free_coordinates(result);
  } else {
    const auto& [sum, other] = vectors_[v].is_sum() ? std::pair(v, w) : std::pair(w, v);
    for (const auto& [p, a] : vectors_[sum].sum) result = result + p * dot(a, other);
    for (const auto& [p, pair] : vectors_[sum].cross_products)
      result = result + p * triple({pair.first, pair.second, other});
  }
  return dots_.emplace(std::pair(v, w), reduced(result)).first->second;
}

RationalPolynomial VectorProducts::triple(std::array<std::size_t, 3> v) {
  if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return zero();
  std::ranges::rotate(
      v, std::ranges::max_element(v, {}, [&](std::size_t k) { return std::pair(vectors_[k].is_sum(), k); }) + 1);
  if (v[0] > v[1]) return zero() - triple({v[1], v[0], v[2]});
  if (const auto known = triples_.find(v); known != triples_.end()) return known->second;
  const auto& [a, b, last] = v;
  RationalPolynomial result = zero();
  if (!vectors_[last].is_sum()) {
    const auto x = components(a), y = components(b), z = components(last);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const std::size_t j = (i + 1) % x.size(), k = (i + 2) % x.size();
      result = result + x[i] * (y[j] * z[k] - y[k] * z[j]);
    }
    result = exact_.in_free_coordinates(result);
  }
  for (const auto& [p, c] : vectors_[last].sum) result = result + p * triple({a, b, c});
  for (const auto& [p, pair] : vectors_[last].cross_products)
    result = result + p * (dot(a, pair.first) * dot(b, pair.second) - dot(a, pair.second) * dot(b, pair.first));
  return triples_.emplace(v, reduced(result)).first->second;
}

std::set<std::string> find_components(const Mechanism& mechanism) {
  const auto may_be_one = [](const Coordinate& c) { return c.auxiliary && c.kind == CoordinateKind::length; };
  if (std::ranges::none_of(mechanism.coordinates(), may_be_one)) return {};
  return VectorProducts(mechanism).unit_components();
}

}  // namespace

std::set<std::string> unit_vector_components(const Mechanism& mechanism) {
  static Remembered<Mechanism, std::set<std::string>> remembered(2);
  return remembered.of(mechanism, has_same_vectors, find_components);
}

}  // namespace corank::symbolic
