#include "corank/solve/minimum.h"

#include <coin/IpIpoptApplication.hpp>
#include <coin/IpTNLP.hpp>

#include <algorithm>
#include <cmath>

#include "corank/core/nearest_rounding.h"
#include "corank/core/rounding.h"
#include "corank/solve/ipopt_lock.h"

namespace corank::solve {
namespace {

using Ipopt::Index;
using Ipopt::Number;

constexpr int kIterations = 150;
constexpr double kInfinity = 2e19;  // what Ipopt takes for it

// min x_variable, F(x) = 0, G(x) ≥ 0, x in the box; Ipopt sees each variable, and each row, divided by its typical size, so
// that its tolerances are in no unit.
class LeastValue : public Ipopt::TNLP {
 public:
  LeastValue(const certify::CompiledSystem& system, int variable, const Box& box, const std::vector<double>& start,
             const Ended& ended)
      : system_(system), variable_(variable), box_(box), start_(start), ended_(ended) {
    derivatives_.resize(static_cast<std::size_t>(system.entries()));
    const UpwardRounding rounding;
    for (Index i = 0; i < system.rows(); ++i) {
      system.jacobian(i, box, derivatives_);
      double largest = 0;
      for (Index k = system.row_begin(i); k < system.row_begin(i + 1); ++k)
        largest = std::max(largest, derivatives_[static_cast<std::size_t>(k)].mag() * size(system.column(k)));
      row_sizes_.push_back(largest > 0 && std::isfinite(largest) ? largest : 1);
    }
  }
  const std::optional<std::vector<double>>& solution() const { return solution_; }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian_entries, Index& hessian_entries, IndexStyleEnum& style) override {
    n = system_.variables();
    m = system_.rows();
    jacobian_entries = system_.row_begin(m);
    hessian_entries = 0;
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(Index n, Number* lower, Number* upper, Index m, Number* least, Number* greatest) override {
    for (Index j = 0; j < n; ++j)
      lower[j] = box_[static_cast<std::size_t>(j)].lo() / size(j),
      upper[j] = box_[static_cast<std::size_t>(j)].hi() / size(j);
    std::fill(least, least + m, 0.0);
    for (Index i = 0; i < m; ++i) greatest[i] = i < system_.equations() ? 0 : kInfinity;
    return true;
  }
  bool get_starting_point(Index n, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    for (Index j = 0; j < n; ++j) x[j] = start_[static_cast<std::size_t>(j)] / size(j);
    return true;
  }
  bool eval_f(Index, const Number* x, bool, Number& value) override {
    value = x[variable_];
    return std::isfinite(value);
  }
  bool eval_grad_f(Index n, const Number*, bool, Number* gradient) override {
    std::fill(gradient, gradient + n, 0.0);
    gradient[variable_] = 1;
    return true;
  }
  bool eval_g(Index n, const Number* x, bool, Index m, Number* g) override {
    const std::vector<double> at = point(n, x);
    const UpwardRounding rounding;
    for (Index i = 0; i < m; ++i) g[i] = system_.evaluate_at(i, at.data()).mid() / row_size(i);
    return all_finite(g, m);
  }
  bool eval_jac_g(Index n, const Number* x, bool, Index m, Index entries, Index* rows, Index* columns,
                  Number* values) override {
    if (!values) {
      for (Index i = 0; i < m; ++i)
        for (Index k = system_.row_begin(i); k < system_.row_begin(i + 1); ++k) rows[k] = i, columns[k] = system_.column(k);
      return true;
    }
    const std::vector<double> at = point(n, x);
    const UpwardRounding rounding;
    const std::vector<Interval> sides(at.begin(), at.end());
    for (Index i = 0; i < m; ++i) {
      system_.jacobian(i, sides, derivatives_);
      for (Index k = system_.row_begin(i); k < system_.row_begin(i + 1); ++k)
        values[k] = derivatives_[static_cast<std::size_t>(k)].mid() * size(system_.column(k)) / row_size(i);
    }
    return all_finite(values, entries);
  }
  bool intermediate_callback(Ipopt::AlgorithmMode, Index, Number, Number, Number, Number, Number, Number, Number, Number,
                             Index, const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    return !is_over(ended_);
  }
  void finalize_solution(Ipopt::SolverReturn status, Index n, const Number* x, const Number*, const Number*, Index,
                         const Number*, const Number*, Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    if (status != Ipopt::LOCAL_INFEASIBILITY && status != Ipopt::INVALID_NUMBER_DETECTED) solution_ = point(n, x);
  }

 private:
  double size(Index j) const { return system_.scales()[static_cast<std::size_t>(j)]; }
  double row_size(Index i) const { return row_sizes_[static_cast<std::size_t>(i)]; }
  std::vector<double> point(Index n, const Number* x) const {
    std::vector<double> at;
    for (Index j = 0; j < n; ++j) at.push_back(x[j] * size(j));
    return at;
  }

  // Ipopt's linear solver writes past its memory where it meets infinities.
  static bool all_finite(const Number* x, Index n) {
    return std::all_of(x, x + n, [](Number a) { return std::isfinite(a); });
  }

  const certify::CompiledSystem& system_;
  const int variable_;
  const Box& box_;
  const std::vector<double>& start_;
  const Ended& ended_;
  std::vector<Interval> derivatives_;
  std::vector<double> row_sizes_;
  std::optional<std::vector<double>> solution_;
};

}  // namespace

std::optional<std::vector<double>> local_minimum(const certify::CompiledSystem& system, int variable, const Box& box,
                                                 const std::vector<double>& start, const Ended& ended) {
  const NearestRounding nearest;
  const IpoptLock lock;
  const Ipopt::SmartPtr<LeastValue> problem = new LeastValue(system, variable, box, start, ended);
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt = IpoptApplicationFactory();
  ipopt->Options()->SetIntegerValue("print_level", 0);
  ipopt->Options()->SetStringValue("sb", "yes");  // no banner
  ipopt->Options()->SetStringValue("hessian_approximation", "limited-memory");
  ipopt->Options()->SetNumericValue("tol", 1e-7);
  ipopt->Options()->SetNumericValue("constr_viol_tol", 1e-9);
  ipopt->Options()->SetNumericValue("bound_relax_factor", 0);
  ipopt->Options()->SetIntegerValue("max_iter", kIterations);
  const bool ready = ipopt->Initialize("") == Ipopt::Solve_Succeeded;  // reads no options file
  if (ready) ipopt->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(Ipopt::GetRawPtr(problem)));
  return problem->solution();
}

}  // namespace corank::solve
