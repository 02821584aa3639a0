#include "corank/report/gallery/outcome.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "corank/result/values/words.h"
#include "corank/symbolic/writing/line_breaks.h"

namespace corank::report {
namespace {

using Row = std::array<std::string, 6>;

}  // namespace

Standing GalleryResult::standing() const {
  Standing worst = Standing::proven;
  for (const auto& of_question : findings)
    for (const GalleryFinding& finding : of_question) worst = std::max(worst, finding.standing);
  return worst;
}

GallerySums sums_of(const std::vector<GalleryResult>& results) {
  GallerySums sums;
  for (const GalleryResult& result : results) {
    ++sums.entries;
    for_each_number(result, [&](const Expectation&, const GalleryFinding& finding, const GalleryRun&, bool) {
      ++sums.numbers;
      switch (finding.standing) {
        case Standing::proven: ++sums.proven; break;
        case Standing::agrees: ++sums.agree; break;
        case Standing::contradiction: ++sums.contradictions; break;
        case Standing::open: ++sums.open; break;
        case Standing::surprise: ++sums.surprises; break;
        default: ++sums.failures;
      }
    });
  }
  return sums;
}

std::string to_words(const GallerySums& sums) {
  std::string words = fmt::format("{} with {} published {}: {} proven", result::counted(sums.entries, "entry"), sums.numbers,
                                  result::noun(sums.numbers, "number"), sums.proven);
  const auto add = [&words](std::size_t n, const char* what) {
    if (n > 0) words += fmt::format(", {} {}", n, what);
  };
  add(sums.agree, "agree without a proof");
  add(sums.contradictions, "contradict the publication");
  add(sums.open, "open");
  add(sums.surprises, "proven though marked as open");
  add(sums.failures, "NOT MET");
  return words;
}

std::string gallery_table(const std::vector<GalleryResult>& results) {
  std::vector<Row> rows{{"entry", "number", "published", "corank", "", "seconds"}};
  for (const GalleryResult& result : results)
    for_each_number(result, [&](const Expectation& e, const GalleryFinding& finding, const GalleryRun& run, bool first) {
      rows.push_back({result.entry.name, e.claim, e.published, finding.found, to_string(finding.standing),
                      first ? fmt::format("{:.1f}{}", run.seconds, run.stored ? " (stored)" : "") : ""});
    });
  std::array<std::size_t, 6> widths{};
  for (const Row& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], symbolic::columns(row[k]));
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k)
      line += row[k] + std::string(widths[k] - symbolic::columns(row[k]) + 2, ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string gallery_json(const std::vector<GalleryResult>& results, bool complete) {
  using Json = nlohmann::ordered_json;
  Json entries = Json::array();
  for (const GalleryResult& result : results) {
    Json numbers = Json::array();
    for_each_number(result, [&](const Expectation& e, const GalleryFinding& finding, const GalleryRun& run, bool) {
      numbers.push_back({{"claim", e.claim},
                         {"published", e.published},
                         {"found", finding.found},
                         {"standing", to_string(finding.standing)},
                         {"seconds", run.seconds},
                         {"stored", run.stored}});
    });
    entries.push_back({{"name", result.entry.name},
                       {"title", result.entry.title},
                       {"standing", to_string(result.standing())},
                       {"source", result.entry.source},
                       {"certainty", to_string(result.entry.certainty)},
                       {"problems", result.problems},
                       {"numbers", numbers}});
  }
  return Json{{"complete", complete}, {"failures", sums_of(results).failures}, {"entries", entries}}.dump(
      2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace corank::report
