#include "corank/analyze/pieces/climb.h"

#include <Eigen/QR>
#include <algorithm>

#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"
#include "corank/solve/step/problem.h"

namespace corank::analyze {
namespace {

using certify::CompiledSystem;

// In units of the scales, at a point; nothing is proven by it.
class Gradient {
 public:
  Gradient(const CompiledSystem& compiled, const Box& at) : compiled_(compiled), at_(at) {}

  // Of a row of any kind.
  Eigen::VectorXd of(int row) const {
    std::vector<Interval> entries(compiled_.entries());
    compiled_.jacobian(row, at_, entries);
    Eigen::VectorXd result = Eigen::VectorXd::Zero(compiled_.variables());
    for (int e = compiled_.row_begin(row); e < compiled_.row_begin(row + 1); ++e)
      result[compiled_.column(e)] += entries[e].mid() * compiled_.scales()[compiled_.column(e)];
    return result;
  }

  // Along the set, of the sum of log(s·g) over all functions; nothing where one is not known to have its sign, or the set no
  // tangent space.
  std::optional<Eigen::VectorXd> of_barrier(const std::vector<int>& signs) const {
    const int m = compiled_.equations(), n = compiled_.variables();
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
    for (int k = 0; k < compiled_.values(); ++k) {
      const double g = signs[k] * compiled_.evaluate(compiled_.value_row(k), at_).mid();
      if (!(g > 0)) return std::nullopt;
      sum += signs[k] / g * of(compiled_.value_row(k));
    }
    Eigen::MatrixXd normals(n, m);
    for (int i = 0; i < m; ++i) normals.col(i) = of(i);
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(normals);
    if (qr.rank() < m || !sum.allFinite()) return std::nullopt;
    Eigen::VectorXd rotated = qr.householderQ().adjoint() * sum;
    rotated.head(m).setZero();
    return qr.householderQ() * rotated;
  }

 private:
  const CompiledSystem& compiled_;
  const Box& at_;
};

}  // namespace

std::optional<Climb> Climber::climb(const Box& from, std::vector<double> c, const std::vector<int>& signs,
                                    const Arrived& arrived) {
  CORANK_CHECK(UpwardRounding::active());
  constexpr int kMostSheets = 200;
  constexpr double kLargest = 0.25, kSmallest = 1e-10, kShare = 0.7, kSteep = 1e-6;
  const CompiledSystem& compiled = cells_.compiled();
  const auto as_box = [](const std::vector<double>& x) { return Box(x.begin(), x.end()); };
  Climb result;
  double radius = kLargest;
  while (result.sheets.size() < kMostSheets) {
    certify::Sheet sheet;
    for (radius = std::min(kLargest, 4 * radius); radius > kSmallest; radius /= 2) {
      sheet = test_.sheet_about(as_box(c), radius);
      if (sheet.proven && cells_.signs(sheet.region) == signs) break;
    }
    if (radius <= kSmallest) return std::nullopt;
    SheetBridge own{all_but(sheet.dependent, cells_.system().size()), std::move(sheet.region)};
    const auto meets = [&](const Box& box) {
      Box common = own.region;
      if (!intersect(common, box)) return false;
      std::optional<certify::Sheet> at = test_.sheet_in(common, as_box(c));
      if (!at) at = test_.sheet_in(common, common);  // as from a point on the border of a cell
      if (!at) return false;
      c = midpoint(at->image);
      result.links.push_back({c, all_but(at->dependent, cells_.system().size())});
      return true;
    };
    if (!meets(result.sheets.empty() ? from : result.sheets.back().region)) return std::nullopt;
    result.sheets.push_back(own);
    if (const std::optional<PieceLink> last = arrived(own)) {
      result.links.push_back(*last);
      return result;
    }
    const Box at = as_box(c);
    const std::optional<Eigen::VectorXd> gradient = Gradient(compiled, at).of_barrier(signs);
    if (!gradient || !(gradient->norm() * radius > kSteep)) return std::nullopt;
    const double step = kShare * radius / gradient->lpNorm<Eigen::Infinity>();
    for (std::size_t j = 0; j < c.size(); ++j)
      c[j] += step * (*gradient)[static_cast<Eigen::Index>(j)] * compiled.scales()[j];
  }
  return std::nullopt;
}

}  // namespace corank::analyze
