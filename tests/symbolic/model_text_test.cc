// A mechanism's text reads back as the same mechanism: the repository's models, and random ones.
#include "corank/symbolic/writing/printer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "corank/symbolic/model/model_file.h"

namespace corank::symbolic {
namespace {

using testing::HasSubstr;

bool same(const Expression& a, const Expression& b) { return same_tree(a, b); }
template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b);
bool same(const Constant& a, const Constant& b) { return a.name == b.name && same(a.value, b.value); }
bool same(const Coordinate& a, const Coordinate& b) {
  return a.name == b.name && a.kind == b.kind && a.auxiliary == b.auxiliary && a.has_range == b.has_range &&
         (!a.has_range || (same(a.lower, b.lower) && same(a.upper, b.upper)));
}
bool same(const Composite& a, const Composite& b) {
  return a.kind == b.kind && a.name == b.name && a.components == b.components;
}
bool same(const Constraint& a, const Constraint& b) {
  return a.relation.kind == b.relation.kind && same(a.relation.lhs, b.relation.lhs) &&
         same(a.relation.rhs, b.relation.rhs) && a.note == b.note;
}
bool same(const Rate& a, const Rate& b) { return a.name == b.name && a.kind == b.kind && a.role == b.role; }
bool same(const DrawingPoint& a, const DrawingPoint& b) {
  return a.name == b.name && same(a.coordinates, b.coordinates) && same(a.velocity, b.velocity);
}
bool same(const DrawingPart& a, const DrawingPart& b) {
  return a.kind == b.kind && a.points == b.points && a.colour == b.colour && same_tree(a.radius, b.radius);
}
template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const T& x, const T& y) { return same(x, y); });
}

void expect_round_trip(const Mechanism& m) {
  const std::string text = to_model(m);
  SCOPED_TRACE(text);
  const Mechanism back = parse_model(text, m.name() + ".cuik");
  EXPECT_EQ(back.name(), m.name());
  EXPECT_TRUE(same(back.constants(), m.constants()));
  EXPECT_TRUE(same(back.coordinates(), m.coordinates()));
  EXPECT_TRUE(same(back.composites(), m.composites()));
  EXPECT_TRUE(same(back.constraints(), m.constraints()));
  EXPECT_TRUE(same(back.implied(), m.implied()));
  EXPECT_TRUE(same(back.rates(), m.rates()));
  EXPECT_TRUE(same(back.velocity_equations(), m.velocity_equations()));
  EXPECT_EQ(back.inputs(), m.inputs());
  EXPECT_EQ(back.outputs(), m.outputs());
  EXPECT_EQ(back.drawing().unit, m.drawing().unit);
  EXPECT_TRUE(same(back.drawing().points, m.drawing().points));
  EXPECT_TRUE(same(back.drawing().parts, m.drawing().parts));
  EXPECT_EQ(to_model(back), text);
}

TEST(ModelText, OfEveryModelOfTheRepositoryReadsBack) {
  int models = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CORANK_SOURCE_DIR "/models")) {
    if (entry.path().extension() != ".cuik") continue;
    ++models;
    expect_round_trip(read_model(entry.path()));
  }
  EXPECT_GE(models, 5);
}

TEST(ModelText, IsReadable) {
  const Mechanism m = parse_model(
      "[CONSTANTS] l:=1\n[SYSTEM VARS] x:[-l,l] phi~ [-pi,pi] n:\n w@unit\n[DUMMY VARS] z:[0,1]\n[SYSTEM EQS] "
      "x=l*cos(phi);\n"
      "n=z; z=w_x;\n[RATES] v:output\nphidot~input a~passive; b~passive\n[VELOCITY EQS] v=-l*sin(phi)*phidot;\n[OUTPUTS] w\n"
      "[DRAWING] point P=(x,0) moves(v,0)\npoint Q2=(0,l)\nlink P Q2",
      "slide.cuik");
  EXPECT_EQ(to_model(m), R"(% slide

[CONSTANTS]
l := 1

[SYSTEM VARS]
x   : [-l, l]
phi ~ [-pi, pi]
n   :
w @ unit

[DUMMY VARS]
z   : [0, 1]

[SYSTEM EQS]
x = l*cos(phi);
n = z;
z = w_x;

[RATES]
v      : output
phidot ~ input
a      ~ passive
b      ~ passive

[VELOCITY EQS]
v = -l*sin(phi)*phidot;

[OUTPUTS]  w

[DRAWING]
point P  = (x, 0) moves (v, 0)
point Q2 = (0, l)
link P Q2
)");
  expect_round_trip(m);
}

TEST(ModelText, KeepsTheOrderOfConstraintsAroundDeclarationsThatImplySome) {
  Mechanism m("order");
  const Expression x = m.length("x", -1, 1);
  m.constrain(x == Expression("1/2"));
  const auto w = m.unit_vector("w");
  m.constrain(w[0] >= x);
  const auto r = m.rotation("R");
  m.mark_auxiliary(9);
  m.imply(r[2] == r[2]);
  m.inputs({w[0], w[1], w[2], x});
  m.outputs({Expression::symbol("R")});
  expect_round_trip(m);
  EXPECT_THAT(to_model(m), HasSubstr("[INPUTS]   w, x\n[OUTPUTS]  R\n"));
}

class RandomModel {
 public:
  explicit RandomModel(unsigned seed) : random_(seed) {}

  Mechanism make() {
    Mechanism m("random");
    for (int i = pick(0, 3); i > 0; --i) constants_.push_back(m.constant(name("c"), expression(constants_, 2)));
    for (int i = pick(2, 6); i > 0; --i) {
      declare(m);
      if (pick(0, 3) == 0) constrain(m);
    }
    constrain(m);
    if (pick(0, 1)) m.imply(expression(all(), 2) == expression(all(), 1));
    if (pick(0, 1)) choose(m);
    if (pick(0, 1)) give_rates(m);
    draw(m);
    return m;
  }

 private:
  int pick(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
  std::string name(const std::string& stem) { return stem + std::string(pick(0, 2), '_') + std::to_string(next_++); }
  std::vector<Expression> all() const {
    std::vector<Expression> names = constants_;
    names.insert(names.end(), coordinates_.begin(), coordinates_.end());
    return names;
  }

  Expression expression(const std::vector<Expression>& names, int depth) {
    if (depth == 0)
      return names.empty() || pick(0, 2) == 0 ? Expression(pick(-3, 12))
                                              : names[pick(0, static_cast<int>(names.size()) - 1)];
    const Expression a = expression(names, depth - 1), b = expression(names, depth - 1);
    switch (pick(0, 6)) {
      case 0: return a + b;
      case 1: return a - b;
      case 2: return a * b;
      case 3: return -a;
      case 4: return a / Expression("7/10");
      case 5: return pow(a, 2);
      default: return cos(a);
    }
  }

  void declare(Mechanism& m) {
    std::vector<Expression> added;
    switch (pick(0, 4)) {
      case 0: added = {m.angle(name("t"))}; break;
      case 1: added = {m.length(name("x"), expression(constants_, 1), expression(constants_, 2))}; break;
      case 2: added = {m.length_without_range(name("n"))}; break;
      case 3: added = m.unit_vector(name("w")); break;
      case 4: added = m.rotation(name("R")); break;
    }
    if (pick(0, 2) == 0) m.mark_auxiliary(added.size());
    coordinates_.insert(coordinates_.end(), added.begin(), added.end());
  }

  void constrain(Mechanism& m) {
    const Expression lhs = expression(all(), 3), rhs = expression(all(), 2);
    m.constrain(pick(0, 3) ? lhs == rhs : pick(0, 1) ? lhs <= rhs : lhs >= rhs);
  }

  void choose(Mechanism& m) {
    std::vector<Expression> inputs, outputs;
    for (const Expression& c : coordinates_)
      if (const int role = pick(0, 3); role < 2) (role ? inputs : outputs).push_back(c);
    std::shuffle(inputs.begin(), inputs.end(), random_);
    m.inputs(inputs);
    m.outputs(outputs);
  }

  void give_rates(Mechanism& m) {
    const auto equations = std::count_if(m.constraints().begin(), m.constraints().end(),
                                         [](const Constraint& c) { return c.relation.kind == Relation::Kind::equal; });
    const int mobility = static_cast<int>(m.coordinates().size()) - static_cast<int>(equations), rows = pick(1, 3);
    if (mobility + rows < 1) return;
    for (int i = 0; i < mobility + rows; ++i)
      rates_.push_back(m.rate(name("v"), pick(0, 1) ? CoordinateKind::angle : CoordinateKind::length,
                              std::array{Role::input, Role::output, Role::passive}[pick(0, 2)]));
    for (int i = 0; i < rows; ++i) m.velocity(linear() == (pick(0, 1) ? Expression(0) : linear()));
  }
  Expression linear() {
    Expression sum = expression(constants_, 1) * rates_[0];
    for (const Expression& r : rates_)
      if (pick(0, 1)) sum = pick(0, 1) ? sum + cos(expression(constants_, 1)) * r : sum - r / Expression("3/4");
    return sum;
  }

  void draw(Mechanism& m) {
    Drawing drawing;
    if (pick(0, 1)) drawing.unit = "mm";
    const std::size_t dimension = pick(2, 3);
    for (int i = pick(0, 5); i > 0; --i) {
      DrawingPoint p{name("P"), {}, {}};
      for (std::size_t k = 0; k < dimension; ++k) p.coordinates.push_back(expression(constants_, 2));
      if (!rates_.empty() && pick(0, 1))
        for (std::size_t k = 0; k < dimension; ++k) p.velocity.push_back(k == 0 ? Expression(0) : linear());
      drawing.points.push_back(p);
    }
    if (drawing.points.size() >= 3) {
      const std::vector<std::string> names{drawing.points[0].name, drawing.points[1].name, drawing.points[2].name};
      for (const auto kind : {DrawingPart::Kind::link, DrawingPart::Kind::slider, DrawingPart::Kind::platform})
        if (pick(0, 1)) drawing.parts.push_back({kind, names, {}});
    }
    m.drawing(drawing);
  }

  std::mt19937 random_;
  int next_ = 0;
  std::vector<Expression> constants_, coordinates_, rates_;
};

TEST(ModelText, OfRandomMechanismsReadsBack) {
  int valid = 0, with_rates = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    const Mechanism m = RandomModel(seed).make();
    try {
      m.validate();
    } catch (const ModelError&) {  // an angle outside sin and cos, a drawing's
      continue;
    }
    ++valid;
    with_rates += m.has_own_velocity_equation();
    expect_round_trip(m);
    if (HasFailure()) break;
  }
  EXPECT_GT(valid, 200);
  EXPECT_GT(with_rates, 50);
}

}  // namespace
}  // namespace corank::symbolic
