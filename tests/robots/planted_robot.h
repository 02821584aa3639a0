// Random robots, built about a configuration that is known exactly: rotations by rational quaternions, rational points.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "corank/kinematics/equations/assembly.h"
#include "corank/tests/robots/numeric_mechanism.h"

namespace corank::test {

using kinematics::Joint;
using kinematics::JointKind;
using symbolic::Expression;

struct Rational {
  std::int64_t numerator = 0, denominator = 1;
  Rational(std::int64_t n = 0, std::int64_t d = 1) : numerator(n), denominator(d) {  // NOLINT: a number is one
    const std::int64_t g = std::gcd(n, d) * (d < 0 ? -1 : 1);
    numerator /= g;
    denominator /= g;
  }
  friend Rational operator+(Rational a, Rational b) {
    return {a.numerator * b.denominator + b.numerator * a.denominator, a.denominator * b.denominator};
  }
  friend Rational operator-(Rational a, Rational b) { return a + Rational(-b.numerator, b.denominator); }
  friend Rational operator*(Rational a, Rational b) { return {a.numerator * b.numerator, a.denominator * b.denominator}; }
  friend bool operator==(Rational a, Rational b) = default;
  double value() const { return static_cast<double>(numerator) / static_cast<double>(denominator); }
  Expression exact() const { return Expression(std::to_string(numerator)) / Expression(std::to_string(denominator)); }
};

using Point = std::array<Rational, 3>;
using Rotation = std::array<Point, 3>;  // row by row

inline Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point operator*(Rational s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Point& a, const Point& b) {
  return a[0].value() * b[0].value() + a[1].value() * b[1].value() + a[2].value() * b[2].value();
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Point transposed(const Rotation& r, const Point& a) {
  Point result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) result[i] = result[i] + r[k][i] * a[k];
  return result;
}
inline Point column(const Rotation& r, std::size_t i) { return {r[0][i], r[1][i], r[2][i]}; }
inline kinematics::Vector exact(const Point& a) { return {a[0].exact(), a[1].exact(), a[2].exact()}; }

/// By which a turns to b about the unit vector w, to both of which it is perpendicular or not: what is across counts.
inline double angle_between(const Point& w, const Point& a, const Point& b) {
  return std::atan2(dot(w, cross(a, b)), dot(a, b) - dot(a, w) * dot(b, w));
}

class Planted {
 public:
  Planted(unsigned seed, const std::vector<JointKind>& kinds, bool dressed) : random_(seed) {
    const std::size_t n = kinds.size();
    rotations.resize(n);
    origins.resize(n);
    rotations[0] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (std::size_t i = 1; i < n; ++i) {
      origins[i] = point();
      rotations[i] = kinds[i - 1] == JointKind::prismatic ? rotations[i - 1] : rotation();
    }
    for (std::size_t i = 0; i < n; ++i) robot.link("link" + std::to_string(i));
    for (std::size_t i = 0; i < n; ++i) add(kinds[i], i, (i + 1) % n, dressed);
  }

  /// A ring of bodies in a plane, with rods between some of them, of mobility 0 or 1.
  static Planted planar(unsigned seed) {
    Planted planted(seed);
    const int bodies = planted.number(3, 6), rods = std::max(0, bodies - 3 - planted.number(0, 1));
    for (int i = 0; i < bodies; ++i)
      planted.add_link(i == 0 ? planted.upright(0) : planted.upright(planted.number(-4, 4)), true);
    for (std::size_t i = 0; i < planted.rotations.size(); ++i)
      planted.hinge(i, (i + 1) % planted.rotations.size(), planted.planar_point(), {0, 0, 1}, 0);
    for (int k = 0; k < rods; ++k) {
      const int a = planted.number(0, bodies - 1), b = (a + planted.number(1, bodies - 1)) % bodies;
      planted.rod("rod" + std::to_string(k), static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    }
    return planted;
  }

  /// A ring of bodies, of five with a chord, about one point, from which joints are away; of mobility 0 or 1.
  static Planted spherical(unsigned seed) {
    Planted planted(seed);
    const int bodies = planted.number(3, 5);
    for (int i = 0; i < bodies; ++i) planted.add_link(i == 0 ? planted.upright(0) : planted.rotation(), false);
    const Point centre = planted.point();
    std::vector<Point> axes;  // no two alike: hinges on one line may ask for nothing
    const auto hinge = [&](std::size_t a, std::size_t b) {
      Point axis = column(planted.rotation(), 0);
      const auto is_along = [&](const Point& other) { return dot(cross(axis, other), cross(axis, other)) == 0; };
      while (std::any_of(axes.begin(), axes.end(), is_along)) axis = column(planted.rotation(), 0);
      axes.push_back(axis);
      planted.hinge(a, b, centre + Rational(planted.number(-4, 4), 2) * axis, axis, planted.number(-4, 4));
    };
    for (std::size_t i = 0; i < planted.rotations.size(); ++i) hinge(i, (i + 1) % planted.rotations.size());
    if (bodies == 5) hinge(0, 2);
    return planted;
  }

  /// A ring in space whose joints have six freedoms together.
  static Planted spatial(unsigned seed) {
    std::mt19937 random(seed);
    std::vector<JointKind> kinds;
    for (int left = 6, balls = 0; left > 0;) {
      static constexpr std::pair<JointKind, int> kFreedoms[] = {
          {JointKind::revolute, 1},    {JointKind::revolute, 1},  {JointKind::prismatic, 1}, {JointKind::universal, 2},
          {JointKind::cylindrical, 2}, {JointKind::spherical, 3}, {JointKind::slot, 4}};
      const auto [kind, freedom] = kFreedoms[random() % 7];
      const bool is_ball = kind == JointKind::spherical || kind == JointKind::slot;
      if (freedom > left || (is_ball && balls++ > 0)) continue;  // two balls leave a turn between them
      // A sliding joint that would have to be made a cylindrical one has a freedom more.
      if (kind == JointKind::prismatic && left == 1) continue;
      kinds.push_back(kind);
      left -= freedom;
    }
    return {seed, kinds, false};
  }

  /// Links hung on each other at random, and up to two joints or rods more that close loops; in a plane or in space, of all
  /// kinds of joints, some with ranges, some actuated, with an output or none.
  static Planted tangled(unsigned seed) {
    Planted planted(seed);
    const bool flat = planted.number(0, 1) == 0;
    const int links = planted.number(2, 5), loops = planted.number(0, 2);
    planted.add_link(upright(0), flat);
    for (int i = 1; i < links; ++i) {
      const auto on = static_cast<std::size_t>(planted.number(0, i - 1));
      const JointKind kind = planted.any_kind(flat);
      planted.add_link(flat ? upright(planted.number(-4, 4)) : planted.rotation(), flat);
      if (kinematics::keeps_orientation(kind)) planted.rotations.back() = planted.rotations[on];
      planted.tie(kind, on, static_cast<std::size_t>(i), flat);
    }
    for (int k = 0; k < loops; ++k) {
      const auto a = static_cast<std::size_t>(planted.number(0, links - 1)),
                 b = (a + static_cast<std::size_t>(planted.number(1, links - 1))) % static_cast<std::size_t>(links);
      planted.tie(planted.any_kind(flat), a, b, flat);
    }
    planted.ask();
    return planted;
  }

  /// A platform that two rods tie to the ground and two to each of two cranks, which a rod holds; of mobility 0.
  static Planted on_two_rods_each(unsigned seed) {
    Planted planted(seed);
    planted.add_link(upright(0), false);
    for (std::size_t crank = 1; crank <= 2; ++crank) {
      planted.add_link(planted.rotation(), false);
      planted.hinge(0, crank, planted.point(), column(planted.rotation(), 0), 0);
    }
    planted.add_link(planted.rotation(), false);
    for (const std::size_t carrier : {0, 0, 1, 1, 2, 2})  // some from the platform
      planted.number(0, 2) > 0 ? planted.tie(JointKind::distance, carrier, 3, false)
                               : planted.tie(JointKind::distance, 3, carrier, false);
    for (const std::size_t crank : {1, 2}) planted.tie(JointKind::distance, 0, crank, false);
    return planted;
  }

  kinematics::Robot robot;
  std::vector<Rotation> rotations;  ///< of the links
  std::vector<Point> origins;
  std::map<std::string, double> coordinates;  ///< of joints, by the names that coordinates have where there are such

 private:
  explicit Planted(unsigned seed) : random_(seed) {}

  void add_link(const Rotation& turned, bool in_plane) {
    robot.link("link" + std::to_string(rotations.size()));
    origins.push_back(rotations.empty() ? Point{} : in_plane ? planar_point() : point());
    rotations.push_back(turned);
  }
  /// A revolute joint; its points `along` halves away on the axis, in its links' coordinates.
  void hinge(std::size_t from, std::size_t to, const Point& at, const Point& axis, int along) {
    Joint& j = robot.joints.emplace_back();
    j.name = "J" + std::to_string(robot.joints.size());
    const Point there = at + Rational(along, 2) * axis;
    j.ends = {end(from, there, axis, {}), end(to, there, axis, {})};
  }
  JointKind any_kind(bool flat) {
    using enum JointKind;
    static constexpr JointKind kFlat[] = {revolute, revolute, revolute,          revolute,      prismatic, prismatic,
                                          fixed,    distance, distance_variable, parallelogram, slot};
    static constexpr JointKind kInSpace[] = {revolute,  revolute,          revolute,      prismatic,     cylindrical,
                                             universal, spherical,         spherical,     planar,        fixed,
                                             distance,  distance,          revolute,      revolute,      prismatic,
                                             fixed,     distance_variable, parallelogram, universal_rod, slot};
    return flat ? kFlat[number(0, 10)] : kInSpace[number(0, 19)];
  }
  /// A joint of this kind between two links where they are, or of one that does not keep their frames parallel where they
  /// are not.
  void tie(JointKind kind, std::size_t from, std::size_t to, bool flat) {
    Joint& j = robot.joints.emplace_back();
    j.name = "J" + std::to_string(robot.joints.size());
    if (kinematics::keeps_orientation(kind) && rotations[from] != rotations[to]) kind = JointKind::revolute;
    if (kind == JointKind::revolute && !flat && number(0, 1) == 0) kind = JointKind::spherical;
    j.kind = kind;
    const Rotation frame = flat ? upright(number(-4, 4)) : rotation();
    const Point along = flat ? Point{0, 0, 1} : column(frame, 2), across = column(frame, 0), third = column(frame, 1);
    const Point at = flat ? planar_point() : point();
    const Rational way(number(1, 6), 2);
    const auto sometimes = [this] { return number(0, 3) == 0; };
    switch (kind) {
      case JointKind::revolute:
        j.ends = {end(from, at, along, across), end(to, at, along, third)};
        if (sometimes()) j.ranges = {range(angle_between(along, across, third))};
        j.actuated = sometimes();
        break;
      case JointKind::prismatic:
        j.ends = {end(from, at, across, {}), end(to, at + way * across, across, {})};
        j.ranges = {kinematics::Range{(way - 8).exact(), (way + 8).exact()}};
        j.actuated = sometimes();
        break;
      case JointKind::slot:
        j.ends = {end(from, at, across, {}), end(to, at + way * across, {}, {})};
        j.ranges = {kinematics::Range{(way - 8).exact(), (way + 8).exact()}};
        j.actuated = sometimes();
        break;
      case JointKind::parallelogram:
        j.ends = {end(from, at, along, {}), end(to, at + way * across, along, {})};
        j.length = way.exact();
        j.actuated = sometimes();
        break;
      case JointKind::cylindrical: j.ends = {end(from, at, along, {}), end(to, at + way * along, along, {})}; break;
      case JointKind::universal: j.ends = {end(from, at, along, {}), end(to, at, across, {})}; break;
      case JointKind::planar: j.ends = {end(from, at, along, {}), end(to, at + way * across, along, {})}; break;
      case JointKind::fixed: {
        j.ends = {end(from, {}, {}, {}), end(to, {}, {}, {})};
        j.pose.translation = exact(transposed(rotations[from], origins[to] - origins[from]));
        for (std::size_t c = 0; c < 3; ++c) {
          const Point image = transposed(rotations[from], column(rotations[to], c));
          for (std::size_t r = 0; r < 3; ++r) j.pose.rotation[r][c] = image[r].exact();
        }
        break;
      }
      case JointKind::distance:
      case JointKind::distance_variable: {
        Point far = at;
        while (dot(far - at, far - at) == 0) far = flat ? planar_point() : point();
        j.ends = {end(from, at, {}, {}), end(to, far, {}, {})};
        const Point gap = far - at;
        const double length = std::sqrt(dot(gap, gap));
        if (kind == JointKind::distance) {
          j.length = symbolic::sqrt((gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2]).exact());
        } else {
          j.ranges = {kinematics::Range{Rational(static_cast<int>(50 * length), 100).exact(),
                                        Rational(static_cast<int>(200 * length) + 1, 100).exact()}};
          j.actuated = sometimes();
        }
        break;
      }
      case JointKind::universal_rod: {
        // The axes in a plane with the rod.
        const Point far = at + way * across;
        j.ends = {end(from, at, third + across, {}), end(to, far, third - Rational(number(0, 3)) * across, {})};
        j.ranges = {kinematics::Range{"1/100", 20}};
        j.actuated = sometimes();
        break;
      }
      case JointKind::spherical: j.ends = {end(from, at, {}, {}), end(to, at, {}, {})}; break;
    }
  }
  /// Where a point of the last link is, or nothing.
  void ask() {
    if (number(0, 1) == 0) return;
    kinematics::Output& output = robot.outputs.emplace_back();
    output.name = "out";
    output.link = robot.links.size() - 1;
    output.point = exact(planar_point());
  }
  void rod(const std::string& name, std::size_t from, std::size_t to) {
    Joint& j = robot.joints.emplace_back();
    j.name = name;
    j.kind = JointKind::distance;
    const Point a = planar_point();
    Point b = a;
    while (dot(b - a, b - a) == 0) b = planar_point();
    j.ends = {end(from, a, {}, {}), end(to, b, {}, {})};
    const Point way = b - a;
    j.length = symbolic::sqrt((way[0] * way[0] + way[1] * way[1]).exact());
  }
  /// About z, by a rational cosine and sine.
  static Rotation upright(int half_tangent) {
    const int m = 3, n = half_tangent, square = m * m + n * n;
    const Rational c(m * m - n * n, square), s(2 * m * n, square);
    return {{{c, Rational(0) - s, 0}, {s, c, 0}, {0, 0, 1}}};
  }
  Point planar_point() { return {Rational(number(-8, 8), 4), Rational(number(-8, 8), 4), 0}; }

  int number(int lo, int hi) { return std::uniform_int_distribution<>(lo, hi)(random_); }
  Point point() { return {Rational(number(-4, 4), 2), Rational(number(-4, 4), 2), Rational(number(-4, 4), 2)}; }
  Rotation rotation() {
    int q[4], square = 0;
    while (square == 0) {
      for (int& c : q) c = number(-2, 2);
      square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    }
    const auto [w, x, y, z] = std::tie(q[0], q[1], q[2], q[3]);
    const auto over = [&](int a) { return Rational(a, square); };
    return {{{over(w * w + x * x - y * y - z * z), over(2 * (x * y - w * z)), over(2 * (x * z + w * y))},
             {over(2 * (x * y + w * z)), over(w * w - x * x + y * y - z * z), over(2 * (y * z - w * x))},
             {over(2 * (x * z - w * y)), over(2 * (y * z + w * x)), over(w * w - x * x - y * y + z * z)}}};
  }
  kinematics::JointEnd end(std::size_t link, const Point& at, const Point& axis, const std::optional<Point>& zero) {
    kinematics::JointEnd e;
    e.link = link;
    e.point = exact(transposed(rotations[link], at - origins[link]));
    e.axis = exact(transposed(rotations[link], axis));
    if (zero) e.zero = exact(transposed(rotations[link], *zero));
    return e;
  }
  /// About a value, which it holds: not in its middle.
  kinematics::Range range(double value) {
    const auto rounded = static_cast<std::int64_t>(std::floor(value * 100));
    return {Rational(rounded - number(10, 60), 100).exact(), Rational(rounded + number(10, 60), 100).exact()};
  }

  void add(JointKind kind, std::size_t from, std::size_t to, bool dressed) {
    Joint j;
    j.name = "J" + std::to_string(from);
    j.kind = kind;
    // A prismatic joint keeps its frames parallel: that of the ground has to be met, else it turns as well.
    if (kind == JointKind::prismatic)
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
          if (rotations[from][r][c].value() != rotations[to][r][c].value()) j.kind = JointKind::cylindrical;
    const Rotation frame = rotation(), zeros = rotation();
    const Point at = point(), axis = column(frame, 0);
    const auto with_range = [&](double value) {
      return dressed && number(0, 2) == 0 ? std::optional(range(value)) : std::nullopt;
    };
    const Rational way(number(-6, 6), 2);
    switch (j.kind) {
      case JointKind::revolute:
      case JointKind::cylindrical: {
        // Zeros askew to the axis: what is across it counts. A direction along it has none.
        Point a = column(frame, 1) + Rational(1, 3) * axis, b = column(zeros, 1);
        if (std::fabs(dot(b, axis)) > 0.9) b = column(zeros, 2);
        const bool slides = j.kind == JointKind::cylindrical;
        const Point far = slides ? at + way * axis : at;
        j.ends = {end(from, at, axis, a), end(to, far, axis, b)};
        const double angle = angle_between(axis, a, b);
        j.ranges = {with_range(angle)};
        if (slides) {
          coordinates[j.name + "_way"] = way.value();
          j.ranges.push_back(kinematics::Range{(way - 20).exact(), (way + 20).exact()});
        } else {
          coordinates[j.name] = angle;
          j.actuated = dressed && number(0, 3) == 0;
        }
        break;
      }
      case JointKind::prismatic:
      case JointKind::slot:
        j.ends = {end(from, at, axis, {}), end(to, at + way * axis, j.kind == JointKind::slot ? Point{} : axis, {})};
        coordinates[j.name] = way.value();
        j.ranges = {kinematics::Range{(way - 20).exact(), (way + 20).exact()}};
        j.actuated = dressed && number(0, 3) == 0;
        break;
      case JointKind::universal: {
        const Point second = column(frame, 1);
        Rotation other = rotation();
        // Across the axes: zero 0 across the first, zero 1 across the second.
        Point a = cross(axis, column(other, 0)), b = cross(second, column(other, 1));
        if (dot(a, a) < 0.1) a = cross(axis, column(other, 1));
        if (dot(b, b) < 0.1) b = cross(second, column(other, 2));
        j.ends = {end(from, at, axis, a), end(to, at, second, b)};
        j.ranges = {with_range(angle_between(axis, a, second)), with_range(angle_between(second, axis, b))};
        break;
      }
      default: {
        const Point other = column(zeros, 0);
        j.ends = {end(from, at, axis, {}), end(to, at, other, {})};
        if (dressed && number(0, 2) == 0) {
          const double between = std::acos(std::clamp(dot(axis, other), -1.0, 1.0));
          j.ranges = {kinematics::Range{Expression(0), Rational(static_cast<int>(between * 100) + 20, 100).exact()}};
        }
      }
    }
    robot.joints.push_back(j);
  }

  std::mt19937 random_;
};

inline bool has_coordinate(const symbolic::Mechanism& mechanism, const Expression& e) {
  if (e.kind() == Expression::Kind::symbol) return mechanism.find_coordinate(e.name()) >= 0;
  return std::any_of(e.operands().begin(), e.operands().end(),
                     [&](const Expression& part) { return has_coordinate(mechanism, part); });
}

/// The mechanism's coordinates alone, with equations that put its links where they were planted.
inline symbolic::Mechanism where_planted(const Planted& planted, const kinematics::Assembly& assembly) {
  symbolic::Mechanism result("planted");
  for (const symbolic::Constant& c : assembly.mechanism.constants()) result.constant(c.name, c.value);
  for (const symbolic::Coordinate& c : assembly.mechanism.coordinates()) {
    if (c.kind == symbolic::CoordinateKind::angle) {
      result.angle(c.name);
    } else {
      result.length(c.name, Expression(-50), Expression(50));
    }
  }
  for (std::size_t l = 1; l < planted.rotations.size(); ++l)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto put = [&](const Expression& e, const Rational& value) {
        if (has_coordinate(result, e)) result.constrain(e == value.exact());
      };
      put(assembly.poses[l].origin[i], planted.origins[l][i]);
      for (std::size_t k = 0; k < 3; ++k) put(assembly.poses[l].rotation[i][k], planted.rotations[l][i][k]);
    }
  return result;
}

/// The planted configuration in all of the mechanism's variables.
inline std::optional<VectorXd> coordinates(const Planted& planted, const kinematics::Assembly& assembly) {
  const NumericMechanism poses(where_planted(planted, assembly));
  const System& system = poses.system();
  std::mt19937 random(7);
  for (int attempt = 0; attempt < 20; ++attempt) {
    VectorXd x = poses.random_point(random) / 5;
    std::vector<Eigen::Index> fixed;
    const auto fix = [&](int variable, double value) {
      x[variable] = value;
      fixed.push_back(variable);
    };
    for (const auto& [name, value] : planted.coordinates) {
      if (const int variable = system.find(name); variable >= 0) fix(variable, value);
      for (const Angle& a : system.angles) {
        if (a.name != name) continue;
        fix(a.cosine, std::cos(value));
        fix(a.sine, std::sin(value));
      }
    }
    if (const auto found = poses.solution(x, fixed)) return found;
  }
  return std::nullopt;
}

}  // namespace corank::test
