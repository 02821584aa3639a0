// Parses a text by a grammar whose faults raise_fault() words and whose actions fill a ModelBuilder, or what derives from
// it.
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

/// A failed must<Rule>; other builders have their own.
template <typename Rule>
[[noreturn]] void raise_fault(const Fault& fault, const ModelBuilder&) {
  FaultOf<Rule>::raise(fault);
}

template <typename Rule>
struct FaultControl : tao::pegtl::normal<Rule> {
  static constexpr bool kInComment = std::is_same_v<Rule, grammar::block_comment_rest>;

  /// Comments may begin where the grammar looks ahead, without actions.
  template <typename AnyInput>
  static void start(const AnyInput& in, ModelBuilder& builder) {
    if constexpr (kInComment) {
      builder.comment_where = place(in, builder);
      builder.comment_where.column -= 2;
    }
  }
  template <typename AnyInput, typename Builder>
  [[noreturn]] static void raise(const AnyInput& in, Builder& builder) {
    raise_fault<Rule>({builder, kInComment ? builder.comment_where : place(in, builder), {in.current(), in.size()}},
                      builder);
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
