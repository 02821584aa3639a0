#include "corank/solve/exactness/corank_system.h"
#include "corank/core/dense.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <string>

namespace corank::solve {
namespace {

double value(const Polynomial& f, const std::vector<double>& x) {
  double sum = 0;
  for (const Monomial& m : f.monomials) {
    double product = m.enclosure.mid();
    for (const Factor& factor : m.factors) product *= std::pow(x[factor.variable], factor.power);
    sum += product;
  }
  return sum;
}

Eigen::MatrixXd values(const PolynomialMatrix& matrix, const std::vector<double>& x) {
  Eigen::MatrixXd m(matrix.rows, matrix.columns);
  for (int i = 0; i < matrix.rows; ++i)
    for (int j = 0; j < matrix.columns; ++j) m(i, j) = value(matrix.entries[i * matrix.columns + j], x);
  return m;
}

}  // namespace

std::vector<double> singular_values(const PolynomialMatrix& matrix, const std::vector<double>& x) {
  const Eigen::VectorXd s = corank::singular_values(values(matrix, x));
  std::vector<double> result(s.data(), s.data() + s.size());
  result.resize(matrix.columns, 0.0);  // a wide matrix has a kernel anyway
  return result;
}

CorankSystem corank_system(const System& system, const PolynomialMatrix& matrix, const std::vector<double>& x, int c) {
  const int k = matrix.columns;
  // Null vectors, then the combinations of them that are the unit vectors in c well-chosen entries.
  const Eigen::MatrixXd null = decompose(values(matrix, x)).v.rightCols(c);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> choice(null.transpose());
  std::vector<int> pivots;
  Eigen::MatrixXd at_pivots(c, c);
  for (int i = 0; i < c; ++i) {
    pivots.push_back(choice.colsPermutation().indices()(i));
    at_pivots.row(i) = null.row(pivots.back());
  }
  const Eigen::MatrixXd vectors = null * inverse(at_pivots);

  CorankSystem result;
  result.system.name = system.name + ", corank " + std::to_string(c);
  std::vector<int> index(system.variables.size(), -1);
  for (int j = 0; j < system.size(); ++j) {
    const Variable& v = system.variables[j];
    if (v.kind == VariableKind::kernel) continue;
    index[j] = result.system.size();
    result.configuration.push_back(j);
    result.system.variables.push_back(v);
    result.start.push_back(x[j]);
  }
  result.system.configuration_size = result.system.size();
  const auto renamed = [&](Monomial m) {
    for (Factor& factor : m.factors) factor.variable = index[factor.variable];
    return m;
  };
  for (const Polynomial& f : system.equations) {
    Polynomial g{{}, f.source};
    const bool of_configuration = std::ranges::all_of(f.monomials, [&](const Monomial& m) {
      return std::ranges::all_of(m.factors, [&](const Factor& factor) { return index[factor.variable] >= 0; });
    });
    if (!of_configuration) continue;
    for (const Monomial& m : f.monomials) g.monomials.push_back(renamed(m));
    result.system.equations.push_back(std::move(g));
  }
  for (int v = 0; v < c; ++v) {
    std::vector<int> entry(k, -1);  // variable of ξ_j; −1: a pivot
    for (int j = 0; j < k; ++j) {
      if (std::ranges::find(pivots, j) != pivots.end()) continue;
      entry[j] = result.system.size();
      result.system.variables.emplace_back("xi" + std::to_string(v + 1) + "_" + std::to_string(j + 1), VariableKind::kernel,
                                           -1000, 1000);
      result.start.push_back(vectors(j, v));
    }
    for (int i = 0; i < matrix.rows; ++i) {
      Polynomial g{{}, "kernel"};
      for (int j = 0; j < k; ++j) {
        const int variable = entry[j];
        if (variable < 0 && pivots[v] != j) continue;  // times 0
        for (const Monomial& m : matrix.entries[i * k + j].monomials) {
          Monomial term = renamed(m);
          if (variable >= 0) term.factors.push_back({variable, 1});
          g.monomials.push_back(std::move(term));
        }
      }
      if (!g.monomials.empty()) result.system.equations.push_back(std::move(g));
    }
  }
  return result;
}

}  // namespace corank::solve
