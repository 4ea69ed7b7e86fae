// How much a YAML text stands for, found without a parser: some lines of aliases can mean gigabytes.
#pragma once

#include <cstdint>
#include <string_view>

namespace scotopic {

/// Of a text with every alias written out as what it stands for.
struct YamlExtent {
  std::int64_t size = 0;  ///< characters, at least those of the text itself; 2^60 at most
  int depth = 0;          ///< of mappings and sequences within each other, to one or two
  bool endless = false;   ///< an alias stands within what it stands for
};

/// Looks at anchors, aliases, brackets, indentation, quotes, comments and block scalars (YAML 1.2, 6 to 8);
/// one pass. Of what is no YAML it says something, too. Ends early, with what it has found, beyond 200
/// levels.
YamlExtent yaml_extent(std::string_view text);

}  // namespace scotopic
