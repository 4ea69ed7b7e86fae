#include "cli/scene/glare_options.h"

#include "cli/options/values.h"

namespace scotopic {
namespace {

constexpr const char* rules = "above, above:T (T in image units), all, or none";

}  // namespace

void add_glare_options(CLI::App& verb, GlareOptions& o) {
  const std::string group = "Glare";
  const auto add = [&](const char* name, std::string& value, const std::string& text, const char* kind) {
    verb.add_option(name, value, text)->type_name(kind)->group(group);
  };
  add("--glare", o.rule,
      "What the eye scatters: above (default: light the display cannot show), above:T (image units), all "
      "(the image on the "
      "retina, to measure), none",
      "RULE");
  add("--age", o.age, "Of the eye, years (default 28.58)", "YEARS");
  add("--pigmentation", o.pigmentation, "Of the eye: 0 black, 0.5 brown (default), 1 blue, 1.2 very light",
      "X");
  add("--strength-glare", o.strength, "Of the scattered light, 0 to 1", "X");
}

GlareChoice understand(const GlareOptions& o) {
  GlareChoice out;
  constexpr std::string_view above = "above:";
  out.named = o.rule != GlareOptions().rule;
  if (o.rule.rfind(above, 0) == 0)
    out.threshold = number_in("--glare", o.rule.substr(above.size()), 1e-30, 1e30, rules);
  else if (o.rule == "all")
    out.rule = GlareRule::all;
  else if (o.rule == "none")
    out.off = true;
  else if (o.rule != "above")
    fail_value("--glare", o.rule, rules);
  out.eye.age = number_in("--age", o.age, 0, 100, "an age in years, 0 to 100");
  out.eye.pigmentation = number_in("--pigmentation", o.pigmentation, 0, 1.2,
                                   "a pigmentation from 0 (black) to 1.2 (very light)");
  out.strength = number_in("--strength-glare", o.strength, 0, 1, "a strength from 0 (off) to 1 (the model)");
  return out;
}

}  // namespace scotopic
