#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "corank/result/cuik/cuik_files.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/model/text_file.h"

namespace corank::result {
namespace {

using symbolic::trimmed;

constexpr std::string_view kBlanks = " \t\r\n\f\v";

bool is_blank(char c) { return kBlanks.find(c) != std::string_view::npos; }
bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

// Short, printable, in quotes.
std::string shown(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string out = "'";
  for (const char c : text.substr(0, kLongest)) out += is_control(c) || static_cast<unsigned char>(c) > 0x7E ? '?' : c;
  return out + (text.size() > kLongest ? "…'" : "'");
}

class SolParser {
 public:
  SolParser(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  SolFile parse() {
    while (skip_to_brace()) {
      const bool approximate = trimmed(text_.substr(line_start_, at_ - line_start_)).starts_with("Newton");
      SolBox box = read_box(!approximate);
      if (approximate) continue;
      read_verdict(box);
      out_.boxes.push_back(std::move(box));
    }
    if (out_.boxes.empty() && text_.find("SOLUTIONS (to input file") == std::string_view::npos)
      throw CuikFileError(file_, line_, "holds no boxes", "boxes such as { 2  x[0,1] y[0,1] }");
    if (ours() && text_.find("\nEND OF THE SOLUTION FILE") == std::string_view::npos)
      throw CuikFileError(file_, line_, "the file is cut short", "END OF THE SOLUTION FILE");
    if (out_.variables.empty() && out_.boxes.empty()) return out_;
    if (std::set<std::string>(out_.variables.begin(), out_.variables.end()).size() != out_.variables.size())
      throw CuikFileError(file_, first_box_line_, "a name occurs twice in a box", "distinct names of variables");
    return out_;
  }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& expectation) const {
    throw CuikFileError(file_, line_, problem, expectation);
  }
  [[noreturn]] void found(const std::string& expectation) const {
    if (at_ >= text_.size()) fail("the file ends inside a box", expectation);
    fail("found " + shown(text_.substr(at_, 1)) + " in a box", expectation);
  }

  bool ours() const { return text_.find("\nWritten by corank ") != std::string_view::npos; }

  void advance() {
    if (text_[at_] == '\n') {
      ++line_;
      line_start_ = at_ + 1;
    }
    ++at_;
  }
  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) advance();
  }
  bool skip_to_brace() {
    while (at_ < text_.size() && text_[at_] != '{') advance();
    return at_ < text_.size();
  }
  void expect(char c, const std::string& expectation) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != c) found(expectation);
    advance();
  }

  template <typename Number>
  Number number(const std::string& expectation) {
    skip_blanks();
    const char *const begin = text_.data() + at_, *const end = text_.data() + text_.size();
    const char* const digits = begin != end && *begin == '+' ? begin + 1 : begin;
    Number value{};
    const auto [stop, error] = std::from_chars(digits, end, value);
    if (error == std::errc::result_out_of_range) fail("a number is out of range", "a double");
    if (error != std::errc{}) found(expectation);
    at_ += stop - begin;
    return value;
  }

  Interval interval() {
    expect('[', "'['");
    const double lo = number<double>("a lower bound");
    expect(',', "',' between the bounds");
    const double hi = number<double>("an upper bound");
    expect(']', "']' after the bounds");
    if (!std::isfinite(lo) || !std::isfinite(hi)) fail("a bound is not finite", "finite numbers");
    if (!(lo <= hi)) fail("a side of a box is empty", "a lower bound of at most the upper one");
    return {lo, hi};
  }

  // "{ n  name[a,b] … }"; the names are optional, but then all.
  SolBox read_box(bool keep) {
    const int line = line_;
    advance();
    const auto n = number<std::size_t>("the number of sides");
    std::vector<std::string> names;
    SolBox box;
    for (skip_blanks(); at_ < text_.size() && text_[at_] != '}'; skip_blanks()) {
      if (box.box.size() == n) fail("a box has more than " + std::to_string(n) + " sides", "'}'");
      const std::size_t begin = at_;
      while (at_ < text_.size() && !is_blank(text_[at_]) && !is_control(text_[at_]) &&
             std::string_view("[]{},%").find(text_[at_]) == std::string_view::npos) {
        advance();
      }
      if (at_ > begin) names.emplace_back(text_.substr(begin, at_ - begin));
      if (at_ < text_.size() && text_[at_] != '[' && !is_blank(text_[at_])) found("'[' or a variable's name");
      box.box.push_back(interval());
      if (!names.empty() && names.size() != box.box.size())
        fail("only some sides have a name", "a name for each side, or no names");
    }
    if (at_ >= text_.size()) found("'}'");
    advance();
    if (box.box.size() != n)
      fail("a box announces " + std::to_string(n) + " sides and has " + std::to_string(box.box.size()),
           "as many as announced");
    if (n == 0) fail("a box has no sides", "at least one");
    if (keep) check_like_first(line, box, std::move(names));
    return box;
  }

  void check_like_first(int line, const SolBox& box, std::vector<std::string> names) {
    if (out_.boxes.empty()) {
      first_box_line_ = line;
      out_.variables = std::move(names);
      return;
    }
    if (box.box.size() != out_.boxes.front().box.size() || names != out_.variables)
      throw CuikFileError(file_, line, "a box has other variables than the one in line " + std::to_string(first_box_line_),
                          "the same variables in every box");
  }

  // The comment behind a box: "% verdict" or "% verdict, free x y". Anything else is none of ours.
  void read_verdict(SolBox& box) const {
    std::string_view rest = text_.substr(at_, text_.substr(at_).find('\n'));
    rest = trimmed(rest.substr(0, rest.find('{')));
    if (!rest.starts_with('%')) return;
    rest = trimmed(rest.substr(1));
    const std::string_view word = rest.substr(0, rest.find(','));
    for (int v = 0; v < kVerdicts; ++v) {
      if (word == to_string(static_cast<Verdict>(v))) box.verdict = static_cast<Verdict>(v);
    }
    if (!box.verdict || word.size() == rest.size()) return;
    rest = trimmed(rest.substr(word.size() + 1));
    if (!rest.starts_with("free "))
      fail("the verdict " + shown(word) + " is followed by " + shown(rest), "free and names of variables");
    std::istringstream names{std::string(rest.substr(5))};
    for (std::string name; names >> name; box.free.push_back(name)) {
      if (std::ranges::find(out_.variables, name) == out_.variables.end())
        fail("the free variable " + shown(name) + " is not a variable of the box", "names of its variables");
    }
  }

  const std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1, first_box_line_ = 1;
  SolFile out_;
};

}  // namespace

CuikFileError::CuikFileError(const std::string& file, int line, const std::string& problem, const std::string& expectation)
    : ResultFileError(file + ":" + std::to_string(line) + ": " + problem + "; expected " + expectation), line_(line) {}

std::string read_cuik_text(const std::filesystem::path& path, const std::string& extension) {
  try {
    return symbolic::read_bytes(path);
  } catch (const symbolic::ReadingError& error) {
    throw ResultFileError(path.string() + ": " + error.what() + "; expected a " + extension + " file");
  }
}

int SolFile::find(const std::string& name_or_number) const {
  const auto named = std::ranges::find(variables, name_or_number);
  if (named != variables.end()) return static_cast<int>(named - variables.begin());
  int number = 0;
  const char* const end = name_or_number.data() + name_or_number.size();
  const auto [stop, error] = std::from_chars(name_or_number.data(), end, number);
  return error == std::errc{} && stop == end && number >= 1 && number <= size() ? number - 1 : -1;
}

SolFile parse_sol(std::string_view text, const std::string& file) { return SolParser(text, file).parse(); }

SolFile read_sol(const std::filesystem::path& path) { return parse_sol(read_cuik_text(path, ".sol"), path.string()); }

}  // namespace corank::result
