// Text from files on a terminal: nothing that a file holds may steer it.
#pragma once

#include <string>
#include <string_view>

namespace corank::result {

/// The text with all that a terminal may obey made visible: control characters but line feeds and tabs, U+0080 to U+009F,
/// the marks that turn the direction of text, and bytes that are no UTF-8, as "\x1b" or "\u202e". Other text is returned as
/// it is.
std::string printable(std::string_view text);

/// The same for a text within one line: line feeds and tabs are made visible, too.
std::string printable_line(std::string_view text);

}  // namespace corank::result
