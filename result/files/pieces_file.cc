// The file of the pieces of a C-space.
#include "corank/result/files/cover_group.h"
#include "corank/result/files/source_group.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/determinant_factors.h"

namespace corank::result {
namespace {

constexpr int kMostPieces = 1'000'000, kNone = -1;
constexpr std::array<const char*, 3> kLists{"aspects", "assembly_modes", "working_modes"};
constexpr std::array<const char*, 3> kWords{"aspects", "assembly modes", "working modes"};

symbolic::TrigonometricSystem cspace_of(const symbolic::Mechanism& model) {
  return symbolic::singularity_system(model, symbolic::SingularitySet::cspace);
}

std::vector<check::PieceFunctions> functions_of(const symbolic::Mechanism& model, const PiecesFile& file) {
  const symbolic::TrigonometricSystem equations = cspace_of(model);
  const symbolic::Loci loci = symbolic::singularity_loci(model);
  const std::array matrices{polynomials(equations, loci.matrices[0]), polynomials(equations, loci.matrices[1])};
  const auto list = [&](const PieceClaims& claims, const std::vector<symbolic::Expression>& own) {
    std::vector<symbolic::Expression> named;
    for (const std::string& text : claims.factors) named.push_back(symbolic::parse_expression(text, "a factor"));
    return check::PieceFunctions{symbolic::polynomials(equations, named), symbolic::polynomials(equations, own), matrices};
  };
  return {list(file.lists[0], loci.all_factors), list(file.lists[1], loci.factors[0]), list(file.lists[2], loci.factors[1])};
}

// Boxes have n sides; as many variables are held or free as C-space has dimensions.
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

template <class File, class Data>
void store_claims(File& to, const std::string& group, Data& claims, const Sizes& sizes) {
  to.enter(group);
  const StoredPart file(to);
  file("at_least", claims.at_least, 0, kMostPieces);
  file.optional("at_most", claims.at_most, 0, kMostPieces, kNone);
  file.list("/", claims.members, sizes.members());
  file.texts("/factors", claims.factors);
  file.further("/", claims.members, sizes.determinants());
}

template <class File, class Data>
void store_proof(File& to, const std::string& group, Data& proof, const Sizes& sizes) {
  const StoredPart file(to);
  to.enter(file.kWrites ? group + "/proof" : group);
  const std::string place = file.kWrites ? "/" : "/proof/";
  file.list(place + "bridges_", proof.bridges, sizes.bridges(), Storage::packed);
  file.list(place + "cells_", proof.cells, sizes.cells(), Storage::packed);
  file.list(place + "links_", proof.links, sizes.links(), Storage::packed);
}

template <class File, class Data>
void store_pieces(File& to, Data& data) {
  const StoredPart file(to);
  const std::vector<std::string> variables = names(symbolic::algebrize(cspace_of(model_of(data))));
  file.same("/variables", variables, "its variables are not those of the model");
  if constexpr (file.kWrites)
    write_cover(to, "/space", data.space, variables.size());
  else
    data.space = read_cover(to, "/space", variables.size());
  const Sizes sizes{variables.size(), static_cast<std::size_t>(data.space.dimension)};
  const auto group = [](std::size_t list) { return std::string("/") + kLists[list]; };
  for (std::size_t k = 0; k < kLists.size(); ++k) store_claims(to, group(k), data.lists[k], sizes);
  for (std::size_t k = 0; k < kLists.size(); ++k) {
    auto& proof = data.lists[k].proof;
    to.enter("");
    if constexpr (!file.kWrites)
      if (to.has(group(k) + "/proof")) proof.emplace();
    file.check(!proof || sizes.dimension > 0, group(k) + "/proof: a set of points has none");
    if (proof) store_proof(to, group(k), *proof, sizes);
  }
}

}  // namespace

void write_pieces(const std::filesystem::path& path, const PiecesFile& data, const Ended& in_haste) {
  write_certificate(path, kPiecesKind, data, in_haste, [&](Hdf5Writer& file) { store_pieces(file, data); });
}

PiecesFile read_pieces(const std::filesystem::path& path) {
  return read_certificate<PiecesFile>(path, kPiecesKind,
                                      [](Hdf5Reader& file, PiecesFile& data) { store_pieces(file, data); });
}

check::PiecesReport verify(const PiecesFile& file, const check::Options& options) {
  const symbolic::Mechanism model = model_of(file);
  return check::check_pieces(symbolic::algebrize(cspace_of(model)), file.space, {file.lists.begin(), file.lists.end()},
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
  nlohmann::ordered_json json{{"verified", report.verified()},
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
  return ended_json(std::move(json), report, all_failures(report));
}

}  // namespace corank::result
