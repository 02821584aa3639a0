#include "corank/app/run.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <regex>
#include <sstream>

#include "corank/app/subcommands.h"
#include "corank/core/check.h"
#include "corank/solve/step/options.h"
#include "corank/symbolic/model/model_error.h"

namespace corank::app {
namespace {

constexpr std::size_t kColumns = 100;

// For BibTeX, of what CITATION.cff says and the version that runs.
std::string citation() {
  return R"(@software{corank,
  author  = {{The corank developers}},
  title   = {corank: all singularities of a robot mechanism, each with a proof},
  version = {)" +
         result::version() + R"(},
  license = {GPL-3.0-or-later}
})";
}

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

// Help texts at 100 columns, whatever the length of a description: options and subcommands in two columns, prose in
// paragraphs. Lines that begin with a space, such as examples, stay as they are.
class HelpFormat : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    // What CLI11 says of a value's range is no part of what is to be typed.
    static const std::regex range(R"(:(FILE|SIZE \[[^\]]*\]|(INT|FLOAT) in \[[^\]]*\]|a number from 0 to 1000))");
    return in_two_columns(std::regex_replace(make_option_name(option, is_positional) + make_option_opts(option), range, ""),
                          make_option_desc(option), column_width_);
  }
  std::string make_subcommand(const CLI::App* sub) const override {
    return in_two_columns(sub->get_display_name(true), sub->get_description(), column_width_);
  }
  std::string make_description(const CLI::App* app) const override {
    return in_paragraphs(CLI::Formatter::make_description(app));
  }
  std::string make_footer(const CLI::App* app) const override { return in_paragraphs(CLI::Formatter::make_footer(app)); }
};

bool is_too_large(const std::string& digits) {
  errno = 0;
  std::strtoull(digits.c_str(), nullptr, 10);
  return errno == ERANGE;
}

/// What CLI11 lets pass: a file without a name, an empty value, "nan" and "inf", which no range excludes, and whole numbers
/// that no variable holds.
void check_values(const CLI::App& program) {
  for (const CLI::App* sub : program.get_subcommands()) {
    for (const CLI::Option* option : sub->get_options()) {
      const std::string type = option->get_type_name();
      const bool is_count = type == "N" || type.starts_with("UINT") || type.starts_with("N:");
      const bool is_time = type.starts_with("SECONDS"), is_sigma = type == "S|inf";
      const bool is_number = is_time || is_sigma || type.starts_with("FLOAT");
      const bool may_be_empty = option->get_positional() || option->check_lname("json") || option->check_lname("title");
      for (const std::string& value : option->results()) {
        if (value.empty() && option->check_sname("o")) throw UsageError("-o: no name given; expected the name of a file");
        if (value.empty() && !may_be_empty) throw UsageError(option->get_name() + ": nothing given; expected a value");
        if (is_count && is_too_large(value))
          throw UsageError(fmt::format("{}: {} given; expected a smaller number", option->get_name(), value));
        const double number = is_number ? std::strtod(value.c_str(), nullptr) : 0;
        if ((std::isfinite(number) && !(is_time && number < 0)) || (is_sigma && value == "inf")) continue;
        throw UsageError(fmt::format("{}: {} given; expected {}", option->get_name(), value,
                                     is_time    ? "seconds, from 0 on; 0: no limit"
                                     : is_sigma ? "a number, or inf"
                                                : "a number"));
      }
    }
  }
}

}  // namespace

int run(const std::string& name, const std::vector<std::string>& args) {
  const auto say = [&name](ExitStatus status, const std::string& message) {
    fmt::print(stderr, "{}: {}\n", name, result::printable(message));  // it may quote a file
    return status;
  };
  CLI::App program("corank returns all singularities of a robot mechanism, each with a proof.", "corank");
  program.formatter(std::make_shared<HelpFormat>());
  program.set_version_flag("--version", "corank " + result::version());
  program.add_flag_callback(
      "--cite", [] { throw CLI::CallForVersion(citation(), 0); }, "Print how to cite corank, as BibTeX, and exit");
  program.require_subcommand(1);
  program.footer(
      "corank SUBCOMMAND --help explains a subcommand.\n\n"
      "Exit status:\n"
      "  0  done and complete\n"
      "  1  bad input; of verify: a claim is false or cannot be checked\n"
      "  2  wrong usage\n"
      "  3  incomplete: a limit or an interrupt ended the work early, or path or clearance did not find\n"
      "     what was asked for; what the output claims is proven\n"
      "  4  of verify: every claim holds, but it is not proven that no solution is missing\n"
      "  5  of solve: it is proven that the robot cannot be assembled within its ranges\n\n"
      "Example:\n  corank solve models/three_slider.cuik --set forward");
  const auto with_help = [&program](const std::string& fault) {
    const std::vector<CLI::App*> named = program.get_subcommands();
    return fmt::format("{}; corank {}--help tells more", fault, named.empty() ? "" : named[0]->get_name() + " ");
  };
  Action action;
  for (const auto add :
       {add_derive, add_solve, add_verify, add_plot, add_report, add_sweep, add_map, add_clearance, add_tolerance,
        add_topology, add_aspects, add_path, add_postures, add_cuspidal, add_angles, add_gallery, add_studio})
    add(program, action);
  try {
    program.parse(std::vector<std::string>(args.rbegin(), args.rend()));  // CLI11 wants them backwards
    check_values(program);
    const ExitStatus status = action();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) return say(kBadInput, "cannot write to standard output");
    return status;
  } catch (const CLI::Success& asked) {  // --help, --version
    return program.exit(asked);
  } catch (const CLI::ExtrasError&) {
    std::vector<std::string> unknown = program.remaining(true);
    std::ranges::sort(unknown, {}, [&](const std::string& word) { return std::ranges::find(args, word) - args.begin(); });
    return say(kUsage, with_help(fmt::format("not expected: {}", fmt::join(unknown, " "))));
  } catch (const CLI::ParseError& error) {
    return say(kUsage, with_help(error.what()));
  } catch (const UsageError& error) {
    return say(kUsage, error.what());
  } catch (const Stopped& stopped) {
    return say(kIncomplete, stopped.what());
  } catch (const solve::OptionError& error) {
    std::string option = error.option();
    std::ranges::replace(option, '_', '-');
    return say(kUsage, with_help(fmt::format("--{}: {}", option, error.reason())));
  } catch (const symbolic::ModelError& error) {
    return say(kBadInput, error.what());
  } catch (const result::ResultFileError& error) {
    return say(kBadInput, error.what());
  } catch (const std::bad_alloc&) {
    return say(kBadInput, "out of memory; a larger --sigma or a smaller --max-boxes needs less");
  } catch (const InvariantError& error) {
    return say(kBug, fmt::format("{}; this is a bug in corank", error.what()));
  } catch (const std::exception& error) {
    return say(kBug, fmt::format("unexpected: {}; this is a bug in corank", error.what()));
  }
}

}  // namespace corank::app
