#include "corank/report/html/gallery_page.h"

#include <fmt/format.h>

#include <optional>

#include "corank/core/box.h"
#include "corank/report/html/page_assets.h"
#include "corank/report/html/page_data.h"
#include "corank/report/html/page_words.h"
#include "corank/report/html/template_data.h"
#include "corank/report/pictures/box_payload.h"
#include "corank/result/files/result_file.h"
#include "corank/result/files/verification.h"
#include "corank/result/values/result.h"
#include "corank/result/values/tallies.h"
#include "corank/symbolic/model/model_error.h"

namespace corank::report {
namespace {

namespace fs = std::filesystem;

/// A word for CSS and for a reader: ok, agrees, contradiction, open or failed.
std::string look_of(Standing standing) {
  switch (standing) {
    case Standing::proven: return "ok";
    case Standing::agrees: return "agrees";
    case Standing::contradiction: return "contradiction";
    case Standing::open: return "open";
    case Standing::surprise: return "ok";
    default: return "failed";
  }
}

/// Those that hold a solution.
std::vector<Box> proven_boxes(const std::vector<CoverBox>& boxes) {
  std::vector<Box> list;
  for (const CoverBox& b : boxes)
    if (result::is_surely_within(b.verdict)) list.push_back(b.box);
  return list;
}

/// The mechanism at a box of a result, for the page's script; nothing where there is no such box or nothing to draw.
std::optional<std::string> robot_data(const fs::path& file, int number) {
  try {
    result::Result result = result::read_result(file, {.free = false});
    const symbolic::Mechanism mechanism = result::model_of(result);
    std::vector<Box> boxes = proven_boxes(result.cover.points);
    if (boxes.empty()) boxes = proven_boxes(result.cover.boxes);
    if (boxes.empty())
      for (const CoverBox& b : result.cover.boxes) boxes.push_back(b.box);
    const int place = number < 0 ? static_cast<int>(boxes.size()) + number : number;
    if (mechanism.drawing().points.empty() || place < 0 || place >= static_cast<int>(boxes.size())) return std::nullopt;
    const Box& box = boxes[place];
    result.cover.boxes.clear();
    result.cover.points.clear();
    result.cover.self_motions.clear();
    const Json values = midpoint(box);
    std::string model;
    if (mechanism.is_plain_system()) {
      model = drawing_model(mechanism, result::system_of(mechanism, result));
    } else {
      model = page_model(mechanism, symbolic::derive(mechanism), {set_view(mechanism, std::move(result))});
    }
    return fmt::format(R"({{"model":{},"x":{}}})", model, values.dump());
  } catch (const result::ResultFileError&) {
    return std::nullopt;
  } catch (const symbolic::ModelError&) {
    return std::nullopt;
  }
}

TemplateData number_row(const Expectation& e, const GalleryFinding& finding, const GalleryRun& run, bool first) {
  TemplateData row{"claim", e.claim};
  row["published"] = e.published;
  row["found"] = with_minus(finding.found);
  row["standing"] = to_string(finding.standing);
  row["look"] = look_of(finding.standing);
  row["seconds"] = first ? fmt::format("{:.1f}", run.seconds) : "";
  row["contradiction"] = if_any(e.contradiction);
  row["whyOpen"] = if_any(e.open);
  return row;
}

TemplateData rows_of(const GalleryResult& result) {
  TemplateData rows = empty_list();
  const std::size_t size = sums_of({result}).numbers;
  bool first_row = true;
  for_each_number(result, [&](const Expectation& e, const GalleryFinding& finding, const GalleryRun& run, bool first) {
    TemplateData row = number_row(e, finding, run, first);
    if (first_row) row["head"] = TemplateData{"rows", std::to_string(size)};
    first_row = false;
    rows << row;
  });
  return rows;
}

/// Of each command what it took, and its answer as a file.
TemplateData commands_of(const GalleryResult& result, const std::string& link) {
  TemplateData commands = empty_list();
  for (std::size_t q = 0; q < result.runs.size(); ++q) {
    const GalleryRun& run = result.runs[q];
    std::string command = "corank";
    for (const std::string& word : words_of(result.entry.questions[q].command, result.entry.shown_model))
      command += " " + (word.find_first_of(" ()*;&|<>$'") == std::string::npos ? word : '"' + word + '"');
    TemplateData item{"command", command};
    item["seconds"] = fmt::format("{:.2f}", run.seconds);
    item["processor"] = fmt::format("{:.2f}", run.processor_seconds);
    const std::uint64_t boxes = boxes_processed(run);
    item["boxes"] = if_any(boxes > 0 ? grouped(boxes) : "");
    item["answer"] = fmt::format("{}/{}.json", link, q + 1);
    commands << item;
  }
  return commands;
}

TemplateData section_of(const GalleryResult& result, const fs::path& folder, TemplateData& robots) {
  const GalleryEntry& entry = result.entry;
  const std::string link = result.folder.lexically_relative(folder).generic_string();
  const Standing standing = result.standing();
  TemplateData section{"name", entry.name}, locus = empty_list(), drawn = empty_list();
  section["title"] = entry.title;
  section["about"] = entry.about;
  section["standing"] = (standing == Standing::agrees || standing == Standing::open) && sums_of({result}).proven > 0
                            ? "partly proven"
                            : to_string(standing);
  section["look"] = look_of(standing);
  section["rows"] = rows_of(result);
  section["commands"] = commands_of(result, link);
  section["source"] = entry.source;
  section["doi"] = if_any(entry.doi);
  section["certainty"] = entry.certainty == Certainty::read ? "The numbers were read in the publication."
                         : entry.certainty == Certainty::derived
                             ? "The numbers were derived anew."
                             : "The numbers are remembered; the publication was not at hand.";
  section["derived"] = if_any(entry.derived);
  section["open"] = if_any(entry.open);
  section["model"] = entry.shown_model;
  section["modelText"] = result::file_bytes(entry.model);
  section["report"] = if_any(fs::exists(result.folder / "page" / "index.html") ? link + "/page/index.html" : "");
  section["problems"] = list_of("problem", result.problems);
  for (std::size_t k = 0; k < entry.robots.size(); ++k) {
    const auto data = robot_data(result.folder / entry.robots[k].file, entry.robots[k].box);
    if (!data) continue;
    const std::string id = fmt::format("{}-{}", entry.name, k);
    TemplateData robot{"id", id};
    robot["caption"] = entry.robots[k].caption;
    drawn << robot;
    TemplateData script{"id", id};
    script["data"] = *data;
    robots << script;
  }
  for (const GalleryPicture& picture : entry.pictures) {
    const std::string svg = result::file_bytes(result.folder / picture.file);
    if (svg.empty()) continue;
    TemplateData item{"svg", base64({reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size()})};
    item["caption"] = picture.caption;
    locus << item;
  }
  section["robots"] = std::move(drawn);
  section["pictures"] = std::move(locus);
  return section;
}

}  // namespace

std::string gallery_page(const std::vector<GalleryResult>& results, const fs::path& folder, const std::string& command) {
  TemplateData page, sections = empty_list(), robots = empty_list();
  double seconds = 0;
  for (const GalleryResult& result : results) {
    sections << section_of(result, folder, robots);
    seconds += result.seconds;
  }
  const GallerySums sums = sums_of(results);
  page["version"] = result::version();
  page["style"] = std::string(kPageStyle) + set_style() + std::string(kGalleryStyle);
  page["words"] = to_words(sums);
  page["entries"] = std::to_string(sums.entries);
  page["numbers"] = std::to_string(sums.numbers);
  page["provenNumbers"] = std::to_string(sums.proven + sums.surprises);
  page["agree"] = if_any(sums.agree > 0 ? std::to_string(sums.agree) : "");
  page["contradictions"] = if_any(sums.contradictions > 0 ? std::to_string(sums.contradictions) : "");
  page["open"] = if_any(sums.open > 0 ? std::to_string(sums.open) : "");
  page["failures"] = if_any(sums.failures > 0 ? std::to_string(sums.failures) : "");
  page["seconds"] = fmt::format("{:.0f}", seconds);
  page["sections"] = std::move(sections);
  page["robots"] = std::move(robots);
  page["command"] = command;
  page["script"] = std::string(kGalleryScript);
  return filled(kGalleryTemplate, page);
}

}  // namespace corank::report
