#include "corank/kinematics/loops/identities.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace corank::kinematics {
namespace {

// Of a coefficient in constants.
std::size_t terms(const ex& sum) { return GiNaC::is_a<GiNaC::add>(sum) ? sum.nops() : 1; }

int degree(const std::map<std::size_t, int>& monomial) {
  return std::accumulate(monomial.begin(), monomial.end(), 0, [](int sum, const auto& f) { return sum + f.second; });
}

// monomial / by, where that is one.
std::optional<std::map<std::size_t, int>> quotient(std::map<std::size_t, int> monomial,
                                                   const std::map<std::size_t, int>& by) {
  for (const auto& [number, power] : by) {
    const auto found = monomial.find(number);
    if (found == monomial.end() || found->second < power) return std::nullopt;
    if ((found->second -= power) == 0) monomial.erase(found);
  }
  return monomial;
}

}  // namespace

bool Identities::Before::operator()(const Monomial& a, const Monomial& b) const {
  const int of_a = degree(a), of_b = degree(b);
  if (of_a != of_b) return of_a > of_b;
  for (auto at_a = a.begin(), at_b = b.begin(); at_a != a.end() && at_b != b.end(); ++at_a, ++at_b) {
    if (at_a->first != at_b->first) return at_a->first > at_b->first;
    if (at_a->second != at_b->second) return at_a->second < at_b->second;  // less of the earliest base
  }
  return false;
}

void Identities::insert(Polynomial& sum, const Monomial& monomial, const ex& coefficient) const {
  const auto [at, is_new] = sum.try_emplace(monomial, coefficient);
  if (!is_new) at->second = (at->second + coefficient).expand();
  if (algebra_.is_zero(at->second)) sum.erase(at);
}

// With a sine or cosine comes its circle.
std::size_t Identities::number(const ex& base) {
  const auto [at, is_new] = numbers_.try_emplace(base, numbers_.size());
  const std::size_t result = at->second;
  if (!is_new || !GiNaC::is_a<GiNaC::function>(base)) return result;
  const std::string name = GiNaC::ex_to<GiNaC::function>(base).get_name();
  const bool is_sine = name == "sin";
  if (!is_sine && name != "cos") return result;
  const ex other = is_sine ? ex(GiNaC::cos(base.op(0))) : ex(GiNaC::sin(base.op(0)));
  const auto [partner, other_is_new] = numbers_.try_emplace(other, numbers_.size());
  if (other_is_new) add({{{{{result, 2}}, 1}, {{{partner->second, 2}}, 1}, {{}, -1}}, {}});
  return result;
}

// New bases are numbered in the order of their texts: that of GiNaC's terms is not the same in each run.
Identities::Polynomial Identities::polynomial(const ex& e) {
  std::vector<std::pair<ex, std::vector<std::pair<ex, int>>>> terms;
  std::map<std::string, ex> fresh;
  for (const ex& term : symbolic::parts_of<GiNaC::add>(e.expand())) {
    auto& [coefficient, powers] = terms.emplace_back(1, std::vector<std::pair<ex, int>>{});
    for (const ex& f : symbolic::parts_of<GiNaC::mul>(term)) {
      if (algebra_.is_constant(f)) {
        coefficient *= f;
        continue;
      }
      const bool is_power = GiNaC::is_a<GiNaC::power>(f) && f.op(1).info(GiNaC::info_flags::posint);
      const ex base = is_power ? f.op(0) : f;
      powers.emplace_back(base, is_power ? GiNaC::ex_to<GiNaC::numeric>(f.op(1)).to_int() : 1);
      if (!numbers_.contains(base)) fresh.emplace(symbolic::text_of(base), base);
    }
  }
  for (const auto& [text, base] : fresh) number(base);
  Polynomial result;
  for (const auto& [coefficient, powers] : terms) {
    Monomial monomial;
    for (const auto& [base, power] : powers) monomial[number(base)] += power;
    insert(result, monomial, coefficient);
  }
  return result;
}

std::optional<Identities::Known> Identities::remainder(const ex& e) {
  if (operations_left_ == 0) return std::nullopt;
  const auto spend = [&](std::size_t operations) { operations_left_ -= std::min(operations_left_, operations); };
  Polynomial f = polynomial(e);
  Known left;
  spend(f.size());
  while (!f.empty()) {
    if (operations_left_ == 0) return std::nullopt;
    const auto [monomial, coefficient] = *f.begin();
    std::optional<Monomial> factor;
    const auto divisor = std::ranges::find_if(known_, [&](const Known& p) {
      factor = quotient(monomial, p.value.begin()->first);
      return factor.has_value();
    });
    if (divisor == known_.end()) {
      spend(1);
      left.value.emplace(monomial, coefficient);
      f.erase(f.begin());
      continue;
    }
    left.of.insert(divisor->of.begin(), divisor->of.end());
    for (const auto& [other, times] : divisor->value) {
      spend(terms(coefficient) * terms(times));
      Monomial product = *factor;
      for (const auto& [number, power] : other) product[number] += power;
      insert(f, product, -coefficient * times);
    }
  }
  return left;
}

void Identities::add(const ex& e, std::size_t equation) {
  std::optional<Known> rest = remainder(e);
  if (!rest) return;
  rest->of.insert(equation);
  add(std::move(*rest));
}

std::optional<Identities::Numbers> Identities::sources(const ex& e) {
  std::optional<Known> rest = remainder(e);
  if (!rest || !rest->value.empty()) return std::nullopt;
  return std::move(rest->of);
}

void Identities::add(Known rest) {
  if (rest.value.empty()) return;
  const ex first = rest.value.begin()->second;
  for (auto& [monomial, coefficient] : rest.value) coefficient = (coefficient / first).expand();
  rest.value.begin()->second = 1;
  known_.push_back(std::move(rest));
}

}  // namespace corank::kinematics
