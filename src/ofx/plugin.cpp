// Scotopic.ofx: what a host loads. Every action ends here, with a status and where it failed a message; no
// exception passes.
#include <cstring>
#include <exception>
#include <optional>
#include <string>

#include "base/error.h"
#include "ofx/colour.h"
#include "ofx/instance.h"
#include "ofx/panel.h"
#include "ofx/suites.h"

namespace scotopic::ofx {
namespace {

constexpr const char* identifier = "org.scotopic.Scotopic";
constexpr const char* description =
    "Shows images as the dark-adapted eye sees them: rods, cones, and the way between. Linear light in; La "
    "is "
    "what the eye is adapted to.";

ImageEffect effect_of(const void* handle) { return static_cast<ImageEffect>(const_cast<void*>(handle)); }

Properties properties_of(ImageEffect effect) {
  PropertySet set = nullptr;
  (void)suites().effect->get_property_set(effect, &set);
  return Properties(set);
}

Status describe(ImageEffect effect) {
  const Properties p = properties_of(effect);
  p.set(property::label, "Scotopic");
  p.set(property::grouping, "Colour");
  p.set(property::plugin_description, description);
  p.set(property::contexts, context::filter, 0);
  p.set(property::contexts, context::general, 1);
  p.set(property::depths, depth_float, 0);
  p.set(property::depths, depth_half, 1);
  p.set(property::single_instance, 0);
  p.set(property::thread_safety, fully_safe);
  p.set(property::host_frame_threading, 0);
  p.set(property::supports_tiles, 1);
  p.set(property::supports_multi_resolution, 1);
  p.set(property::temporal_access, 0);
  p.set(property::multiple_clip_depths, 0);
  p.set(property::multiple_clip_pars, 0);
  describe_colour(p);
  return ok;
}

Status describe_in_context(ImageEffect effect) {
  for (const char* name : {source_clip, output_clip}) {
    PropertySet clip = nullptr;
    if (suites().effect->clip_define(effect, name, &clip) != ok) return failed;
    const Properties p(clip);
    p.set(property::components_supported, rgba, 0);
    p.set(property::components_supported, rgb, 1);
    p.set(property::supports_tiles, 1);
  }
  ParamSet set = nullptr;
  if (suites().effect->get_param_set(effect, &set) != ok) return failed;
  define_panel(set);
  properties_of(effect).set(property::clip_preferences_follow, colour_space);
  return ok;
}

Instance& instance_of(ImageEffect effect) {
  auto* const instance = static_cast<Instance*>(properties_of(effect).pointer(property::instance_data));
  if (!instance) throw Error(ExitCode::internal, "", "the host has lost the instance's data");
  return *instance;
}

Moment moment_of(const Properties& in) {
  Moment out;
  out.time = in.number(property::time, 0);
  const double x = in.number(property::render_scale, 1, 0), y = in.number(property::render_scale, 1, 1);
  if (x > 0) out.scale_x = x;
  if (y > 0) out.scale_y = y;
  return out;
}

Status create(ImageEffect effect) {
  properties_of(effect).set_pointer(property::instance_data, new Instance(effect));
  return ok;
}

Status destroy(ImageEffect effect) {
  const Properties p = properties_of(effect);
  delete static_cast<Instance*>(p.pointer(property::instance_data));
  p.set_pointer(property::instance_data, nullptr);
  return ok;
}

Status render(ImageEffect effect, const Properties& in) {
  const std::optional<RectI> window = in.rectangle(property::render_window);
  if (!window) return failed;
  instance_of(effect).render(moment_of(in), *window);
  return ok;
}

Status is_identity(ImageEffect effect, const Properties& in, const Properties& out) {
  if (!instance_of(effect).is_identity(moment_of(in))) return reply_default;
  out.set(property::name, source_clip);
  out.set(property::time, in.number(property::time, 0));
  return ok;
}

Status regions_of_interest(ImageEffect effect, const Properties& in, const Properties& out) {
  RectD wanted{};
  double* const sides_of_wanted[] = {&wanted.x1, &wanted.y1, &wanted.x2, &wanted.y2};
  for (int i = 0; i < 4; ++i) *sides_of_wanted[i] = in.number(property::region_of_interest, 0, i);
  const std::optional<RectD> region = instance_of(effect).source_region(moment_of(in), wanted);
  if (!region) return reply_default;
  const double sides[] = {region->x1, region->y1, region->x2, region->y2};
  for (int i = 0; i < 4; ++i) out.set(property::source_region, sides[i], i);
  return ok;
}

Status clip_preferences(ImageEffect effect, const Properties& out) {
  const char* const space = instance_of(effect).preferred_space();
  if (!space) return reply_default;
  out.set(property::preferred_for_source, space);
  return ok;
}

Status output_colourspace(ImageEffect effect, const Properties& out) {
  const std::string space = instance_of(effect).output_space();
  if (space.empty()) return reply_default;
  out.set(property::colourspace, space);
  return ok;
}

Status act(const std::string& name, ImageEffect effect, const Properties& in, const Properties& out) {
  if (name == action::load) return fetch_suites() ? ok : missing_feature;
  if (name == action::unload) return ok;
  if (name == action::describe) return describe(effect);
  if (name == action::describe_in_context) return describe_in_context(effect);
  if (name == action::create_instance) return create(effect);
  if (name == action::destroy_instance) return destroy(effect);
  if (name == action::render) return render(effect, in);
  if (name == action::is_identity) return is_identity(effect, in, out);
  if (name == action::regions_of_interest) return regions_of_interest(effect, in, out);
  if (name == action::clip_preferences) return clip_preferences(effect, out);
  if (name == action::output_colourspace) return output_colourspace(effect, out);
  return reply_default;
}

/// Whether a failure is told now: render will meet the same, and tells it once.
bool is_told(const std::string& name) {
  return name != action::is_identity && name != action::regions_of_interest &&
         name != action::clip_preferences && name != action::output_colourspace;
}

Status main_entry(const char* name, const void* handle, PropertySet in, PropertySet out) {
  const std::string action = name ? name : "";
  const ImageEffect effect = effect_of(handle);
  try {
    return act(action, effect, Properties(in), Properties(out));
  } catch (const std::exception& error) {
    if (!is_told(action)) return reply_default;
    show_error(effect, std::string("Scotopic: ") + error.what());
  } catch (...) {
    show_error(effect, "Scotopic: failed");
  }
  return failed;
}

Plugin plugin = {image_effect_api, 1, identifier, 0, 1, set_host, main_entry};

}  // namespace
}  // namespace scotopic::ofx

extern "C" {

__attribute__((visibility("default"))) int OfxGetNumberOfPlugins() { return 1; }

__attribute__((visibility("default"))) scotopic::ofx::Plugin* OfxGetPlugin(int index) {
  return index == 0 ? &scotopic::ofx::plugin : nullptr;
}

}  // extern "C"
