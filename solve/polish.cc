#include "corank/solve/polish.h"

#include <coin/IpIpoptApplication.hpp>
#include <coin/IpTNLP.hpp>

#include <algorithm>
#include <cmath>

#include "corank/certify/compiled_system.h"
#include "corank/core/nearest_rounding.h"
#include "corank/core/rounding.h"
#include "corank/solve/ipopt_lock.h"

namespace corank::solve {
namespace {

using Ipopt::Index;
using Ipopt::Number;

// ½‖F‖² with the Gauss–Newton Hessian JᵀJ, no constraints but the bounds.
class LeastSquares : public Ipopt::TNLP {
 public:
  LeastSquares(const certify::CompiledSystem& system, const Box& box, const Ended& ended)
      : system_(system), box_(box), ended_(ended) {}
  const std::vector<double>& solution() const { return solution_; }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian_entries, Index& hessian_entries, IndexStyleEnum& style) override {
    n = system_.variables();
    m = jacobian_entries = 0;
    hessian_entries = n * (n + 1) / 2;
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(Index n, Number* lower, Number* upper, Index, Number*, Number*) override {
    for (Index j = 0; j < n; ++j) {
      const Interval& side = box_[static_cast<std::size_t>(j)];
      const double margin = 0.5 * (side.hi() - side.lo()) + 1e-12;
      lower[j] = side.lo() - margin;
      upper[j] = side.hi() + margin;
    }
    return true;
  }
  bool get_starting_point(Index n, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    for (Index j = 0; j < n; ++j) x[j] = box_[static_cast<std::size_t>(j)].mid();
    return true;
  }
  bool eval_f(Index, const Number* x, bool, Number& value) override {
    value = 0;
    for (const double f : residual(x)) value += 0.5 * f * f;
    return std::isfinite(value);
  }
  bool eval_grad_f(Index n, const Number* x, bool, Number* gradient) override {
    const std::vector<double> f = residual(x), j = jacobian(x);
    std::fill(gradient, gradient + n, 0.0);
    for_each_entry([&](int row, int k) {
      gradient[system_.column(k)] += f[static_cast<std::size_t>(row)] * j[static_cast<std::size_t>(k)];
    });
    return all_finite(gradient, n);
  }
  bool eval_g(Index, const Number*, bool, Index, Number*) override { return true; }
  bool eval_jac_g(Index, const Number*, bool, Index, Index, Index*, Index*, Number*) override { return true; }
  bool eval_h(Index n, const Number* x, bool, Number factor, Index, const Number*, bool, Index, Index* rows, Index* columns,
              Number* values) override {
    Index entry = 0;
    if (!values) {
      for (Index a = 0; a < n; ++a)
        for (Index b = 0; b <= a; ++b) rows[entry] = a, columns[entry++] = b;
      return true;
    }
    const std::vector<double> j = jacobian(x);
    std::fill(values, values + n * (n + 1) / 2, 0.0);
    for (int row = 0; row < system_.equations(); ++row)
      for (int p = system_.row_begin(row); p < system_.row_begin(row + 1); ++p)
        for (int q = system_.row_begin(row); q < system_.row_begin(row + 1); ++q) {
          const Index a = system_.column(p), b = system_.column(q);
          if (b <= a)
            values[a * (a + 1) / 2 + b] += factor * j[static_cast<std::size_t>(p)] * j[static_cast<std::size_t>(q)];
        }
    return all_finite(values, n * (n + 1) / 2);
  }
  bool intermediate_callback(Ipopt::AlgorithmMode, Index, Number, Number, Number, Number, Number, Number, Number, Number,
                             Index, const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    return !is_over(ended_);
  }
  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number*, const Number*, Index, const Number*,
                         const Number*, Number, const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    solution_.assign(x, x + n);
  }

 private:
  // Ipopt's linear solver writes past its memory where it meets infinities.
  static bool all_finite(const Number* x, Index n) {
    return std::all_of(x, x + n, [](Number a) { return std::isfinite(a); });
  }
  template <class Visit>
  void for_each_entry(Visit visit) const {
    for (int row = 0; row < system_.equations(); ++row)
      for (int k = system_.row_begin(row); k < system_.row_begin(row + 1); ++k) visit(row, k);
  }
  std::vector<double> residual(const Number* x) const {
    const UpwardRounding rounding;
    std::vector<double> f;
    for (int row = 0; row < system_.equations(); ++row) f.push_back(system_.evaluate_at(row, x).mid());
    return f;
  }
  std::vector<double> jacobian(const Number* x) const {
    std::vector<double> j(static_cast<std::size_t>(system_.entries()));
    system_.approximate_jacobian(x, j.data());
    return j;
  }

  const certify::CompiledSystem& system_;
  const Box& box_;
  const Ended& ended_;
  std::vector<double> solution_;
};

}  // namespace

std::optional<std::vector<double>> polish(const System& system, const Box& box, const Ended& ended) {
  const certify::CompiledSystem compiled(system);
  const NearestRounding nearest;
  const IpoptLock lock;
  const Ipopt::SmartPtr<LeastSquares> problem = new LeastSquares(compiled, box, ended);
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt = IpoptApplicationFactory();
  ipopt->Options()->SetIntegerValue("print_level", 0);
  ipopt->Options()->SetStringValue("sb", "yes");  // no banner
  ipopt->Options()->SetNumericValue("tol", 1e-14);
  ipopt->Options()->SetNumericValue("bound_relax_factor", 0);
  ipopt->Options()->SetIntegerValue("max_iter", 200);
  const bool ready = ipopt->Initialize("") == Ipopt::Solve_Succeeded;  // reads no options file
  if (ready) ipopt->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(Ipopt::GetRawPtr(problem)));
  if (problem->solution().empty()) return std::nullopt;
  return problem->solution();
}

}  // namespace corank::solve
