// Man pages from the option table, in the macros of man(7).
#include "cli/report/option_table.h"

#include <algorithm>

namespace scotopic {
namespace {

/// Text that roff prints as it is.
std::string roff(const std::string& text) {
  std::string out;
  bool line_start = true;
  for (const char c : text) {
    if (line_start && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\') out += "\\e";
    else if (c == '-') out += "\\-";
    else out += c;
    line_start = c == '\n';
  }
  return out;
}

std::string head(const std::string& name, const std::string& text) {
  std::string upper = name;
  for (char& c : upper)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 32);
  return ".\\\" Made from the program's own options: edit those.\n.TH " + upper + " 1 \"\" \"scotopic " SCOTOPIC_VERSION
         "\" \"User commands\"\n.SH NAME\n" + roff(name) + " \\- " + roff(text) + "\n";
}

std::string option_text(const OptionRow& row) {
  std::string out = ".TP\n\\fB" + roff(row.short_name);
  if (!row.short_name.empty() && !row.long_name.empty()) out += "\\fR, \\fB";
  out += roff(row.long_name) + "\\fR";
  if (!row.kind.empty()) out += " \\fI" + roff(row.kind) + "\\fR";
  out += "\n" + roff(row.text);
  if (!row.preset.empty()) out += " (default " + roff(row.preset) + ")";
  if (!row.values.empty()) {
    std::string all;
    for (const std::string& value : row.values) all += (all.empty() ? "" : ", ") + value;
    out += ".\nOne of: " + roff(all);
  }
  return out + ".\n";
}

std::string exit_codes() {
  return ".SH EXIT STATUS\n"
         ".TP\n0\ndone\n.TP\n1\na check failed\n.TP\n2\nthe command line is wrong\n.TP\n3\nan input is missing or damaged\n"
         ".TP\n4\na limit is exceeded\n.TP\n5\nan output cannot be written; what was there before stays\n"
         ".TP\n6\na colour config, colour space or LUT is at fault\n.TP\n70\nan error of the program\n"
         ".TP\n128+n\nsignal n ended it\n.PP\nOf a sequence: that of the first frame that failed.\n";
}

std::string examples(const std::string& footer) {
  if (footer.empty()) return "";
  const std::size_t colon = footer.find(':');
  const std::string lines = colon == footer.npos ? footer : footer.substr(colon + 1);
  return ".SH EXAMPLES\n.nf\n" + roff(lines.substr(lines.find_first_not_of(" \n"))) + "\n.fi\n";
}

}  // namespace

std::string man_page(const VerbRow& verb) {
  std::string out = head("scotopic-" + verb.name, verb.text) + ".SH SYNOPSIS\n\\fBscotopic " + verb.name + "\\fR";
  for (const OptionRow& row : verb.arguments) out += " \\fI" + roff(row.kind) + "\\fR";
  for (const OptionRow& row : verb.options)
    if (row.required) out += " \\fB" + roff(row.short_name.empty() ? row.long_name : row.short_name) + "\\fR \\fI" + roff(row.kind) + "\\fR";
  out += " [\\fIoptions\\fR]\n.SH DESCRIPTION\n" + roff(verb.text) + ".\n";
  for (const OptionRow& row : verb.arguments) out += ".TP\n\\fI" + roff(row.kind) + "\\fR\n" + roff(row.text) + ".\n";
  std::vector<std::string> groups;
  for (const OptionRow& row : verb.options)
    if (std::find(groups.begin(), groups.end(), row.group) == groups.end()) groups.push_back(row.group);
  out += ".SH OPTIONS\n";
  for (const std::string& group : groups) {
    out += ".SS " + roff(group) + "\n";
    for (const OptionRow& row : verb.options)
      if (row.group == group) out += option_text(row);
  }
  return out + exit_codes() + examples(verb.footer) + ".SH SEE ALSO\n\\fBscotopic\\fR(1)\n";
}

std::string man_page(const std::vector<VerbRow>& verbs) {
  std::string out = head("scotopic", "images as the dark-adapted eye sees them") +
                    ".SH SYNOPSIS\n\\fBscotopic\\fR \\fIVERB\\fR [\\fIoptions\\fR]\n.br\n\\fBscotopic\\fR \\-\\-help | \\-\\-version\n"
                    ".SH VERBS\n";
  for (const VerbRow& verb : verbs) out += ".TP\n\\fB" + verb.name + "\\fR\n" + roff(verb.text) + ": \\fBscotopic\\-" + verb.name + "\\fR(1).\n";
  out += exit_codes() +
         ".SH ENVIRONMENT\n.TP\nOCIO\nThe OpenColorIO config, where \\-\\-config does not name one. "
         "A config may look at variables of its own.\n.SH SEE ALSO\n";
  for (std::size_t i = 0; i < verbs.size(); ++i) out += (i ? ",\n" : "") + ("\\fBscotopic\\-" + verbs[i].name + "\\fR(1)");
  return out + "\n";
}

}  // namespace scotopic
