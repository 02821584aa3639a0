#include "corank/app/help_format.h"

#include <sstream>

namespace corank::app {
namespace {

constexpr std::size_t kColumns = 100;

// Appends words, and where the line is full goes on in the next one after an indentation; a word that fits into no line is
// broken after commas.
class Lines {
 public:
  Lines(std::string begin, std::size_t indent) : text_(std::move(begin)), indent_(indent), column_(text_.size()) {}

  void add(std::string word) {
    while (indent_ + word.size() > kColumns) {
      const std::size_t room = kColumns - std::min(kColumns, column_ + 1), comma = word.rfind(',', room - 1);
      if (room == 0 || comma == std::string::npos) break;
      put(word.substr(0, comma + 1));
      word.erase(0, comma + 1);
      next_line();
    }
    put(word);
  }
  void add_all(const std::string& words) {
    std::istringstream in(words);
    for (std::string word; in >> word;) add(word);
  }
  void next_line() {
    text_ += '\n' + std::string(indent_, ' ');
    column_ = indent_;
    empty_ = true;
  }
  /// Goes on at a column of the same line, or of the next one where that is passed.
  void to_column(std::size_t column) {
    indent_ = column;
    if (column_ >= column) return next_line();
    text_.append(column - column_, ' ');
    column_ = column;
    empty_ = true;
  }
  const std::string& text() const { return text_; }

 private:
  void put(const std::string& word) {
    if (!empty_ && column_ + 1 + word.size() > kColumns) next_line();
    if (!empty_) text_ += ' ', ++column_;
    text_ += word;
    column_ += word.size();
    empty_ = false;
  }

  std::string text_;
  std::size_t indent_, column_;
  bool empty_ = true;  // since the line began
};

std::string in_two_columns(const std::string& name, const std::string& description, std::size_t column) {
  Lines lines("  ", 6);
  lines.add_all(name);
  if (!description.empty()) lines.to_column(column);
  lines.add_all(description);
  return lines.text() + "\n";
}

std::string in_paragraphs(const std::string& text) {
  std::istringstream in(text);
  std::string result, paragraph;
  const auto end_paragraph = [&] {
    Lines lines("", 0);
    lines.add_all(paragraph);
    if (!paragraph.empty()) result += lines.text() + "\n";
    paragraph.clear();
  };
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line[0] != ' ') {
      paragraph += line + " ";
      continue;
    }
    end_paragraph();
    result += line + "\n";
  }
  end_paragraph();
  return result;
}

}  // namespace

std::string HelpFormat::make_option(const CLI::Option* option, bool is_positional) const {
  return in_two_columns(make_option_name(option, is_positional) + make_option_opts(option), make_option_desc(option),
                        column_width_);
}

std::string HelpFormat::make_subcommand(const CLI::App* sub) const {
  return in_two_columns(sub->get_display_name(true), sub->get_description(), column_width_);
}

std::string HelpFormat::make_description(const CLI::App* app) const {
  return in_paragraphs(CLI::Formatter::make_description(app));
}

std::string HelpFormat::make_footer(const CLI::App* app) const { return in_paragraphs(CLI::Formatter::make_footer(app)); }

}  // namespace corank::app
