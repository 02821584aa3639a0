// Self-motions in words: which coordinates stay, which moves freely, which follow.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "corank/certify/polynomial_algebra.h"
#include "corank/core/rounding.h"
#include "corank/result/values/sentences.h"
#include "corank/result/values/words.h"
#include "corank/symbolic/velocity/velocity_equation.h"

namespace corank::result {
namespace {

bool is_linear_and_exact(const Polynomial& f) {
  return !f.monomials.empty() && std::ranges::all_of(f.monomials, [](const Monomial& m) {
    return m.coefficient.is_rational() && m.degree() <= 1 && !m.is_trigonometric() && !certify::carries_tolerance(m);
  });
}

// f = 0 as "name = …", solved for the monomial `own`.
template <class Name>
std::string solved_text(const Polynomial& f, std::size_t own, Name name) {
  std::string text;
  for (std::size_t k = 0; k < f.monomials.size(); ++k) {
    const Monomial& m = f.monomials[k];
    if (k == own) continue;
    ExactNumber c = -(m.coefficient / f.monomials[own].coefficient);
    const bool negative = c.sign() == -1;
    if (negative) c = -c;
    const std::string factor =
        m.factors.empty() ? c.text() : (c.text() == "1" ? "" : c.text() + "*") + name(m.factors[0].variable);
    text += text.empty() ? (negative ? "-" : "") + factor : (negative ? " - " : " + ") + factor;
  }
  return name(f.monomials[own].factors[0].variable) + " = " + (text.empty() ? "0" : text);
}

// The linear equations of a set in reduced echelon form: kernel unknowns and what comes late are expressed by what comes
// first.
class LinearRelations {
 public:
  LinearRelations(const System& system, const std::vector<Polynomial>& relations) : system_(system) {
    for (const Polynomial& f : relations) add(f);
    rest_ = system.equations;
    for (bool more = true; more;) {
      more = false;
      for (Polynomial& f : rest_) {
        f = reduced(f);
        if (!is_linear_and_exact(f)) continue;
        add(f);
        f.monomials.clear();
        more = true;
      }
    }
  }

  /// x_v as the others have it; nothing where it is one of these.
  const std::optional<Polynomial>& value(int v) const { return values_[v]; }
  /// What the equations say besides.
  const std::vector<Polynomial>& rest() const { return rest_; }

 private:
  Polynomial reduced(Polynomial f) const {
    for (int v = 0; v < system_.size(); ++v) {
      const auto inside = [v](const Monomial& m) { return m.is_trigonometric() && m.factors[0].variable == v; };
      if (value(v) && certify::mentions(f, v) && std::ranges::none_of(f.monomials, inside))
        f = certify::substitute(f, v, *value(v));
    }
    return f;
  }

  void add(Polynomial f) {
    f = reduced(f);
    int own = -1;
    for (const Monomial& m : f.monomials)
      if (!m.factors.empty()) own = std::max(own, m.factors[0].variable);
    const auto solved = own < 0 ? std::nullopt : certify::solved_for(f, own);
    if (!solved) return;
    for (auto& other : values_)
      if (other) other = certify::substitute(*other, own, *solved);
    values_[own] = solved;
  }

  const System& system_;
  std::vector<std::optional<Polynomial>> values_{system_.variables.size()};
  std::vector<Polynomial> rest_;
};

// a·x_v or a: what most relations of angles are.
struct Term {
  ExactNumber factor;
  int variable = -1;
};

class Sentence {
 public:
  Sentence(const symbolic::Mechanism& mechanism, const System& system, const SelfMotionRecord& motion,
           const std::string& set)
      : mechanism_(mechanism),
        system_(system),
        linear_(system, motion.relations),
        dimension_(motion.dimension),
        locked_roles_(mechanism.has_own_velocity_equation() ? std::span<const symbolic::Role>()
                                                            : symbolic::definition(set).locked) {}

  std::string text() {
    find_staying();
    find_kernel_equations();
    for (const symbolic::Coordinate& c : mechanism_.coordinates()) {
      const auto angle = std::ranges::find_if(system_.angles, [&](const Angle& a) { return a.name == c.name; });
      if (angle != system_.angles.end()) {
        if (!c.auxiliary) sort_angle(*angle);
      } else if (const int v = system_.find(c.name); v >= 0 && !c.auxiliary) {
        sort_length(v);
      }
    }
    return written();
  }

 private:
  std::string name(int v) const {
    for (const Angle& a : system_.angles) {
      if (a.cosine == v) return "cos " + a.name;
      if (a.sine == v) return "sin " + a.name;
    }
    return system_.variables[v].name;
  }

  // "x = …" in words, where the relations say it.
  std::string relation(int v) const {
    Polynomial f = *linear_.value(v);
    f.monomials.insert(f.monomials.begin(), Monomial(ExactNumber(-1), std::vector<Factor>{{v, 1}}));
    return solved_text(f, 0, [this](int variable) { return name(variable); });
  }

  bool is_constant(int v) const {
    const auto& value = linear_.value(v);
    return value && (value->monomials.empty() || (value->monomials.size() == 1 && value->monomials[0].factors.empty()));
  }

  // An angle of which one of cos and sin is a number does not move; nor does what follows from such angles alone.
  void find_staying() {
    for (const Angle& a : system_.angles)
      if (is_constant(a.cosine) || is_constant(a.sine)) staying_.insert({a.cosine, a.sine});
  }
  bool stays(int v) const {
    if (!linear_.value(v)) return staying_.contains(v);
    for (int other = 0; other < system_.size(); ++other)
      if (certify::mentions(*linear_.value(v), other) && !staying_.contains(other)) return false;
    return true;
  }

  // An equation that gives a component of the kernel vector, which no other equation mentions, says nothing else: it has a
  // solution for all values of the other variables.
  void find_kernel_equations() {
    for (bool more = true; more;) {
      more = false;
      for (int v = 0; v < system_.size(); ++v) {
        const Polynomial* only = nullptr;
        int mentions = 0;
        for (const Polynomial& f : linear_.rest()) {
          if (!is_kernel(v) || gives_kernel_.contains(&f) || !certify::mentions(f, v)) continue;
          only = &f;
          ++mentions;
        }
        if (mentions != 1 || !certify::solved_for(*only, v)) continue;
        gives_kernel_.insert(only);
        given_.insert(v);
        more = true;
      }
    }
  }

  std::optional<Term> term(int v) const {
    const auto& value = linear_.value(v);
    if (!value) return Term{ExactNumber(1), v};
    if (value->monomials.empty()) return Term{ExactNumber(0), -1};
    if (value->monomials.size() > 1) return std::nullopt;
    const Monomial& m = value->monomials[0];
    return Term{m.coefficient, m.factors.empty() ? -1 : m.factors[0].variable};
  }

  void put_fixed(const std::string& coordinate, const std::string& text) {
    const symbolic::Role role = symbolic::role_of(mechanism_, coordinate);
    const bool locked = std::ranges::find(locked_roles_, role) != locked_roles_.end();
    (locked ? locked_ : fixed_).push_back(text);
  }

  void sort_length(int v) {
    const std::string& coordinate = system_.variables[v].name;
    if (!linear_.value(v)) {
      free_.push_back({coordinate, {v}, false});
    } else if (stays(v)) {
      put_fixed(coordinate, relation(v));
    } else {
      following_.push_back(relation(v));
    }
  }

  void sort_angle(const Angle& a) {
    const bool c = is_constant(a.cosine), s = is_constant(a.sine);
    if (c || s) {
      put_fixed(a.name, constant_angle(a));
    } else if (stays(a.cosine) && stays(a.sine)) {
      put_fixed(a.name, relation(a.cosine) + ", " + relation(a.sine));
    } else if (!linear_.value(a.cosine) && !linear_.value(a.sine)) {
      free_.push_back({a.name, {a.cosine, a.sine}, true});
    } else if (const auto tied = tied_angle(a)) {
      following_.push_back(a.name + " = " + *tied);
    } else {
      for (const int v : {a.cosine, a.sine})
        if (linear_.value(v)) following_.push_back(relation(v));
      open_ = open_ || !linear_.value(a.cosine) || !linear_.value(a.sine);
    }
  }

  // One of cos and sin is a number, so the angle does not move: the other follows by the circle, but for its sign.
  std::string constant_angle(const Angle& a) const {
    const auto is = [this](int v, int number) { return is_constant(v) && term(v)->factor == ExactNumber(number); };
    if (is(a.cosine, 1)) return a.name + " = 0";
    if (is(a.cosine, -1)) return a.name + " = 180°";
    if (is(a.sine, 1)) return a.name + " = 90°";
    if (is(a.sine, -1)) return a.name + " = -90°";
    std::string text;
    for (const int v : {a.cosine, a.sine})
      if (is_constant(v)) text += (text.empty() ? "" : ", ") + relation(v);
    return text;
  }

  // cos t and sin t are ± those of another angle, or exchanged.
  std::optional<std::string> tied_angle(const Angle& a) const {
    const auto c = term(a.cosine), s = term(a.sine);
    if (!c || !s || c->variable < 0 || s->variable < 0) return std::nullopt;
    const auto sign = [](const Term& t) { return t.factor == ExactNumber(1) ? 1 : t.factor == ExactNumber(-1) ? -1 : 0; };
    const int p = sign(*c), q = sign(*s);
    if (p == 0 || q == 0) return std::nullopt;
    for (const Angle& b : system_.angles) {
      if (c->variable == b.cosine && s->variable == b.sine)
        return p > 0 ? (q > 0 ? b.name : "-" + b.name) : (q > 0 ? "180° - " + b.name : b.name + " + 180°");
      if (c->variable == b.sine && s->variable == b.cosine)  // cos(b ± 90°) = ∓sin b, sin(b ± 90°) = ±cos b
        return p > 0 ? (q > 0 ? "90° - " + b.name : b.name + " - 90°")
                     : (q > 0 ? b.name + " + 90°" : "-" + b.name + " - 90°");
    }
    return std::nullopt;
  }

  struct Free {
    std::string name;
    std::vector<int> variables;
    bool angle;
  };

  bool is_kernel(int v) const { return system_.variables[v].kind == VariableKind::kernel; }

  // Are the free coordinates bound by no equation but the circles of angles? Those of the kernel, or of an angle that stays,
  // leave them free.
  bool turns_freely() const {
    if (open_) return false;
    for (const Polynomial& f : linear_.rest()) {
      if (f.monomials.empty() || gives_kernel_.contains(&f)) continue;
      bool kernel = false, others = false;
      for (int v = 0; v < system_.size(); ++v) {
        if (certify::mentions(f, v) && !staying_.contains(v)) (is_kernel(v) ? kernel : others) = true;
      }
      if (!others) continue;
      const auto circle = std::ranges::any_of(free_, [&](const Free& t) { return t.angle && is_circle(f, t); });
      if (kernel || !circle) return false;
    }
    return true;
  }

  // c² + s² − 1, or what is left of it: nothing but the squares and a number.
  static bool is_circle(const Polynomial& f, const Free& angle) {
    ExactNumber squares[2];
    ExactNumber constant;
    for (const Monomial& m : f.monomials) {
      if (m.factors.empty()) {
        constant = m.coefficient;
      } else if (m.factors.size() == 1 && m.factors[0].power == 2 && !m.is_trigonometric() &&
                 (m.factors[0].variable == angle.variables[0] || m.factors[0].variable == angle.variables[1])) {
        squares[m.factors[0].variable == angle.variables[1]] = m.coefficient;
      } else {
        return false;
      }
    }
    return squares[0] == squares[1] && constant == -squares[0] && !constant.is_zero();
  }

  // Does each configuration have finitely many kernel vectors, by linear relations? Then the configurations alone have the
  // set's dimension.
  bool kernel_follows() const {
    for (int v = 0; v < system_.size(); ++v) {
      if (!is_kernel(v) || given_.contains(v)) continue;
      if (!linear_.value(v)) return false;
      for (int other = 0; other < system_.size(); ++other)
        if (is_kernel(other) && certify::mentions(*linear_.value(v), other)) return false;
    }
    return true;
  }

  std::string movement(const std::vector<std::string>& moving, bool angles) const {
    const bool one = moving.size() == 1;
    if (turns_freely() && static_cast<int>(free_.size()) <= dimension_)
      return angles ? (one ? " turns freely" : " turn freely") : (one ? " moves freely" : " move freely");
    if (!kernel_follows())
      return fmt::format(" {} bound by the other equations; the dimension counts kernel vectors, too", one ? "is" : "are");
    return (one ? " moves " : " move ") + (dimension_ == 1   ? "along a curve"
                                           : dimension_ == 2 ? "on a surface"
                                                             : fmt::format("in a set of dimension {}", dimension_));
  }

  std::string written() const {
    std::string text;
    if (!locked_.empty())
      text += fmt::format("with the {} locked at {}",
                          noun(names_of(mechanism_, locked_roles_.front()).size(), to_string(locked_roles_.front())),
                          listed(locked_));
    if (!fixed_.empty()) text += (text.empty() ? "with " : " and with ") + listed(fixed_);
    std::vector<std::string> moving;
    bool angles = true;
    for (const Free& f : free_) moving.push_back(f.name), angles = angles && f.angle;
    if (moving.empty() && following_.empty()) return "no coordinate moves, " + text;
    if (moving.empty()) moving.push_back("it");
    text += (text.empty() ? "" : ", ") + listed(moving) + movement(moving, angles);
    if (!following_.empty()) text += ": " + fmt::format("{}", fmt::join(following_, ", "));
    return text;
  }

  const symbolic::Mechanism& mechanism_;
  const System& system_;
  LinearRelations linear_;
  int dimension_;
  std::span<const symbolic::Role> locked_roles_;  // of coordinates: a rate of the mechanism's own locks none that we know of
  std::vector<std::string> locked_, fixed_, following_;
  std::vector<Free> free_;
  std::set<int> staying_;  // cosine and sine of angles that do not move
  std::set<const Polynomial*> gives_kernel_;
  std::set<int> given_;  // by these
  bool open_ = false;    // an angle is bound by one relation
};

}  // namespace

std::string relation_text(const Result& result, const Polynomial& f) {
  std::size_t own = 0;
  const auto is_unit = [](const Monomial& m) { return !m.factors.empty() && m.coefficient.text() == "1"; };
  for (std::size_t k = f.monomials.size(); k-- > 0;)
    if (is_unit(f.monomials[k])) own = k;
  return solved_text(f, own, [&](int v) { return result.variables[v].name; });
}

void describe_in_words(const symbolic::Mechanism& mechanism, const System& system, Result& result) {
  describe_domain(mechanism, system, result);
  result.motions.clear();
  if (result.variables.size() != system.variables.size()) return;
  const UpwardRounding rounding;
  for (const SelfMotionRecord& motion : result.cover.self_motions) {
    try {
      if (!std::ranges::all_of(motion.relations, is_linear_and_exact)) throw std::domain_error("no relations to speak of");
      result.motions.push_back(Sentence(mechanism, system, motion, result.set).text());
    } catch (const std::domain_error&) {  // numbers of too many bits: a stranger's file
      result.motions.emplace_back();
    }
  }
}

std::string motion_sentence(const Result& result, std::size_t motion) {
  const SelfMotionRecord& record = result.cover.self_motions[motion];
  std::string text = motion < result.motions.size() ? result.motions[motion] : "";
  const bool still = text.starts_with("no coordinate moves");
  if (text.empty()) text = joined(record.relations, [&](const Polynomial& f) { return relation_text(result, f); });
  return fmt::format("{} of dimension {}: {}", still ? "a set of kernel vectors" : "a self-motion", record.dimension, text);
}

}  // namespace corank::result
