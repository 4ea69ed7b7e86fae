// bake --config DIR: a config of looks, whole.
#include <filesystem>

#include "base/error.h"
#include "bake/bake_options.h"
#include "looks/chain/read_back.h"
#include "looks/config/manifest.h"
#include "looks/config/own_mark.h"
#include "looks/lut/shipped_looks.h"
#include "looks/verify/inspect.h"

namespace scotopic {
namespace {

namespace fs = std::filesystem;

bool has_all_shipped_looks(const std::vector<LookSpec>& specs) {
  for (const NamedAdaptation& step : named_adaptations) {
    bool found = false;
    for (const LookSpec& spec : specs) found |= spec.parameters.adaptation == step.adaptation;
    if (!found) return false;
  }
  return true;
}

bool is_ours(const std::string& config) { return !fs::exists(config) || is_as_marked(text_of(config)); }

void refuse_what_is_not_ours(const std::string& config, const std::string& manifest) {
  if (!is_ours(config))
    throw Error(ExitCode::output, config,
                "is a config that bake has not written, or that was changed since: give another folder, or "
                "--force, which "
                "keeps it beside as config.ocio.before_scotopic");
  if (fs::exists(manifest) && !is_manifest(text_of(manifest)))
    throw Error(ExitCode::output, manifest,
                "is not one that bake has written: give another folder, or --force");
}

/// Beside, under a name that is free.
void keep_what_is_not_ours(OutputSet& files, const std::string& config) {
  if (is_ours(config)) return;
  std::string copy = config + ".before_scotopic";
  for (int n = 2; fs::exists(copy); ++n) copy = config + ".before_scotopic_" + std::to_string(n);
  files.add(copy, text_of(config));
}

/// Relative to the config's folder. LUTs in ../luts may be moved beside the config one day, for an archive:
/// that is searched, too.
std::string search_path_to(const std::string& luts, const std::string& config_folder) {
  const std::string relative = fs::absolute(luts)
                                   .lexically_normal()
                                   .lexically_relative(fs::absolute(config_folder).lexically_normal())
                                   .string();
  if (relative == "../luts" || relative == "../luts/") return lut_search_path;
  return relative.empty() ? fs::absolute(luts).string() : relative;
}

}  // namespace

int bake_config(const BakeOptions& o, const Console& console) {
  const ColourConfig config = ColourConfig::own();
  const std::vector<LookSpec> specs = specs_for_config(o, config);
  const std::string luts = o.luts.empty() ? o.new_config + "/luts" : o.luts;
  require_writable_folder(o.new_config);
  require_writable_folder(luts);
  const std::string file = o.new_config + "/config.ocio";
  if (!o.force) refuse_what_is_not_ours(file, luts + "/MANIFEST");
  LookSet set = bake_set(specs, config, SCOTOPIC_VERSION, has_all_shipped_looks(specs));
  add_nights(set, specs, config, SCOTOPIC_VERSION);
  for (const auto* baked : {&set.looks, &set.night_luts})
    for (const BakedLook& look : *baked) {
      check_error(o, look);
      console.note(said(look));
    }
  const std::string text = look_config_text(set, search_path_to(luts, o.new_config));
  require_config(text, file);
  OutputSet files;
  files.make_folder(o.new_config);
  files.make_folder(luts);
  // The config last: it is never there without its files.
  add_luts(files, luts, set);
  files.add(luts + "/MANIFEST", manifest_text(set, SCOTOPIC_VERSION, command_of(o)));
  if (o.force) keep_what_is_not_ours(files, file);
  files.add(file, marked(text, SCOTOPIC_VERSION));
  if (!o.force) refuse_what_is_not_ours(file, luts + "/MANIFEST");
  files.commit();
  nlohmann::ordered_json results = nlohmann::ordered_json::array();
  for (const BakedLook& look : set.looks) results.push_back(json_of(look));
  console.result({{"config", file}, {"looks", results}});
  return static_cast<int>(ExitCode::done);
}

}  // namespace scotopic
