#include "looks/config/own_mark.h"

#include "base/digest.h"

namespace scotopic {
namespace {

constexpr const char* maker = "# Made by scotopic ";
constexpr const char* hash_follows = "; SHA-256 of what follows: ";

}  // namespace

std::string marked(const std::string& text, const std::string& version) {
  return maker + version + hash_follows + sha256(text) + "\n" + text;
}

bool is_as_marked(const std::string& text) {
  const std::size_t end = text.find('\n');
  if (end == std::string::npos) return false;
  const std::string line = text.substr(0, end);
  const std::size_t hash = line.find(hash_follows);
  if (line.rfind(maker, 0) != 0 || hash == std::string::npos) return false;
  return line.substr(hash + std::string(hash_follows).size()) == sha256(text.substr(end + 1));
}

}  // namespace scotopic
