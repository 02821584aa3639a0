#include "corank/analyze/paths/tube_builder.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "corank/core/dense.h"
#include "corank/core/rounding.h"

namespace corank::analyze {
namespace {

constexpr int kMostHalvings = 26;
constexpr double kLeastRadius = 1e-9;
constexpr double kShortest = 1e-7;  // step

// cos 1, cos 2 …
Eigen::MatrixXd generic(Eigen::Index rows, Eigen::Index columns) {
  return Eigen::VectorXd::LinSpaced(rows * columns, 1, static_cast<double>(rows * columns))
      .array()
      .cos()
      .matrix()
      .reshaped(rows, columns);
}

}  // namespace

TubeBuilder::TubeBuilder(const PathSpace& space)
    : space_(space), prover_(space.system(), space.matrices(), space.ranks(), space.distances()) {}

// The rows of T follow each other along the path as nearly as tangent spaces allow: the rotation of the basis that is
// nearest to the basis before, by the singular vectors of their products; of the first node to a generic one, so that
// roundings, which decide which basis the tangent space gets, change little.
std::optional<TubeBuilder::Node> TubeBuilder::node(const PathSpace::Point& x, const Node* before) {
  Node result;
  result.point = x;
  const Eigen::MatrixXd basis = space_.tangent(x);
  if (!basis.allFinite() || basis.cols() != space_.dimension()) return std::nullopt;
  const SingularValueDecomposition svd = decompose((before ? before->across : generic(basis.cols(), basis.rows())) * basis);
  result.across = svd.u * svd.v.transpose() * basis.transpose();
  const Eigen::VectorXd c = result.across * x;
  for (Eigen::Index i = 0; i < result.across.rows(); ++i)
    for (Eigen::Index j = 0; j < result.across.cols(); ++j)
      result.node.rows.push_back(result.across(i, j) / space_.sizes()[j]);
  result.node.values = {c.data(), c.data() + c.size()};
  const UpwardRounding rounding;
  const auto box = prover_.node(result.node.rows, result.node.values, space_.values(x));
  if (!box) return std::nullopt;
  result.node.box = *box;
  return result;
}

// The node at b is made anew from the one that comes before it: over a long way their bases may have turned against each
// other.
std::optional<TubeBuilder::Node> TubeBuilder::connect(Tube& tube, const Node& a, const PathSpace::Point& b, double radius,
                                                      int depth, const solve::Control& control) {
  const double length = (b - a.point).norm();
  if (hope_ == 0 || length <= hope_) {
    if (std::optional<Node> end = node(b, &a)) {
      const UpwardRounding rounding;
      const auto piece = prover_.piece(a.node, end->node);
      if (piece && prover_.is_free(*piece, radius, space_.sizes())) {
        hope_ = std::max(hope_, 2 * length);
        tube.nodes.push_back(end->node);
        tube.pieces.push_back(*piece);
        tube.radii.push_back(radius);
        return end;
      }
    }
  }
  if (depth >= kMostHalvings || length < kShortest || control.ended()) return std::nullopt;
  hope_ = std::min(hope_ == 0 ? length : hope_, 0.75 * length);
  PathSpace::Point x = 0.5 * (a.point + b);
  if (!space_.project(x, length)) return std::nullopt;
  const std::optional<Node> middle = connect(tube, a, x, radius, depth + 1, control);
  return middle ? connect(tube, *middle, b, radius, depth + 1, control) : std::nullopt;
}

// By doubling and halving; a hundredth of it is given away.
double TubeBuilder::widest_radius(const Box& piece, double known, double guess) const {
  const auto is_free = [&](double r) { return prover_.is_free(piece, r, space_.sizes()); };
  double low = known, high = std::max(guess, 2 * known);
  if (is_free(high)) {
    while (low = high, high *= 2, high < 1e6 && is_free(high)) {
    }
  } else {
    while (high > 4 * low && !is_free(high)) high /= 2;
    if (is_free(high)) low = high, high *= 2;
  }
  for (int k = 0; k < 6; ++k) {
    const double middle = std::sqrt(low * high);
    (is_free(middle) ? low : high) = middle;
  }
  return low;
}

TubeBuilder::Outcome TubeBuilder::build(const Box& from, const Points& points, const Box& to, double radius,
                                        const solve::Control& control) {
  Tube tube;
  tube.sizes = space_.sizes();
  hope_ = 0;
  radius = std::max(radius, kLeastRadius);
  std::optional<Node> last = node(points.front(), nullptr);
  if (!last) return {};
  tube.nodes.push_back(last->node);
  for (std::size_t k = 1; k < points.size(); ++k) {
    // Points that are one but for rounding add nothing.
    if (k + 1 < points.size() && (points[k] - last->point).norm() < 10 * kShortest) continue;
    last = connect(tube, *last, points[k], radius, 0, control);
    if (!last) return {std::nullopt, k - 1};
  }
  const UpwardRounding rounding;
  double guess = radius;
  for (std::size_t k = 0; k < tube.pieces.size() && !control.ended(); ++k)
    guess = tube.radii[k] = widest_radius(tube.pieces[k], radius, guess);
  const auto about = [&](std::size_t k) {
    Box box = tube.pieces[k];
    for (std::size_t j = 0; j < box.size(); ++j) {
      const double room = tube.radii[k] * tube.sizes[j] / 2;
      box[j] = Interval(box[j].lo() - room, box[j].hi() + room);
    }
    return box;
  };
  if (!prover_.joins(from, tube.nodes.front().box, about(0))) return {std::nullopt, 0};
  if (!prover_.joins(to, tube.nodes.back().box, about(tube.pieces.size() - 1))) return {std::nullopt, points.size() - 2};
  return {std::move(tube), 0};
}

TubeBuilder::Points TubeBuilder::shortcut(const Points& points, double share, const solve::Control& control) const {
  double least = 1, length = 0;
  for (const auto& x : points) least = std::min(least, space_.state(x).margin);
  for (std::size_t k = 1; k < points.size(); ++k) length += (points[k] - points[k - 1]).norm();
  const std::vector<int> signs = space_.state(points.front()).signs;
  const double step = std::max(length / 200, 1e-3);
  const auto accept = [&](const PathSpace::Point& x) { return space_.admits(x, signs, share * least); };
  Points result{points.front()};
  for (std::size_t at = 0; at + 1 < points.size();) {
    std::size_t next = points.size() - 1;
    // The farthest that is seen, by halving the way: what is seen need not be monotone.
    while (next > at + 1 && !control.ended() && !follow(points[at], points[next], step, accept)) next = at + (next - at) / 2;
    if (control.ended()) next = at + 1;
    result.push_back(points[next]);
    at = next;
  }
  return result;
}

}  // namespace corank::analyze
