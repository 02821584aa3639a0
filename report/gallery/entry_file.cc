// Reads an entry of the gallery by toml++, which no other file includes: it takes long to compile.
#include <fmt/format.h>

#include <toml++/toml.h>
#include <set>

#include "corank/report/gallery/entry.h"
#include "corank/symbolic/model/model_error.h"

namespace corank::report {
namespace {

/// A table whose keys are taken one by one; those that are left are unknown.
class EntryTable {
 public:
  EntryTable(const toml::table& table, std::string file) : table_(table), file_(std::move(file)) {}

  std::string text(const char* key, bool needed = false) {
    const toml::node* node = find(key, needed, "a text");
    if (!node) return "";
    if (!node->is_string()) fail(*node, fmt::format("{} is no text", key), "\"…\"");
    std::string value = node->as_string()->get();
    if (needed && value.find_first_not_of(" \n") == std::string::npos)
      fail(*node, fmt::format("{} is empty", key), "a text");
    return value;
  }
  bool flag(const char* key, bool otherwise) {
    const toml::node* node = find(key, false, "");
    if (!node) return otherwise;
    if (!node->is_boolean()) fail(*node, fmt::format("{} is neither true nor false", key), "true or false");
    return node->as_boolean()->get();
  }
  double number(const char* key, double otherwise) {
    const toml::node* node = find(key, false, "");
    if (!node) return otherwise;
    if (!node->is_number()) fail(*node, fmt::format("{} is no number", key), "a number");
    return *node->value<double>();
  }
  GalleryValue value(const char* key) {
    const toml::node& node = *find(key, true, "a number, a text, true or false");
    if (node.is_boolean()) return node.as_boolean()->get();
    if (node.is_number()) return *node.value<double>();
    if (node.is_string()) return node.as_string()->get();
    fail(node, fmt::format("{} is a list or a table", key), "a number, a text, true or false");
  }
  /// What each table of a list is read as.
  template <class Read>
  auto list(const char* key, bool needed, const Read& read) {
    std::vector<decltype(read(std::declval<EntryTable&>()))> all;
    const toml::node* node = find(key, needed, "a list of tables");
    if (!node) return all;
    if (!node->is_array() || node->as_array()->empty()) fail(*node, fmt::format("{} is no list", key), "a list of tables");
    for (const toml::node& item : *node->as_array()) {
      if (!item.is_table()) fail(item, fmt::format("an item of {} is no table", key), "{key = value, …}");
      EntryTable table(*item.as_table(), file_);
      all.push_back(read(table));
      table.finish();
    }
    return all;
  }
  void finish() const {
    for (const auto& [key, node] : table_)
      if (!taken_.contains(std::string(key.str())))
        throw symbolic::ModelError(place(key.source()), fmt::format("unknown key '{}'", key.str()),
                                   fmt::format("one of {}", fmt::join(taken_, ", ")));
  }
  [[noreturn]] void fail(const std::string& key, const std::string& problem, const std::string& expected) const {
    const toml::node* node = table_.get(key);
    fail(node ? *node : table_, problem, expected);
  }

 private:
  symbolic::SourceLocation place(const toml::source_region& region) const {
    return {file_, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
  }
  [[noreturn]] void fail(const toml::node& node, const std::string& problem, const std::string& expected) const {
    throw symbolic::ModelError(place(node.source()), problem, expected);
  }
  const toml::node* find(const char* key, bool needed, const std::string& expected) {
    taken_.insert(key);
    const toml::node* node = table_.get(key);
    if (!node && needed) fail(table_, fmt::format("{} is missing", key), fmt::format("{} = {}", key, expected));
    return node;
  }

  const toml::table& table_;
  std::string file_;
  std::set<std::string> taken_;
};

Expectation expectation_of(EntryTable& table) {
  Expectation e;
  e.claim = table.text("claim", true);
  e.at = table.text("at", true);
  if (e.at.front() != '/' || e.at.find('~') != std::string::npos) table.fail("at", "at is no JSON pointer", "\"/name\"");
  e.value = table.value("value");
  e.tolerance = table.number("tolerance", 0);
  e.published = table.text("published", true);
  e.contradiction = table.text("contradiction");
  e.open = table.text("open");
  e.proven = table.flag("proven", true);
  return e;
}

GalleryQuestion question_of(EntryTable& table) {
  GalleryQuestion question;
  question.command = table.text("command", true);
  question.expect = table.list("expect", true, expectation_of);
  return question;
}

GalleryPicture picture_of(EntryTable& table) {
  GalleryPicture picture{table.text("command"), table.text("file", true), table.text("caption", true)};
  if (!picture.file.ends_with(".svg")) table.fail("file", "a picture is no SVG", "a name that ends in .svg");
  return picture;
}

RobotPicture robot_of(EntryTable& table) {
  return {table.text("command"), table.text("file", true), static_cast<int>(table.number("box", 0)),
          table.text("caption", true)};
}

Certainty certainty_of(EntryTable& table, const std::string& derived) {
  const std::string word = table.text("certainty", true);
  for (const Certainty c : {Certainty::read, Certainty::derived, Certainty::memory}) {
    if (word != to_string(c)) continue;
    if (c == Certainty::derived && derived.empty())
      table.fail("certainty", "nothing says how the numbers were derived", "derived = \"how\"");
    return c;
  }
  table.fail("certainty", fmt::format("certainty is '{}'", word), "read, derived or memory");
}

toml::table parsed(const std::filesystem::path& file) {
  try {
    return toml::parse_file(file.string());
  } catch (const toml::parse_error& error) {
    const auto& begin = error.source().begin;
    throw symbolic::ModelError({file.string(), static_cast<int>(begin.line), static_cast<int>(begin.column)},
                               std::string(error.description()), "TOML");
  }
}

}  // namespace

GalleryEntry read_entry(const std::filesystem::path& file) {
  const toml::table root = parsed(file);
  EntryTable table(root, file.string());
  GalleryEntry entry;
  entry.name = file.stem().string();
  entry.title = table.text("title", true);
  entry.about = table.text("about", true);
  entry.shown_model = table.text("model", true);
  entry.model = std::filesystem::weakly_canonical(file.parent_path() / entry.shown_model);
  if (!std::filesystem::exists(entry.model))
    table.fail("model", fmt::format("there is no file {}", entry.model.string()),
               "the path of a model from the entry's folder");
  while (entry.shown_model.starts_with("../")) entry.shown_model.erase(0, 3);
  if (entry.shown_model.find('/') == std::string::npos) entry.shown_model.insert(0, "gallery/");
  entry.source = table.text("source", true);
  entry.doi = table.text("doi");
  entry.key = table.text("key");
  entry.derived = table.text("derived");
  entry.certainty = certainty_of(table, entry.derived);
  entry.open = table.text("open");
  entry.quick = table.flag("quick", false);
  entry.report = table.text("report");
  entry.questions = table.list("question", true, question_of);
  entry.pictures = table.list("picture", false, picture_of);
  entry.robots = table.list("robot", false, robot_of);
  table.finish();
  return entry;
}

}  // namespace corank::report
