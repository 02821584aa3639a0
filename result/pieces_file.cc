#include "corank/result/pieces_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corank/core/check.h"
#include "corank/result/cover_group.h"
#include "corank/result/hdf5_file.h"
#include "corank/result/output_file.h"
#include "corank/result/piece_proof_group.h"
#include "corank/result/printable.h"
#include "corank/result/source_group.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/determinant_factors.h"
#include "corank/symbolic/model_file.h"
#include "corank/symbolic/singularity_system.h"

namespace corank::result {
namespace {

constexpr std::int64_t kPiecesVersion = 1;
constexpr std::int64_t kMostPieces = 1'000'000, kNone = -1;
constexpr std::array<const char*, 3> kLists{"aspects", "assembly_modes", "working_modes"};
constexpr std::array<const char*, 3> kWords{"aspects", "assembly modes", "working modes"};

std::string proof_group(std::size_t list) { return std::string("/") + kLists[list] + "/proof"; }

symbolic::TrigonometricSystem equations_of(const symbolic::Mechanism& model) {
  return symbolic::singularity_system(model, symbolic::SingularitySet::cspace, std::nullopt, {}, 1);
}

std::vector<check::PieceFunctions> functions_of(const symbolic::Mechanism& model, const PiecesFile& file) {
  const symbolic::TrigonometricSystem equations = equations_of(model);
  std::array<PolynomialMatrix, 2> matrices;
  std::array<std::vector<symbolic::Expression>, 2> factors;
  for (const auto& [k, set] : {std::pair(0U, symbolic::SingularitySet::forward), {1U, symbolic::SingularitySet::inverse}}) {
    const symbolic::ExpressionMatrix m = symbolic::kernel_question(model, set, symbolic::KernelSide::left).matrix;
    factors[k] = symbolic::determinant_factors(model, m);
    matrices[k].rows = matrices[k].columns = static_cast<int>(m.rows.size());
    for (const auto& row : m.rows)
      for (Polynomial& f : symbolic::polynomials(equations, row)) matrices[k].entries.push_back(std::move(f));
  }
  std::vector<symbolic::Expression> both = factors[0];
  for (const auto& e : factors[1])
    if (std::none_of(factors[0].begin(), factors[0].end(), [&](const auto& f) { return same_tree(e, f); }))
      both.push_back(e);
  const auto list = [&](const PieceClaims& claims, const std::vector<symbolic::Expression>& own) {
    std::vector<symbolic::Expression> named;
    for (const std::string& text : claims.factors) named.push_back(symbolic::parse_expression(text, "a factor"));
    return check::PieceFunctions{symbolic::polynomials(equations, named), symbolic::polynomials(equations, own), matrices};
  };
  return {list(file.lists[0], both), list(file.lists[1], factors[0]), list(file.lists[2], factors[1])};
}

void write_list(Hdf5Writer& file, const std::string& name, const PieceClaims& claims, std::size_t n, std::size_t dimension) {
  std::vector<double> lower, upper;
  std::vector<std::int64_t> free, signs, determinants;
  for (const PieceMember& m : claims.members) {
    CORANK_CHECK(m.box.size() == n && m.free.size() == dimension && m.signs.size() == claims.members.front().signs.size());
    for (const Interval& side : m.box) {
      lower.push_back(side.lo());
      upper.push_back(side.hi());
    }
    free.insert(free.end(), m.free.begin(), m.free.end());
    signs.insert(signs.end(), m.signs.begin(), m.signs.end());
    determinants.insert(determinants.end(), m.determinant_signs.begin(), m.determinant_signs.end());
  }
  file.enter("/" + name);
  file.attribute("/", "at_least", std::int64_t{claims.at_least});
  file.attribute("/", "at_most", claims.at_most ? std::int64_t{*claims.at_most} : kNone);
  file.doubles("/lower", lower, claims.members.size(), n);
  file.doubles("/upper", upper, claims.members.size(), n);
  file.integers("/free", free);
  file.integers("/signs", signs);
  file.texts("/factors", claims.factors);
  file.integers("/determinant_signs", determinants);
}

PieceClaims read_list(Hdf5Reader& file, const std::string& name, std::size_t n, std::size_t dimension) {
  const auto refuse = [&](const std::string& what) { throw ResultFileError(file.path() + ": /" + name + ": " + what); };
  const auto number = [&](std::int64_t value, std::int64_t least, std::int64_t most) {
    if (value < least || value > most) refuse("a number is out of range");
    return static_cast<int>(value);
  };
  file.enter("/" + name);
  PieceClaims claims;
  claims.at_least = number(file.integer_attribute("/", "at_least"), 0, kMostPieces);
  const std::int64_t most = file.integer_attribute("/", "at_most");
  if (most != kNone) claims.at_most = number(most, 0, kMostPieces);
  const std::vector<std::int64_t> free = file.integers("/free"), signs = file.integers("/signs"),
                                  determinants = file.integers("/determinant_signs");
  claims.factors = file.texts("/factors");
  const std::size_t members = determinants.size() / 2, functions = members == 0 ? 0 : signs.size() / members;
  if (determinants.size() != 2 * members || free.size() != members * dimension || signs.size() != members * functions)
    refuse("its members differ in length");
  const std::vector<double> lower = file.doubles("/lower", members, n), upper = file.doubles("/upper", members, n);
  for (std::size_t k = 0; k < members; ++k) {
    PieceMember& m = claims.members.emplace_back();
    for (std::size_t j = k * n; j < (k + 1) * n; ++j) {
      if (!(lower[j] <= upper[j])) refuse("a box has a side that is not an interval");
      m.box.emplace_back(lower[j], upper[j]);
    }
    for (std::size_t j = 0; j < dimension; ++j) m.free.push_back(number(free[k * dimension + j], 0, kMostPieces));
    for (std::size_t g = 0; g < functions; ++g) m.signs.push_back(number(signs[k * functions + g], -1, 1));
    for (std::size_t d = 0; d < 2; ++d) m.determinant_signs[d] = number(determinants[2 * k + d], -1, 1);
  }
  file.enter("");
  return claims;
}

}  // namespace

void write_pieces(const std::filesystem::path& path, const PiecesFile& data, const Ended& in_haste) {
  const System system = symbolic::algebrize(equations_of(model_of(data)));
  const std::size_t n = system.variables.size();
  const OutputFile target(path);
  Hdf5Writer file(target.part().string(), 1, in_haste);
  write_source(file, kPiecesFormat, kPiecesVersion, data);
  file.texts("/variables", names(system));
  write_cover(file, "/space", data.space, n);
  for (std::size_t k = 0; k < kLists.size(); ++k)
    write_list(file, kLists[k], data.lists[k], n, static_cast<std::size_t>(data.space.dimension));
  for (std::size_t k = 0; k < kLists.size(); ++k)
    if (const auto& proof = data.lists[k].proof)
      write_piece_proof(file, proof_group(k), *proof, n, static_cast<std::size_t>(data.space.dimension));
  file.close();
  target.finish();
}

bool is_pieces_file(const std::filesystem::path& path) { return format_of(path.string()) == kPiecesFormat; }

PiecesFile read_pieces(const std::filesystem::path& path) {
  Hdf5Reader file(path.string());
  const auto refuse = [&](const std::string& what) { throw ResultFileError(file.path() + ": " + what); };
  PiecesFile data;
  read_source(file, kPiecesFormat, kPiecesVersion, data);
  const std::vector<std::string> expected = names(symbolic::algebrize(equations_of(model_of(data))));
  if (file.texts("/variables") != expected) refuse("its variables are not those of the model");
  data.space = read_cover(file, "/space", expected.size());
  const auto dimension = static_cast<std::size_t>(data.space.dimension);
  for (std::size_t k = 0; k < kLists.size(); ++k) {
    data.lists[k] = read_list(file, kLists[k], expected.size(), dimension);
    if (file.has(proof_group(k))) data.lists[k].proof = read_piece_proof(file, proof_group(k), expected.size(), dimension);
  }
  return data;
}

check::PiecesReport verify(const PiecesFile& file, const check::Options& options) {
  const symbolic::Mechanism model = model_of(file);
  return check::check_pieces(symbolic::algebrize(equations_of(model)), file.space, {file.lists.begin(), file.lists.end()},
                             functions_of(model, file), options);
}

namespace {

std::vector<std::string> all_failures(const check::PiecesReport& report) {
  std::vector<std::string> list = report.failures;
  for (std::size_t k = 0; k < report.lists.size(); ++k)
    for (const std::string& f : report.lists[k].failures) list.push_back(std::string(kLists[k]) + ": " + f);
  return list;
}

std::string claimed(const PieceClaims& c) {
  if (!c.at_most) return fmt::format("at least {}", c.at_least);
  return *c.at_most == c.at_least ? std::to_string(c.at_least) : fmt::format("{} to {}", c.at_least, *c.at_most);
}

}  // namespace

namespace {

std::string confirmed(const check::PieceReport& r) {
  if (!r.at_most) return fmt::format("at least {}", r.at_least);
  return *r.at_most == r.at_least ? std::to_string(r.at_least) : fmt::format("{} to {}", r.at_least, *r.at_most);
}

// Why there may be more pieces than these; empty where there are not.
std::string open_lines(const check::PiecesReport& report) {
  std::string text;
  for (std::size_t k = 0; k < report.lists.size(); ++k) {
    const check::PieceReport& r = report.lists[k];
    if (r.bounded) continue;
    text += fmt::format("not confirmed: that there are at most as many {} as claimed{}{}\n", kWords[k],
                        r.unbounded.empty() ? "" : ": ", r.unbounded);
  }
  return text;
}

}  // namespace

std::string to_table(const check::PiecesReport& report, const PiecesFile& file) {
  std::string text = printable_line(file.model) + ": the pieces of C-space\n";
  for (std::size_t k = 0; k < report.lists.size(); ++k) {
    const check::PieceReport& r = report.lists[k];
    text += fmt::format("  {:<14}  claimed: {}; confirmed: {}, {} members with their signs, on {} cells", kLists[k],
                        claimed(file.lists[k]), confirmed(r), r.members, r.cells);
    text += r.at_most ? fmt::format(" and {} of the file's with {} links\n", r.cells_of_bound, r.links) : "\n";
  }
  const std::vector<std::string> failures = all_failures(report);
  text += failure_lines(failures);
  if (!report.verified())
    return text + (report.interrupted && failures.empty()
                       ? "interrupted in " + report.stage + "; nothing is said about the rest\n"
                       : "NOT VERIFIED\n");
  if (report.complete()) return text + "verified\n";
  text += open_lines(report);
  if (!report.space.complete())
    text += "the file does not prove that its boxes hold all of C-space, on which the counts rest\n";
  return text + "verified, except for completeness\n";
}

std::string to_json(const check::PiecesReport& report, const PiecesFile& file) {
  using Json = nlohmann::ordered_json;
  const auto or_null = [](const std::optional<int>& x) { return x ? Json(*x) : Json(); };
  Json json{{"verified", report.verified()},
            {"complete", report.complete()},
            {"covers_cspace", report.covered()},
            {"interrupted", report.interrupted}};
  for (std::size_t k = 0; k < report.lists.size(); ++k) {
    const check::PieceReport& r = report.lists[k];
    json[kLists[k]] = {{"claimed", {{"at_least", file.lists[k].at_least}, {"at_most", or_null(file.lists[k].at_most)}}},
                       {"at_least", r.at_least},
                       {"at_most", or_null(r.at_most)},
                       {"members", r.members},
                       {"cells", r.cells_of_bound},
                       {"links", r.links}};
    if (!r.bounded) json[kLists[k]]["open"] = r.unbounded;
  }
  json["failures"] = all_failures(report);
  if (report.interrupted) json["stage"] = report.stage;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace corank::result
