#include "corank/certify/distance.h"

#include <cmath>

#include "corank/core/check.h"
#include "corank/core/closest_points.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

using FormOfPoint = std::array<AffineForm, 3>;
using Offsets = std::span<const Interval>;

class DistanceProof {
 public:
  DistanceProof(const DistanceTest& test, const FormOfVariable& form, Offsets offsets)
      : offsets_(offsets), least_(test.least.enclose()) {
    for (std::size_t b = 0; b < 2; ++b)
      for (const std::array<MatrixEntry, 3>& p : test.hulls[b]) {
        FormOfPoint& forms = points_[b].emplace_back();
        for (std::size_t i = 0; i < 3; ++i)
          forms[i] = p[i].variable >= 0 ? form(p[i].variable) : AffineForm{p[i].number.enclose(), no_slopes()};
      }
  }

  Standing run() {
    PointsOfBodies middle = middles([](const AffineForm& f) { return f.constant.mid(); });
    for (const auto& body : middle)
      for (const auto& p : body)
        for (const double x : p)
          if (!std::isfinite(x)) return Standing::open;
    closest_ = closest_points(middle);
    for (const double x : closest_.direction)
      if (!std::isfinite(x)) return Standing::open;
    if (is_near()) return Standing::violated;
    std::vector<PointsOfBodies> slopes;
    for (std::size_t k = 0; k < offsets_.size(); ++k)
      slopes.push_back(middles([k](const AffineForm& f) { return f.slopes[k].mid(); }));
    return is_apart(turn_of_direction(middle, closest_, slopes)) ? Standing::satisfied : Standing::open;
  }

 private:
  std::vector<Interval> no_slopes() const { return std::vector<Interval>(offsets_.size()); }

  template <typename Middle>
  PointsOfBodies middles(const Middle& of) const {
    PointsOfBodies result;
    for (std::size_t b = 0; b < 2; ++b)
      for (const FormOfPoint& p : points_[b]) result[b].push_back({of(p[0]), of(p[1]), of(p[2])});
    return result;
  }

  bool is_apart(const std::vector<std::array<double, 3>>& turns) const {
    FormOfPoint e;
    AffineForm square_of_e{Interval(), no_slopes()};
    for (std::size_t i = 0; i < 3; ++i) {
      e[i] = {closest_.direction[i], no_slopes()};
      for (std::size_t k = 0; k < turns.size(); ++k) e[i].slopes[k] = std::isfinite(turns[k][i]) ? turns[k][i] : 0.0;
      square_of_e.add(1.0, product(e[i], e[i], offsets_));
    }
    const std::optional<Interval> norm = square_root(square_of_e.range(offsets_));
    if (!norm || !norm->is_bounded()) return false;
    const double wanted = (least_ * Interval(norm->hi())).hi();
    for (const FormOfPoint& a : points_[0])
      for (const FormOfPoint& b : points_[1]) {
        AffineForm along{Interval(), no_slopes()};
        for (std::size_t i = 0; i < 3; ++i) {
          AffineForm difference = a[i];
          difference.add(-1.0, b[i]);
          along.add(1.0, product(e[i], difference, offsets_));
        }
        if (!(wanted > 0 && along.range(offsets_).lo() >= wanted)) return false;  // e = 0 separates nothing
      }
    return true;
  }

  bool is_near() const {
    FormOfPoint v;
    for (AffineForm& component : v) component = {Interval(), no_slopes()};
    for (std::size_t b = 0; b < 2; ++b) {
      Interval sum;
      for (const double w : closest_.weights[b]) {
        if (!(w >= 0) || !std::isfinite(w)) return false;
        sum += Interval(w);
      }
      for (std::size_t i = 0; i < points_[b].size(); ++i) {
        if (closest_.weights[b][i] == 0) continue;
        const std::optional<Interval> share = divide(Interval(closest_.weights[b][i]), sum, Interval(0.0, 1.0));
        if (!share) return false;
        for (std::size_t k = 0; k < 3; ++k) v[k].add(b == 0 ? *share : -*share, points_[b][i][k]);
      }
    }
    AffineForm along{Interval(), no_slopes()};
    Interval length, across;
    for (std::size_t k = 0; k < 3; ++k) {
      along.add(closest_.direction[k], v[k]);
      length += square(Interval(closest_.direction[k]));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      AffineForm rest = v[k];
      rest.add(-closest_.direction[k], along);
      across += square(rest.range(offsets_));
    }
    const Interval all = square(along.range(offsets_)) * (Interval(2.0) - length) + across;
    return all.hi() < square(least_).lo();
  }

  const Offsets offsets_;
  const Interval least_;
  std::array<std::vector<FormOfPoint>, 2> points_;
  ClosestPoints closest_;
};

}  // namespace

Standing standing(const DistanceTest& test, const FormOfVariable& form, Offsets offsets) {
  CORANK_CHECK(UpwardRounding::active());
  return DistanceProof(test, form, offsets).run();
}

}  // namespace corank::certify
