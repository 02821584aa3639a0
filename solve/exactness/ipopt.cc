#include "corank/solve/exactness/ipopt.h"

#include <coin/IpIpoptApplication.hpp>
#include <coin/IpTNLP.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>
#include <span>

#include "corank/core/nearest_rounding.h"
#include "corank/core/rounding.h"

namespace corank::solve {
namespace {

using Ipopt::Index;
using Ipopt::Number;

// What both problems have in common: Ipopt sees each variable, and each row, divided by its typical size, so that its
// tolerances are in no unit.
class Task : public Ipopt::TNLP {
 public:
  Task(const certify::CompiledSystem& system, const Box& box, const Ended& ended)
      : system_(system), box_(box), ended_(ended), derivatives_(system.entries()) {
    const UpwardRounding rounding;
    for (Index i = 0; i < system.rows(); ++i) {
      system.jacobian(i, box, derivatives_);
      double largest = 0;
      for (Index k = system.row_begin(i); k < system.row_begin(i + 1); ++k)
        largest = std::max(largest, derivatives_[k].mag() * size(system.column(k)));
      row_sizes_.push_back(largest > 0 && std::isfinite(largest) ? largest : 1);
    }
  }

  const std::optional<std::vector<double>>& solution() const { return solution_; }

  bool intermediate_callback(Ipopt::AlgorithmMode, Index, Number, Number, Number, Number, Number, Number, Number, Number,
                             Index, const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    return !is_over(ended_);
  }

 protected:
  // Ipopt's linear solver writes past its memory where it meets infinities.
  static bool all_finite(const Number* x, Index n) {
    return std::all_of(x, x + n, [](Number a) { return std::isfinite(a); });
  }

  double size(Index j) const { return system_.scales()[j]; }
  std::vector<double> point(const Number* x) const {
    std::vector<double> at;
    for (Index j = 0; j < system_.variables(); ++j) at.push_back(x[j] * size(j));
    return at;
  }
  // Of as many rows as these two have room for.
  void evaluate(const Number* x, std::span<Number> values) const {
    const std::vector<double> at = point(x);
    const UpwardRounding rounding;
    for (Index i = 0; i < std::ssize(values); ++i) values[i] = system_.evaluate_at(i, at.data()).mid() / row_sizes_[i];
  }
  void differentiate(const Number* x, Index rows, Number* values) {
    const std::vector<double> at = point(x);
    const UpwardRounding rounding;
    const std::vector<Interval> sides(at.begin(), at.end());
    for (Index i = 0; i < rows; ++i) {
      system_.jacobian(i, sides, derivatives_);
      for (Index k = system_.row_begin(i); k < system_.row_begin(i + 1); ++k)
        values[k] = derivatives_[k].mid() * size(system_.column(k)) / row_sizes_[i];
    }
  }

  const certify::CompiledSystem& system_;
  const Box& box_;
  const Ended& ended_;
  std::optional<std::vector<double>> solution_;

 private:
  std::vector<Interval> derivatives_;
  std::vector<double> row_sizes_;
};

// ½‖F‖² with the Gauss–Newton Hessian JᵀJ, no constraints but the bounds.
class LeastSquaresTask : public Task {
 public:
  using Task::Task;

  bool get_nlp_info(Index& n, Index& m, Index& jacobian_entries, Index& hessian_entries, IndexStyleEnum& style) override {
    n = system_.variables();
    m = jacobian_entries = 0;
    hessian_entries = n * (n + 1) / 2;
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(Index n, Number* lower, Number* upper, Index, Number*, Number*) override {
    for (Index j = 0; j < n; ++j) {
      const double margin = 0.5 * (box_[j].hi() - box_[j].lo()) + 1e-12 * size(j);
      lower[j] = (box_[j].lo() - margin) / size(j);
      upper[j] = (box_[j].hi() + margin) / size(j);
    }
    return true;
  }
  bool get_starting_point(Index n, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    for (Index j = 0; j < n; ++j) x[j] = box_[j].mid() / size(j);
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
    for (int row = 0; row < system_.equations(); ++row)
      for (int k = system_.row_begin(row); k < system_.row_begin(row + 1); ++k) gradient[system_.column(k)] += f[row] * j[k];
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
          if (b <= a) values[a * (a + 1) / 2 + b] += factor * j[p] * j[q];
        }
    return all_finite(values, n * (n + 1) / 2);
  }
  void finalize_solution(Ipopt::SolverReturn, Index, const Number* x, const Number*, const Number*, Index, const Number*,
                         const Number*, Number, const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    solution_ = point(x);
  }

 private:
  std::vector<double> residual(const Number* x) const {
    std::vector<double> f(system_.equations());
    evaluate(x, f);
    return f;
  }
  std::vector<double> jacobian(const Number* x) {
    std::vector<double> j(system_.entries());
    differentiate(x, system_.equations(), j.data());
    return j;
  }
};

constexpr double kInfinity = 2e19;  // what Ipopt takes for it

// min x_variable, F(x) = 0, G(x) ≥ 0, x in the box.
class LeastValueTask : public Task {
 public:
  LeastValueTask(const certify::CompiledSystem& system, int variable, const Box& box, const std::vector<double>& start,
                 const Ended& ended)
      : Task(system, box, ended), variable_(variable), start_(start) {}

  bool get_nlp_info(Index& n, Index& m, Index& jacobian_entries, Index& hessian_entries, IndexStyleEnum& style) override {
    n = system_.variables();
    m = system_.rows();
    jacobian_entries = system_.row_begin(m);
    hessian_entries = 0;
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(Index n, Number* lower, Number* upper, Index m, Number* least, Number* greatest) override {
    for (Index j = 0; j < n; ++j) lower[j] = box_[j].lo() / size(j), upper[j] = box_[j].hi() / size(j);
    std::fill(least, least + m, 0.0);
    for (Index i = 0; i < m; ++i) greatest[i] = i < system_.equations() ? 0 : kInfinity;
    return true;
  }
  bool get_starting_point(Index n, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    for (Index j = 0; j < n; ++j) x[j] = start_[j] / size(j);
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
  bool eval_g(Index, const Number* x, bool, Index m, Number* g) override {
    evaluate(x, {g, static_cast<std::size_t>(m)});
    return all_finite(g, m);
  }
  bool eval_jac_g(Index, const Number* x, bool, Index m, Index entries, Index* rows, Index* columns,
                  Number* values) override {
    if (!values) {
      for (Index i = 0; i < m; ++i)
        for (Index k = system_.row_begin(i); k < system_.row_begin(i + 1); ++k) rows[k] = i, columns[k] = system_.column(k);
      return true;
    }
    differentiate(x, m, values);
    return all_finite(values, entries);
  }
  void finalize_solution(Ipopt::SolverReturn status, Index, const Number* x, const Number*, const Number*, Index,
                         const Number*, const Number*, Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    if (status != Ipopt::LOCAL_INFEASIBILITY && status != Ipopt::INVALID_NUMBER_DETECTED) solution_ = point(x);
  }

 private:
  const int variable_;
  const std::vector<double>& start_;
};

// MUMPS, Ipopt's linear solver, keeps its state in global variables: one thread of a process may use Ipopt at a time.
std::optional<std::vector<double>> optimize(const Ipopt::SmartPtr<Task>& task, int iterations,
                                            const std::function<void(Ipopt::OptionsList&)>& set) {
  static std::mutex mutex;
  const NearestRounding nearest;
  const std::lock_guard lock(mutex);
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt = IpoptApplicationFactory();
  ipopt->Options()->SetIntegerValue("print_level", 0);
  ipopt->Options()->SetStringValue("sb", "yes");  // no banner
  ipopt->Options()->SetNumericValue("bound_relax_factor", 0);
  ipopt->Options()->SetIntegerValue("max_iter", iterations);
  set(*ipopt->Options());
  const bool ready = ipopt->Initialize("") == Ipopt::Solve_Succeeded;  // reads no options file
  if (ready) ipopt->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(Ipopt::GetRawPtr(task)));
  return task->solution();
}

}  // namespace

std::optional<std::vector<double>> polish(const System& system, const Box& box, const Ended& ended) {
  const certify::CompiledSystem compiled(system);
  return optimize(new LeastSquaresTask(compiled, box, ended), 200,
                  [](Ipopt::OptionsList& options) { options.SetNumericValue("tol", 1e-14); });
}

std::optional<std::vector<double>> local_minimum(const certify::CompiledSystem& system, int variable, const Box& box,
                                                 const std::vector<double>& start, const Ended& ended) {
  return optimize(new LeastValueTask(system, variable, box, start, ended), 150, [](Ipopt::OptionsList& options) {
    options.SetStringValue("hessian_approximation", "limited-memory");
    options.SetNumericValue("tol", 1e-7);
    options.SetNumericValue("constr_viol_tol", 1e-9);
  });
}

}  // namespace corank::solve
