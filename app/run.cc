#include "corank/app/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>

#include "corank/app/help_format.h"
#include "corank/app/limited_run.h"
#include "corank/app/subcommands.h"
#include "corank/core/check.h"
#include "corank/result/printable.h"
#include "corank/result/result_file.h"
#include "corank/solve/options.h"
#include "corank/symbolic/model_error.h"

namespace corank::app {
namespace {

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
      const bool is_time = type.starts_with("SECONDS"), is_number = is_time || type.starts_with("FLOAT");
      const bool may_be_empty = option->get_positional() || option->check_lname("json") || option->check_lname("title");
      for (const std::string& value : option->results()) {
        if (value.empty() && option->check_sname("o")) throw UsageError("-o: no name given; expected the name of a file");
        if (value.empty() && !may_be_empty) throw UsageError(option->get_name() + ": nothing given; expected a value");
        if (is_count && is_too_large(value))
          throw UsageError(fmt::format("{}: {} given; expected a smaller number", option->get_name(), value));
        const double number = is_number ? std::strtod(value.c_str(), nullptr) : 0;
        if (std::isfinite(number) && !(is_time && number < 0)) continue;
        throw UsageError(fmt::format("{}: {} given; expected {}", option->get_name(), value,
                                     is_time ? "seconds, from 0 on; 0: no limit" : "a number"));
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
  program.require_subcommand(1);
  program.footer(
      "corank SUBCOMMAND --help explains a subcommand.\n\n"
      "Exit status:\n"
      "  0  done and complete\n"
      "  1  bad input\n"
      "  2  wrong usage\n"
      "  3  incomplete: a limit or an interrupt ended the work; what is said holds\n"
      "  4  of verify: every claim holds, but it is not proven that no solution is missing\n"
      "  5  of solve: it is proven that the robot cannot be assembled within its ranges\n\n"
      "Example:\n  corank solve models/three_slider.cuik --set forward");
  Action action;
  add_derive(program, action);
  add_solve(program, action);
  add_verify(program, action);
  add_plot(program, action);
  add_report(program, action);
  add_sweep(program, action);
  add_map(program, action);
  add_clearance(program, action);
  add_topology(program, action);
  add_aspects(program, action);
  add_path(program, action);
  add_angles(program, action);

  try {
    program.parse(std::vector<std::string>(args.rbegin(), args.rend()));  // CLI11 wants them backwards
    check_values(program);
    const ExitStatus status = action();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) return say(kBadInput, "cannot write to standard output");
    return status;
  } catch (const CLI::Success& asked) {  // --help, --version
    return program.exit(asked);
  } catch (const CLI::ParseError& error) {
    return say(kUsage, std::string(error.what()) + "; corank --help tells more");
  } catch (const UsageError& error) {
    return say(kUsage, error.what());
  } catch (const Stopped& stopped) {
    return say(kIncomplete, stopped.what());
  } catch (const solve::OptionError& error) {
    std::string option = error.option();
    std::replace(option.begin(), option.end(), '_', '-');
    return say(kUsage, fmt::format("--{}: {}; corank --help tells more", option, error.reason()));
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

std::optional<int> usage_status(const std::string& usage, const std::vector<std::string>& args, std::size_t fewest) {
  const bool asked = !args.empty() && (args[0] == "-h" || args[0] == "--help");
  if (!asked && args.size() >= fewest) return std::nullopt;
  fmt::print(asked ? stdout : stderr, "{}", usage);
  return asked ? kDone : kUsage;
}

std::string with_extension(const std::string& name, const std::string& extension) {
  return name.ends_with(extension) ? name : name + extension;
}

}  // namespace corank::app
