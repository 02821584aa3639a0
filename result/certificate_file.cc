#include "corank/result/certificate_file.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "corank/core/check.h"
#include "corank/result/printable.h"

namespace corank::result {
namespace {

const std::string kGroup = "/certificates/";
const std::string kPoints = kGroup + "exact_points/";
const std::string kProof = kGroup + "proof/";
const std::string kReduction = kGroup + "reduction/";
const std::string kImplied = kGroup + "implied/";
const std::string kMotions = kGroup + "self_motions/";

void append(const std::vector<Interval>& box, std::vector<double>& lower, std::vector<double>& upper) {
  for (const Interval& side : box) {
    lower.push_back(side.lo());
    upper.push_back(side.hi());
  }
}

std::string to_text(const RationalPolynomial& f) {
  std::string text;
  for (const ExactNumber& c : f) text += (text.empty() ? "" : ", ") + c.text();
  return text;
}

void write_indices(Hdf5Writer& file, const std::string& name, const std::vector<CoverBox>& boxes) {
  std::vector<std::int32_t> indices(boxes.size());
  for (const auto& [word, member] :
       {std::pair("_corank", &CoverBox::kernel_at_most), std::pair("_region", &CoverBox::region),
        std::pair("_point", &CoverBox::point), std::pair("_motion", &CoverBox::motion)}) {
    for (std::size_t i = 0; i < boxes.size(); ++i) indices[i] = boxes[i].*member;
    file.packed(kGroup + name + word, indices);
  }
}

// The relations of all self-motions, one after the other, each with a coefficient for every variable and a constant.
void write_motions(Hdf5Writer& file, const std::vector<SelfMotionRecord>& motions, std::size_t variables) {
  std::vector<std::int64_t> dimensions, counts;
  std::vector<std::string> coefficients;
  for (const SelfMotionRecord& motion : motions) {
    dimensions.push_back(motion.dimension);
    counts.push_back(static_cast<std::int64_t>(motion.relations.size()));
    for (const Polynomial& f : motion.relations) {
      std::vector<ExactNumber> row(variables + 1);
      for (const Monomial& m : f.monomials)
        row[m.factors.empty() ? variables : static_cast<std::size_t>(m.factors[0].variable)] = m.coefficient;
      for (const ExactNumber& c : row) coefficients.push_back(c.text());
    }
  }
  file.integers(kMotions + "dimension", dimensions);
  file.integers(kMotions + "relations", counts);
  file.texts(kMotions + "coefficients", coefficients);
}

void write_points(Hdf5Writer& file, const std::vector<ExactPoint>& points, std::size_t variables) {
  std::vector<std::string> polynomials, lower, upper, coordinates;
  std::vector<std::int64_t> corank;
  std::vector<double> sole_within;
  std::vector<std::uint8_t> proven, excluded;
  for (const ExactPoint& p : points) {
    proven.push_back(p.types.proven);
    excluded.push_back(p.types.excluded);
    CORANK_CHECK(p.coordinates.size() == variables);
    polynomials.push_back(to_text(p.polynomial));
    lower.push_back(p.lower.text());
    upper.push_back(p.upper.text());
    for (const RationalPolynomial& x : p.coordinates) coordinates.push_back(to_text(x));
    corank.push_back(p.corank);
    sole_within.push_back(p.sole_within);
  }
  file.texts(kPoints + "polynomial", polynomials);
  file.texts(kPoints + "lower", lower);
  file.texts(kPoints + "upper", upper);
  file.texts(kPoints + "coordinates", coordinates);
  file.integers(kPoints + "corank", corank);
  file.packed(kPoints + "sole_within", sole_within);
  file.packed(kPoints + "types_proven", proven);
  file.packed(kPoints + "types_excluded", excluded);
}

void write_proof(Hdf5Writer& file, const Proof& proof) {
  std::vector<double> lower, upper;
  for (const auto& root : proof.roots) append(root, lower, upper);
  file.packed(kProof + "root_lower", lower);
  file.packed(kProof + "root_upper", upper);
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
    read_implied();
    cover_.regions = boxes(kGroup + "region", n_);
    read_points();
    read_motions();
    read_indices("box", cover_.boxes);
    read_indices("point", cover_.points);
    read_decimals();
    if (file_.has(kGroup + "proof")) cover_.proof = std::make_shared<const Proof>(proof());
  }

 private:
  [[noreturn]] void refuse(const std::string& problem) const {
    throw ResultFileError(printable_line(file_.path() + ": " + problem));
  }

  template <class T>
  std::vector<T> vector(const std::string& name) const {
    std::vector<T> data;
    file_.read(name, data);
    return data;
  }

  // name_lower and name_upper, each a multiple of `width` numbers.
  std::vector<Box> boxes(const std::string& name, std::size_t width) const {
    const auto lower = vector<double>(name + "_lower"), upper = vector<double>(name + "_upper");
    if (lower.size() != upper.size() || (width == 0 ? !lower.empty() : lower.size() % width != 0))
      refuse(name + "_lower and _upper have no whole boxes");
    std::vector<Box> result(width == 0 ? 0 : lower.size() / width);
    for (std::size_t i = 0; i < lower.size(); ++i) {
      if (!(lower[i] <= upper[i])) refuse(name + "_lower and _upper hold an empty interval");
      result[i / width].push_back({lower[i], upper[i]});
    }
    return result;
  }

  void read_reduction() {
    if (!file_.has(kGroup + "reduction")) refuse("certificates of format version 2: solve again");
    const auto variables = file_.integers(kReduction + "variable"), equations = file_.integers(kReduction + "equation"),
               others = file_.integers(kReduction + "other");
    const auto factors = file_.texts(kReduction + "factor");
    if (variables.size() != equations.size() || variables.size() != others.size() || variables.size() != factors.size())
      refuse(kReduction + "variable, equation, other and factor differ in length");
    for (std::size_t k = 0; k < variables.size(); ++k) {
      const auto is_index = [](std::int64_t i) { return i >= -1 && i <= std::numeric_limits<int>::max(); };
      if (!is_index(variables[k]) || variables[k] >= static_cast<std::int64_t>(n_) || !is_index(equations[k]) ||
          !is_index(others[k]))
        refuse(kReduction + " names no variable or no equation");
      const int variable = static_cast<int>(variables[k]), equation = static_cast<int>(equations[k]);
      const ExactNumber factor = number(factors[k], kReduction + "factor");
      if (variable < 0) {
        cover_.reduction.emplace_back(SumOfEquations{equation, static_cast<int>(others[k]), factor});
      } else {
        cover_.reduction.emplace_back(Elimination{variable, equation < 0 ? std::nullopt : std::optional(equation)});
      }
    }
  }

  void read_implied() {
    if (!file_.has(kGroup + "implied")) return;  // before format version 4
    const auto parts = file_.integers(kImplied + "parts"), equations = file_.integers(kImplied + "equation"),
               powers = file_.integers(kImplied + "powers"), variables = file_.integers(kImplied + "variable"),
               power = file_.integers(kImplied + "power");
    const auto factors = file_.texts(kImplied + "factor");
    if (equations.size() != factors.size() || powers.size() != factors.size() || variables.size() != power.size())
      refuse(kImplied + "equation, factor, powers, variable and power differ in length");
    const auto take = [&](std::int64_t count, std::size_t& next, std::size_t size, const std::string& name) {
      if (count < 0 || static_cast<std::uint64_t>(count) > size - next) refuse(kImplied + name + " is out of range");
      const std::size_t first = next;
      next += static_cast<std::size_t>(count);
      return first;
    };
    const auto number_in = [&](std::int64_t i, std::int64_t least) {
      if (i < least || i > std::numeric_limits<int>::max()) refuse(kImplied + "equation, variable or power is out of range");
      return static_cast<int>(i);
    };
    std::size_t part = 0, factor = 0;
    for (const std::int64_t count : parts) {
      ImpliedEquation implied;
      for (std::size_t k = take(count, part, factors.size(), "parts"); k < part; ++k) {
        ImpliedEquation::Part p{number_in(equations[k], 0), number(factors[k], kImplied + "factor"), {}};
        for (std::size_t f = take(powers[k], factor, variables.size(), "powers"); f < factor; ++f)
          p.product.push_back({number_in(variables[f], 0), number_in(power[f], 1)});
        implied.parts.push_back(std::move(p));
      }
      cover_.reduction.emplace_back(std::move(implied));
    }
    if (part != factors.size() || factor != variables.size()) refuse(kImplied + "parts and powers do not use all of it");
  }

  void read_motions() {
    if (!file_.has(kGroup + "self_motions")) return;  // before format version 4
    const auto dimensions = file_.integers(kMotions + "dimension"), counts = file_.integers(kMotions + "relations");
    const auto coefficients = file_.texts(kMotions + "coefficients");
    if (dimensions.size() != counts.size()) refuse(kMotions + "dimension and relations differ in length");
    std::size_t next = 0;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      if (counts[k] < 0 || counts[k] > static_cast<std::int64_t>(n_) || dimensions[k] < 0 ||
          dimensions[k] > static_cast<std::int64_t>(n_))
        refuse(kMotions + "dimension or relations is out of range");
      SelfMotionRecord motion{static_cast<int>(dimensions[k]), {}};
      for (std::int64_t i = 0; i < counts[k]; ++i) {
        if (coefficients.size() - next < n_ + 1) refuse(kMotions + "coefficients is too short");
        Polynomial f{{}, "self-motion"};
        for (std::size_t v = 0; v <= n_; ++v) {
          const ExactNumber c = number(coefficients[next++], kMotions + "coefficients");
          std::vector<Factor> factors;
          if (v < n_) factors.push_back({static_cast<int>(v), 1});
          if (!c.is_zero()) f.monomials.emplace_back(c, std::move(factors));
        }
        motion.relations.push_back(std::move(f));
      }
      cover_.self_motions.push_back(std::move(motion));
    }
    if (next != coefficients.size()) refuse(kMotions + "coefficients is too long");
  }

  void read_indices(const std::string& name, std::vector<CoverBox>& list) const {
    const auto regions = vector<std::int32_t>(kGroup + name + "_region"),
               points = vector<std::int32_t>(kGroup + name + "_point"),
               coranks = vector<std::int32_t>(kGroup + name + "_corank");
    if (regions.size() != list.size() || points.size() != list.size() || coranks.size() != list.size())
      refuse(kGroup + name + "_region, _point or _corank has another length than the list of boxes");
    const auto fits = [](std::int32_t index, std::size_t size) {
      return index >= -1 && index < static_cast<std::int64_t>(size);
    };
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (!fits(regions[i], cover_.regions.size()) || !fits(points[i], cover_.exact_points.size()))
        refuse(kGroup + name + "_region or _point is out of range");
      if (coranks[i] < -1 || coranks[i] > static_cast<std::int64_t>(n_)) refuse(kGroup + name + "_corank is out of range");
      list[i].region = regions[i];
      list[i].point = points[i];
      list[i].kernel_at_most = coranks[i];
    }
    if (!file_.has(kGroup + name + "_motion")) return;  // before format version 4
    const auto motions = vector<std::int32_t>(kGroup + name + "_motion");
    if (motions.size() != list.size()) refuse(kGroup + name + "_motion has another length than the list of boxes");
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (!fits(motions[i], cover_.self_motions.size())) refuse(kGroup + name + "_motion is out of range");
      list[i].motion = motions[i];
    }
  }

  void read_decimals() {
    const std::vector<std::string> texts = file_.texts(kGroup + "decimals");
    if (texts.empty()) return;
    if (n_ == 0 || texts.size() != cover_.points.size() * n_)
      refuse(kGroup + "decimals has another length than the list of points");
    const auto is_decimal = [](const std::string& t) { return t.find_first_not_of("-.0123456789") == std::string::npos; };
    if (!std::all_of(texts.begin(), texts.end(), is_decimal)) refuse(kGroup + "decimals holds a text that is not a number");
    for (std::size_t i = 0; i < cover_.points.size(); ++i) {
      const auto from = texts.begin() + static_cast<std::ptrdiff_t>(i * n_);
      cover_.decimals.emplace_back(from, from + static_cast<std::ptrdiff_t>(n_));
      if (cover_.decimals.back().front().empty()) cover_.decimals.back().clear();  // nothing proven
    }
  }

  ExactNumber number(const std::string& text, const std::string& where) const {
    try {
      return ExactNumber::rational(text);
    } catch (const std::exception& error) {
      refuse(where + ": " + error.what());
    }
  }

  RationalPolynomial polynomial(const std::string& text, const std::string& where) const {
    RationalPolynomial f;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find(", ", begin), text.size());
      f.push_back(number(text.substr(begin, end - begin), where));
      begin = end + 2;
    }
    return f;
  }

  void read_points() {
    const auto polynomials = file_.texts(kPoints + "polynomial"), lower = file_.texts(kPoints + "lower"),
               upper = file_.texts(kPoints + "upper"), coordinates = file_.texts(kPoints + "coordinates");
    const auto corank = file_.integers(kPoints + "corank");
    const auto sole_within = vector<double>(kPoints + "sole_within");
    const std::size_t size = polynomials.size();
    if (lower.size() != size || upper.size() != size || coordinates.size() != size * n_ || corank.size() != size ||
        sole_within.size() != size)
      refuse(kPoints + " differ in length");
    for (std::size_t i = 0; i < size; ++i) {
      ExactPoint point;
      point.polynomial = polynomial(polynomials[i], kPoints + "polynomial");
      point.lower = number(lower[i], kPoints + "lower");
      point.upper = number(upper[i], kPoints + "upper");
      for (std::size_t j = 0; j < n_; ++j)
        point.coordinates.push_back(polynomial(coordinates[i * n_ + j], kPoints + "coordinates"));
      if (corank[i] < -1 || corank[i] > static_cast<std::int64_t>(n_)) refuse(kPoints + "corank is out of range");
      point.corank = static_cast<int>(corank[i]);
      point.sole_within = sole_within[i];
      cover_.exact_points.push_back(std::move(point));
    }
    if (!file_.has(kPoints + "types_proven")) return;  // older files
    const auto proven = vector<std::uint8_t>(kPoints + "types_proven"),
               excluded = vector<std::uint8_t>(kPoints + "types_excluded");
    if (proven.size() != size || excluded.size() != size)
      refuse(kPoints + "types_proven or _excluded has another length than the list of points");
    for (std::size_t i = 0; i < size; ++i) {
      if (proven[i] > kAllTypes || excluded[i] > kAllTypes) refuse(kPoints + "types_proven or _excluded is out of range");
      cover_.exact_points[i].types = {proven[i], excluded[i]};
    }
  }

  Proof proof() const {
    Proof proof;
    const auto eliminated = static_cast<std::size_t>(
        std::count_if(cover_.reduction.begin(), cover_.reduction.end(),
                      [](const ReductionStep& step) { return std::holds_alternative<Elimination>(step); }));
    if (n_ < eliminated) refuse("more variables were eliminated than there are");
    proof.roots = boxes(kProof + "root", n_ - eliminated);
    if (n_ == eliminated) proof.roots.resize(1);  // the only point that there is, without a number
    const auto sizes = vector<std::int32_t>(kProof + "combination_size"),
               equations = vector<std::int32_t>(kProof + "combination_equations"),
               dependent = vector<std::int32_t>(kProof + "combination_dependent");
    const auto y = vector<float>(kProof + "combination_y");
    std::size_t at = 0, entry = 0;
    for (const std::int32_t size : sizes) {
      const auto r = static_cast<std::size_t>(size);
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
    proof.steps = vector<std::uint8_t>(kProof + "steps");
    proof.integers = vector<std::int32_t>(kProof + "integers");
    proof.reals = vector<double>(kProof + "reals");
    return proof;
  }

  const Hdf5Reader& file_;
  Cover& cover_;
  std::size_t n_;
};

}  // namespace

void write_certificates(Hdf5Writer& file, const Cover& cover, std::size_t variables) {
  std::vector<std::int64_t> eliminated, equations, others;
  std::vector<std::string> factors;
  std::vector<std::int64_t> parts, of_equation, powers, variable, power;
  std::vector<std::string> part_factors;
  for (const ReductionStep& step : cover.reduction) {
    if (const auto* implied = std::get_if<ImpliedEquation>(&step)) {
      parts.push_back(static_cast<std::int64_t>(implied->parts.size()));
      for (const ImpliedEquation::Part& part : implied->parts) {
        of_equation.push_back(part.equation);
        part_factors.push_back(part.factor.text());
        powers.push_back(static_cast<std::int64_t>(part.product.size()));
        for (const Factor& x : part.product) variable.push_back(x.variable), power.push_back(x.power);
      }
      continue;
    }
    const auto* elimination = std::get_if<Elimination>(&step);
    const SumOfEquations sum =
        elimination ? SumOfEquations{elimination->equation.value_or(-1), -1, 0} : std::get<SumOfEquations>(step);
    eliminated.push_back(elimination ? elimination->variable : -1);
    equations.push_back(sum.equation);
    others.push_back(sum.other);
    factors.push_back(sum.factor.text());
  }
  file.integers(kReduction + "variable", eliminated);
  file.integers(kReduction + "equation", equations);
  file.integers(kReduction + "other", others);
  file.texts(kReduction + "factor", factors);
  file.integers(kImplied + "parts", parts);
  file.integers(kImplied + "equation", of_equation);
  file.texts(kImplied + "factor", part_factors);
  file.integers(kImplied + "powers", powers);
  file.integers(kImplied + "variable", variable);
  file.integers(kImplied + "power", power);
  std::vector<double> lower, upper;
  for (const Box& region : cover.regions) {
    CORANK_CHECK(region.size() == variables);
    append(region, lower, upper);
  }
  file.packed(kGroup + "region_lower", lower);
  file.packed(kGroup + "region_upper", upper);
  write_indices(file, "box", cover.boxes);
  write_indices(file, "point", cover.points);
  std::vector<std::string> decimals;
  for (std::vector<std::string> of_point : cover.decimals) {
    of_point.resize(variables);
    decimals.insert(decimals.end(), of_point.begin(), of_point.end());
  }
  file.texts(kGroup + "decimals", decimals);
  write_points(file, cover.exact_points, variables);
  write_motions(file, cover.self_motions, variables);
  if (cover.proof) write_proof(file, *cover.proof);
}

void read_certificates(const Hdf5Reader& file, Cover& cover, std::size_t variables) {
  Reader(file, cover, variables).read();
}

}  // namespace corank::result
