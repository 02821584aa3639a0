// corank derive: the equations, for people (text, latex) and for programs (cuik); the model itself (model).

#include <cctype>
#include <filesystem>

#include "corank/app/subcommands.h"
#include "corank/result/values/summary.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_error.h"
#include "corank/symbolic/model/text_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/parameters.h"
#include "corank/symbolic/sets/part_names.h"
#include "corank/symbolic/writing/line_breaks.h"
#include "corank/symbolic/writing/printer.h"

namespace corank::app {
namespace {

struct DeriveCommand {
  QuestionOptions question;
  std::string format = "text", path;
  JsonOption json;
  double time_limit = 0;
};

/// Of what corank derive wrote into a file in the model language, which it may write again.
constexpr std::string_view kMark = "% Derived by corank from ";

/// Throws UsageError where the path is that of an input, a model's file that was not made here among them.
void check_path(const std::string& path, const std::string& model) {
  const std::filesystem::path file = path;
  if (path.empty() || !std::filesystem::exists(file)) return;
  std::error_code ignored;
  const std::string extension = file.extension().string();
  bool kept = std::filesystem::equivalent(file, model, ignored);
  for (const char* input : {".world", ".urdf", ".loops", ".param"}) kept = kept || extension == input;
  if (extension == ".cuik" && !kept)
    kept = symbolic::reading_fault(file).empty() && symbolic::read_bytes(file, kMark.size()) != kMark;
  if (kept) throw UsageError(path + ": not overwritten, because corank derive did not make it; remove it first");
}

/// What equations of parts are not made for: "Left out, being 0 for these values of the constants: b - 3".
std::string left_out_by_constants(const std::vector<symbolic::Condition>& conditions) {
  constexpr std::size_t kMost = 8;
  std::vector<std::string> texts;
  for (const symbolic::Condition& c : conditions)
    if (c.sign == 0) texts.push_back(texts.size() == kMost ? "…" : c.value.text());
  if (texts.empty()) return "";
  if (texts.size() > kMost) texts.resize(kMost + 1);
  return fmt::format("% Left out, being 0 for these values of the constants: {}\n", fmt::join(texts, ", "));
}

/// And what follows from those that are made, each with its reason. `mark`: before each line, that of a comment or nothing.
std::string left_out(const std::vector<symbolic::LeftOut>& list, const std::string& mark) {
  if (list.empty()) return "";
  std::string lines = mark + "Left out, because it follows by an exact identity:\n";
  for (const symbolic::LeftOut& e : list) {
    std::string text = mark + "  " + symbolic::broken(e.relation(), mark.size() + 2, 6);
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos;) text.insert(++at, mark);
    lines += fmt::format("{}\n{}    % {}: {}\n", text, mark, e.source(), e.reason());
  }
  return lines;
}

bool has_word(const std::string& text, const std::string& word) {
  const auto is_of_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += word.size()) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !is_of_name(text[at - 1])) && (end == text.size() || !is_of_name(text[end]))) return true;
  }
  return false;
}

/// What nobody has declared, as far as the equations, or another such constant, have it: "k1 = sqrt(3)/2".
std::string named_constants(const symbolic::Mechanism& model, const std::string& equations) {
  std::string lines;
  for (auto c = model.constants().rbegin(); c != model.constants().rend(); ++c)
    if (symbolic::is_of_corank(*c) && (has_word(equations, c->name) || has_word(lines, c->name)))
      lines = "  " + symbolic::broken(c->name + " = " + c->value.text(), 2, 6) + "\n" + lines;
  return lines.empty() ? "" : "Constants that corank has named:\n" + lines;
}

bool moves_freely(const study::Question& question) { return question.assembly && question.model.constraints().empty(); }

// The question, with its set, and the systems of that set.
struct Derived {
  study::Question question;
  std::vector<symbolic::TrigonometricSystem> systems{};
};

Derived derived(const DeriveCommand& command, WholeRun& run) {
  run.enter("reading the model");
  Derived result{load(command.question)};
  study::Question& question = result.question;
  run.enter("deriving the equations");
  if (moves_freely(question) || (command.format == "model" && !command.json.given())) return result;
  QuestionOptions options = command.question;
  if (options.set.empty() && !question.model.is_plain_system()) options.set = "cspace";
  question.set = chosen_set(options, question.model);
  if (command.format == "cuik" && (symbolic::definition(question.set).of_parts || question.in_parts.value_or(false)))
    throw UsageError("--format cuik: the set consists of several systems; --format text shows them");
  result.systems = study::equations_of_parts(question, [&run] { return run.ended(); });
  run.enter("printing the equations");
  return result;
}

std::string json_of(const Derived& d) {
  const std::optional<kinematics::Assembly>& assembly = d.question.assembly;
  std::optional<std::string> robot;
  if (assembly) robot = study::describe(*assembly);
  return result::derivation_json(d.question.model, robot, assembly ? assembly->left_out : std::vector<symbolic::LeftOut>{},
                                 symbolic::definition(d.question.set).name, d.systems);
}

std::string text_of(const Derived& d, const std::string& format) {
  const study::Question& question = d.question;
  std::string head;
  if (question.assembly)
    head = fmt::format("{}{}\n", format == "text" ? "Robot: " : "% ", study::describe(*question.assembly));
  if (moves_freely(question))
    return head + "It has no loops and no outputs: every value of its joints is a configuration.\n";
  if (question.assembly && format != "cuik")  // whose equations have other numbers
    head += left_out(question.assembly->left_out, format == "text" ? "" : "% ");
  if (format == "model")
    return head + (question.assembly ? left_out_by_constants(question.assembly->conditions) : "") +
           symbolic::broken_model(symbolic::to_model(question.model));
  if (format == "cuik") return head + symbolic::broken_model(symbolic::to_cuik(symbolic::algebrize(d.systems.front())));
  const symbolic::Derivation derivation = symbolic::derive(question.model);
  if (format == "latex") return head + symbolic::to_latex(derivation, d.systems);
  const std::string equations = symbolic::to_text(derivation, d.systems);
  return head + named_constants(question.model, equations) + equations;
}

ExitStatus derive(const CLI::App& sub, DeriveCommand command) {
  command.json.begin(command.question.file);
  if (command.format == "model" && !command.json.given())
    refuse_without_effect(sub, {"--set", "--kernel", "--corank"}, "another --format: the model is the same for all sets");
  const bool text_is_asked = !command.json.takes_standard_output() || !command.path.empty();
  if (!text_is_asked)
    refuse_without_effect(sub, {"--format"}, "--json PATH or -o FILE: standard output holds only the JSON");
  check_path(command.path, command.question.file);
  WholeRun run(command.time_limit);
  const Derived d = derived(command, run);
  const std::string json = command.json.given() ? json_of(d) : "", text = text_is_asked ? text_of(d, command.format) : "";
  run.enter("writing the equations");
  command.json.say([&json] { return json; });
  if (!text_is_asked) return kDone;
  if (command.path.empty()) {
    fmt::print("{}", result::printable(text));
    return kDone;
  }
  const bool is_model = command.format == "cuik" || command.format == "model";
  if (is_model && text.find("\n[SYSTEM VARS]") == std::string::npos)
    throw symbolic::ModelError({command.question.file, 0, 0},
                               "there are no equations to write: the robot has no loops and no outputs",
                               "a robot with a loop or an output");
  const std::string name = std::filesystem::path(command.question.file).filename().string();
  result::write_text(command.path, (is_model ? std::string(kMark) + result::printable_line(name) + ".\n" : "") + text);
  return kDone;
}

}  // namespace

void add_derive(CLI::App& program, Action& action) {
  CLI::App* sub =
      program.add_subcommand("derive",
                             "Print the equations of a model: its constraints, the blocks of their Jacobian, and the system "
                             "whose solutions are a set of configurations, such as the forward singularities");
  const auto options = std::make_shared<DeriveCommand>();
  options->question.add_options(*sub);
  sub->add_option("--format", options->format,
                  "text or latex: with sines and cosines; cuik: as polynomials, in a file that corank solve accepts;\n"
                  "model: the model itself, written out in order")
      ->check(CLI::IsMember({"text", "latex", "cuik", "model"}))
      ->capture_default_str();
  add_time_limit(*sub, options->time_limit);
  add_option(*sub, "-o FILE", options->path, "Write to this file instead of standard output");
  options->json.add(*sub, "the constraints, the velocity equation and the systems", "the text");
  sub->footer(
      "Without --set, the set is cspace.\n\n"
      "Exit status: 0 done, 1 bad input, 2 wrong usage, 3 stopped by the limit or an interrupt.\n\n"
      "Example:\n  corank derive models/dextar.cuik --set inverse --format latex");
  sub->callback([=, &action] { action = [=] { return derive(*sub, *options); }; });
}

}  // namespace corank::app
