#include "corank/certify/contact.h"

#include <algorithm>
#include <limits>
#include <map>

#include "corank/certify/compiled_system.h"
#include "corank/certify/implied.h"
#include "corank/certify/newton.h"
#include "corank/core/box.h"
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
    return c.with != Contact::With::inequality && x[c.index].contains(end(c));
  }

  // The intermediate value theorem, for the contact's dependent variable over the corners of the box's free sides.
  bool crosses_end(const CoverBox& b, const Box& region, const Contact& c) {
    constexpr std::size_t kMostFree = 3;
    if (c.with == Contact::With::inequality || b.free.size() > kMostFree) return false;
    const std::vector<int> dependent = all_but(b.free, compiled_.variables());
    if (static_cast<int>(dependent.size()) != compiled_.equations()) return false;
    const Preconditioner p = midpoint_preconditioner(compiled_, midpoint(region), dependent);
    bool beneath = false, above = false;
    for (unsigned corner = 0; corner < 1U << b.free.size() && !(beneath && above); ++corner) {
      Box x = region;
      for (std::size_t k = 0; k < b.free.size(); ++k) {
        const Interval& side = b.box[b.free[k]];
        x[b.free[k]] = (corner >> k & 1U) != 0 ? side.hi() : side.lo();
      }
      for (int step = 0; step < 4; ++step)  // the one solution over this corner stays
        if (NewtonStep(compiled_, p, x, workspace_).outcome().empty) return false;
      const Interval& value = x[c.index];
      beneath = beneath || value.hi() < end(c).lo();
      above = above || value.lo() > end(c).hi();
    }
    return beneath && above;
  }

 private:
  const Interval& end(const Contact& c) const { return (c.with == Contact::With::lower_end ? lower_ : upper_)[c.index]; }

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
    const bool whole = spans(cover, b);
    const bool alone = b.verdict == Verdict::boundary && contacts.size() == 1;
    for (Contact& c : contacts) {
      const bool is_free = std::ranges::find(b.free, c.index) != b.free.end();
      if (is_free) {
        c.reached = whole && (b.verdict == Verdict::regular || alone) && test.holds_end(b.box, c);
      } else if (int& so_far = tries[{c.with, c.index}]; whole && alone && b.region >= 0 && so_far < kTries) {
        c.reached = test.crosses_end(b, cover.regions[b.region], c);
        so_far = c.reached ? kTries : so_far + 1;
      }
    }
    visit(b, contacts);
  }
}

}  // namespace corank::certify
