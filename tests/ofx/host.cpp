#include "ofx/host.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace scotopic::ofx {

using Value = PropertySetStruct::Value;

namespace {

template <class T>
T value_or(const PropertySetStruct& set, const std::string& name, std::size_t index, T otherwise) {
  const auto found = set.values.find(name);
  if (found == set.values.end() || index >= found->second.size()) return otherwise;
  const T* value = std::get_if<T>(&found->second[index]);
  return value ? *value : otherwise;
}

}  // namespace

std::string PropertySetStruct::text(const std::string& name, std::size_t index) const {
  return value_or<std::string>(*this, name, index, "");
}
double PropertySetStruct::number(const std::string& name, std::size_t index) const {
  return value_or<double>(*this, name, index, 0);
}
int PropertySetStruct::integer(const std::string& name, std::size_t index) const {
  return value_or<int>(*this, name, index, 0);
}
std::size_t PropertySetStruct::count(const std::string& name) const {
  const auto found = values.find(name);
  return found == values.end() ? 0 : found->second.size();
}

}  // namespace scotopic::ofx

namespace scotopic::test {
namespace {

using namespace ofx;

std::string missing_suite;
std::mutex message_lock;
std::vector<std::string> messages;

template <class T>
Status set_value(PropertySet set, const char* name, int index, T value) {
  if (!set || index < 0) return bad_handle;
  auto& values = set->values[name];
  if (values.size() <= static_cast<std::size_t>(index)) values.resize(static_cast<std::size_t>(index) + 1);
  values[static_cast<std::size_t>(index)] = std::move(value);
  return ok;
}

template <class T, class Out>
Status get_value(PropertySet set, const char* name, int index, Out* out) {
  if (!set) return bad_handle;
  const auto found = set->values.find(name);
  if (found == set->values.end()) return unknown;
  if (index < 0 || static_cast<std::size_t>(index) >= found->second.size()) return bad_index;
  T* const value = std::get_if<T>(&found->second[static_cast<std::size_t>(index)]);
  if (!value) return bad_value;
  if constexpr (std::is_same_v<T, std::string>)
    *out = value->data();
  else
    *out = *value;
  return ok;
}

template <class T, class Out>
Status get_values(PropertySet set, const char* name, int count, Out* out) {
  for (int i = 0; i < count; ++i)
    if (const Status status = get_value<T>(set, name, i, out + i); status != ok) return status;
  return ok;
}

template <class T, class In>
Status set_values(PropertySet set, const char* name, int count, const In* values) {
  for (int i = 0; i < count; ++i)
    if (const Status status = set_value<T>(set, name, i, T(values[i])); status != ok) return status;
  return ok;
}

const PropertySuite property_functions = {
    [](PropertySet s, const char* n, int i, void* v) { return set_value<void*>(s, n, i, v); },
    [](PropertySet s, const char* n, int i, const char* v) { return set_value<std::string>(s, n, i, v); },
    [](PropertySet s, const char* n, int i, double v) { return set_value<double>(s, n, i, v); },
    [](PropertySet s, const char* n, int i, int v) { return set_value<int>(s, n, i, v); },
    [](PropertySet s, const char* n, int c, void* const* v) { return set_values<void*>(s, n, c, v); },
    [](PropertySet s, const char* n, int c, const char* const* v) {
      return set_values<std::string>(s, n, c, v);
    },
    [](PropertySet s, const char* n, int c, const double* v) { return set_values<double>(s, n, c, v); },
    [](PropertySet s, const char* n, int c, const int* v) { return set_values<int>(s, n, c, v); },
    [](PropertySet s, const char* n, int i, void** v) { return get_value<void*>(s, n, i, v); },
    [](PropertySet s, const char* n, int i, char** v) { return get_value<std::string>(s, n, i, v); },
    [](PropertySet s, const char* n, int i, double* v) { return get_value<double>(s, n, i, v); },
    [](PropertySet s, const char* n, int i, int* v) { return get_value<int>(s, n, i, v); },
    [](PropertySet s, const char* n, int c, void** v) { return get_values<void*>(s, n, c, v); },
    [](PropertySet s, const char* n, int c, char** v) { return get_values<std::string>(s, n, c, v); },
    [](PropertySet s, const char* n, int c, double* v) { return get_values<double>(s, n, c, v); },
    [](PropertySet s, const char* n, int c, int* v) { return get_values<int>(s, n, c, v); },
    [](PropertySet s, const char* n) { return s->values.erase(n) ? ok : unknown; },
    [](PropertySet s, const char* n, int* c) {
      *c = static_cast<int>(s->count(n));
      return s->count(n) ? ok : unknown;
    }};

Clip clip_of(ImageEffect effect, const char* name) {
  const auto found = effect->clips.find(name);
  return found == effect->clips.end() ? nullptr : &found->second;
}

const ImageEffectSuite effect_functions = {
    [](ImageEffect e, PropertySet* out) { return e ? (*out = &e->properties, ok) : bad_handle; },
    [](ImageEffect e, ParamSet* out) { return e ? (*out = &e->params, ok) : bad_handle; },
    [](ImageEffect e, const char* name, PropertySet* out) {
      if (out) *out = &e->clips[name].properties;
      return ok;
    },
    [](ImageEffect e, const char* name, Clip* clip, PropertySet* out) {
      Clip const found = clip_of(e, name);
      if (!found) return bad_handle;
      if (clip) *clip = found;
      if (out) *out = &found->properties;
      return ok;
    },
    [](Clip clip, PropertySet* out) { return clip ? (*out = &clip->properties, ok) : bad_handle; },
    [](Clip clip, Time, const RectD*, PropertySet* out) {
      return clip && clip->has_image ? (*out = &clip->image, ok) : failed;
    },
    [](PropertySet image) { return image ? ok : bad_handle; },
    [](Clip clip, Time, RectD* out) { return clip ? (*out = clip->definition, ok) : bad_handle; },
    [](ImageEffect) { return 0; },
    nullptr,
    nullptr,
    nullptr,
    nullptr};

void put_value(const ParamStruct& param, Time time, va_list arguments) {
  if (param.type == type::dbl)
    *va_arg(arguments, double*) = param.animation ? param.animation(time) : param.number;
  else if (param.type == type::string)
    *va_arg(arguments, char**) = const_cast<char*>(param.text.c_str());
  else
    *va_arg(arguments, int*) = param.integer;
}

Status value_now(Param param, ...) {
  va_list arguments;
  va_start(arguments, param);
  put_value(*param, 0, arguments);
  va_end(arguments);
  return ok;
}

Status value_at(Param param, Time time, ...) {
  va_list arguments;
  va_start(arguments, time);
  put_value(*param, time, arguments);
  va_end(arguments);
  return ok;
}

const ParameterSuite parameter_functions = {
    [](ParamSet set, const char* kind, const char* name, PropertySet* out) {
      if (set->params.count(name)) return exists;
      ParamStruct& param = set->params[name];
      param.type = kind;
      if (out) *out = &param.properties;
      return ok;
    },
    [](ParamSet set, const char* name, Param* param, PropertySet* out) {
      const auto found = set->params.find(name);
      if (found == set->params.end()) return unknown;
      if (param) *param = &found->second;
      if (out) *out = &found->second.properties;
      return ok;
    },
    [](ParamSet set, PropertySet* out) { return *out = &set->properties, ok; },
    [](Param param, PropertySet* out) { return *out = &param->properties, ok; },
    value_now,
    value_at,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    nullptr};

Status show(void*, const char* kind, const char*, const char* format, ...) {
  char text[4096];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  const std::lock_guard guard(message_lock);
  messages.push_back(std::string(kind) + ": " + text);
  return ok;
}

const MessageSuite message_functions = {show};

const void* suite(PropertySet, const char* name, int version) {
  if (version != 1 || name == missing_suite) return nullptr;
  const std::map<std::string, const void*> all = {{property_suite, &property_functions},
                                                  {image_effect_suite, &effect_functions},
                                                  {parameter_suite, &parameter_functions},
                                                  {message_suite, &message_functions}};
  const auto found = all.find(name);
  return found == all.end() ? nullptr : found->second;
}

constexpr std::byte untouched{0x5a};

}  // namespace

HostImage::HostImage(const RectI& bounds, int channels, Depth depth, int padding)
    : bounds_(bounds),
      channels_(channels),
      depth_(depth),
      pixel_bytes_(static_cast<std::size_t>(channels) * (depth == Depth::half ? 2 : 4)),
      row_bytes_(static_cast<std::size_t>(bounds.x2 - bounds.x1) * pixel_bytes_ +
                 4 * static_cast<std::size_t>(padding)),
      padding_(4 * static_cast<std::size_t>(padding)),
      bytes_(row_bytes_ * static_cast<std::size_t>(bounds.y2 - bounds.y1) + padding_, untouched) {}

std::byte* HostImage::at(int x, int y) {
  return bytes_.data() + padding_ + static_cast<std::size_t>(y - bounds_.y1) * row_bytes_ +
         static_cast<std::size_t>(x - bounds_.x1) * pixel_bytes_;
}

bool HostImage::padding_is_whole() const {
  const std::size_t row = row_bytes_ - padding_;
  for (std::size_t i = 0; i < bytes_.size(); ++i)
    if ((i + row_bytes_ - padding_) % row_bytes_ >= row && bytes_[i] != untouched) return false;
  return true;
}

void HostImage::describe(PropertySetStruct& image, const RectI& frame) {
  image.set(property::data, {static_cast<void*>(at(bounds_.x1, bounds_.y1))});
  image.set(property::bounds, {bounds_.x1, bounds_.y1, bounds_.x2, bounds_.y2});
  image.set(property::region_of_definition, {frame.x1, frame.y1, frame.x2, frame.y2});
  image.set(property::row_bytes, {static_cast<int>(row_bytes_)});
  image.set(property::components, {std::string(channels_ == 4 ? rgba : rgb)});
  image.set(property::pixel_depth, {std::string(depth_ == Depth::half ? depth_half : depth_float)});
  image.set(property::premultiplication, {std::string("OfxImageAlphaPremultiplied")});
  image.set(property::pixel_aspect, {1.0});
}

TestHost::TestHost(const std::string& module, const std::string& lacking) {
  module_ = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!module_) throw std::runtime_error(dlerror());
  const auto count = reinterpret_cast<int (*)()>(dlsym(module_, "OfxGetNumberOfPlugins"));
  const auto get = reinterpret_cast<Plugin* (*)(int)>(dlsym(module_, "OfxGetPlugin"));
  if (!count || !get || count() != 1 || get(1)) throw std::runtime_error("not one plug-in");
  plugin_ = get(0);
  missing_suite = lacking;
  host_ = {nullptr, suite};
  plugin_->set_host(&host_);
}

// The module stays loaded, as in most hosts: OpenImageIO's threads live on in it.
TestHost::~TestHost() { (void)call(action::unload, nullptr); }

Status TestHost::call(const char* action, ImageEffect effect, PropertySet in, PropertySet out) const {
  return plugin_->main_entry(action, effect, in, out);
}

Status TestHost::open(const char* context) {
  description_ = {};
  if (const Status status = call(action::load, nullptr); status != ok) return status;
  if (const Status status = call(action::describe, &description_); status != ok) return status;
  PropertySetStruct in;
  in.set(property::context, {std::string(context)});
  return call(action::describe_in_context, &description_, &in);
}

std::unique_ptr<ImageEffectStruct> TestHost::instance() {
  auto out = std::make_unique<ImageEffectStruct>(description_);
  for (auto& [name, param] : out->params.params) {
    param.number = param.properties.number(property::initial);
    param.integer = param.properties.integer(property::initial);
    param.text = param.properties.text(property::initial);
  }
  out->properties.set(property::frame_rate, {24.0});
  if (call(action::create_instance, out.get()) != ok) throw std::runtime_error("no instance");
  return out;
}

std::vector<std::string> TestHost::take_messages() {
  const std::lock_guard guard(message_lock);
  return std::exchange(messages, {});
}

}  // namespace scotopic::test
