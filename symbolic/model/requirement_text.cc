#include "corank/symbolic/model/requirement_text.h"

#include <cctype>
#include <tao/pegtl.hpp>

#include "corank/symbolic/model/expression_actions.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/model/model_faults.h"
#include "corank/symbolic/model/model_grammar.h"
#include "corank/symbolic/model/parse_text.h"

namespace corank::symbolic {
namespace grammar {

struct requirement_open : one<'('> {};
struct requirement_close : one<')'> {};
struct at_most : string<'<', '='> {};
struct at_least : string<'>', '='> {};
struct within : sor<at_most, string<'+', '-'>, string<'\xC2', '\xB1'>> {};
struct quantity_colon : one<':'> {};

// A number or an expression, and a unit behind a blank.
struct unit_of_length : sor<exactly<"mm">, exactly<"cm">, exactly<"dm">, exactly<"um">, exactly<"m">> {};
struct unit_of_force : sor<exactly<"kN">, exactly<"mN">, exactly<"N">> {};
struct unit_of_moment : seq<unit_of_force, sor<seq<star<blank_character>, one<'*'>>, plus<blank_character>>,
                            star<blank_character>, unit_of_length> {};
struct unit_of_angle : sor<exactly<"mrad">, exactly<"rad">, exactly<"deg">> {};
struct quantity_unit : seq<sor<seq<unit_of_moment, not_at<name_tail>>, seq<unit_of_force, not_at<name_tail>>,
                               seq<unit_of_angle, not_at<name_tail>>, seq<unit_of_length, not_at<name_tail>>>> {};
struct quantity_end : success {};
struct quantity : seq<expression<gap>, gap, opt<quantity_unit>, quantity_end> {};

struct rate_list_name : identifier {};
struct rate_names : seq<must<requirement_open>, gap, must<rate_list_name>, star<gap, one<','>, gap, must<rate_list_name>>,
                        gap, must<requirement_close>> {};

struct role_name : sor<word<exactly<"outputs">>, word<exactly<"inputs">>> {};
struct metric_name : identifier {};
struct metric_item : seq<must<metric_name>, gap, must<quantity_colon>, gap, quantity> {};
struct metric_word : word<exactly<"metric">> {};
struct amplification_word : word<exactly<"amplification">> {};
struct amplification
    : seq<amplification_word, gap, must<requirement_open>, gap, must<role_name>, gap, must<requirement_close>, gap,
          must<at_most>, gap, quantity, opt<gap, metric_word, gap, metric_item, star<gap, one<','>, gap, metric_item>>> {};

struct under_word : word<exactly<"under">> {};
struct load_word : sor<word<exactly<"force">>, word<exactly<"moment">>> {};
struct load_is : one<'='> {};
struct load_sign : sor<load_is, at_most> {};
struct load_end : success {};
struct load : seq<must<load_word>, gap, rate_names, gap, must<load_sign>, gap, quantity, load_end> {};
struct loads : seq<must<under_word>, gap, load, star<gap, one<','>, gap, load>> {};
struct effort_word : sor<word<exactly<"torque">>, word<exactly<"force">>> {};
struct effort : seq<effort_word, gap, rate_names, gap, must<at_most>, gap, quantity, gap, loads> {};

struct tension_word : word<exactly<"tension">> {};
struct tension_in : word<exactly<"in">> {};
struct tension_open : one<'['> {};
struct tension_comma : one<','> {};
struct tension_close : one<']'> {};
struct tension : seq<tension_word, gap, rate_names, gap, must<tension_in>, gap, must<tension_open>, gap, quantity, gap,
                     must<tension_comma>, gap, quantity, gap, must<tension_close>, gap, loads> {};

struct error_word : word<exactly<"error">> {};
struct input_name : identifier {};
struct input_error : seq<must<input_name>, gap, must<within>, gap, quantity> {};
struct error_limit : seq<error_word, gap, rate_names, gap, must<at_most>, gap, quantity, gap, must<under_word>, gap,
                         input_error, star<gap, one<','>, gap, input_error>> {};

struct distance_word : word<exactly<"distance">> {};
struct radius_of_body : word<exactly<"radius">> {};
struct body_point : identifier {};
struct body_comma : one<','> {};
struct body_close : one<')'> {};
struct body_end : success {};
struct body_names : seq<must<body_point>, star<gap, not_at<radius_of_body>, body_point>> {};
struct body_of_distance : seq<body_names, opt<gap, radius_of_body, gap, quantity>, body_end> {};
struct distance : seq<distance_word, gap, must<requirement_open>, gap, body_of_distance, gap, must<body_comma>, gap,
                      body_of_distance, gap, must<body_close>, gap, must<at_least>, gap, quantity> {};

struct pressure_angle_word : word<exactly<"pressure_angle">> {};
struct transmission_angle_word : word<exactly<"transmission_angle">> {};
struct angle_points : seq<body_names, body_end> {};
struct pressure_angle : seq<pressure_angle_word, gap, must<requirement_open>, gap, angle_points, gap, must<body_comma>, gap,
                            angle_points, gap, must<body_close>, gap, must<at_most>, gap, quantity> {};
struct transmission_angle : seq<transmission_angle_word, gap, must<requirement_open>, gap, angle_points, gap,
                                must<body_close>, gap, must<at_least>, gap, quantity> {};

struct comparison_sign : sor<string<'<', '='>, string<'>', '='>> {};
struct comparison : seq<expression<gap>, gap, must<comparison_sign>, gap, expression<gap>> {};

struct requirement_end : eof {};
/// A word of these in front of a parenthesis is no function of the language, so that nothing is taken back.
template <typename Word>
struct begins : at<Word, gap, one<'('>> {};
struct requirement : seq<gap,
                         sor<seq<begins<amplification_word>, amplification>, seq<begins<effort_word>, effort>,
                             seq<begins<tension_word>, tension>, seq<begins<error_word>, error_limit>,
                             seq<begins<distance_word>, distance>, seq<begins<pressure_angle_word>, pressure_angle>,
                             seq<begins<transmission_angle_word>, transmission_angle>, comparison>,
                         gap, must<requirement_end>> {};

}  // namespace grammar

namespace {

struct RequirementBuilder : ModelBuilder {
  using ModelBuilder::ModelBuilder;

  RequirementText out;
  std::string unit, item;  // read last
  std::vector<Quantity> quantities;
  std::vector<std::string> names;  // of the list read last
  bool moment = false, constant = false;

  Quantity take() {
    Quantity last = quantities.back();
    quantities.pop_back();
    return last;
  }
};

template <typename Rule>
struct RequirementAction : ExpressionAction<Rule> {};

#define CORANK_ACTION(rule, ...) CORANK_ACTION_OF(RequirementAction, RequirementBuilder, rule, __VA_ARGS__)
#define CORANK_ACTION0(rule, ...) CORANK_ACTION0_OF(RequirementAction, RequirementBuilder, rule, __VA_ARGS__)

CORANK_ACTION(quantity_unit, {
  b.unit.clear();
  for (const char c : in.string())
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      if (b.unit.ends_with('N')) b.unit += ' ';
      b.unit += c;
    }
})
CORANK_ACTION0(quantity_end, {
  b.quantities.push_back({b.values.back(), std::exchange(b.unit, {})});
  b.values.clear();
})
CORANK_ACTION0(requirement_open, { b.names.clear(); })
CORANK_ACTION(rate_list_name, { b.names.push_back(in.string()); })
CORANK_ACTION0(amplification_word, { b.out.limit = AmplificationLimit(); })
CORANK_ACTION(role_name, {
  std::get<AmplificationLimit>(b.out.limit).role = in.string_view() == "outputs" ? Role::output : Role::input;
})
CORANK_ACTION(metric_name, { b.item = in.string(); })
CORANK_ACTION0(metric_word, { std::get<AmplificationLimit>(b.out.limit).most = b.take(); })
CORANK_ACTION0(metric_item, { std::get<AmplificationLimit>(b.out.limit).metric.push_back({b.item, b.take()}); })
CORANK_ACTION0(amplification, {
  if (auto& limit = std::get<AmplificationLimit>(b.out.limit); limit.metric.empty()) limit.most = b.take();
})
CORANK_ACTION(effort_word, {
  b.out.limit = EffortLimit();
  std::get<EffortLimit>(b.out.limit).torque = in.string_view() == "torque";
})
CORANK_ACTION0(error_word, { b.out.limit = ErrorLimit(); })
CORANK_ACTION(under_word, {
  if (auto* effort = std::get_if<EffortLimit>(&b.out.limit)) {
    if (b.names.size() != 1)
      throw ModelError(place(in, b), "a torque or force is that of one motor, found " + joined(b.names), "one input's name");
    effort->motor = b.names[0];
    effort->most = b.take();
  } else if (auto* tension = std::get_if<TensionLimit>(&b.out.limit)) {
    tension->most = b.take();
    tension->least = b.take();
  } else {
    auto& error = std::get<ErrorLimit>(b.out.limit);
    error.names = b.names;
    error.most = b.take();
  }
})
CORANK_ACTION(load_word, { b.moment = in.string_view() == "moment"; })
CORANK_ACTION(load_sign, { b.constant = in.string_view() == "="; })
CORANK_ACTION(load_end, {
  if (b.constant && b.names.size() != 1)
    throw ModelError(place(in, b), "a load with one value works on one rate, found " + joined(b.names), "one for each");
  auto* effort = std::get_if<EffortLimit>(&b.out.limit);
  (effort ? effort->loads : std::get<TensionLimit>(b.out.limit).loads).push_back({b.moment, b.names, b.take(), b.constant});
})
CORANK_ACTION0(tension_word, { b.out.limit = TensionLimit(); })
CORANK_ACTION0(tension_open, { std::get<TensionLimit>(b.out.limit).cables = b.names; })
CORANK_ACTION(input_name, { b.item = in.string(); })
CORANK_ACTION0(input_error, { std::get<ErrorLimit>(b.out.limit).inputs.push_back({b.item, b.take()}); })
CORANK_ACTION0(distance_word, { b.out.limit = DistanceLimit(); })
CORANK_ACTION(body_point, { b.names.push_back(in.string()); })
CORANK_ACTION0(body_end, {
  std::vector<std::string> names = std::exchange(b.names, {});
  if (auto* angle = std::get_if<LineAngleLimit>(&b.out.limit)) {
    angle->points.push_back(std::move(names));
  } else {
    auto& body = std::get<DistanceLimit>(b.out.limit).bodies.emplace_back(DistanceLimit::Body{std::move(names)});
    if (!b.quantities.empty()) body.radius = b.take();
  }
})
CORANK_ACTION0(distance, { std::get<DistanceLimit>(b.out.limit).least = b.take(); })
CORANK_ACTION0(pressure_angle_word, { b.out.limit = LineAngleLimit(); })
CORANK_ACTION0(transmission_angle_word, { b.out.limit = LineAngleLimit{.points = {}, .least = true, .limit = {}}; })
CORANK_ACTION0(pressure_angle, { std::get<LineAngleLimit>(b.out.limit).limit = b.take(); })
CORANK_ACTION0(transmission_angle, { std::get<LineAngleLimit>(b.out.limit).limit = b.take(); })
CORANK_ACTION(comparison_sign,
              { b.relation = *in.begin() == '<' ? Relation::Kind::less_equal : Relation::Kind::greater_equal; })
CORANK_ACTION0(comparison, { b.out.limit = Relation{b.values.at(0), b.relation, b.values.at(1)}; })
#undef CORANK_ACTION
#undef CORANK_ACTION0

}  // namespace

#define CORANK_FAULT(rule, expectation)                                                         \
  template <>                                                                                   \
  struct FaultOf<grammar::rule> {                                                               \
    [[noreturn]] static void raise(const Fault& fault) { fault.found_instead_of(expectation); } \
  };
CORANK_FAULT(requirement_open, "'('")
CORANK_FAULT(requirement_close, "',' or ')' after the name")
CORANK_FAULT(rate_list_name, "the name of a coordinate or of a rate")
CORANK_FAULT(role_name, "outputs or inputs")
CORANK_FAULT(at_most, "'<=' and a number")
CORANK_FAULT(at_least, "'>=' and a number")
CORANK_FAULT(body_point, "the name of a body, or names of points")
CORANK_FAULT(body_comma, "a point, radius, or ',' and what is compared with it")
CORANK_FAULT(body_close, "')' behind the points")
CORANK_FAULT(within, "'<=' or '±' and a number")
CORANK_FAULT(metric_name, "the name of an input or an output")
CORANK_FAULT(quantity_colon, "':' and a number after the name")
CORANK_FAULT(under_word, "a unit, or under and what the limit holds under")
CORANK_FAULT(load_word, "force or moment")
CORANK_FAULT(load_sign, "'<=' or '=' and a number")
CORANK_FAULT(tension_in, "in and a range such as [5 N, 200 N]")
CORANK_FAULT(tension_open, "'[' and two tensions")
CORANK_FAULT(tension_comma, "a unit, or ',' and the larger tension")
CORANK_FAULT(tension_close, "a unit, or ']'")
CORANK_FAULT(input_name, "inputs, or the name of one")
CORANK_FAULT(comparison_sign, "an operator, '<=' or '>='")
CORANK_FAULT(requirement_end, "the end of the requirement")
#undef CORANK_FAULT

RequirementText parse_requirement(std::string_view text, const SourceLocation& begin) {
  RequirementBuilder builder(begin.file);
  parse_text<grammar::requirement, RequirementAction>(text, builder, begin);
  return std::move(builder.out);
}

}  // namespace corank::symbolic
