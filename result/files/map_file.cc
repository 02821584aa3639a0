// The file of a map.
#include <algorithm>
#include <map>

#include "corank/result/files/cover_group.h"
#include "corank/result/files/source_group.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::result {
namespace {

constexpr int kMostOfOne = 1'000'000;
const char* const kPlain = "system";

symbolic::FamilySystem family_of(const MapFile& file) { return symbolic::family_system(model_of(file), file.family); }

// All sheets, one after the other, as regular boxes, each with a region of its own.
Cover cover_of(const MapClaims& claims, const std::vector<int>& parameters) {
  Cover cover;
  cover.dimension = 2;
  cover.reduction = claims.reduction;
  for (const MapCellClaim& cell : claims.cells)
    for (const MapSheet& sheet : cell.sheets) {
      CoverBox& box = cover.boxes.emplace_back();
      box.box = sheet.box;
      box.verdict = Verdict::regular;
      box.free = parameters;
      std::ranges::sort(box.free);
      box.region = static_cast<int>(cover.regions.size());
      cover.regions.push_back(sheet.region);
    }
  return cover;
}

struct CellRow {
  int count = 0, sheets = 0;  ///< `sheets` of those that follow one another
  int standing = 0;           ///< Standing
  Box sides;
};

constexpr auto kCellFields = [](auto& field, auto& cell) {
  field("count", cell.count, 0, kMostOfOne);
  field("sheets", cell.sheets, 0);
  field("standing", cell.standing, 0, static_cast<int>(Standing::open));
  field.box("", cell.sides, 2);
};

// A parameter or a fixed coordinate, as texts.
struct NamedTexts {
  std::string name, first, second;
};

constexpr auto kOverFields = [](auto& field, auto& over) {
  field("names", over.name);
  field("from", over.first);
  field("to", over.second);
};

constexpr auto kFixedFields = [](auto& field, auto& fixed) {
  field("names", fixed.name);
  field("values", fixed.first);
};

void write_family(Hdf5Writer& file, const symbolic::FamilyQuestion& family) {
  file.attribute("/", "set", std::string(family.set ? symbolic::to_string(*family.set) : kPlain));
  file.attribute("/", "kernel", std::string(family.kernel ? symbolic::to_string(*family.kernel) : ""));
  file.attribute("/", "corank", std::int64_t{family.corank});
  std::vector<NamedTexts> over, fixed;
  for (const symbolic::Parameter& p : family.over) over.push_back({p.name, p.lower.text(), p.upper.text()});
  for (const symbolic::FixedCoordinate& f : family.fixed) fixed.push_back({f.name, f.value.text(), {}});
  write_list(file, "/over/", over, kOverFields);
  write_list(file, "/fixed/", fixed, kFixedFields);
}

void read_family(const Hdf5Reader& file, symbolic::FamilyQuestion& family) {
  const auto set = file.attribute<std::string>("/", "set"), kernel = file.attribute<std::string>("/", "kernel");
  if (set != kPlain && !(family.set = symbolic::singularity_set_from_string(set))) file.fail("no such set");
  if (!kernel.empty() && !(family.kernel = symbolic::kernel_side_from_string(kernel))) file.fail("no such kernel");
  family.corank = file.integer("/", "corank", 1, kMostOfOne);
  for (const auto& [name, from, to] : read_list<NamedTexts>(file, "/over/", kOverFields))
    family.over.push_back({name, symbolic::parse_expression(from, name), symbolic::parse_expression(to, name)});
  if (family.over.size() != 2) file.fail("it does not have two parameters");
  for (const auto& [name, value, none] : read_list<NamedTexts>(file, "/fixed/", kFixedFields))
    family.fixed.push_back({name, symbolic::parse_expression(value, name)});
}

void read_cells(const Hdf5Reader& file, Cover cover, MapClaims& claims) {
  std::size_t next = 0;
  for (CellRow& row : read_list<CellRow>(file, "/cells/", kCellFields)) {
    MapCellClaim& cell =
        claims.cells.emplace_back(MapCellClaim{std::move(row.sides), row.count, {}, static_cast<Standing>(row.standing)});
    if (static_cast<std::size_t>(row.sheets) > cover.boxes.size() - next)
      file.fail("its cells name sheets that do not exist");
    for (const std::size_t end = next + row.sheets; next < end; ++next) {
      CoverBox& sheet = cover.boxes[next];
      if (sheet.region < 0) file.fail("a sheet has no region");
      cell.sheets.push_back({std::move(sheet.box), cover.regions[sheet.region]});
    }
  }
  if (next != cover.boxes.size()) file.fail("its cells name sheets that do not exist");
  claims.reduction = std::move(cover.reduction);
}

}  // namespace

void write_map(const std::filesystem::path& path, const MapFile& data, const Ended& in_haste) {
  const symbolic::FamilySystem family = family_of(data);
  std::vector<CellRow> cells;
  for (const MapCellClaim& cell : data.claims.cells)
    cells.push_back({cell.count, static_cast<int>(cell.sheets.size()), static_cast<int>(cell.standing), cell.sides});
  write_certificate(path, kMapKind, data, in_haste, [&](Hdf5Writer& file) {
    write_family(file, data.family);
    file.texts("/variables", names(family.system));
    write_list(file, "/cells/", cells, kCellFields);
    write_cover(file, "/sheets", cover_of(data.claims, family.parameters), family.system.variables.size());
  });
}

MapFile read_map(const std::filesystem::path& path) {
  return read_certificate<MapFile>(path, kMapKind, [](Hdf5Reader& file, MapFile& data) {
    read_family(file, data.family);
    const std::vector<std::string> expected = names(family_of(data).system);
    if (file.texts("/variables") != expected) file.fail("its variables are not those of the model");
    read_cells(file, read_cover(file, "/sheets", expected.size()), data.claims);
  });
}

check::MapReport verify(const MapFile& file, const check::Options& options) {
  const symbolic::FamilySystem family = family_of(file);
  return check::check_map(family.system, family.parameters, family.copies, family.requirements, file.claims, options);
}

namespace {

// Of the map's area: what is confirmed of its cells.
struct ConfirmedShares {
  std::map<int, double> at_least, exactly;  // by the number of solutions
  double satisfied = 0, violated = 0;       // the requirements
};

ConfirmedShares confirmed_shares(const check::MapReport& report, const MapFile& file) {
  double all = 1;
  const symbolic::FamilySystem family = family_of(file);
  for (const int p : {family.parameters.at(0), family.parameters.at(1)}) all *= family.system.variables[p].domain.width();
  ConfirmedShares shares;
  for (std::size_t c = 0; c < report.cells.size(); ++c) {
    const MapCellClaim& cell = file.claims.cells[c];
    const check::MapCellReport& found = report.cells[c];
    const double share = cell.sides[0].width() * cell.sides[1].width() / all;
    if (found.at_least) shares.at_least[cell.count] += share;
    if (found.complete) shares.exactly[cell.count] += share;
    if (found.standing && cell.standing == Standing::violated) shares.violated += share;
    if (found.standing && found.complete && cell.count > 0 && cell.standing == Standing::satisfied)
      shares.satisfied += share;
  }
  return shares;
}

}  // namespace

std::string to_table(const check::MapReport& report, const MapFile& file) {
  const std::size_t all = report.cells.size();
  const symbolic::FamilySystem family = family_of(file);
  std::vector<std::string> toleranced;
  for (std::size_t k = file.family.over.size(); k < family.parameters.size(); ++k)
    toleranced.push_back(family.system.variables[family.parameters[k]].name);
  std::string text = fmt::format("{}: numbers of solutions over {} and {}{}\n", printable_line(file.model),
                                 printable_line(file.family.over.at(0).name), printable_line(file.family.over.at(1).name),
                                 of_every_robot(toleranced));
  text += fmt::format("  cells  claimed: {}; confirmed: at least as many in {}, at most as many in {}; {} sheets\n", all,
                      report.at_least(), report.completed(), report.sheets);
  ConfirmedShares shares = confirmed_shares(report, file);
  for (const auto& [count, share] : shares.at_least)
    text += fmt::format("  {:<5}  on {:.1f} % of the plane; at most as many: on {:.1f} %\n", count, 100 * share,
                        100 * shares.exactly[count]);
  const std::vector<std::string> required = model_of(file).requirement_texts();
  for (const std::string& r : required) text += fmt::format("  required: {}\n", printable_line(r));
  if (!required.empty())
    text += fmt::format("  satisfied by every solution: on {:.1f} % of the plane; violated by one: on {:.1f} %\n",
                        100 * shares.satisfied, 100 * shares.violated);
  return text + conclusion(report, report.failures,
                           fmt::format("not confirmed in {} cells: that there are at most as many solutions as claimed\n",
                                       all - report.completed()));
}

std::string to_json(const check::MapReport& report, const MapFile& file) {
  nlohmann::ordered_json json{
      {"verified", report.verified()},
      {"complete", report.complete()},
      {"interrupted", report.interrupted},
      {"over", {file.family.over.at(0).name, file.family.over.at(1).name}},
      {"cells", {{"claimed", report.cells.size()}, {"at_least", report.at_least()}, {"complete", report.completed()}}},
      {"sheets", report.sheets},
      {"boxes", report.boxes}};
  const ConfirmedShares shares = confirmed_shares(report, file);
  for (const auto& [name, by_count] : {std::pair("shares_at_least", &shares.at_least), {"shares", &shares.exactly}}) {
    json[name] = nlohmann::ordered_json::object();
    for (const auto& [count, share] : *by_count) json[name][std::to_string(count)] = share;
  }
  if (const std::vector<std::string> required = model_of(file).requirement_texts(); !required.empty()) {
    json["require"] = required;
    json["standings"] = {{"satisfied", shares.satisfied}, {"violated", shares.violated}};
  }
  return ended_json(std::move(json), report, report.failures);
}

}  // namespace corank::result
