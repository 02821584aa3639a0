// Parses a text by a grammar whose faults FaultOf words (model_faults.h) and whose actions fill a ModelBuilder.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "corank/symbolic/model/expression_actions.h"
#include "corank/symbolic/model/model_faults.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/model/model_grammar.h"

namespace corank::symbolic {

/// Turns a failed must<Rule> into the ModelError that FaultOf<Rule> words.
template <typename Rule>
struct FaultControl : tao::pegtl::normal<Rule> {
  template <typename AnyInput>
  [[noreturn]] static void raise(const AnyInput& in, ModelBuilder& builder) {
    const bool unfinished_comment = std::is_same_v<Rule, grammar::block_comment_rest>;
    FaultOf<Rule>::raise({builder, unfinished_comment ? builder.comment_where : place(in, builder),
                          std::string_view(in.current(), in.size())});
    throw std::logic_error("a fault that says nothing");
  }
};

/// Returns the place of the text's end; `begin`: that of its beginning.
template <typename Rule, template <typename...> typename Action, typename Builder>
SourceLocation parse_text(std::string_view text, Builder& builder, const SourceLocation& begin = {}) {
  if (text.size() > kMaxFileBytes)
    throw ModelError({builder.file, 0, 0}, "the text has " + std::to_string(text.size()) + " bytes",
                     "at most " + std::to_string(kMaxFileBytes));
  const auto input = [&] {
    return TextInput(text.data(), text.data() + text.size(), "", 0, std::max(begin.line, 1), std::max(begin.column, 1));
  };
  TextInput plain = input(), in = input();
  tao::pegtl::parse<grammar::plain_text, tao::pegtl::nothing, FaultControl>(plain, builder);
  if (!tao::pegtl::parse<Rule, Action, FaultControl>(in, builder))
    throw std::logic_error("a grammar that fails without a fault");
  return place(in, builder);
}

}  // namespace corank::symbolic
