#include "shaders/osl_grammar.h"

#include <array>
#include <cctype>
#include <map>
#include <stdexcept>
#include <vector>

namespace scotopic::test {
namespace {

enum class Type { integer, number, colour, text };

bool arithmetic(Type type) { return type != Type::text; }
Type wider(Type a, Type b) { return a < b ? b : a; }

/// Functions of float, by how many arguments they take.
const std::map<std::string, std::size_t> functions = {{"min", 2}, {"max", 2}, {"fabs", 1}, {"sqrt", 1},
                                                      {"exp", 1}, {"log", 1}, {"pow", 2}};

class Parser {
 public:
  explicit Parser(const std::string& text) : text_(text) { split(); }

  void shader() {
    expect("shader");
    name();
    expect("(");
    formal();
    while (accept(",")) formal();
    expect(")");
    expect("{");
    while (!accept("}")) statement();
    if (at_ != words_.size()) fail("more behind the shader");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(what + " at '" + word() + "', word " + std::to_string(at_));
  }

  // Words: names, numbers, strings, signs.
  void split() {
    for (std::size_t i = 0; i < text_.size();) {
      const auto is = [&](std::size_t k, auto test) {
        return k < text_.size() && test(static_cast<unsigned char>(text_[k]));
      };
      std::size_t end = i + 1;
      if (is(i, [](int c) { return std::isspace(c) != 0; })) {
        ++i;
        continue;
      }
      if (text_.compare(i, 2, "//") == 0) {
        i = text_.find('\n', i);
        continue;
      }
      if (text_[i] == '"') {
        end = text_.find('"', end) + 1;
      } else if (is(i, [](int c) { return std::isalpha(c) || c == '_'; })) {
        while (is(end, [](int c) { return std::isalnum(c) || c == '_'; })) ++end;
      } else if (is(i, [](int c) { return std::isdigit(c) != 0; })) {
        while (is(end, [](int c) { return std::isdigit(c) || c == '.' || c == 'e'; }) ||
               (is(end, [](int c) { return c == '-' || c == '+'; }) && text_[end - 1] == 'e'))
          ++end;
      } else {
        for (const char* sign : {"[[", "]]", "<=", ">=", "==", "!=", "&&", "||"})
          if (text_.compare(i, 2, sign) == 0) end = i + 2;
      }
      words_.push_back(text_.substr(i, end - i));
      i = end;
    }
  }

  std::string word() const { return at_ < words_.size() ? words_[at_] : ""; }
  bool accept(const std::string& wanted) {
    if (word() != wanted) return false;
    ++at_;
    return true;
  }
  void expect(const std::string& wanted) {
    if (!accept(wanted)) fail("no '" + wanted + "'");
  }
  std::string name() {
    const std::string out = word();
    if (out.empty() || !(std::isalpha(static_cast<unsigned char>(out[0])) || out[0] == '_')) fail("no name");
    ++at_;
    return out;
  }
  Type type() {
    if (accept("float")) return Type::number;
    if (accept("int")) return Type::integer;
    if (accept("color")) return Type::colour;
    if (accept("string")) return Type::text;
    fail("no type");
  }
  void declare(const std::string& what, Type of) {
    if (functions.count(what) || !variables_.emplace(what, of).second) fail("declared before: " + what);
  }
  void require_assignable(Type to, Type from) const {
    // A float is a colour, too, and an int a float; not the other way.
    if ((to == Type::text) != (from == Type::text) || to < from) fail("not assignable");
  }

  void formal() {
    accept("output");
    const Type of = type();
    const std::string what = name();
    expect("=");
    require_assignable(of, expression());
    if (accept("[[")) metadata();
    declare(what, of);
  }
  void metadata() {
    do {
      const Type of = type();
      name();
      expect("=");
      require_assignable(of, expression());
    } while (accept(","));
    expect("]]");
  }

  void statement() {
    if (word() == "float" || word() == "int" || word() == "color") {
      const Type of = type();
      const std::string what = name();
      expect("=");
      require_assignable(of, expression());
      declare(what, of);
    } else {
      const std::string what = name();
      if (!variables_.count(what)) fail("not declared: " + what);
      expect("=");
      require_assignable(variables_.at(what), expression());
    }
    expect(";");
  }

  Type expression() {
    const Type condition = binary(0);
    if (!accept("?")) return condition;
    if (condition != Type::integer) fail("a condition that is no int");
    const Type yes = expression();
    expect(":");
    return wider(yes, expression());
  }
  // Operators by how loosely they bind; comparisons and logic give int.
  Type binary(std::size_t level) {
    static const std::array<std::vector<std::string>, 6> levels = {
        {{"||"}, {"&&"}, {"==", "!="}, {"<", "<=", ">", ">="}, {"+", "-"}, {"*", "/"}}};
    if (level == levels.size()) return unary();
    Type left = binary(level + 1);
    for (bool more = true; more;) {
      more = false;
      for (const std::string& sign : levels[level]) {
        if (!accept(sign)) continue;
        const Type right = binary(level + 1);
        if (!arithmetic(left) || !arithmetic(right)) fail("text is no number");
        if (level < 2 && (left != Type::integer || right != Type::integer)) fail("logic of what is no int");
        left = level < 4 ? Type::integer : wider(left, right);
        more = true;
      }
    }
    return left;
  }
  Type unary() {
    if (accept("!")) {
      if (unary() != Type::integer) fail("not of what is no int");
      return Type::integer;
    }
    if (accept("-")) return unary();
    return postfix();
  }
  Type postfix() {
    Type of = primary();
    while (accept("[")) {
      if (of != Type::colour || expression() != Type::integer) fail("not an index of a colour");
      expect("]");
      of = Type::number;
    }
    return of;
  }
  Type primary() {
    const std::string next = word();
    if (accept("(")) {
      const Type of = expression();
      expect(")");
      return of;
    }
    if (next.empty()) fail("an end");
    if (next[0] == '"') return ++at_, Type::text;
    if (std::isdigit(static_cast<unsigned char>(next[0])))
      return ++at_, next.find_first_of(".e") == std::string::npos ? Type::integer : Type::number;
    const std::string what = name();
    if (word() == "(") return call(what);
    if (!variables_.count(what)) fail("not declared: " + what);
    return variables_.at(what);
  }
  Type call(const std::string& what) {
    const bool makes_colour = what == "color";
    if (!makes_colour && !functions.count(what)) fail("no function of OSL: " + what);
    expect("(");
    std::size_t count = 0;
    do {
      if (expression() > Type::number) fail("an argument that is no float");
      ++count;
    } while (accept(","));
    expect(")");
    if (count != (makes_colour ? 3 : functions.at(what))) fail("another number of arguments: " + what);
    return makes_colour ? Type::colour : Type::number;
  }

  const std::string& text_;
  std::vector<std::string> words_;
  std::size_t at_ = 0;
  std::map<std::string, Type> variables_;
};

}  // namespace

std::string osl_fault(const std::string& text) {
  try {
    Parser(text).shader();
  } catch (const std::runtime_error& fault) {
    return fault.what();
  }
  return "";
}

}  // namespace scotopic::test
