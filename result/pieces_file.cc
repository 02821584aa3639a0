#include "corank/result/pieces_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corank/result/cover_group.h"
#include "corank/result/printable.h"
#include "corank/result/stored_list.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/determinant_factors.h"
#include "corank/symbolic/model_file.h"
#include "corank/symbolic/singularity_system.h"

namespace corank::result {
namespace {

constexpr int kMostPieces = 1'000'000, kNone = -1;
constexpr std::array<const char*, 3> kLists{"aspects", "assembly_modes", "working_modes"};
constexpr std::array<const char*, 3> kWords{"aspects", "assembly modes", "working modes"};

symbolic::TrigonometricSystem equations_of(const symbolic::Mechanism& model) {
  return symbolic::singularity_system(model, symbolic::SingularitySet::cspace, std::nullopt, {}, 1);
}

std::vector<check::PieceFunctions> functions_of(const symbolic::Mechanism& model, const PiecesFile& file) {
  const symbolic::TrigonometricSystem equations = equations_of(model);
  const symbolic::Loci loci = symbolic::singularity_loci(model);
  std::array<PolynomialMatrix, 2> matrices;
  for (std::size_t k = 0; k < 2; ++k) {
    const symbolic::ExpressionMatrix& m = loci.matrices[k];
    matrices[k].rows = matrices[k].columns = static_cast<int>(m.rows.size());
    for (const auto& row : m.rows)
      for (Polynomial& f : symbolic::polynomials(equations, row)) matrices[k].entries.push_back(std::move(f));
  }
  const auto list = [&](const PieceClaims& claims, const std::vector<symbolic::Expression>& own) {
    std::vector<symbolic::Expression> named;
    for (const std::string& text : claims.factors) named.push_back(symbolic::parse_expression(text, "a factor"));
    return check::PieceFunctions{symbolic::polynomials(equations, named), symbolic::polynomials(equations, own), matrices};
  };
  return {list(file.lists[0], loci.all_factors), list(file.lists[1], loci.factors[0]), list(file.lists[2], loci.factors[1])};
}

std::string list_group(std::size_t list) { return std::string("/") + kLists[list]; }

// Boxes have n sides, and so many variables are held or free as C-space has dimensions.
struct Sizes {
  std::size_t n, dimension;

  auto members() const {
    return [*this](auto& field, auto& m) {
      field.box("", m.box, n);
      field.row("free", m.free, dimension, 0, kMostPieces);
      field.row("signs", m.signs, kAlike, -1, 1);
      // The factors stand between.
    };
  }
  auto determinants() const {
    return [](auto& field, auto& m) { field.row("determinant_signs", m.determinant_signs, 2, -1, 1); };
  }
  auto bridges() const {
    return [*this](auto& field, auto& b) {
      field.row("free", b.free, dimension, 0, static_cast<int>(n) - 1);
      field.box("", b.region, n);
    };
  }
  auto cells() const {
    return [*this](auto& field, auto& c) {
      field("sheet", c.sheet);
      field.box("", c.sides, dimension);
    };
  }
  auto links() const {
    return [*this](auto& field, auto& l) {
      field.row("held", l.held, dimension, 0, static_cast<int>(n) - 1);
      field.row("point", l.point, n);
    };
  }
};

void write_claims(Hdf5Writer& file, std::size_t list, const PieceClaims& claims, const Sizes& sizes) {
  file.enter(list_group(list));
  file.attribute("/", "at_least", std::int64_t{claims.at_least});
  file.attribute("/", "at_most", claims.at_most ? std::int64_t{*claims.at_most} : kNone);
  write_list(file, "/", claims.members, sizes.members());
  file.texts("/factors", claims.factors);
  write_list(file, "/", claims.members, sizes.determinants());
}

PieceClaims read_claims(Hdf5Reader& file, std::size_t list, const Sizes& sizes) {
  file.enter(list_group(list));
  PieceClaims claims;
  claims.at_least = file.integer("/", "at_least", 0, kMostPieces);
  const int most = file.integer("/", "at_most", kNone, kMostPieces);
  if (most != kNone) claims.at_most = most;
  claims.factors = file.texts("/factors");
  claims.members = read_list<PieceMember>(file, "/", sizes.members());
  read_into(file, "/", claims.members, sizes.determinants());
  if (file.has("/proof")) {
    if (sizes.dimension == 0) file.fail(list_group(list) + "/proof: a set of points has none");
    claims.proof = {read_list<SheetBridge>(file, "/proof/bridges_", sizes.bridges(), Storage::packed),
                    read_list<PieceCell>(file, "/proof/cells_", sizes.cells(), Storage::packed),
                    read_list<PieceLink>(file, "/proof/links_", sizes.links(), Storage::packed)};
  }
  file.enter("");
  return claims;
}

void write_proof(Hdf5Writer& file, std::size_t list, const PieceProof& proof, const Sizes& sizes) {
  file.enter(list_group(list) + "/proof");
  write_list(file, "/bridges_", proof.bridges, sizes.bridges(), Storage::packed);
  write_list(file, "/cells_", proof.cells, sizes.cells(), Storage::packed);
  write_list(file, "/links_", proof.links, sizes.links(), Storage::packed);
  file.enter("");
}

}  // namespace

void write_pieces(const std::filesystem::path& path, const PiecesFile& data, const Ended& in_haste) {
  const System system = symbolic::algebrize(equations_of(model_of(data)));
  const Sizes sizes{system.variables.size(), static_cast<std::size_t>(data.space.dimension)};
  write_certificate(path, kPiecesKind, data, in_haste, [&](Hdf5Writer& file) {
    file.texts("/variables", names(system));
    write_cover(file, "/space", data.space, sizes.n);
    for (std::size_t k = 0; k < kLists.size(); ++k) write_claims(file, k, data.lists[k], sizes);
    for (std::size_t k = 0; k < kLists.size(); ++k)
      if (const auto& proof = data.lists[k].proof) write_proof(file, k, *proof, sizes);
  });
}

PiecesFile read_pieces(const std::filesystem::path& path) {
  Hdf5Reader file(path.string());
  PiecesFile data;
  read_source(file, kPiecesKind, data);
  const std::vector<std::string> expected = names(symbolic::algebrize(equations_of(model_of(data))));
  if (file.texts("/variables") != expected) file.fail("its variables are not those of the model");
  data.space = read_cover(file, "/space", expected.size());
  for (std::size_t k = 0; k < kLists.size(); ++k)
    data.lists[k] = read_claims(file, k, {expected.size(), static_cast<std::size_t>(data.space.dimension)});
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

// Of claims, or of what is confirmed of them.
std::string bounds(const auto& c) {
  if (!c.at_most) return fmt::format("at least {}", c.at_least);
  return *c.at_most == c.at_least ? std::to_string(c.at_least) : fmt::format("{} to {}", c.at_least, *c.at_most);
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
                        bounds(file.lists[k]), bounds(r), r.members, r.cells);
    text += r.at_most ? fmt::format(" and {} of the file's with {} links\n", r.cells_of_bound, r.links) : "\n";
  }
  std::string open = open_lines(report);
  if (!report.space.complete())
    open += "the file does not prove that its boxes hold all of C-space, on which the counts rest\n";
  return text + conclusion(report, all_failures(report), open);
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
