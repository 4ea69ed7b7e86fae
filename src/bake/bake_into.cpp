// bake --into CONFIG: looks added to a studio's config.
#include <fmt/format.h>

#include <filesystem>

#include "base/error.h"
#include "bake/bake_options.h"
#include "options/image_options.h"
#include "color/config/config_glance.h"
#include "io/atomic/file_lock.h"
#include "looks/config/manifest.h"
#include "looks/merge/config_merge.h"
#include "looks/merge/line_diff.h"
#include "looks/verify/inspect.h"

namespace scotopic {
namespace {

namespace fs = std::filesystem;

/// The config as it was stays beside the new one; an older such copy is never overwritten.
void keep_original(OutputSet& files, const std::string& file, const std::string& text) {
  const std::string copy = file + ".before_scotopic";
  if (!fs::exists(copy)) files.add(copy, text);
}

/// Configs that are no text files: lines cannot be put into them.
void refuse_archives(const std::string& file) {
  if (file.rfind("ocio://", 0) == 0)
    throw Error(ExitCode::config, file, "is built into OpenColorIO: write it to a file, and give that");
  if (is_archive(file))
    throw Error(ExitCode::config, file,
                "is an archive, which --into does not change: unzip it, give its config.ocio, and pack that "
                "by ocioarchive");
}

ColourConfig read_config(const BakeOptions& o) {
  return ColourConfig::from_file(o.into, o.limits, working_primaries(o.working_primaries));
}

/// Two configs may share a folder of LUTs; names that stand for something else there are not taken.
void refuse_other_luts(const std::string& folder, const LookSet& set) {
  for (const TextFile& lut : set.luts) {
    const std::string file = folder + "/" + lut.name;
    if (fs::exists(file) && text_of(file) != lut.text)
      throw Error(ExitCode::output, file, "is another look's already: --force replaces it");
  }
  const std::string manifest = folder + "/MANIFEST";
  if (fs::exists(manifest) && !is_manifest(text_of(manifest)))
    throw Error(ExitCode::output, manifest, "is not one that bake has written: --force replaces it");
}

std::string manifest_with(const std::string& folder, const LookSet& set, const BakeOptions& o) {
  const std::string fresh = manifest_text(set, SCOTOPIC_VERSION, command_of(o)), file = folder + "/MANIFEST";
  const std::string older = fs::exists(file) ? text_of(file) : "";
  return is_manifest(older) ? merged_manifest(older, fresh) : fresh;
}

void tell(const MergedConfig& merged, const BakeOptions& o, const Console& console) {
  if (merged.rewritten)
    console.note(o.into + ": its layout is unusual: OpenColorIO writes the config anew, comments are lost");
  for (const std::string& display : merged.unproven_displays)
    console.note(fmt::format(
        "{}: no view of display '{}' loads here: those added to it are not tried, either", o.into, display));
}

MergedConfig merge(const ColourConfig& config, const LookSet& set, const BakeOptions& o,
                   const Console& console) {
  const MergedConfig merged = merge_looks(config, set.entries);
  if (!o.force) refuse_other_luts(merged.lut_folder, set);
  require_all_load(merged, config, set);
  tell(merged, o, console);
  return merged;
}

int show(const ColourConfig& config, const LookSet& set, const BakeOptions& o, const Console& console) {
  const MergedConfig merged = merge(config, set, o, console);
  std::fputs(line_diff(text_of(o.into), merged.text).c_str(), stdout);
  for (const TextFile& lut : set.luts) console.note("would write " + merged.lut_folder + "/" + lut.name);
  return static_cast<int>(ExitCode::done);
}

FileLock locked(const std::string& path, const Console& console) {
  return FileLock(path, [&] { console.note(path + ": another program is at work on it; waiting"); });
}

void require_same_light(const ColourConfig& before, const ColourConfig& now) {
  if (before.working_space() != now.working_space() ||
      before.xyz_from_working().rows != now.xyz_from_working().rows)
    throw Error(ExitCode::config, now.file(), "got another scene_linear meanwhile: run this again");
}

/// Writes LUTs, MANIFEST and config; whoever does the same waits, and finds what was written.
MergedConfig write(const ColourConfig& baked_for, const LookSet& set, const BakeOptions& o,
                   const Console& console) {
  const FileLock config_lock = locked(o.into, console);
  const std::string original = text_of(o.into);
  const ColourConfig config = read_config(o);
  require_same_light(baked_for, config);
  const MergedConfig merged = merge(config, set, o, console);
  OutputSet files;
  files.make_folder(merged.lut_folder);
  const FileLock folder_lock = locked(merged.lut_folder, console);
  if (!o.force) refuse_other_luts(merged.lut_folder, set);
  add_luts(files, merged.lut_folder, set);
  files.add(merged.lut_folder + "/MANIFEST", manifest_with(merged.lut_folder, set, o));
  keep_original(files, o.into, original);
  files.add(o.into, merged.text);
  if (text_of(o.into) != original)
    throw Error(ExitCode::config, o.into, "was changed by another program meanwhile: run this again");
  files.commit();
  return merged;
}

}  // namespace

int bake_into(const BakeOptions& o, const Console& console) {
  refuse_archives(o.into);
  const ColourConfig config = read_config(o);
  const std::vector<LookSpec> specs = specs_for_config(o, config);
  if (!o.dry_run) require_writable_folder(fs::absolute(o.into).parent_path().string());
  const LookSet set = bake_set(specs, config, SCOTOPIC_VERSION, false);
  for (const BakedLook& look : set.looks) check_error(o, look);
  if (o.dry_run) return show(config, set, o, console);
  const MergedConfig merged = write(config, set, o, console);
  for (const BakedLook& look : set.looks) console.note(said(look));
  console.result({{"config", o.into}, {"luts", merged.lut_folder}, {"looks", set.looks.size()}});
  return static_cast<int>(ExitCode::done);
}

}  // namespace scotopic
