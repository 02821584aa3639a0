#include "corank/result/cuik/cuik_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>

#include "corank/symbolic/model/expression_words.h"

namespace corank::result {
namespace {

// Values that are words; each has a number there, and none here.
const char* const kValueWords =
    "LINKS DOF FLINKS QLINKS JOINTS SOLID VCOLLIDE PQP FCL C_FCL BULLET C_BULLET RIGIDCLL NONE "
    "TANGENT_SAMPLING EULER RK4 X AMBIENT_SAMPLING KDTREE_SAMPLING LOCAL_TRAPEZOID LOCAL_EULER LOCAL_RK4 "
    "Y Z";

std::vector<std::string> words_of_text(const char* text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

std::string upper(std::string name) {
  for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

std::string nearest(const std::string& name) {
  return *std::ranges::min_element(cuik_parameters(), {},
                                   [&](const std::string& known) { return symbolic::edit_distance(name, known); });
}

const std::map<std::string, double (*)(double)> kFunctions{
    {"COS", [](double x) { return std::cos(x); }}, {"SIN", [](double x) { return std::sin(x); }},
    {"TAN", [](double x) { return std::tan(x); }}, {"EXP", [](double x) { return std::exp(x); }},
    {"LOG", [](double x) { return std::log(x); }}, {"SQRT", [](double x) { return std::sqrt(x); }}};

bool is_value_word(const std::string& word) {
  static const std::vector<std::string> all = words_of_text(kValueWords);
  return std::ranges::find(all, word) != all.end();
}

struct Token {
  enum class Kind { name, number, sign, end } kind = Kind::end;
  std::string text;
  double number = 0;
  int line = 1;
};

class ParamParser {
 public:
  ParamParser(std::string_view text, const std::string& file) : text_(text), file_(file) { next(); }

  CuikParameters parse() {
    while (token_.kind != Token::Kind::end) parameter();
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& problem, const std::string& expectation) const {
    throw CuikFileError(file_, line, problem, expectation);
  }
  [[noreturn]] void found(const std::string& expectation) const {
    fail(token_.line, token_.kind == Token::Kind::end ? "found the end of the file" : "found '" + token_.text + "'",
         expectation);
  }

  bool at(std::string_view start) const { return text_.substr(at_).starts_with(start); }
  void skip_gap() {
    for (; at_ < text_.size(); ++at_) {
      if (at("%") || at("#") || at("//")) at_ = std::min(text_.find('\n', at_), text_.size());
      if (at("/*")) {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == std::string_view::npos) fail(line_, "a comment that begins with /* has no end", "*/");
        line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                             text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
        at_ = end + 1;
        continue;
      }
      if (at_ >= text_.size() || std::isspace(static_cast<unsigned char>(text_[at_])) == 0) return;
      if (text_[at_] == '\n') ++line_;
    }
  }

  void next() {
    skip_gap();
    token_ = {};
    token_.line = line_;
    if (at_ >= text_.size()) return;
    const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    const char c = text_[at_];
    std::size_t end = at_;
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') {
      const auto [stop, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), token_.number);
      if (error != std::errc{})
        fail(line_, error == std::errc::result_out_of_range ? "a number is out of range" : "found '.'", "a number");
      end = stop - text_.data();
      if (end < text_.size() && (is_word(text_[end]) || text_[end] == '.'))
        fail(line_, "found a letter right after a number", "a blank");
      token_.kind = Token::Kind::number;
    } else if (is_word(c)) {
      while (end < text_.size() && is_word(text_[end])) ++end;
      token_.kind = Token::Kind::name;
    } else {
      if (std::string_view("+-*/^()=?:<>").find(c) == std::string_view::npos) {
        const bool printable = c > 0x20 && c < 0x7F;
        fail(line_, printable ? std::string("found '") + c + "'" : "found a character that is not allowed here",
             "NAME = value, with +, -, *, /, ^, <, >, ? : and parentheses in the value");
      }
      end = at_ + 1;
      token_.kind = Token::Kind::sign;
    }
    constexpr std::size_t kLongestName = 60;
    token_.text = std::string(text_.substr(at_, std::min(end - at_, kLongestName)));
    at_ = end;
  }
  bool take(char sign) {
    if (token_.kind != Token::Kind::sign || token_.text[0] != sign) return false;
    next();
    return true;
  }
  void need(char sign) {
    if (!take(sign)) found(std::string("'") + sign + "'");
  }

  void parameter() {
    if (token_.kind != Token::Kind::name) found("a parameter, NAME = value");
    const Token name = token_;
    const std::string known = upper(name.text);
    if (std::ranges::find(cuik_parameters(), known) == cuik_parameters().end())
      fail(name.line, "the parameter '" + name.text + "' is unknown",
           "a parameter of the CUIK suite; did you mean " + nearest(name.text) + "?");
    next();
    need('=');
    const std::optional<double> value = this->value();
    if (value) values_[known] = *value;
    apply(known, name, value);
  }

  std::optional<double> value() {
    // -Z, of G_AXIS: a sign and a word.
    const bool sign = token_.kind == Token::Kind::sign && (token_.text == "-" || token_.text == "+");
    const std::size_t at = at_;
    const int line = line_;
    const Token token = token_;
    if (sign) next();
    if (token_.kind == Token::Kind::name && is_value_word(upper(token_.text))) {
      next();
      return std::nullopt;
    }
    at_ = at;
    line_ = line;
    token_ = token;
    return choice(0);
  }

  void apply(const std::string& known, const Token& name, std::optional<double> value) {
    const auto refuse = [&](const char* expected) { fail(name.line, name.text + " cannot be used", expected); };
    if (known == "SIGMA" || known == "SMALL_SIGMA") {
      if (!value || !std::isfinite(*value) || *value <= 0) refuse("a positive number");
      (known == "SIGMA" ? out_.sigma : out_.small_sigma) = value;
    } else if (known == "N_SOLUTIONS") {
      if (!value || !(*value >= 0 && *value <= std::numeric_limits<int>::max()) || *value != std::floor(*value))
        refuse("a number of boxes, or 0 for all");
      out_.n_solutions = static_cast<int>(*value);
    } else if (std::ranges::find(out_.ignored, name.text) == out_.ignored.end()) {
      out_.ignored.push_back(name.text);
    }
  }

  // condition ? a : b
  double choice(int depth) {
    double x = sum(depth);
    if (take('>')) {
      x = x > sum(depth);
    } else if (take('<')) {
      x = x < sum(depth);
    }
    if (!take('?')) return x;
    const double a = choice(depth + 1);
    need(':');
    const double b = choice(depth + 1);
    return x != 0 ? a : b;
  }
  // From left to right, powers, too, and a sign binds closer, as in the CUIK suite: -2^2 is 4, 2^3^2 is 64.
  double sum(int depth, std::size_t rank = 0) {
    static constexpr std::array<std::string_view, 3> kSigns{"+-", "*/", "^"};
    if (rank == kSigns.size()) return operand(depth);
    double x = sum(depth, rank + 1);
    while (token_.kind == Token::Kind::sign && kSigns[rank].find(token_.text) != std::string_view::npos) {
      const char sign = token_.text[0];
      next();
      const double y = sum(depth, rank + 1);
      x = sign == '+' ? x + y : sign == '-' ? x - y : sign == '*' ? x * y : sign == '/' ? x / y : std::pow(x, y);
    }
    return x;
  }
  double in_parentheses(int depth) {
    need('(');
    const double x = choice(depth + 1);
    need(')');
    return x;
  }
  double operand(int depth) {
    constexpr int kDeepest = 100;
    if (depth > kDeepest) fail(token_.line, "a value is nested too deeply", "a number");
    if (take('-')) return -operand(depth + 1);
    if (take('+')) return operand(depth + 1);
    const Token token = token_;
    if (token.kind == Token::Kind::sign && token.text == "(") return in_parentheses(depth);
    if (token.kind == Token::Kind::number) {
      next();
      return token.number;
    }
    if (token.kind != Token::Kind::name) found("a value");
    next();
    if (const auto f = kFunctions.find(upper(token.text)); f != kFunctions.end()) return f->second(in_parentheses(depth));
    if (const auto v = values_.find(token.text); v != values_.end()) return v->second;
    fail(token.line, "'" + token.text + "' has no value",
         "a number, a constant such as PI or TRUE, or a parameter given before");
  }

  const std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  int line_ = 1;
  Token token_;
  std::map<std::string, double> values_{// and of parameters given before
                                        {"PI", std::numbers::pi},
                                        {"INF", std::numeric_limits<double>::infinity()},
                                        {"TRUE", 1},
                                        {"FALSE", 0},
                                        {"ON", 1},
                                        {"OFF", 0}};
  CuikParameters out_;
};

}  // namespace

const std::vector<std::string>& cuik_parameters() {
  // SAVE_SIMPLEX is what the suite prints for SAFE_SIMPLEX; ERROR_SPLIT is its older name for SPLIT_TYPE.
  static const char* const kAll =
      "SIGMA SMALL_SIGMA N_SOLUTIONS EPSILON REPRESENTATION RHO STATE_PERIOD DUMMIFY SPLIT_TYPE ERROR_SPLIT "
      "SAFE_SIMPLEX SAVE_SIMPLEX SIMPLIFICATION_LEVEL LR2TM_Q LR2TM_S MAX_NEWTON_ITERATIONS N_DOF E CE R SR "
      "DELTA BETA GAMMA MAX_CHARTS DETECT_BIFURCATIONS SAMPLING MAX_PLANNING_TIME MAX_PLANNING_ITERATIONS "
      "MAX_NODES_RRT BI_RRT RRT_GRAPH DYNAMIC_DOMAIN COEF_TEMP NFAIL_MAX CD_ENGINE DYNAMICS "
      "INTEGRATION_TIME DEFAULT_MAX_VELOCITY N_DYNAMIC_ACTIONS DYNAMIC_GOAL_ERROR G_COMPENSATION G_AXIS "
      "NEG_LM TAU LQR_PLANNING_TIME PRETENSION VDW_RATIO CUT_X CUT_Y CUT_Z DYNAMIC_PROBLEM "
      "N_CACHED_DYNAMIC_ACTIONS N_SAMPLES REACHABILITY";
  static const std::vector<std::string> list = words_of_text(kAll);
  return list;
}

std::optional<double> sigma_for(const CuikParameters& parameters, const System& system) {
  if (system.equations.size() != system.variables.size()) return parameters.sigma;
  constexpr double kDefaultSmallSigma = 1e-4;
  if (parameters.small_sigma) return parameters.small_sigma;
  return parameters.sigma ? std::optional(std::min(*parameters.sigma, kDefaultSmallSigma)) : std::nullopt;
}

CuikParameters parse_param(std::string_view text, const std::string& file) { return ParamParser(text, file).parse(); }

CuikParameters read_param(const std::filesystem::path& path) {
  return parse_param(read_cuik_text(path, ".param"), path.string());
}

}  // namespace corank::result
