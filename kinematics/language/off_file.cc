#include <charconv>

#include "corank/kinematics/language/part_builder.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::kinematics {
namespace {

using symbolic::in_quotes;
using symbolic::ModelError;
using symbolic::SourceLocation;

constexpr std::size_t kMaxParts = 1'000'000;

// Words, and the ends of lines between them.
class Words {
 public:
  Words(std::string_view text, const std::string& file) : text_(text), where_{file, 1, 0} {}

  const SourceLocation& where() const { return where_; }

  std::string_view next(const std::string& expectation) {
    skip(false);
    if (text_.empty()) throw ModelError(where_, "found the end of the body", expectation);
    std::size_t n = 0;
    while (n < text_.size() && !is_blank(text_[n]) && text_[n] != '\n' && text_[n] != '#') ++n;
    const std::string_view word = text_.substr(0, n);
    text_.remove_prefix(n);
    return word;
  }

  std::size_t count(const std::string& expectation) {
    const std::string_view word = next(expectation);
    std::size_t n = 0;
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), n);
    if (parsed.ec != std::errc() || parsed.ptr != word.data() + word.size() || n > kMaxParts)
      throw ModelError(where_, "found " + in_quotes(word), expectation);
    return n;
  }

  Expression number(const std::string& expectation) {
    std::string_view word = next(expectation);
    const bool negative = word.starts_with('-');
    if (negative || word.starts_with('+')) word.remove_prefix(1);
    const Expression value = Expression::number(symbolic::normal_decimal(word, where_), where_);
    return negative ? -value : value;
  }

  /// To the end of the line: colours of vertices and faces.
  void end_line() {
    const std::size_t end = text_.find('\n');
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end);
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

  void skip(bool in_comment) {
    while (!text_.empty()) {
      const char c = text_[0];
      if (c == '\n') {
        ++where_.line;
        in_comment = false;
      } else if (c == '#') {
        in_comment = true;
      } else if (!in_comment && !is_blank(c)) {
        return;
      }
      text_.remove_prefix(1);
    }
  }

  std::string_view text_;
  SourceLocation where_;
};

}  // namespace

OffBody parse_off(std::string_view text, const std::string& file) {
  if (text.size() > symbolic::kMaxFileBytes)
    throw ModelError({file, 0, 0}, "the body has more than " + std::to_string(symbolic::kMaxFileBytes) + " bytes",
                     "a smaller body");
  Words words(text, file);
  const std::string_view format = words.next("OFF or COFF");
  if (format != "OFF" && format != "COFF") throw ModelError(words.where(), "found " + in_quotes(format), "OFF or COFF");
  const std::size_t vertices = words.count("the number of vertices"), faces = words.count("the number of faces");
  words.count("the number of edges");
  OffBody body;
  for (std::size_t i = 0; i < vertices; ++i) {
    Vector& v = body.vertices.emplace_back();
    for (Expression& coordinate : v) coordinate = words.number("the three coordinates of a vertex");
    words.end_line();
  }
  for (std::size_t i = 0; i < faces; ++i) {
    const std::size_t corners = words.count("the number of a face's corners");
    std::vector<std::size_t>& face = body.faces.emplace_back();
    for (std::size_t k = 0; k < corners; ++k) {
      face.push_back(words.count("the number of a vertex"));
      if (face.back() >= vertices)
        throw ModelError(words.where(), "a face names the vertex " + std::to_string(face.back()),
                         "a number below " + std::to_string(vertices));
    }
    words.end_line();
  }
  return body;
}

}  // namespace corank::kinematics
