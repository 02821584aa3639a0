// An entry of the gallery: a robot, questions about it, and the numbers that were published as answers.
//
// A question is a command line of corank as a user types it. In it {model} stands for the entry's model:
//
//   command = "aspects {model} --json"
//   expect = [{claim = "aspects", at = "/aspects", value = 10, published = "10"}]
//
// An expectation's number is at a JSON pointer of what the command prints. doc/gallery.md lists the keys of an entry's file.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace corank::report {

using GalleryValue = std::variant<bool, double, std::string>;

struct Expectation {
  std::string claim;          ///< what the number is, in words
  std::string at;             ///< a JSON pointer
  GalleryValue value;         ///< that corank is to find
  double tolerance = 0;       ///< of a number; where corank gives bounds, of each of them
  std::string published;      ///< the number as the publication has it
  std::string contradiction;  ///< not empty: the value is not what was published; why, and how that was checked
  std::string open;           ///< not empty: why corank does not reach this number
  bool proven = true;         ///< false: corank has no proof of it, and need not have one
};

struct GalleryQuestion {
  std::string command;  ///< without "corank"
  std::vector<Expectation> expect;
};

struct GalleryPicture {
  std::string command;  ///< empty: another command writes the file
  std::string file;     ///< an SVG, in the folder of the entry's results
  std::string caption;
};

/// The robot at a configuration of a result: its box number `box`, from 0, of those that are proven to hold a solution, if
/// there are any; a negative number counts from the last.
struct RobotPicture {
  std::string command;  ///< empty: another command writes the file
  std::string file;
  int box = 0;
  std::string caption;
};

/// Where an entry's numbers come from.
enum class Certainty {
  read,     ///< in the publication
  derived,  ///< found anew by other means than corank; GalleryEntry::derived says how
  memory,   ///< remembered: the publication was not at hand
};
std::string to_string(Certainty certainty);

struct GalleryEntry {
  std::string name;              ///< of its file, without .toml
  std::string title, about;      ///< the robot, in a few words and in a sentence or two
  std::filesystem::path model;   ///< its file
  std::string shown_model;       ///< the model as the entry names it
  std::string source, doi, key;  ///< the publication, as a citation; its key in doc/references.bib
  Certainty certainty = Certainty::read;
  std::string derived;  ///< how its numbers were found by other means; empty unless they were
  std::string open;     ///< not empty: why none of its numbers is reached
  bool quick = false;   ///< takes seconds; part of the tests
  std::string report;   ///< a command that writes a report into the folder "page"; empty: none
  std::vector<GalleryQuestion> questions;
  std::vector<GalleryPicture> pictures;
  std::vector<RobotPicture> robots;
};

/// Throws symbolic::ModelError, with file and line, where a key is unknown, missing or of another kind, or where the entry
/// has no source.
GalleryEntry read_entry(const std::filesystem::path& file);
/// Every *.toml of a folder, in the order of their names. Throws the same, also where there is none.
std::vector<GalleryEntry> read_entries(const std::filesystem::path& folder);

/// The words of a command, with {model} replaced. Words in double quotes may have spaces.
std::vector<std::string> words_of(const std::string& command, const std::string& model);

}  // namespace corank::report
