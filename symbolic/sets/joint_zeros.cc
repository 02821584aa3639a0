#include "corank/symbolic/sets/joint_zeros.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <numbers>

#include "corank/certify/trigonometric.h"
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

bool JointZeros::have_no_common_zero(const std::vector<RationalPolynomial>& polynomials,
                                     const std::vector<Function>& functions, double share) const {
  constexpr std::size_t kMostBoxes = 50'000;
  constexpr double kSmallest = 1e-3;
  struct Term {
    Interval coefficient;
    std::vector<std::pair<std::size_t, int>> powers;  // of functions
  };
  const UpwardRounding rounding;
  std::vector<std::vector<Term>> all;
  for (const RationalPolynomial& f : polynomials) {
    all.emplace_back();
    std::size_t known = 0;
    for (const Function& function : functions) known += f.mentions(function.unknown);
    if (known < f.unknowns()) return false;  // an irrational number
    for (const RationalPolynomial::Term& t : f.terms()) {
      Term& term = all.back().emplace_back(Term{ExactNumber::rational(t.coefficient).enclose(), {}});
      for (std::size_t k = 0; k < functions.size(); ++k)
        if (const auto power = t.powers[functions[k].unknown]; power > 0)
          term.powers.emplace_back(k, static_cast<int>(power));
    }
  }
  std::vector<const Turning*> joints;
  std::vector<std::size_t> joint_of;
  std::vector<Interval> ranges;
  for (const Function& function : functions) {
    const auto known = std::ranges::find(joints, function.joint);
    joint_of.push_back(static_cast<std::size_t>(known - joints.begin()));
    if (known != joints.end()) continue;
    joints.push_back(function.joint);
    const Coordinate& c = coordinate(function.joint->name);
    const Interval lower = exact_value(mechanism_, c.lower, c.name).enclose(),
                   upper = exact_value(mechanism_, c.upper, c.name).enclose();
    const Interval turn = Interval(lower.lo()) + Interval(0, 7);  // more than a turn
    ranges.emplace_back(lower.lo(), std::min(upper.hi(), turn.hi()));
  }
  std::vector<std::vector<Interval>> open{ranges};
  for (std::size_t boxes = 0; !open.empty(); ++boxes) {
    const std::vector<Interval> box = std::move(open.back());
    open.pop_back();
    std::vector<Interval> values;
    for (std::size_t k = 0; k < functions.size(); ++k) {
      const Interval angle = Interval(share) * box[joint_of[k]];
      values.push_back(functions[k].is_sine ? certify::sine(angle) : certify::cosine(angle));
    }
    const auto is_not_zero = [&](const std::vector<Term>& terms) {
      Interval sum(0);
      for (const Term& t : terms) {
        Interval product = t.coefficient;
        for (const auto& [k, exponent] : t.powers) product *= power(values[k], exponent);
        sum += product;
      }
      return !sum.contains_zero();
    };
    if (std::ranges::any_of(all, is_not_zero)) continue;
    const auto widest = std::ranges::max_element(box, {}, [](const Interval& x) { return x.width(); });
    if (widest == box.end() || widest->width() < kSmallest || boxes > kMostBoxes || is_over(ended_)) return false;
    const auto side = static_cast<std::size_t>(widest - box.begin());
    for (const Interval& half : {Interval(widest->lo(), widest->mid()), Interval(widest->mid(), widest->hi())}) {
      open.push_back(box);
      open.back()[side] = half;
    }
  }
  return true;
}

bool JointZeros::have_no_common_zero(const std::vector<RationalPolynomial>& polynomials) const {
  std::vector<Function> functions;
  for (const Turning& joint : turning_)
    for (const auto& [unknown, is_sine] : {std::pair(joint.cosine, false), std::pair(joint.sine, true)}) {
      const auto is_in = [&](const RationalPolynomial& f) { return f.mentions(*unknown); };
      if (unknown && std::ranges::any_of(polynomials, is_in)) functions.push_back({*unknown, &joint, is_sine});
    }
  return have_no_common_zero(polynomials, functions, 1);
}

JointZeros::Zeros JointZeros::Zeros::chosen(const Zeros& other, bool has) const {
  const auto is_chosen = [&](const auto& x) { return other.has(x) == has; };
  Zeros result;
  std::ranges::copy_if(values, std::back_inserter(result.values), is_chosen);
  std::ranges::copy_if(factors, std::back_inserter(result.factors), is_chosen);
  return result;
}

void JointZeros::Zeros::add(const Zeros& other) {
  const Zeros more = other.chosen(*this, false);
  values.insert(values.end(), more.values.begin(), more.values.end());
  factors.insert(factors.end(), more.factors.begin(), more.factors.end());
}

RationalPolynomial JointZeros::product(const Zeros& zeros) const {
  const auto number = [&](const char* text) { return RationalPolynomial::number(matrix_.ring(), text); };
  RationalPolynomial result = number("1");
  for (const QuarterTurns& value : zeros.values) {
    const Turning& joint = *std::ranges::find(turning_, value.joint, &Turning::name);
    const std::optional<std::size_t> u = value.quarters % 2 == 0 ? joint.cosine : joint.sine;
    if (!u) return number("0");  // it is not known where
    const RationalPolynomial f = RationalPolynomial::unknown(matrix_.ring(), *u);
    result = result * (value.quarters < 2 ? number("1") - f : number("1") + f);
  }
  for (const RationalPolynomial& factor : zeros.factors) result = result * factor;
  return result;
}

std::vector<std::string> JointZeros::joints() const {
  std::vector<std::string> names;
  for (const Turning& joint : turning_) names.push_back(joint.name);
  return names;
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
  return have_no_common_zero({f}, {{joint.half_sine, &joint, true}, {joint.half_cosine, &joint, false}}, 0.5);
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
      zeros.add(*own);
    } else {
      zeros.factors.push_back(g);
    }
  }
  std::ranges::sort(zeros.values);
  zeros.values.erase(std::ranges::unique(zeros.values).begin(), zeros.values.end());
  return zeros;
}

}  // namespace corank::symbolic
