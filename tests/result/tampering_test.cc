// A result that was tampered with is rejected, whatever was changed; the untouched one is accepted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>

#include "corank/result/files/result_file.h"
#include "corank/result/files/verification.h"
#include "corank/solve/exactness/exactness.h"
#include "corank/solve/search/box_labels.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/velocity_blocks.h"
#include "corank/symbolic/writing/printer.h"
#include "corank/tests/result/rejection.h"

namespace corank::result {
namespace {
using Step = Proof::Step;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double up(double x) { return std::nextafter(x, kInfinity); }
double down(double x) { return std::nextafter(x, -kInfinity); }

// What `corank solve --proof` finds.
Result solved(const std::string& model, const std::string& set, double sigma, std::vector<ConstantOverride> constants = {}) {
  const symbolic::Mechanism mechanism = symbolic::read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + model + ".cuik");
  Result result;
  result.model = mechanism.name();
  result.model_text = mechanism.source_text();
  result.set = set;
  result.options.kernel = set == "cspace" ? "" : "right";
  result.options.constants = std::move(constants);
  const System system = system_of(result);
  result.system_text = symbolic::to_cuik(system);
  describe_system(system, result);
  solve::Options options;
  options.sigma = sigma;
  options.proof = true;
  result.cover = solve::solve(system, options);
  solve::prove_exactly(system, options, result.cover);
  solve::Control control;
  if (set != "cspace")
    solve::label_types(solve::prepare(system, options, control),
                       {*symbolic::velocity_blocks(model_of(result), *symbolic::singularity_set_from_string(set))},
                       result.cover, control);
  result.options.sigma = result.cover.sigma;
  return result;
}

// 4 isolated points and the exact ones (0, 0, ±1).
const Result& points() {
  static const Result result = solved("three_slider", "forward", 1e-6, {{"L2", "1"}});
  return result;
}
// A curve with boundary boxes.
const Result& curve() {
  static const Result result = solved("dextar", "forward", 0.25);
  return result;
}
// A curve with undecided boxes that exact points explain.
const Result& crossing() {
  static const Result result = [] {
    Result all = solved("dextar", "inverse", 0.4);
    all.cover.proof = nullptr;  // the longest of the three
    return all;
  }();
  return result;
}

std::size_t first(const Result& r, Verdict verdict) {
  for (std::size_t i = 0; i < r.cover.boxes.size(); ++i)
    if (r.cover.boxes[i].verdict == verdict) return i;
  throw std::runtime_error("no box is " + std::string(to_string(verdict)));
}

TypeLabels& label(Result& r, std::size_t box) { return r.cover.boxes.at(box).types; }

// Of the first box with the verdict that names an exact point.
std::size_t exact_of(const Result& r, Verdict verdict) {
  for (const CoverBox& box : r.cover.boxes)
    if (box.verdict == verdict && box.point >= 0) return static_cast<std::size_t>(box.point);
  throw std::runtime_error("no exact point");
}

// The proof, to be changed.
void change_proof(Result& r, const std::function<void(Proof&)>& change) {
  auto proof = std::make_shared<Proof>(*r.cover.proof);
  change(*proof);
  r.cover.proof = std::move(proof);
}

// Visits every step: its number, its first integer and its first real number, as places in the vectors.
void for_each_step(const Proof& proof, const std::function<void(std::size_t, Step, std::size_t, std::size_t)>& visit) {
  std::size_t integer = 0, real = 0;
  for (std::size_t s = 0; s < proof.steps.size(); ++s) {
    const auto step = static_cast<Step>(proof.steps[s]);
    visit(s, step, integer, real);
    switch (step) {
      case Step::row:
      case Step::newton:
      case Step::box:
      case Step::root: ++integer; break;
      case Step::keep:
        real += static_cast<std::size_t>(proof.integers[integer]),
            integer += 1 + static_cast<std::size_t>(proof.integers[integer]);
        break;
      case Step::split: ++integer, ++real; break;
      case Step::cut: real += static_cast<std::size_t>(proof.integers[integer + 1]), integer += 2; break;
      case Step::empty:
      case Step::elsewhere: break;
    }
  }
}

// Moves a side so that it excludes the number, by one unit in the last place where an end touches it.
Interval excluding(const Interval& side, double number) {
  if (side.hi() > number) return {up(number), std::max(up(number), side.hi())};
  return {std::min(side.lo(), down(number)), down(number)};
}

// Every leaf `box i` becomes an empty one.
void drop_leaves(Result& r, std::size_t box) {
  change_proof(r, [&](Proof& proof) {
    std::vector<std::size_t> integers;
    std::vector<std::size_t> steps;
    for_each_step(proof, [&](std::size_t s, Step step, std::size_t integer, std::size_t) {
      if (step == Step::box && proof.integers[integer] == static_cast<int>(box))
        steps.push_back(s), integers.push_back(integer);
    });
    for (const std::size_t s : steps) proof.steps[s] = static_cast<std::uint8_t>(Step::empty);
    for (auto at = integers.rbegin(); at != integers.rend(); ++at)
      proof.integers.erase(proof.integers.begin() + static_cast<std::ptrdiff_t>(*at));
  });
}

struct Tampering {
  const char* name;
  const char* reason;  // part of what is said of it
  const Result& (*result)();
  std::function<void(Result&)> change;
  bool needs_proof = false;  // what it changes shows in the proof alone
};

// The isolated point (−1, −1, 0).
constexpr std::size_t kIsolated = 0;

const std::vector<Tampering>& tamperings() {
  static const std::vector<Tampering> all{
      {"a bound of an isolated box moved by a unit in the last place past its solution", "lies outside it", points,
       [](Result& r) {
         for (auto* list : {&r.cover.boxes, &r.cover.points})
           list->at(kIsolated).box[0] = excluding(list->at(kIsolated).box[0], -1);
       }},
      {"a bound of a region moved by a unit in the last place inside its box", "not inside the region", curve,
       [](Result& r) {
         const CoverBox& box = r.cover.boxes[first(r, Verdict::regular)];
         const auto j = static_cast<std::size_t>(box.free[0]);
         Interval& side = r.cover.regions[static_cast<std::size_t>(box.region)][j];
         side = {side.lo(), down(box.box[j].hi())};
       }},
      {"a bound of the proof's root moved by a unit in the last place past a solution", "does not hold the search domain",
       points, [](Result& r) { change_proof(r, [](Proof& p) {
                                 p.roots[0][0] = {up(-1.0), p.roots[0][0].hi()};
                               }); }},
      {"a dependent side cut in half", "outside it", curve,
       [](Result& r) {
         CoverBox& box = r.cover.boxes[first(r, Verdict::regular)];
         const std::size_t j = box.free[0] == 4 ? 5 : 4;
         box.box[j] = {box.box[j].lo(), box.box[j].mid()};
       }},
      {"boundary raised to regular", "violate", curve,
       [](Result& r) {  // of some of them the checker, which knows more digits, may find that they are
         for (CoverBox& b : r.cover.boxes)
           if (b.verdict == Verdict::boundary) b.verdict = Verdict::regular;
       }},
      {"undecided raised to regular", "its region", crossing,
       [](Result& r) {
         CoverBox& box = r.cover.boxes[first(r, Verdict::undecided)];
         const CoverBox& other = r.cover.boxes[first(r, Verdict::regular)];
         box.verdict = Verdict::regular;
         box.free = other.free;
         box.region = static_cast<int>(r.cover.regions.size());
         r.cover.regions.push_back(box.box);
       }},
      {"undecided raised to exact", "says nothing of xi", crossing,
       [](Result& r) { r.cover.boxes[first(r, Verdict::undecided)].verdict = Verdict::exact; }},
      {"exact raised to isolated", "no region for it", points,
       [](Result& r) {
         for (auto* list : {&r.cover.boxes, &r.cover.points})
           for (CoverBox& b : *list)
             if (b.verdict == Verdict::exact) b.verdict = Verdict::isolated;
       }},
      {"a box deleted", "out of range", curve, [](Result& r) { r.cover.boxes.erase(r.cover.boxes.begin() + 5); }, true},
      {"a box deleted and its leaves called empty", "not shown to have no solution", curve,
       [](Result& r) {
         drop_leaves(r, r.cover.boxes.size() - 1);
         r.cover.boxes.pop_back();
       }},
      {"two boxes swapped", "not in the order", curve, [](Result& r) { std::swap(r.cover.boxes[10], r.cover.boxes[11]); }},
      {"a coefficient of the model changed", "the system is not that of the model", curve,
       [](Result& r) { r.model_text.replace(r.model_text.find("l := 0.90"), 9, "l := 0.91"); }},
      {"a coefficient of the model and of the system changed", "outside it", curve,
       [](Result& r) {
         r.model_text.replace(r.model_text.find("l := 0.90"), 9, "l := 0.97");
         r.system_text = symbolic::to_cuik(system_of(r));
         describe_system(system_of(r), r);
       }},
      {"a constant given another value", "the system is not that of the model", points,
       [](Result& r) { r.options.constants[0].expression = "1.000001"; }},
      {"another kernel", "the system is not that of the model", curve, [](Result& r) { r.options.kernel = "left"; }},
      {"another set", "the system is not that of the model", curve, [](Result& r) { r.set = "inverse"; }},
      {"a domain changed", "the domain of J3x is not that of the model", curve,
       [](Result& r) {
         r.variables[0].domain = {-2, 1.8};
       }},
      {"a domain of the model changed", "not shown to lie in its domain", points,
       [](Result& r) {
         r.model_text.replace(r.model_text.find("y_A : [-L1, L1]"), 15, "y_A : [-L1, L1/2]");
         r.system_text = symbolic::to_cuik(system_of(r));
         describe_system(system_of(r), r);
       }},
      {"another sigma", "two different values of sigma", curve,
       [](Result& r) {
         r.options.sigma = {0.01, 0.01};
       }},
      {"a region shrunk below its image", "its region", curve,
       [](Result& r) {
         CoverBox& box = r.cover.boxes[first(r, Verdict::regular)];
         const std::size_t j = box.free[0] == 4 ? 5 : 4;
         Interval& side = r.cover.regions[static_cast<std::size_t>(box.region)][j];
         side = box.box[j] = {box.box[j].lo(), box.box[j].lo() + 0.25 * box.box[j].width()};
       }},
      {"a region that another sheet belongs to", "not inside the region", curve,
       [](Result& r) {
         CoverBox& box = r.cover.boxes[first(r, Verdict::regular)];
         box.region = r.cover.boxes.back().region;
       }},
      {"a free variable exchanged", "its region", curve,
       [](Result& r) {
         CoverBox& box = r.cover.boxes[first(r, Verdict::regular)];
         box.free[0] = box.free[0] == 4 ? 5 : 4;
       }},
      {"a free variable taken away", "not as many as the dependent variables", curve,
       [](Result& r) { r.cover.boxes[first(r, Verdict::regular)].free.clear(); }},
      {"an isolated box and its point twice", "the same solution as point 1", points,
       [](Result& r) {
         for (auto* list : {&r.cover.boxes, &r.cover.points}) list->insert(list->begin(), list->front());
       }},
      {"an isolated box split", "not inside the region", points,
       [](Result& r) {
         for (auto* list : {&r.cover.boxes, &r.cover.points}) {
           list->insert(list->begin(), list->front());
           (*list)[0].box[2] = {(*list)[0].box[2].lo() - 1e-9, 0};
           (*list)[1].box[2] = {0, (*list)[1].box[2].hi() + 1e-9};
         }
       }},
      {"a point deleted", "has no entry for it", points, [](Result& r) { r.cover.points.pop_back(); }},
      {"an exact point's polynomial changed", "not defined by a polynomial", points,
       [](Result& r) {
         for (ExactPoint& p : r.cover.exact_points) p.polynomial.back() = 0;
       }},
      {"an exact point's interval moved", "opposite signs", points,
       [](Result& r) { r.cover.exact_points[0].lower = r.cover.exact_points[0].upper; }},
      {"an exact point's coordinate moved", "does not hold there", points,
       [](Result& r) { r.cover.exact_points[0].coordinates[2] = {ExactNumber::rational("1/1000000000000000000000")}; }},
      {"the algebraic number of a point exchanged for its conjugate", "lies outside it", crossing,
       [](Result& r) {
         ExactPoint& p = r.cover.exact_points[0];
         std::swap(p.lower, p.upper);
         p.lower = -p.lower, p.upper = -p.upper;
       }},
      {"a kernel's dimension at a point raised", "the kernel's dimension is 1, not 2", points,
       [](Result& r) { r.cover.exact_points[0].corank = 2; }},
      {"a kernel's dimension at a point that explains lowered", "the kernel's dimension is 2, not 1", crossing,
       [](Result& r) { r.cover.exact_points[0].corank = 1; }},
      {"a bound of the kernel's dimension lowered", "above 1 is not excluded", crossing,
       [](Result& r) { r.cover.boxes[first(r, Verdict::undecided)].kernel_at_most = 1; }},
      {"an explaining point exchanged", "lies outside it", crossing,
       [](Result& r) {
         CoverBox& box = r.cover.boxes[first(r, Verdict::undecided)];
         box.point = box.point == 0 ? 1 : 0;
       }},
      {"the radius of a sole solution enlarged", "it is not shown that no other solution is near it", points,
       [](Result& r) {
         for (ExactPoint& p : r.cover.exact_points) p.sole_within = 2;
       }},
      {"another elimination", "does not define it", curve,
       [](Result& r) {
         std::swap(std::get<Elimination>(r.cover.reduction[0]).equation,
                   std::get<Elimination>(r.cover.reduction[1]).equation);
       }},
      {"an elimination missing", "no whole boxes", curve,
       [](Result& r) {
         auto& steps = r.cover.reduction;
         const auto last = std::find_if(steps.rbegin(), steps.rend(),
                                        [](const ReductionStep& s) { return std::holds_alternative<Elimination>(s); });
         steps.erase(std::next(last).base());
       },
       true},
      {"another dimension", "the set has dimension 1, not 2", curve, [](Result& r) { r.cover.dimension = 2; }},
      {"a leaf of the proof dropped", "the script ends early", curve,
       [](Result& r) { change_proof(r, [](Proof& p) { p.steps.pop_back(); }); }},
      {"the proof's last leaves called empty", "not shown to have no solution", curve, [](Result& r) { drop_leaves(r, 7); }},
      {"a kept bound moved inward", "a slab that is cut off", curve,
       [](Result& r) {
         change_proof(r, [](Proof& p) {
           bool done = false;
           for_each_step(p, [&](std::size_t, Step step, std::size_t integer, std::size_t real) {
             if (done || step != Step::keep) return;
             done = true;
             // The first lower bound comes to where most of the box is cut off.
             for (std::size_t k = 0; k < static_cast<std::size_t>(p.integers[integer]); ++k) p.reals[real + k] *= 0.25;
           });
         });
       }},
      {"a part of a split that goes to a leaf of another box", "not shown to lie in box", curve,
       [](Result& r) {
         change_proof(r, [](Proof& p) {
           std::size_t last = 0;
           for_each_step(p, [&](std::size_t, Step step, std::size_t integer, std::size_t) {
             if (step == Step::box) last = integer;
           });
           p.integers[last] = p.integers[last] == 0 ? 1 : 0;
         });
       }},
      {"all reasons taken out of the proof", "not shown to have no solution", curve,
       [](Result& r) {
         change_proof(r, [](Proof& p) {
           p = Proof{p.roots, {}, {static_cast<std::uint8_t>(Step::empty)}, {}, {}};
           p.roots.resize(1);
         });
       }},
      {"combinations that are no numbers", "malformed", curve,
       [](Result& r) {
         change_proof(r, [](Proof& p) {
           for (Proof::Combination& c : p.combinations)
             for (float& y : c.y) y = std::numeric_limits<float>::quiet_NaN();
         });
       }},
      {"combinations that prove nothing in place of those that did, and a leaf lost", "not shown to have no solution", curve,
       [](Result& r) {
         change_proof(r, [](Proof& p) {
           for (Proof::Combination& c : p.combinations)
             for (float& y : c.y) y = 0;
         });
         drop_leaves(r, 3);
       }},
      {"a type that is not so", "it is not shown that its solutions are RI", curve,
       [](Result& r) { label(r, r.cover.boxes.size() / 2).proven |= bit(SingularityType::ri); }},
      {"an output said to be impossible that is not", "it is not shown that its solutions are IO", curve,
       [](Result& r) { label(r, 5).proven |= bit(SingularityType::io); }},
      {"an input that is impossible said not to be", "it is not shown that its solutions are not II", curve,
       [](Result& r) {
         label(r, 9) = {0, bit(SingularityType::ii)};
       }},
      {"increased mobility where there is none", "it is not shown that its solutions are IIM", curve,
       [](Result& r) { label(r, 13).proven |= bit(SingularityType::iim); }},
      {"a type that is proven said to be excluded", "it is not shown that its solutions are not RO", curve,
       [](Result& r) {
         label(r, 7) = {0, bit(SingularityType::ro)};
       }},
      {"a type excluded that boxes near by have", "it is not shown that its solutions are not RI", crossing,
       [](Result& r) { label(r, 3).excluded |= bit(SingularityType::ri); }},
      {"passive motion where there is none", "it is not shown that its solutions are RPM", curve,
       [](Result& r) { label(r, 11).proven |= bit(SingularityType::rpm); }},
      {"an exact point of another type", "it is not shown that its solutions are RPM", points,
       [](Result& r) { r.cover.exact_points.at(exact_of(r, Verdict::exact)).types.proven |= bit(SingularityType::rpm); }},
      {"an exact point of which less is excluded than said", "it is not shown that its solutions are not II", points,
       [](Result& r) {
         ExactPoint& point = r.cover.exact_points.at(exact_of(r, Verdict::isolated));
         point.types.proven &= static_cast<TypeSet>(~bit(SingularityType::ii));
         point.types.excluded |= bit(SingularityType::ii);
       }},
      {"types that were not requested", "are not those of the mechanism's set", curve,
       [](Result& r) { r.cover.types.of_set = bit(SingularityType::iim); }},
      {"a proof whose roots prove one another", "an earlier one or itself", points,
       [](Result& r) {
         change_proof(r, [](Proof& p) { p = Proof{p.roots, {}, {static_cast<std::uint8_t>(Step::root)}, {0}, {}}; });
       }},
  };
  return all;
}

// One process for each result, which is dear to make.
void expect_all_rejected(const Result& (*result)()) {
  const Result& untouched = result();
  EXPECT_EQ(rejection(untouched), "");
  std::size_t tried = 0;
  for (const Tampering& tampering : tamperings()) {
    if (tampering.result != result) continue;
    ++tried;
    Result changed = untouched;
    tampering.change(changed);
    // The proof takes most of the time, and what it does not show is rejected without it.
    if (changed.cover.proof == untouched.cover.proof && !tampering.needs_proof) changed.cover.proof = nullptr;
    EXPECT_THAT(rejection(changed), testing::HasSubstr(tampering.reason)) << tampering.name;
  }
  EXPECT_GE(tried, 5u);
}

TEST(Tampered, PointsAreRejectedAndUntouchedOnesAccepted) { expect_all_rejected(points); }

TEST(Tampered, CurvesAreRejectedAndUntouchedOnesAccepted) { expect_all_rejected(curve); }

TEST(Tampered, CrossingsAreRejectedAndUntouchedOnesAccepted) { expect_all_rejected(crossing); }

// What write_result derives from the boxes, changed in the file itself.
TEST(TamperedAttributes, AreRejected) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("corank-attributes-" + std::to_string(getpid()) + ".h5");
  for (const auto& [object, name] :
       {std::pair("/", "complete"), {"/boxes", "isolated"}, {"/boxes", "exact"}, {"/boxes", "wider_than_sigma"}}) {
    write_result(path, points());
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t attribute = H5Aopen_by_name(file, object, name, H5P_DEFAULT, H5P_DEFAULT);
    std::int64_t value = 0;
    H5Aread(attribute, H5T_NATIVE_INT64, &value);
    H5Aclose(attribute);
    value = std::string(name) == "complete" ? 1 - value : value + 1;
    const hid_t space = H5Screate(H5S_SCALAR), owner = H5Oopen(file, object, H5P_DEFAULT);
    EXPECT_GE(H5Adelete(owner, name), 0);
    const hid_t changed = H5Acreate2(owner, name, H5T_NATIVE_INT64, space, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Awrite(changed, H5T_NATIVE_INT64, &value), 0);
    H5Aclose(changed);
    H5Oclose(owner);
    H5Sclose(space);
    H5Fclose(file);
    EXPECT_THROW(read_result(path), ResultFileError) << name;
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace corank::result
