#include "options/scene/apply_settings.h"

#include <utility>

#include "options/values.h"

namespace scotopic {
namespace {

NonFinite non_finite_policy(const std::string& text) {
  return choice<NonFinite>(
      "--nonfinite", text,
      {{"keep", NonFinite::keep}, {"clean", NonFinite::clean}, {"error", NonFinite::error}});
}

}  // namespace

void add_apply_options(CLI::App& verb, ApplyOptions& o) {
  add_precision_options(verb, o.precision);
  add_band_options(verb, o.scene.bands);
  add_display_options(verb, o.display);
  verb.add_option("--nonfinite", o.non_finite, "NaN and infinite pixels: keep, clean (to 0), or error")
      ->type_name("WHAT");
}

ImageSettings parse(const ApplyOptions& o) {
  const NonFinite non_finite = non_finite_policy(o.non_finite);
  ImageRequest request = parse(o.scene.image);
  ImageSettings out = parse(o.scene);
  DisplayChoice display = parse(o.display, out.choice.stages, request);
  parse(o.icc, request);
  if (request.view) out.config = out.config.holding(*request.view);
  out.request = std::move(request);
  out.display = std::move(display);
  out.non_finite = non_finite;
  add_stages(out);
  return out;
}

}  // namespace scotopic
