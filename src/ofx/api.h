// The part of the OpenFX Image Effect API that is used here (1.4, and of 1.5 its colour management): names of
// properties, actions and types, and the layout of the structures that host and plug-in share, as the API's
// specification has them. Plain C data: what crosses the border may be from any compiler.
#pragma once

#include <cstddef>

namespace scotopic::ofx {

using Status = int;
inline constexpr Status ok = 0, failed = 1, fatal = 2, unknown = 3, missing_feature = 4, unsupported = 5,
                        exists = 6, bad_handle = 9, bad_index = 10, bad_value = 11, reply_yes = 12,
                        reply_no = 13, reply_default = 14, image_format = 1000;

struct PropertySetStruct;
struct ImageEffectStruct;
struct ParamStruct;
struct ParamSetStruct;
struct ClipStruct;
using PropertySet = PropertySetStruct*;
using ImageEffect = ImageEffectStruct*;
using Param = ParamStruct*;
using ParamSet = ParamSetStruct*;
using Clip = ClipStruct*;
using Time = double;

struct RectI {
  int x1, y1, x2, y2;
};
struct RectD {
  double x1, y1, x2, y2;
};

/// What a host gives a plug-in.
struct Host {
  PropertySet host;
  const void* (*fetch_suite)(PropertySet host, const char* name, int version);
};

using EntryPoint = Status(const char* action, const void* handle, PropertySet in, PropertySet out);

/// What a plug-in says of itself.
struct Plugin {
  const char* api;
  int api_version;
  const char* identifier;
  unsigned int version_major, version_minor;
  void (*set_host)(Host* host);
  EntryPoint* main_entry;
};

inline constexpr const char* image_effect_api = "OfxImageEffectPluginAPI";

// Suites: tables of functions, in their order.
inline constexpr const char *property_suite = "OfxPropertySuite", *image_effect_suite = "OfxImageEffectSuite",
                            *parameter_suite = "OfxParameterSuite", *message_suite = "OfxMessageSuite",
                            *memory_suite = "OfxMemorySuite", *multi_thread_suite = "OfxMultiThreadSuite";

struct PropertySuite {
  Status (*set_pointer)(PropertySet, const char* name, int index, void* value);
  Status (*set_string)(PropertySet, const char* name, int index, const char* value);
  Status (*set_double)(PropertySet, const char* name, int index, double value);
  Status (*set_int)(PropertySet, const char* name, int index, int value);
  Status (*set_pointers)(PropertySet, const char* name, int count, void* const* values);
  Status (*set_strings)(PropertySet, const char* name, int count, const char* const* values);
  Status (*set_doubles)(PropertySet, const char* name, int count, const double* values);
  Status (*set_ints)(PropertySet, const char* name, int count, const int* values);
  Status (*get_pointer)(PropertySet, const char* name, int index, void** value);
  Status (*get_string)(PropertySet, const char* name, int index, char** value);
  Status (*get_double)(PropertySet, const char* name, int index, double* value);
  Status (*get_int)(PropertySet, const char* name, int index, int* value);
  Status (*get_pointers)(PropertySet, const char* name, int count, void** values);
  Status (*get_strings)(PropertySet, const char* name, int count, char** values);
  Status (*get_doubles)(PropertySet, const char* name, int count, double* values);
  Status (*get_ints)(PropertySet, const char* name, int count, int* values);
  Status (*reset)(PropertySet, const char* name);
  Status (*get_dimension)(PropertySet, const char* name, int* count);
};

struct ImageEffectSuite {
  Status (*get_property_set)(ImageEffect, PropertySet* properties);
  Status (*get_param_set)(ImageEffect, ParamSet* parameters);
  Status (*clip_define)(ImageEffect, const char* name, PropertySet* properties);
  Status (*clip_get_handle)(ImageEffect, const char* name, Clip* clip, PropertySet* properties);
  Status (*clip_get_property_set)(Clip, PropertySet* properties);
  Status (*clip_get_image)(Clip, Time time, const RectD* region, PropertySet* image);
  Status (*clip_release_image)(PropertySet image);
  Status (*clip_get_region_of_definition)(Clip, Time time, RectD* bounds);
  int (*abort)(ImageEffect);
  void* memory_alloc;  ///< these four are not called
  void* memory_free;
  void* memory_lock;
  void* memory_unlock;
};

struct ParameterSuite {
  Status (*define)(ParamSet, const char* type, const char* name, PropertySet* properties);
  Status (*get_handle)(ParamSet, const char* name, Param* param, PropertySet* properties);
  Status (*set_get_property_set)(ParamSet, PropertySet* properties);
  Status (*get_property_set)(Param, PropertySet* properties);
  Status (*get_value)(Param, ...);
  Status (*get_value_at_time)(Param, Time time, ...);
  void* get_derivative;  ///< from here on not called
  void* get_integral;
  void* set_value;
  void* set_value_at_time;
  void* get_num_keys;
  void* get_key_time;
  void* get_key_index;
  void* delete_key;
  void* delete_all_keys;
  void* copy;
  void* edit_begin;
  void* edit_end;
};

// Of these two the plug-in needs nothing: memory and threads are its own.
struct MemorySuite {
  Status (*alloc)(void* handle, std::size_t bytes, void** data);
  Status (*free)(void* data);
};

struct MutexStruct;
using Mutex = MutexStruct*;
using ThreadFunction = void(unsigned int index, unsigned int count, void* argument);

struct MultiThreadSuite {
  Status (*multi_thread)(ThreadFunction* function, unsigned int count, void* argument);
  Status (*num_cpus)(unsigned int* count);
  Status (*index)(unsigned int* index);
  int (*is_spawned)();
  Status (*mutex_create)(Mutex* mutex, int locks);
  Status (*mutex_destroy)(Mutex mutex);
  Status (*mutex_lock)(Mutex mutex);
  Status (*mutex_unlock)(Mutex mutex);
  Status (*mutex_try_lock)(Mutex mutex);
};

struct MessageSuite {
  Status (*message)(void* handle, const char* type, const char* id, const char* format, ...);
};
inline constexpr const char* message_error = "OfxMessageError";

namespace action {
inline constexpr const char *load = "OfxActionLoad", *unload = "OfxActionUnload",
                            *describe = "OfxActionDescribe", *create_instance = "OfxActionCreateInstance",
                            *destroy_instance = "OfxActionDestroyInstance",
                            *describe_in_context = "OfxImageEffectActionDescribeInContext",
                            *render = "OfxImageEffectActionRender",
                            *is_identity = "OfxImageEffectActionIsIdentity",
                            *regions_of_interest = "OfxImageEffectActionGetRegionsOfInterest",
                            *clip_preferences = "OfxImageEffectActionGetClipPreferences",
                            *output_colourspace = "OfxImageEffectActionGetOutputColourspace";
}  // namespace action

namespace context {
inline constexpr const char *filter = "OfxImageEffectContextFilter",
                            *general = "OfxImageEffectContextGeneral";
}

namespace type {
inline constexpr const char *dbl = "OfxParamTypeDouble", *choice = "OfxParamTypeChoice",
                            *boolean = "OfxParamTypeBoolean", *string = "OfxParamTypeString",
                            *group = "OfxParamTypeGroup";
}

namespace property {
// Of anything.
inline constexpr const char *type = "OfxPropType", *name = "OfxPropName", *label = "OfxPropLabel",
                            *time = "OfxPropTime", *version = "OfxPropVersion",
                            *plugin_description = "OfxPropPluginDescription",
                            *instance_data = "OfxPropInstanceData";
// Of the effect.
inline constexpr const char *contexts = "OfxImageEffectPropSupportedContexts",
                            *context = "OfxImageEffectPropContext",
                            *depths = "OfxImageEffectPropSupportedPixelDepths",
                            *grouping = "OfxImageEffectPluginPropGrouping",
                            *single_instance = "OfxImageEffectPluginPropSingleInstance",
                            *thread_safety = "OfxImageEffectPluginRenderThreadSafety",
                            *host_frame_threading = "OfxImageEffectPluginPropHostFrameThreading",
                            *supports_tiles = "OfxImageEffectPropSupportsTiles",
                            *supports_multi_resolution = "OfxImageEffectPropSupportsMultiResolution",
                            *temporal_access = "OfxImageEffectPropTemporalClipAccess",
                            *multiple_clip_depths = "OfxImageEffectPropMultipleClipDepths",
                            *multiple_clip_pars = "OfxImageEffectPropSupportsMultipleClipPARs",
                            *frame_rate = "OfxImageEffectPropFrameRate",
                            *frame_range = "OfxImageEffectPropFrameRange",
                            *render_window = "OfxImageEffectPropRenderWindow",
                            *render_scale = "OfxImageEffectPropRenderScale",
                            *region_of_interest = "OfxImageEffectPropRegionOfInterest",
                            *clip_preferences_follow = "OfxImageEffectPropClipPreferencesSlaveParam";
// Of clips and images.
inline constexpr const char *components_supported = "OfxImageEffectPropSupportedComponents",
                            *components = "OfxImageEffectPropComponents",
                            *pixel_depth = "OfxImageEffectPropPixelDepth",
                            *premultiplication = "OfxImageEffectPropPreMultiplication",
                            *data = "OfxImagePropData", *bounds = "OfxImagePropBounds",
                            *region_of_definition = "OfxImagePropRegionOfDefinition",
                            *row_bytes = "OfxImagePropRowBytes",
                            *pixel_aspect = "OfxImagePropPixelAspectRatio",
                            *connected = "OfxImageClipPropConnected",
                            *source_region = "OfxImageClipPropRoI_Source";
// Of parameters.
inline constexpr const char *hint = "OfxParamPropHint", *parent = "OfxParamPropParent",
                            *initial = "OfxParamPropDefault", *least = "OfxParamPropMin",
                            *greatest = "OfxParamPropMax", *display_least = "OfxParamPropDisplayMin",
                            *display_greatest = "OfxParamPropDisplayMax",
                            *choice_option = "OfxParamPropChoiceOption", *animates = "OfxParamPropAnimates",
                            *group_open = "OfxParamPropGroupOpen";
// Of colour management (1.5): of host, effect and instance; of clips; of the source in clip preferences.
inline constexpr const char *colour_style = "OfxImageEffectPropColourManagementStyle",
                            *colour_configs = "OfxImageEffectPropColourManagementAvailableConfigs",
                            *colourspace = "OfxImageClipPropColourspace",
                            *preferred_for_source = "OfxImageClipPropPreferredColourspaces_Source";
}  // namespace property

// Colour management: how much of it, and the config that its names are of.
namespace colour {
inline constexpr const char *none = "OfxImageEffectColourManagementNone",
                            *basic = "OfxImageEffectColourManagementBasic",
                            *core = "OfxImageEffectColourManagementCore",
                            *native_config = "ofx-native-v1.5_aces-v1.3_ocio-v2.3",
                            *of_source = "OfxColourspace_Source";
// Names that stand for any space of a kind.
inline constexpr const char *scene_linear = "ofx_scene_linear", *scene_log = "ofx_scene_log",
                            *display_sdr = "ofx_display_sdr", *display_hdr = "ofx_display_hdr",
                            *raw = "ofx_raw";
}  // namespace colour

// Values of those.
inline constexpr const char *source_clip = "Source", *output_clip = "Output", *rgba = "OfxImageComponentRGBA",
                            *rgb = "OfxImageComponentRGB", *depth_half = "OfxBitDepthHalf",
                            *depth_float = "OfxBitDepthFloat", *fully_safe = "OfxImageEffectRenderFullySafe",
                            *unpremultiplied = "OfxImageAlphaUnPremultiplied";

}  // namespace scotopic::ofx
