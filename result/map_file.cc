#include "corank/result/map_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "corank/core/check.h"
#include "corank/result/cover_group.h"
#include "corank/result/hdf5_file.h"
#include "corank/result/output_file.h"
#include "corank/result/printable.h"
#include "corank/result/source_group.h"
#include "corank/symbolic/model_file.h"

namespace corank::result {
namespace {

constexpr std::int64_t kMapVersion = 1, kMostOfOne = 1'000'000;
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
      std::sort(box.free.begin(), box.free.end());
      box.region = static_cast<int>(cover.regions.size());
      cover.regions.push_back(sheet.region);
    }
  return cover;
}

}  // namespace

void write_map(const std::filesystem::path& path, const MapFile& data, const Ended& in_haste) {
  const auto [system, parameters, copies] = family_of(data);
  const OutputFile target(path);
  Hdf5Writer file(target.part().string(), 1, in_haste);
  write_source(file, kMapFormat, kMapVersion, data);
  const symbolic::FamilyQuestion& family = data.family;
  file.attribute("/", "set", std::string(family.set ? symbolic::to_string(*family.set) : kPlain));
  file.attribute("/", "kernel", std::string(family.kernel ? symbolic::to_string(*family.kernel) : ""));
  file.attribute("/", "corank", std::int64_t{family.corank});
  std::vector<std::string> over, from, to, fixed, values;
  for (const symbolic::Parameter& p : family.over) {
    over.push_back(p.name);
    from.push_back(p.lower.text());
    to.push_back(p.upper.text());
  }
  for (const symbolic::FixedCoordinate& f : family.fixed) {
    fixed.push_back(f.name);
    values.push_back(f.value.text());
  }
  file.texts("/over/names", over);
  file.texts("/over/from", from);
  file.texts("/over/to", to);
  file.texts("/fixed/names", fixed);
  file.texts("/fixed/values", values);
  file.texts("/variables", names(system));
  const std::vector<MapCellClaim>& cells = data.claims.cells;
  std::vector<std::int64_t> counts, sheets;
  for (const MapCellClaim& cell : cells) {
    CORANK_CHECK(cell.sides.size() == 2);
    counts.push_back(cell.count);
    sheets.push_back(static_cast<std::int64_t>(cell.sheets.size()));
  }
  file.integers("/cells/count", counts);
  file.integers("/cells/sheets", sheets);
  for (const bool upper : {false, true})
    file.doubles(upper ? "/cells/upper" : "/cells/lower", cells.size(), 2, [&](std::size_t i, std::span<double> to_row) {
      for (std::size_t k = 0; k < 2; ++k) to_row[k] = upper ? cells[i].sides[k].hi() : cells[i].sides[k].lo();
    });
  write_cover(file, "/sheets", cover_of(data.claims, parameters), system.variables.size());
  file.close();
  target.finish();
}

bool is_map_file(const std::filesystem::path& path) { return format_of(path.string()) == kMapFormat; }

namespace {

class MapReader {
 public:
  explicit MapReader(const std::filesystem::path& path) : file_(path.string()) {}

  MapFile read() {
    read_source(file_, kMapFormat, kMapVersion, data_);
    read_family();
    const std::vector<std::string> expected = names(family_of(data_).system);
    if (file_.texts("/variables") != expected) refuse("its variables are not those of the model");
    read_cells(read_cover(file_, "/sheets", expected.size()));
    return std::move(data_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw ResultFileError(file_.path() + ": " + what); }

  void read_family() {
    symbolic::FamilyQuestion& family = data_.family;
    const std::string set = file_.text_attribute("/", "set"), kernel = file_.text_attribute("/", "kernel");
    if (set != kPlain && !(family.set = symbolic::singularity_set_from_string(set))) refuse("no such set");
    if (!kernel.empty() && !(family.kernel = symbolic::kernel_side_from_string(kernel))) refuse("no such kernel");
    const std::int64_t corank = file_.integer_attribute("/", "corank");
    if (corank < 1 || corank > kMostOfOne) refuse("corank is out of range");
    family.corank = static_cast<int>(corank);
    const auto over = file_.texts("/over/names"), from = file_.texts("/over/from"), to = file_.texts("/over/to"),
               fixed = file_.texts("/fixed/names"), values = file_.texts("/fixed/values");
    if (over.size() != 2 || from.size() != 2 || to.size() != 2) refuse("it does not have two parameters");
    if (fixed.size() != values.size()) refuse("its fixed coordinates do not have a value each");
    for (std::size_t k = 0; k < 2; ++k)
      family.over.push_back(
          {over[k], symbolic::parse_expression(from[k], over[k]), symbolic::parse_expression(to[k], over[k])});
    for (std::size_t k = 0; k < fixed.size(); ++k)
      family.fixed.push_back({fixed[k], symbolic::parse_expression(values[k], fixed[k])});
  }

  void read_cells(Cover cover) {
    const std::vector<std::int64_t> counts = file_.integers("/cells/count"), sheets = file_.integers("/cells/sheets");
    if (sheets.size() != counts.size()) refuse("its cells differ in length");
    const std::vector<double> lower = file_.doubles("/cells/lower", counts.size(), 2),
                              upper = file_.doubles("/cells/upper", counts.size(), 2);
    std::size_t next = 0;
    for (std::size_t c = 0; c < counts.size(); ++c) {
      MapCellClaim& cell = data_.claims.cells.emplace_back();
      for (std::size_t k = 2 * c; k < 2 * c + 2; ++k) {
        if (!(lower[k] <= upper[k])) refuse("a cell has a side that is not an interval");
        cell.sides.emplace_back(lower[k], upper[k]);
      }
      if (counts[c] < 0 || counts[c] > kMostOfOne) refuse("a number is out of range");
      cell.count = static_cast<int>(counts[c]);
      if (sheets[c] < 0 || static_cast<std::uint64_t>(sheets[c]) > cover.boxes.size() - next)
        refuse("its cells name sheets that do not exist");
      for (const std::size_t end = next + static_cast<std::size_t>(sheets[c]); next < end; ++next) {
        if (cover.boxes[next].region < 0) refuse("a sheet has no region");
        cell.sheets.push_back(
            {std::move(cover.boxes[next].box), cover.regions[static_cast<std::size_t>(cover.boxes[next].region)]});
      }
    }
    if (next != cover.boxes.size()) refuse("its cells name sheets that do not exist");
    data_.claims.reduction = std::move(cover.reduction);
  }

  Hdf5Reader file_;
  MapFile data_;
};

}  // namespace

MapFile read_map(const std::filesystem::path& path) { return MapReader(path).read(); }

check::MapReport verify(const MapFile& file, const check::Options& options) {
  const auto [system, parameters, copies] = family_of(file);
  return check::check_map(system, parameters, copies, file.claims, options);
}

namespace {

// Of the map's area, by the number that is confirmed for them.
std::map<int, double> confirmed_shares(const check::MapReport& report, const MapFile& file,
                                       bool check::MapCellReport::*what) {
  double all = 1;
  const auto [system, parameters, copies] = family_of(file);
  for (const int p : parameters) all *= system.variables[static_cast<std::size_t>(p)].domain.width();
  std::map<int, double> shares;
  for (std::size_t c = 0; c < report.cells.size(); ++c)
    if (const MapCellClaim& cell = file.claims.cells[c]; report.cells[c].*what)
      shares[cell.count] += cell.sides[0].width() * cell.sides[1].width() / all;
  return shares;
}

}  // namespace

std::string to_table(const check::MapReport& report, const MapFile& file) {
  const std::size_t all = report.cells.size();
  std::string text = fmt::format("{}: numbers of solutions over {} and {}\n", printable_line(file.model),
                                 printable_line(file.family.over.at(0).name), printable_line(file.family.over.at(1).name));
  text += fmt::format("  cells  claimed: {}; confirmed: at least as many in {}, at most as many in {}; {} sheets\n", all,
                      report.at_least(), report.completed(), report.sheets);
  const auto exact = confirmed_shares(report, file, &check::MapCellReport::complete);
  for (const auto& [count, share] : confirmed_shares(report, file, &check::MapCellReport::at_least)) {
    const auto found = exact.find(count);
    text += fmt::format("  {:<5}  on {:.1f} % of the plane; at most as many: on {:.1f} %\n", count, 100 * share,
                        100 * (found == exact.end() ? 0 : found->second));
  }
  text += failure_lines(report.failures);
  if (report.complete()) return text + "verified\n";
  if (report.verified())
    return text +
           fmt::format("not confirmed in {} cells: that there are at most as many solutions as claimed\n",
                       all - report.completed()) +
           "verified, except for completeness\n";
  return text + (report.failures.empty() ? "interrupted in " + report.stage + "; nothing is said about the rest\n"
                                         : "NOT VERIFIED\n");
}

std::string to_json(const check::MapReport& report, const MapFile& file) {
  using Json = nlohmann::ordered_json;
  Json json{{"verified", report.verified()},
            {"complete", report.complete()},
            {"interrupted", report.interrupted},
            {"over", {file.family.over.at(0).name, file.family.over.at(1).name}},
            {"cells", {{"claimed", report.cells.size()}, {"at_least", report.at_least()}, {"complete", report.completed()}}},
            {"sheets", report.sheets},
            {"boxes", report.boxes}};
  for (const auto& [name, what] :
       {std::pair("shares_at_least", &check::MapCellReport::at_least), {"shares", &check::MapCellReport::complete}}) {
    json[name] = Json::object();
    for (const auto& [count, share] : confirmed_shares(report, file, what)) json[name][std::to_string(count)] = share;
  }
  json["failures"] = report.failures;
  if (report.interrupted) json["stage"] = report.stage;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace corank::result
