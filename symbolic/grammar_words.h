// Words of a grammar, written as texts. PEGTL's own TAO_PEGTL_STRING looks at 512 characters of each word, which took more
// time than all else in compiling a grammar.
#pragma once

#include <algorithm>
#include <cstddef>
#include <tao/pegtl.hpp>
#include <utility>

namespace corank::symbolic::grammar {

template <std::size_t size>
struct Letters {
  consteval Letters(const char (&text)[size]) { std::copy_n(text, size, letters); }  // NOLINT: implicit
  char letters[size]{};
};

template <template <char...> typename Rule, Letters text, std::size_t... at>
Rule<text.letters[at]...> rule_of(std::index_sequence<at...>);

/// exactly<"unit">: string<'u', 'n', 'i', 't'>
template <Letters text>
using exactly = decltype(rule_of<tao::pegtl::string, text>(std::make_index_sequence<sizeof(text.letters) - 1>{}));

/// The same, in capitals or not.
template <Letters text>
using any_case = decltype(rule_of<tao::pegtl::istring, text>(std::make_index_sequence<sizeof(text.letters) - 1>{}));

}  // namespace corank::symbolic::grammar
