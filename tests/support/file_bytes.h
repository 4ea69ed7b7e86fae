// A file as a string.
#pragma once

#include <fstream>
#include <sstream>
#include <string>

namespace scotopic::test {

inline std::string bytes_of(const std::string& file) {
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}

}  // namespace scotopic::test
