#include "corank/result/files/cover_group.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "corank/core/check.h"
#include "corank/core/proof.h"
#include "corank/result/files/stored_list.h"

namespace corank::result {
namespace {

const EnumWords kVerdictWords = words_of<Verdict>(kVerdicts);

const std::string kGroup = "/certificates/";
const std::string kPoints = kGroup + "exact_points/";
const std::string kProof = kGroup + "proof/";
const std::string kReduction = kGroup + "reduction/";
const std::string kImplied = kGroup + "implied/";
const std::string kMotions = kGroup + "self_motions/";

// An elimination, or a sum of two equations; −1: none.
struct ReductionRow {
  int variable = -1, equation = -1, other = -1;
  ExactNumber factor;
};

constexpr auto kReductionFields = [](auto& field, auto& row) {
  field("variable", row.variable, -1);
  field("equation", row.equation, -1);
  field("other", row.other, -1);
  field("factor", row.factor);
};

// A part of an implied equation: its product is this number of the powers that follow one another.
struct ImpliedRow {
  int equation = 0, powers = 0;
  ExactNumber factor;
};

constexpr auto kImpliedFields = [](auto& field, auto& row) {
  field("equation", row.equation, 0);
  field("factor", row.factor);
  field("powers", row.powers, 0);
};

constexpr auto kPowerFields = [](auto& field, auto& x) {
  field("variable", x.variable, 0);
  field("power", x.power, 1);
};

// Of a self-motion, whose relations follow one another, each with a coefficient for every variable and a constant.
struct MotionRow {
  int dimension = 0, relations = 0;
};

auto motion_fields(std::size_t variables) {
  return [n = static_cast<int>(variables)](auto& field, auto& row) {
    field("dimension", row.dimension, 0, n);
    field("relations", row.relations, 0, n);
  };
}

constexpr auto kCoefficient = [](auto& field, auto& x) { field("coefficients", x); };

auto point_fields(std::size_t variables) {
  return [n = variables](auto& field, auto& point) {
    field("polynomial", point.polynomial);
    field("lower", point.lower);
    field("upper", point.upper);
    field.row("coordinates", point.coordinates, n);
    field("corank", point.corank, -1, static_cast<int>(n));
    field.packed("sole_within", point.sole_within);
  };
}

constexpr auto kPointTypes = [](auto& field, auto& point) {
  field.packed("types_proven", point.types.proven, kAllTypes);
  field.packed("types_excluded", point.types.excluded, kAllTypes);
};

auto index_fields(const Cover& cover, std::size_t variables, bool with_motions = true) {
  const auto last = [](std::size_t size) { return static_cast<int>(size) - 1; };
  return [n = static_cast<int>(variables), regions = last(cover.regions.size()), points = last(cover.exact_points.size()),
          motions = last(cover.self_motions.size()), with_motions](auto& field, auto& box) {
    field("corank", box.kernel_at_most, -1, n);
    field("region", box.region, -1, regions);
    field("point", box.point, -1, points);
    if (with_motions) field("motion", box.motion, -1, motions);
  };
}

auto box_fields(std::size_t width) {
  return [width](auto& field, auto& box) { field.box("", box, width); };
}

void write_motions(Hdf5Writer& file, const std::vector<SelfMotionRecord>& motions, std::size_t variables) {
  std::vector<MotionRow> rows;
  std::vector<ExactNumber> coefficients;
  for (const SelfMotionRecord& motion : motions) {
    rows.push_back({motion.dimension, static_cast<int>(motion.relations.size())});
    for (const Polynomial& f : motion.relations) {
      const std::size_t first = coefficients.size();
      coefficients.resize(first + variables + 1);
      for (const Monomial& m : f.monomials)
        coefficients[first + (m.factors.empty() ? variables : static_cast<std::size_t>(m.factors[0].variable))] =
            m.coefficient;
    }
  }
  write_list(file, kMotions, rows, motion_fields(variables));
  write_list(file, kMotions, coefficients, kCoefficient);
}

void write_proof(Hdf5Writer& file, const Proof& proof) {
  write_list(file, kProof + "root_", proof.roots, box_fields(proof.roots.empty() ? 0 : proof.roots.front().size()),
             Storage::packed);
  std::vector<std::int32_t> sizes, equations, dependent;
  std::vector<float> y;
  for (const Proof::Combination& c : proof.combinations) {
    CORANK_CHECK(c.equations.size() == c.dependent.size() && c.y.size() == c.dependent.size() * c.dependent.size());
    sizes.push_back(static_cast<std::int32_t>(c.dependent.size()));
    equations.insert(equations.end(), c.equations.begin(), c.equations.end());
    dependent.insert(dependent.end(), c.dependent.begin(), c.dependent.end());
    y.insert(y.end(), c.y.begin(), c.y.end());
  }
  file.packed(kProof + "combination_size", sizes);
  file.packed(kProof + "combination_equations", equations);
  file.packed(kProof + "combination_dependent", dependent);
  file.packed(kProof + "combination_y", y);
  file.packed(kProof + "steps", proof.steps);
  file.packed(kProof + "integers", proof.integers);
  file.packed(kProof + "reals", proof.reals);
}

class Reader {
 public:
  Reader(const Hdf5Reader& file, Cover& cover, std::size_t variables) : file_(file), cover_(cover), n_(variables) {}

  void read() {
    read_reduction();
    const bool has_motions = file_.has(kGroup + "self_motions");  // and what else format version 4 has brought
    if (has_motions) read_implied();
    cover_.regions = read_list<Box>(file_, kGroup + "region_", box_fields(n_), Storage::packed);
    cover_.exact_points = read_list<ExactPoint>(file_, kPoints, point_fields(n_));
    if (file_.has(kPoints + "types_proven")) read_into(file_, kPoints, cover_.exact_points, kPointTypes);
    if (has_motions) read_motions();
    read_into(file_, kGroup + "box_", cover_.boxes, index_fields(cover_, n_, has_motions), Storage::packed);
    read_into(file_, kGroup + "point_", cover_.points, index_fields(cover_, n_, has_motions), Storage::packed);
    read_decimals();
    if (file_.has(kGroup + "proof")) cover_.proof = std::make_shared<const Proof>(proof());
  }

 private:
  [[noreturn]] void refuse(const std::string& problem) const { file_.fail(problem); }

  void read_reduction() {
    for (const ReductionRow& row : read_list<ReductionRow>(file_, kReduction, kReductionFields)) {
      if (row.variable >= static_cast<int>(n_)) refuse(kReduction + " names no variable");
      if (row.variable < 0) {
        cover_.reduction.emplace_back(SumOfEquations{row.equation, row.other, row.factor});
      } else {
        cover_.reduction.emplace_back(
            Elimination{row.variable, row.equation < 0 ? std::nullopt : std::optional(row.equation)});
      }
    }
  }

  void read_implied() {
    const auto counts = file_.vector<std::int64_t>(kImplied + "parts");
    const auto rows = read_list<ImpliedRow>(file_, kImplied, kImpliedFields);
    const auto powers = read_list<Factor>(file_, kImplied, kPowerFields);
    const auto take = [&](std::int64_t count, std::size_t& next, std::size_t size, const std::string& name) {
      if (count < 0 || static_cast<std::uint64_t>(count) > size - next) refuse(kImplied + name + " is out of range");
      return std::exchange(next, next + count);
    };
    std::size_t row = 0, power = 0;
    for (const std::int64_t count : counts) {
      ImpliedEquation implied;
      for (std::size_t k = take(count, row, rows.size(), "parts"); k < row; ++k) {
        ImpliedEquation::Multiple& part =
            implied.parts.emplace_back(ImpliedEquation::Multiple{rows[k].equation, rows[k].factor, {}});
        const std::size_t first = take(rows[k].powers, power, powers.size(), "powers");
        for (std::size_t f = first; f < power; ++f) part.product.push_back(powers[f]);
      }
      cover_.reduction.emplace_back(std::move(implied));
    }
    if (row != rows.size() || power != powers.size()) refuse(kImplied + "parts and powers do not use all of it");
  }

  void read_motions() {
    const auto coefficients = read_list<ExactNumber>(file_, kMotions, kCoefficient);
    std::size_t next = 0;
    for (const MotionRow& row : read_list<MotionRow>(file_, kMotions, motion_fields(n_))) {
      SelfMotionRecord& motion = cover_.self_motions.emplace_back(SelfMotionRecord{row.dimension, {}});
      for (int i = 0; i < row.relations; ++i) {
        if (coefficients.size() - next < n_ + 1) refuse(kMotions + "coefficients is too short");
        Polynomial& f = motion.relations.emplace_back(Polynomial{{}, "self-motion"});
        for (std::size_t v = 0; v <= n_; ++v) {
          const ExactNumber& c = coefficients[next++];
          std::vector<Factor> factors;
          if (v < n_) factors.push_back({static_cast<int>(v), 1});
          if (!c.is_zero()) f.monomials.emplace_back(c, std::move(factors));
        }
      }
    }
    if (next != coefficients.size()) refuse(kMotions + "coefficients is too long");
  }

  void read_decimals() {
    const std::vector<std::string> texts = file_.texts(kGroup + "decimals");
    if (texts.empty()) return;
    if (n_ == 0 || texts.size() != cover_.points.size() * n_)
      refuse(kGroup + "decimals has another length than the list of points");
    const auto is_decimal = [](const std::string& t) { return t.find_first_not_of("-.0123456789") == std::string::npos; };
    if (!std::ranges::all_of(texts, is_decimal)) refuse(kGroup + "decimals holds a text that is not a number");
    for (std::size_t i = 0; i < cover_.points.size(); ++i) {
      const auto from = texts.begin() + static_cast<std::ptrdiff_t>(i * n_);
      cover_.decimals.emplace_back(from, from + static_cast<std::ptrdiff_t>(n_));
      if (cover_.decimals.back().front().empty()) cover_.decimals.back().clear();  // nothing proven
    }
  }

  Proof proof() const {
    Proof proof;
    const auto eliminated = static_cast<std::size_t>(std::ranges::count_if(
        cover_.reduction, [](const ReductionStep& step) { return std::holds_alternative<Elimination>(step); }));
    if (n_ < eliminated) refuse("more variables were eliminated than there are");
    proof.roots = read_list<Box>(file_, kProof + "root_", box_fields(n_ - eliminated), Storage::packed);
    if (n_ == eliminated) proof.roots.resize(1);  // the only point that there is, without a number
    const auto sizes = file_.vector<std::int32_t>(kProof + "combination_size"),
               equations = file_.vector<std::int32_t>(kProof + "combination_equations"),
               dependent = file_.vector<std::int32_t>(kProof + "combination_dependent");
    const auto y = file_.vector<float>(kProof + "combination_y");
    std::size_t at = 0, entry = 0;
    for (const std::int32_t size : sizes) {
      const std::size_t r = size;
      if (size < 0 || r > n_ || r > equations.size() - at || r > dependent.size() - at || r * r > y.size() - entry)
        refuse(kProof + "combination_size contradicts the other vectors");
      const auto from = static_cast<std::ptrdiff_t>(at), to = static_cast<std::ptrdiff_t>(at + r);
      Proof::Combination c;
      c.equations.assign(equations.begin() + from, equations.begin() + to);
      c.dependent.assign(dependent.begin() + from, dependent.begin() + to);
      c.y.assign(y.begin() + static_cast<std::ptrdiff_t>(entry), y.begin() + static_cast<std::ptrdiff_t>(entry + r * r));
      proof.combinations.push_back(std::move(c));
      at += r;
      entry += r * r;
    }
    if (at != equations.size() || at != dependent.size() || entry != y.size())
      refuse(kProof + "combination_size contradicts the other vectors");
    proof.steps = file_.vector<std::uint8_t>(kProof + "steps");
    proof.integers = file_.vector<std::int32_t>(kProof + "integers");
    proof.reals = file_.vector<double>(kProof + "reals");
    return proof;
  }

  const Hdf5Reader& file_;
  Cover& cover_;
  std::size_t n_;
};

}  // namespace

void write_boxes(Hdf5Writer& file, const std::string& group, const std::vector<CoverBox>& boxes, std::size_t n) {
  std::vector<std::uint8_t> verdict;
  for (const CoverBox& box : boxes) {
    CORANK_CHECK(box.box.size() == n);
    verdict.push_back(static_cast<std::uint8_t>(box.verdict));
  }
  file.doubles(group + "/lower", boxes.size(), n, [&](std::size_t i, std::span<double> to) {
    for (std::size_t j = 0; j < n; ++j) to[j] = boxes[i].box[j].lo();
  });
  file.doubles(group + "/upper", boxes.size(), n, [&](std::size_t i, std::span<double> to) {
    for (std::size_t j = 0; j < n; ++j) to[j] = boxes[i].box[j].hi();
  });
  file.enumeration(group + "/verdict", verdict, kVerdictWords);
  file.bytes(group + "/free", boxes.size(), n, [&](std::size_t i, std::span<std::uint8_t> to) {
    for (const int f : boxes[i].free) {
      CORANK_CHECK(static_cast<std::size_t>(f) < n);
      to[f] = 1;
    }
  });
}

std::vector<CoverBox> read_boxes(Hdf5Reader& file, const std::string& group, std::size_t n, const std::vector<int>* sides,
                                 bool with_free) {
  const std::vector<std::uint8_t> verdict = file.enumeration(group + "/verdict", kVerdictWords);
  std::vector<CoverBox> boxes(verdict.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].verdict = static_cast<Verdict>(verdict[i]);
  file.take_rows({group + "/lower", group + "/upper"}, group + "/free", boxes.size(), n,
                 [&](std::size_t i, std::span<const std::span<const double>> ends, std::span<const std::uint8_t> free) {
                   CoverBox& b = boxes[i];
                   b.box.reserve(sides ? sides->size() : n);  // no more: there may be many
                   const auto add = [&](std::size_t j) {
                     if (!(ends[0][j] <= ends[1][j])) file.fail(group + " holds an empty interval");
                     b.box.emplace_back(ends[0][j], ends[1][j]);
                   };
                   for (std::size_t k = 0; k < (sides ? sides->size() : n); ++k)
                     add(sides ? static_cast<std::size_t>((*sides)[k]) : k);
                   if (!with_free) return;
                   b.free.reserve(n - std::ranges::count(free, 0));
                   for (std::size_t j = 0; j < n; ++j)
                     if (free[j] != 0) b.free.push_back(static_cast<int>(j));
                 });
  return boxes;
}

void write_certificates(Hdf5Writer& file, const Cover& cover, std::size_t variables) {
  std::vector<ReductionRow> rows;
  std::vector<std::int64_t> parts;
  std::vector<ImpliedRow> implied_rows;
  std::vector<Factor> powers;
  for (const ReductionStep& step : cover.reduction) {
    if (const auto* implied = std::get_if<ImpliedEquation>(&step)) {
      parts.push_back(static_cast<std::int64_t>(implied->parts.size()));
      for (const ImpliedEquation::Multiple& part : implied->parts) {
        implied_rows.push_back({part.equation, static_cast<int>(part.product.size()), part.factor});
        powers.insert(powers.end(), part.product.begin(), part.product.end());
      }
    } else if (const auto* elimination = std::get_if<Elimination>(&step)) {
      rows.push_back({elimination->variable, elimination->equation.value_or(-1), -1, 0});
    } else {
      const auto& sum = std::get<SumOfEquations>(step);
      rows.push_back({-1, sum.equation, sum.other, sum.factor});
    }
  }
  write_list(file, kReduction, rows, kReductionFields);
  file.integers(kImplied + "parts", parts);
  write_list(file, kImplied, implied_rows, kImpliedFields);
  write_list(file, kImplied, powers, kPowerFields);
  write_list(file, kGroup + "region_", cover.regions, box_fields(variables), Storage::packed);
  write_list(file, kGroup + "box_", cover.boxes, index_fields(cover, variables), Storage::packed);
  write_list(file, kGroup + "point_", cover.points, index_fields(cover, variables), Storage::packed);
  std::vector<std::string> decimals;
  for (std::vector<std::string> of_point : cover.decimals) {
    of_point.resize(variables);
    decimals.insert(decimals.end(), of_point.begin(), of_point.end());
  }
  file.texts(kGroup + "decimals", decimals);
  write_list(file, kPoints, cover.exact_points, point_fields(variables));
  write_list(file, kPoints, cover.exact_points, kPointTypes);
  write_motions(file, cover.self_motions, variables);
  if (cover.proof) write_proof(file, *cover.proof);
}

void read_certificates(const Hdf5Reader& file, Cover& cover, std::size_t variables) {
  Reader(file, cover, variables).read();
}

void write_cover(Hdf5Writer& file, const std::string& group, const Cover& cover, std::size_t variables) {
  file.enter(group);
  file.attribute("/", "dimension", std::int64_t{cover.dimension});
  file.attribute("/", "sigma_length", cover.sigma.length);
  file.attribute("/", "sigma_angle", cover.sigma.angle);
  write_boxes(file, "/boxes", cover.boxes, variables);
  write_boxes(file, "/points", cover.points, variables);
  write_certificates(file, cover, variables);
}

Cover read_cover(Hdf5Reader& file, const std::string& group, std::size_t variables) {
  file.enter(group);
  Cover cover;
  cover.dimension = file.integer("/", "dimension", 0, static_cast<std::int64_t>(variables));
  cover.sigma = {file.attribute<double>("/", "sigma_length"), file.attribute<double>("/", "sigma_angle")};
  cover.boxes = read_boxes(file, "/boxes", variables);
  cover.points = read_boxes(file, "/points", variables);
  read_certificates(file, cover, variables);
  file.enter("");
  return cover;
}

}  // namespace corank::result
