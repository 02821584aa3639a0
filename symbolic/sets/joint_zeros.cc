#include "corank/symbolic/sets/joint_zeros.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "corank/core/rounding.h"
#include "corank/symbolic/algebra/exact_value.h"

namespace corank::symbolic {

JointZeros::JointZeros(const Mechanism& mechanism, const FreeCoordinates& free, const ExactMatrix& matrix,
                       const Ended& ended)
    : mechanism_(mechanism), coordinates_(free.system.coordinates), matrix_(matrix), ended_(ended) {
  is_of_joint_.resize(matrix_.ring().unknowns(), false);
  for (const Coordinate& c : coordinates_) {
    if (c.kind != CoordinateKind::angle) continue;
    const auto [cosine, sine] = matrix_.unknowns_of(c.name);
    if (cosine) is_of_joint_[*cosine] = true;
    if (sine) is_of_joint_[*sine] = true;
    if (cosine || sine) turning_.push_back({c.name, cosine, sine, 2 * turning_.size(), 2 * turning_.size() + 1});
  }
  half_ = PolynomialRing(other(is_of_joint_.size()));
}

const Coordinate& JointZeros::coordinate(const std::string& joint) const {
  return *std::ranges::find(coordinates_, joint, &Coordinate::name);
}

RationalPolynomial JointZeros::at(RationalPolynomial f, const QuarterTurns& value) const {
  constexpr std::array<const char*, 4> kSines{"0", "1", "0", "-1"};
  const Turning& joint = *std::ranges::find(turning_, value.joint, &Turning::name);
  const auto number = [&](int quarters) {
    return RationalPolynomial::number(matrix_.ring(), kSines[static_cast<std::size_t>(quarters % 4)]);
  };
  if (joint.cosine) f = f.with(*joint.cosine, 1, number(value.quarters + 1));
  if (joint.sine) f = f.with(*joint.sine, 1, number(value.quarters));
  return f;
}

std::size_t JointZeros::joints_in(const std::vector<RationalPolynomial>& polynomials) const {
  const auto is_in = [](const RationalPolynomial& f, const std::optional<std::size_t>& u) { return u && f.mentions(*u); };
  return static_cast<std::size_t>(std::ranges::count_if(turning_, [&](const Turning& joint) {
    return std::ranges::any_of(polynomials, [&](const auto& f) { return is_in(f, joint.cosine) || is_in(f, joint.sine); });
  }));
}

std::array<int, 4> JointZeros::turns_to(const Coordinate& joint) const {
  const double lower = exact_value(mechanism_, joint.lower, joint.name).enclose().lo();
  const int below = static_cast<int>(std::floor(lower / (2 * std::numbers::pi)));  // or one more or less, by rounding
  std::array<int, 4> turns{below - 1, below, below + 1, below + 2};
  std::ranges::stable_sort(turns, {}, [](int k) { return std::abs(k); });
  return turns;
}

std::optional<Expression> JointZeros::value_of(const QuarterTurns& value) const {
  const Coordinate& c = coordinate(value.joint);
  for (const int turns : turns_to(c)) {
    const int quarters = (value.quarters + 1) % 4 - 1 + 4 * turns;  // of −1, 0, 1, 2
    const std::string half = quarters % 2 == 0 ? "" : "/2";
    const int times = quarters % 2 == 0 ? quarters / 2 : quarters;
    const std::string multiple = std::abs(times) == 1 ? (times < 0 ? "-pi" : "pi") : std::to_string(times) + "*pi";
    const Expression angle = quarters == 0 ? Expression(0) : Expression(multiple + half);
    const auto sign = [&](const Expression& difference) {
      return exact_value(mechanism_, difference, value.joint).sign().value_or(0);
    };
    if (sign(angle - c.lower) >= 0 && sign(c.upper - angle) >= 0) return angle;
  }
  return std::nullopt;
}

// No zero of f(S, C), homogeneous, at angles θ of the joint's range: by intervals, S = sin(θ/2)/r and C = cos(θ/2)/r in
// parts of S = 1 and of C = 1.
bool JointZeros::vanishes_nowhere(const RationalPolynomial& f, const Turning& joint) const {
  struct Term {
    Interval coefficient;
    std::array<std::uint64_t, 2> powers;
  };
  constexpr double kMargin = 1e-8;  // of angles computed in doubles
  constexpr double kSmallest = 1e-3;
  const UpwardRounding rounding;
  const Coordinate& c = coordinate(joint.name);
  const double lower = exact_value(mechanism_, c.lower, c.name).enclose().lo() - kMargin,
               upper = exact_value(mechanism_, c.upper, c.name).enclose().hi() + kMargin;
  const auto is_outside = [&, all = turns_to(c)](double from, double to) {
    if (from > to) std::swap(from, to);
    return std::ranges::all_of(all, [&](int turns) {
      const double shift = 2 * std::numbers::pi * turns;
      return to + shift < lower || from + shift > upper;
    });
  };
  std::vector<Term> terms;
  for (const RationalPolynomial::Term& t : f.terms())
    terms.push_back(
        {ExactNumber::rational(t.coefficient).enclose(), {t.powers[joint.half_sine], t.powers[joint.half_cosine]}});
  for (const std::size_t varies : {0, 1}) {
    const auto angle = [&](double t) { return 2 * (varies == 0 ? std::atan2(t, 1.0) : std::atan2(1.0, t)); };
    std::vector<Interval> open{Interval(-1, 1)};
    while (!open.empty()) {
      const Interval t = open.back();
      open.pop_back();
      if (is_outside(angle(t.lo()), angle(t.hi()))) continue;
      Interval sum(0);
      for (const Term& term : terms) sum += term.coefficient * power(t, static_cast<int>(term.powers[varies]));
      if (!sum.contains_zero()) continue;
      if (t.width() < kSmallest) return false;
      open.emplace_back(t.lo(), t.mid());
      open.emplace_back(t.mid(), t.hi());
    }
  }
  return true;
}

RationalPolynomial JointZeros::by_half_angles(const RationalPolynomial& f) const {
  const auto number = [&](const std::string& value) { return RationalPolynomial::number(half_, value); };
  const std::vector<RationalPolynomial::Term> terms = f.terms();
  std::vector<std::uint64_t> degrees(turning_.size(), 0);
  for (const auto& t : terms)
    for (std::size_t k = 0; k < turning_.size(); ++k)
      degrees[k] = std::max(degrees[k], turning_[k].cosines(t) + turning_[k].sines(t));
  RationalPolynomial result(half_);
  for (const auto& t : terms) {
    RationalPolynomial product = number(t.coefficient);
    for (std::size_t u = 0; u < t.powers.size(); ++u)
      if (!is_of_joint_[u]) product = product * RationalPolynomial::unknown(half_, other(u)).power(t.powers[u]);
    for (std::size_t k = 0; k < turning_.size(); ++k) {
      const Turning& joint = turning_[k];
      const std::uint64_t i = joint.cosines(t), j = joint.sines(t);
      const RationalPolynomial s = RationalPolynomial::unknown(half_, joint.half_sine),
                               c = RationalPolynomial::unknown(half_, joint.half_cosine);
      if (degrees[k] > 0)
        product =
            product * (c * c - s * s).power(i) * (number("2") * s * c).power(j) * (c * c + s * s).power(degrees[k] - i - j);
    }
    result = result + product;
  }
  return result;
}

std::optional<RationalPolynomial> JointZeros::by_whole_angles(const RationalPolynomial& f) const {
  const auto number = [&](const std::string& value) { return RationalPolynomial::number(matrix_.ring(), value); };
  RationalPolynomial result(matrix_.ring());
  for (const auto& t : f.terms()) {
    RationalPolynomial product = number(t.coefficient);
    for (std::size_t u = 0; u < is_of_joint_.size(); ++u)
      product = product * RationalPolynomial::unknown(matrix_.ring(), u).power(t.powers[other(u)]);
    for (const Turning& joint : turning_) {
      const std::uint64_t i = t.powers[joint.half_cosine], j = t.powers[joint.half_sine], both = std::min(i, j);
      if (i + j == 0) continue;
      if ((i + j) % 2 != 0 || !joint.cosine || !joint.sine) return std::nullopt;
      const RationalPolynomial s = RationalPolynomial::unknown(matrix_.ring(), *joint.sine),
                               c = RationalPolynomial::unknown(matrix_.ring(), *joint.cosine);
      const RationalPolynomial square = i > j ? number("1") + c : number("1") - c;  // 2 C², or 2 S²
      product = product * s.power(both) * square.power((i + j) / 2 - both).over(number("2").power((i + j) / 2));
    }
    result = result + product;
  }
  return matrix_.modulo_circles(result);
}

// False where it may vanish elsewhere than at multiples of π/2, where S, C, S − C or S + C is 0.
bool JointZeros::add_zeros_of_joint(const RationalPolynomial& f, const Turning& joint, Zeros& zeros) const {
  constexpr std::array<std::array<const char*, 2>, 4> kSineAndCosine{{{"0", "1"}, {"1", "1"}, {"1", "0"}, {"1", "-1"}}};
  for (std::size_t k = 0; k < kSineAndCosine.size(); ++k) {
    const auto number = [&](std::size_t i) { return RationalPolynomial::number(half_, kSineAndCosine[k][i]); };
    if (!f.with(joint.half_sine, 1, number(0)).with(joint.half_cosine, 1, number(1)).is_zero()) continue;
    if (const QuarterTurns value{joint.name, static_cast<int>(k)}; value_of(value)) zeros.values.push_back(value);
    return true;
  }
  return vanishes_nowhere(f, joint);
}

// Nothing where a factor has no polynomial in sines and cosines of whole angles.
std::optional<JointZeros::Zeros> JointZeros::by_factors(const RationalPolynomial& f) const {
  Zeros zeros;
  const auto factors = by_half_angles(f).factors(ended_);
  if (!factors) return std::nullopt;
  for (const RationalPolynomial& factor : *factors) {
    const auto is_in = [&](const Turning& j) { return factor.mentions(j.half_sine) || factor.mentions(j.half_cosine); };
    const auto first = std::ranges::find_if(turning_, is_in);
    if (first != turning_.end()) {
      const std::size_t own =
          std::size_t{factor.mentions(first->half_sine)} + std::size_t{factor.mentions(first->half_cosine)};
      if (own == factor.unknowns() && add_zeros_of_joint(factor, *first, zeros)) continue;
    }
    std::optional<RationalPolynomial> whole = by_whole_angles(factor);
    if (!whole) return std::nullopt;
    if (first == turning_.end() && !matrix_.condition(*whole)) {  // a constant
      const Expression constant = matrix_.expression(*whole);
      if (exact_value(mechanism_, constant, constant.text()).sign().value_or(0) != 0) continue;
      return std::nullopt;
    }
    zeros.factors.push_back(std::move(*whole));
  }
  return zeros;
}

std::optional<JointZeros::Zeros> JointZeros::of(const RationalPolynomial& f) {
  const auto is_same = [&](const auto& known) { return known.first.size() == f.size() && known.first == f; };
  auto known = std::ranges::find_if(known_, is_same);
  if (known == known_.end()) known = known_.emplace(known_.end(), f, found(f));
  return known->second;
}

std::optional<JointZeros::Zeros> JointZeros::found(const RationalPolynomial& f) const {
  Zeros zeros;
  const auto factors = f.factors(ended_);
  if (!factors) return std::nullopt;
  for (const RationalPolynomial& factor : *factors) {
    const RationalPolynomial g = matrix_.modulo_circles(factor);
    if (g.is_zero()) return std::nullopt;
    if (g.is_number()) continue;
    if (const std::optional<Zeros> own = by_factors(g)) {
      zeros.values.insert(zeros.values.end(), own->values.begin(), own->values.end());
      zeros.factors.insert(zeros.factors.end(), own->factors.begin(), own->factors.end());
    } else {
      zeros.factors.push_back(g);
    }
  }
  std::ranges::sort(zeros.values);
  zeros.values.erase(std::ranges::unique(zeros.values).begin(), zeros.values.end());
  return zeros;
}

}  // namespace corank::symbolic
