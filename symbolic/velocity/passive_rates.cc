#include "corank/symbolic/velocity/passive_rates.h"

#include <optional>

#include "corank/core/check.h"
#include "corank/symbolic/algebra/ginac_bridge.h"
#include "corank/symbolic/algebra/ginac_lock.h"

namespace corank::symbolic {
namespace {

using Row = std::vector<GiNaC::ex>;

class Eliminator {
 public:
  Eliminator(const Mechanism& mechanism, const ExpressionMatrix& matrix)
      : mechanism_(mechanism), columns_(matrix.columns), roles_(matrix.roles), bridge_(mechanism) {
    CORANK_CHECK(roles_.size() == columns_.size());
    for (const auto& row : matrix.rows) {
      rows_.emplace_back();
      for (const Expression& e : row) rows_.back().push_back(bridge_.to_ginac(e, {}).expand());
    }
    used_.assign(rows_.size(), false);
    notes_.resize(rows_.size());
  }

  PassiveRates run() {
    PassiveRates result;
    for (std::size_t j = 0; j < columns_.size(); ++j)
      if (roles_[j] == Role::passive && eliminate(j)) result.eliminated.push_back(j);
    if (result.eliminated.size() == columns_.size()) result.eliminated.clear();
    if (result.eliminated.empty()) return result;
    result.matrix.columns = columns_;
    result.matrix.roles = roles_;
    result.notes = notes_;
    for (const Row& row : rows_) {
      auto& to = result.matrix.rows.emplace_back();
      for (const GiNaC::ex& e : row) to.push_back(bridge_.to_expression(e));
    }
    return result;
  }

 private:
  // α·sin u or α·cos u of one coordinate u.
  struct Entry {
    std::size_t row;
    GiNaC::ex factor;
  };

  // The number that a constant expression is; nothing where it is not rational, or known within a tolerance only.
  std::optional<GiNaC::numeric> number(GiNaC::ex e) const {
    const auto& constants = mechanism_.constants();
    for (auto c = constants.rbegin(); c != constants.rend(); ++c)
      if (!c->tolerance) e = e.subs(bridge_.symbol(c->name) == bridge_.to_ginac(c->value, c->where));
    if (!GiNaC::is_a<GiNaC::numeric>(e) || !GiNaC::ex_to<GiNaC::numeric>(e).is_rational()) return std::nullopt;
    return GiNaC::ex_to<GiNaC::numeric>(e);
  }

  // The column's entries as constants times sin u, and times cos u; false: they are not.
  bool split(std::size_t j, const GiNaC::ex& u, std::vector<Entry>& sines, std::vector<Entry>& cosines) const {
    sines.clear();
    cosines.clear();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const GiNaC::ex& e = rows_[i][j];
      if (e.is_zero()) continue;
      bool found = false;
      for (const bool is_sine : {true, false}) {
        const GiNaC::ex wave = is_sine ? GiNaC::sin(u) : GiNaC::cos(u);
        const GiNaC::ex factor = e.coeff(wave, 1);
        const auto value = factor.is_zero() ? std::nullopt : number(factor);
        if (!value || value->is_zero() || !(e - factor * wave).expand().is_zero()) continue;
        (is_sine ? sines : cosines).push_back({i, factor});
        found = true;
      }
      if (!found) return false;
    }
    return true;
  }

  bool eliminate(std::size_t j) {
    std::vector<Entry> sines, cosines;
    for (const Coordinate& u : mechanism_.coordinates()) {
      if (u.kind != CoordinateKind::angle || is_fixed(u)) continue;
      const GiNaC::ex symbol = bridge_.symbol(u.name);
      if (!split(j, symbol, sines, cosines)) continue;
      // The pair of rows with the fewest other passive rates: those stay free for rows of their own.
      const Entry *best_sine = nullptr, *best_cosine = nullptr;
      GiNaC::numeric best_ratio;
      std::size_t fewest = 0;
      for (const Entry& s : sines)
        for (const Entry& c : cosines) {
          if (used_[s.row] || used_[c.row]) continue;
          const auto ratio = number(s.factor / c.factor);
          const std::size_t others = passive_rates_in(s.row) + passive_rates_in(c.row);
          if (!ratio || (*ratio != 1 && *ratio != -1) || (best_sine != nullptr && others >= fewest)) continue;
          best_sine = &s;
          best_cosine = &c;
          best_ratio = *ratio;
          fewest = others;
        }
      if (best_sine == nullptr) continue;
      take_away(j, *best_sine, sines);
      take_away(j, *best_cosine, cosines);
      rotate(j, *best_sine, *best_cosine, best_ratio, symbol);
      return true;
    }
    return false;
  }

  std::size_t passive_rates_in(std::size_t row) const {
    std::size_t count = 0;
    for (std::size_t k = 0; k < columns_.size(); ++k) count += !rows_[row][k].is_zero() && roles_[k] == Role::passive;
    return count;
  }

  // Adds multiples of the entry's row to those of the others, so that the column is 0 there.
  void take_away(std::size_t j, const Entry& own, const std::vector<Entry>& all) {
    for (const Entry& other : all) {
      if (other.row == own.row) continue;
      const GiNaC::ex factor = (other.factor / own.factor).normal();
      for (std::size_t k = 0; k < columns_.size(); ++k)
        rows_[other.row][k] = (rows_[other.row][k] - factor * rows_[own.row][k]).expand();
      rows_[other.row][j] = 0;
      notes_[other.row].free_of.push_back(columns_[j]);
    }
  }

  // The sine's row becomes free of the rate, the cosine's row gives it.
  void rotate(std::size_t j, const Entry& s, const Entry& c, const GiNaC::numeric& ratio, const GiNaC::ex& u) {
    Row free, giving;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      free.push_back((GiNaC::cos(u) * rows_[s.row][k] - ratio * GiNaC::sin(u) * rows_[c.row][k]).expand());
      giving.push_back((GiNaC::sin(u) * rows_[s.row][k] + ratio * GiNaC::cos(u) * rows_[c.row][k]).expand());
    }
    free[j] = 0;
    giving[j] = s.factor;  // α (sin² + cos²)
    rows_[s.row] = std::move(free);
    rows_[c.row] = std::move(giving);
    used_[c.row] = true;
    notes_[s.row].free_of.push_back(columns_[j]);
    notes_[c.row].gives = columns_[j];
  }

  const Mechanism& mechanism_;
  const std::vector<std::string> columns_;
  const std::vector<Role> roles_;
  const GinacBridge bridge_;
  std::vector<Row> rows_;
  std::vector<bool> used_;  // rows that give a rate
  std::vector<PassiveRates::RowNote> notes_;
};

}  // namespace

PassiveRates eliminate_passive_rates(const Mechanism& mechanism, const ExpressionMatrix& matrix) {
  const GinacLock lock;
  return Eliminator(mechanism, matrix).run();
}

}  // namespace corank::symbolic
