#include "corank/certify/contact.h"

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "corank/certify/compiled_system.h"
#include "corank/certify/implied.h"
#include "corank/certify/newton.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class ContactTest {
 public:
  explicit ContactTest(const System& system) : compiled_(system) {
    const std::vector<ImpliedSides> implied = implied_domains(system);
    for (std::size_t j = 0; j < implied.size(); ++j) {
      const Variable& v = system.variables[j];
      const bool one_value = v.lower == v.upper;
      lower_.push_back(implied[j].lower || one_value ? Interval(-kInfinity) : v.lower.enclose());
      upper_.push_back(implied[j].upper || one_value ? Interval(kInfinity) : v.upper.enclose());
    }
  }

  // The contacts of a box, but for `reached`.
  void find(const Box& x, std::vector<Contact>& contacts) const {
    CORANK_CHECK(x.size() == lower_.size());
    contacts.clear();
    for (std::size_t j = 0; j < x.size(); ++j) {
      const int index = static_cast<int>(j);
      if (!(x[j].lo() > lower_[j].hi())) contacts.push_back({Contact::With::lower_end, index});
      if (!(x[j].hi() < upper_[j].lo())) contacts.push_back({Contact::With::upper_end, index});
    }
    for (int row = compiled_.equations(); row < compiled_.rows(); ++row)
      if (!(compiled_.evaluate(row, x).lo() > 0))
        contacts.push_back({Contact::With::inequality, row - compiled_.equations()});
  }

  // Does a side certainly hold the end?
  bool holds_end(const Box& x, const Contact& c) const {
    return c.with != Contact::With::inequality && x[static_cast<std::size_t>(c.index)].contains(end(c));
  }

  // The intermediate value theorem, for the contact's dependent variable over the corners of the box's free sides.
  bool crosses_end(const CoverBox& b, const Box& region, const Contact& c) {
    constexpr std::size_t kMostFree = 3;
    if (c.with == Contact::With::inequality || b.free.size() > kMostFree) return false;
    const auto p = preconditioner(b, region);
    if (!p) return false;
    bool beneath = false, above = false;
    for (unsigned corner = 0; corner < 1U << b.free.size() && !(beneath && above); ++corner) {
      Box x = region;
      for (std::size_t k = 0; k < b.free.size(); ++k) {
        const Interval& side = b.box[static_cast<std::size_t>(b.free[k])];
        x[static_cast<std::size_t>(b.free[k])] = (corner >> k & 1U) != 0 ? side.hi() : side.lo();
      }
      for (int step = 0; step < 4; ++step)  // the one solution over this corner stays
        if (NewtonStep(compiled_, *p, x, workspace_).outcome().empty) return false;
      const Interval& value = x[static_cast<std::size_t>(c.index)];
      beneath = beneath || value.hi() < end(c).lo();
      above = above || value.lo() > end(c).hi();
    }
    return beneath && above;
  }

 private:
  const Interval& end(const Contact& c) const {
    return (c.with == Contact::With::lower_end ? lower_ : upper_)[static_cast<std::size_t>(c.index)];
  }

  // The inverse of the dependent variables' Jacobian at the region's middle, in floating point: any matrix is valid.
  std::optional<Preconditioner> preconditioner(const CoverBox& b, const Box& region) const {
    const std::size_t n = region.size(), m = static_cast<std::size_t>(compiled_.equations());
    Preconditioner p;
    for (int j = 0; j < static_cast<int>(n); ++j)
      if (std::find(b.free.begin(), b.free.end(), j) == b.free.end()) p.dependent.push_back(j);
    if (p.dependent.size() != m) return std::nullopt;
    std::vector<double> middle, entries(static_cast<std::size_t>(compiled_.entries()));
    for (const Interval& side : region) middle.push_back(side.mid());
    compiled_.approximate_jacobian(middle.data(), entries.data());
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(m));
    for (int row = 0; row < compiled_.equations(); ++row) {
      p.equations.push_back(row);
      for (int e = compiled_.row_begin(row); e < compiled_.row_begin(row + 1); ++e) {
        const auto at = std::find(p.dependent.begin(), p.dependent.end(), compiled_.column(e));
        if (at != p.dependent.end()) jacobian(row, at - p.dependent.begin()) = entries[static_cast<std::size_t>(e)];
      }
    }
    const Eigen::MatrixXd inverse = jacobian.fullPivLu().inverse();
    if (!inverse.allFinite()) return std::nullopt;
    for (Eigen::Index i = 0; i < inverse.rows(); ++i)
      for (Eigen::Index k = 0; k < inverse.cols(); ++k) p.y.push_back(inverse(i, k));
    return p;
  }

  CompiledSystem compiled_;
  std::vector<Interval> lower_, upper_;  // of the exact ends; infinite where that is no end
  NewtonWorkspace workspace_;
};

}  // namespace

void visit_contacts(const System& system, const Cover& cover,
                    const std::function<void(const CoverBox&, const std::vector<Contact>&)>& visit) {
  constexpr int kTries = 200;  // of the intermediate value theorem, for each end
  const UpwardRounding rounding;
  ContactTest test(system);
  std::map<std::pair<Contact::With, int>, int> tries;
  std::vector<Contact> contacts;
  for (const CoverBox& b : cover.boxes) {
    if (b.verdict == Verdict::pending) continue;
    test.find(b.box, contacts);
    const bool alone = b.verdict == Verdict::boundary && contacts.size() == 1;
    for (Contact& c : contacts) {
      const bool is_free = std::find(b.free.begin(), b.free.end(), c.index) != b.free.end();
      if (is_free) {
        c.reached = (b.verdict == Verdict::regular || alone) && test.holds_end(b.box, c);
      } else if (int& so_far = tries[{c.with, c.index}]; alone && b.region >= 0 && so_far < kTries) {
        c.reached = test.crosses_end(b, cover.regions[static_cast<std::size_t>(b.region)], c);
        so_far = c.reached ? kTries : so_far + 1;
      }
    }
    visit(b, contacts);
  }
}

}  // namespace corank::certify
