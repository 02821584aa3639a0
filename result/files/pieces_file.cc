// The file of the pieces of a C-space.
#include "corank/result/files/cover_group.h"
#include "corank/result/files/source_group.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/determinant_factors.h"
#include "corank/symbolic/sets/free_coordinates.h"
#include "corank/symbolic/sets/required_space.h"
#include "corank/symbolic/sets/requirements.h"

namespace corank::result {
namespace {

constexpr int kMostPieces = 1'000'000, kNone = -1;
constexpr std::array<const char*, 3> kLists{"aspects", "assembly_modes", "working_modes"};
constexpr std::array<const char*, 3> kWords{"aspects", "assembly modes", "working modes"};

symbolic::TrigonometricSystem cspace_of(const symbolic::Mechanism& model) {
  return symbolic::singularity_system(model, symbolic::SingularitySet::cspace);
}

std::vector<symbolic::Expression> parsed(const std::vector<std::string>& texts) {
  std::vector<symbolic::Expression> result;
  for (const std::string& text : texts) result.push_back(symbolic::parse_expression(text, "a factor"));
  return result;
}

// What the claims are about, from the model: C-space, or the factors of a product.
class Spaces {
 public:
  explicit Spaces(const symbolic::Mechanism& model) : model_(model) {}

  symbolic::TrigonometricSystem equations(const SpacePieces& pieces) {
    if (!pieces.coordinates.empty()) return part(pieces.coordinates).system;
    symbolic::TrigonometricSystem system = cspace_of(model_);
    const auto& inequalities = required().inequalities;
    system.inequalities.insert(system.inequalities.end(), inequalities.begin(), inequalities.end());
    return system;
  }

  std::vector<check::PieceFunctions> functions(const SpacePieces& pieces) {
    const symbolic::TrigonometricSystem system = equations(pieces);
    std::array<PolynomialMatrix, 2> matrices;
    // Of a factor no configuration is known, and no sign of a determinant.
    if (pieces.coordinates.empty())
      matrices = {polynomials(system, loci().matrices[0]), polynomials(system, loci().matrices[1])};
    const auto lists = loci().lists();
    const symbolic::Requirements requirements(model_);
    std::vector<check::PieceFunctions> result;
    for (std::size_t k = 0; k < lists.size(); ++k) {
      std::vector<symbolic::Expression> own;
      for (const std::size_t i : lists[k])
        if (pieces.coordinates.empty() || std::ranges::count(part(pieces.coordinates).functions, i) > 0)
          own.push_back(loci().all_factors[i]);
      result.push_back({symbolic::polynomials(system, parsed(pieces.lists[k].factors)), symbolic::polynomials(system, own),
                        matrices, requirements.of_functions(), symbolic::polynomials(system, requirements.functions())});
    }
    return result;
  }

  // Are these the factors of the product, each once?
  bool are_all(const PiecesFile& file) {
    if (file.coordinates.empty()) return file.further.empty();
    if (!model_.requirements().empty()) return false;  // they tie the factors
    std::vector<std::vector<std::string>> named{file.coordinates}, known;
    for (const SpacePieces& pieces : file.further) named.push_back(pieces.coordinates);
    for (const symbolic::IndependentPart& p : parts()) known.push_back(names_of(p.system.coordinates));
    std::ranges::sort(named);
    std::ranges::sort(known);
    return named == known;
  }

 private:
  const symbolic::Loci& loci() {
    if (loci_) return *loci_;
    loci_ = symbolic::singularity_loci(model_);
    loci_->add(required().functions);
    return *loci_;
  }
  const symbolic::RequiredSpace& required() {
    if (!required_) required_ = symbolic::required_space(model_);
    return *required_;
  }
  const std::vector<symbolic::IndependentPart>& parts() {
    if (!parts_) {
      parts_.emplace();
      if (const auto free = symbolic::free_coordinates(model_))
        if (auto found = symbolic::independent_parts(*free, loci().all_factors)) parts_ = std::move(found);
    }
    return *parts_;
  }
  const symbolic::IndependentPart& part(const std::vector<std::string>& coordinates) {
    const auto found =
        std::ranges::find_if(parts(), [&](const auto& p) { return names_of(p.system.coordinates) == coordinates; });
    if (found == parts().end()) throw ResultFileError("its coordinates are not those of a factor of the model's C-space");
    return *found;
  }

  const symbolic::Mechanism& model_;
  std::optional<symbolic::Loci> loci_;
  std::optional<symbolic::RequiredSpace> required_;
  std::optional<std::vector<symbolic::IndependentPart>> parts_;
};

// Boxes have n sides; as many variables are held or free as C-space has dimensions.
struct Sizes {
  std::size_t n, dimension;

  auto members() const {
    return [*this](auto& field, auto& m) {
      field.box("", m.box, n);
      field.row("free", m.free, dimension, 0, kMostPieces);
      field.row("signs", m.signs, kAlike, -1, 1);
      field("requirements", m.requirements, -1, 1);
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

template <class File, class Pieces>
void store_space(File& to, const std::string& group, Pieces& pieces, Spaces& spaces) {
  to.enter(group);
  const StoredPart file(to);
  file.texts("/coordinates", pieces.coordinates);
  const std::vector<std::string> variables = names(symbolic::algebrize(spaces.equations(pieces)));
  file.same("/variables", variables, "its variables are not those of the model");
  if constexpr (file.kWrites)
    write_cover(to, group + "/space", pieces.space, variables.size());
  else
    pieces.space = read_cover(to, group + "/space", variables.size());
  const Sizes sizes{variables.size(), static_cast<std::size_t>(pieces.space.dimension)};
  const auto list = [&](std::size_t k) { return group + "/" + kLists[k]; };
  for (std::size_t k = 0; k < kLists.size(); ++k) store_claims(to, list(k), pieces.lists[k], sizes);
  for (std::size_t k = 0; k < kLists.size(); ++k) {
    auto& proof = pieces.lists[k].proof;
    to.enter("");
    if constexpr (!file.kWrites)
      if (to.has(list(k) + "/proof")) proof.emplace();
    file.check(!proof || sizes.dimension > 0, list(k) + "/proof: a set of points has none");
    if (proof) store_proof(to, list(k), *proof, sizes);
  }
}

template <class File, class Data>
void store_pieces(File& to, Data& data) {
  constexpr std::size_t kMostFactors = 1'000;
  std::size_t further = data.further.size();
  const StoredPart file(to);
  file("further_factors", further, 0, kMostFactors);
  if constexpr (!file.kWrites) data.further.resize(further);
  const symbolic::Mechanism model = model_of(data);
  Spaces spaces(model);
  store_space(to, "", data, spaces);
  for (std::size_t k = 0; k < further; ++k) store_space(to, "/factor_" + std::to_string(k + 2), data.further[k], spaces);
  if (!spaces.are_all(data)) throw ResultFileError("its factors are not those of the model's C-space");
}

}  // namespace

void write_pieces(const std::filesystem::path& path, const PiecesFile& data, const Ended& in_haste) {
  write_certificate(path, kPiecesKind, data, in_haste, [&](Hdf5Writer& file) { store_pieces(file, data); });
}

PiecesFile read_pieces(const std::filesystem::path& path) {
  return read_certificate<PiecesFile>(path, kPiecesKind,
                                      [](Hdf5Reader& file, PiecesFile& data) { store_pieces(file, data); });
}

namespace {

// What is confirmed of the product of two spaces.
void multiply_reports(check::PiecesReport& to, check::PiecesReport by) {
  if (to.space.complete()) to.space = std::move(by.space);
  std::ranges::move(by.failures, std::back_inserter(to.failures));
  if (by.interrupted && !to.interrupted) to.interrupted = true, to.stage = by.stage;
  to.lists.resize(std::min(to.lists.size(), by.lists.size()));
  for (std::size_t k = 0; k < to.lists.size(); ++k) {
    check::PieceReport &a = to.lists[k], &b = by.lists[k];
    multiply(a, b);
    a.members += b.members;
    a.cells += b.cells;
    a.cells_of_bound += b.cells_of_bound;
    a.links += b.links;
    a.bounded = a.bounded && b.bounded && a.at_most.has_value();
    if (a.unbounded.empty()) a.unbounded = b.unbounded;
    std::ranges::move(b.failures, std::back_inserter(a.failures));
  }
}

// Of all spaces.
PieceClaims claimed(const PiecesFile& file, std::size_t list) {
  PieceClaims result;
  const PieceClaims& claims = file.lists[list];
  result.at_least = claims.at_least - claims.members_with(0) - claims.members_with(-1);
  result.at_most = claims.at_most;
  if (result.at_most) *result.at_most -= claims.members_with(-1);
  for (const SpacePieces& pieces : file.further) multiply(result, pieces.lists[list]);
  return result;
}

}  // namespace

check::PiecesReport verify(const PiecesFile& file, const check::Options& options) {
  const symbolic::Mechanism model = model_of(file);
  Spaces spaces(model);
  const auto check = [&](const SpacePieces& pieces) {
    return check::check_pieces(symbolic::algebrize(spaces.equations(pieces)), pieces.space,
                               {pieces.lists.begin(), pieces.lists.end()}, spaces.functions(pieces), options);
  };
  check::PiecesReport report = check(file);
  for (const SpacePieces& pieces : file.further) multiply_reports(report, check(pieces));
  return report;
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
  for (const std::string& r : model_of(file).requirement_texts()) text += fmt::format("  where           {}\n", r);
  for (std::size_t k = 0; k < report.lists.size(); ++k) {
    const check::PieceReport& r = report.lists[k];
    text += fmt::format("  {:<14}  claimed: {}; confirmed: {}, {} members with their signs, on {} cells", kLists[k],
                        bounds(claimed(file, k)), bounds(r), r.members, r.cells);
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
                              {"interrupted", report.interrupted},
                              {"require", model_of(file).requirement_texts()}};
  for (std::size_t k = 0; k < report.lists.size(); ++k) {
    const check::PieceReport& r = report.lists[k];
    const PieceClaims all = claimed(file, k);
    json[kLists[k]] = {{"claimed", {{"at_least", all.at_least}, {"at_most", or_null(all.at_most)}}},
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
