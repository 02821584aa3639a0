// What came out of the gallery: for each entry its runs, and how each answer compares; summed up as text and as JSON.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "corank/report/gallery/comparison.h"

namespace corank::report {

struct GalleryResult {
  GalleryEntry entry;
  std::vector<GalleryRun> runs;                       ///< one for each question
  std::vector<std::vector<GalleryFinding>> findings;  ///< of each question, one for each expectation
  std::vector<std::string> problems;                  ///< of commands that were to draw: what they said, and failed
  std::filesystem::path folder;                       ///< of its files
  double seconds = 0;                                 ///< of all its commands, when they were run

  /// What a reader is to see first: a failure, else what is open, else a contradiction, else what is not proven.
  Standing standing() const;
};

struct GallerySums {
  std::size_t entries = 0, numbers = 0, proven = 0, agree = 0, contradictions = 0, open = 0, surprises = 0, failures = 0;
};
GallerySums sums_of(const std::vector<GalleryResult>& results);
/// Calls visit(expectation, finding, run, is it the question's first) for each number of an entry.
template <class Visit>
void for_each_number(const GalleryResult& result, const Visit& visit) {
  for (std::size_t q = 0; q < result.findings.size(); ++q)
    for (std::size_t k = 0; k < result.findings[q].size(); ++k)
      visit(result.entry.questions[q].expect[k], result.findings[q][k], result.runs[q], k == 0);
}
/// "28 entries with 61 published numbers: 57 proven, 2 agree, 2 open"
std::string to_words(const GallerySums& sums);

/// A line for each number: entry, claim, published, found, standing, seconds.
std::string gallery_table(const std::vector<GalleryResult>& results);
/// The same as JSON: {"complete", "failures", "entries": [{"name", "title", "standing", "numbers": […]}]}.
std::string gallery_json(const std::vector<GalleryResult>& results, bool complete);

}  // namespace corank::report
