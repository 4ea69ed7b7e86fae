#include "ofx/host_suites.h"

#include <algorithm>
#include <atomic>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>

#include "ofx/host.h"

namespace scotopic::ofx {

struct MutexStruct {
  std::recursive_mutex mutex;
};

}  // namespace scotopic::ofx

namespace scotopic::test {
namespace {

using namespace ofx;

std::string missing_suite;
std::mutex message_lock;
std::vector<std::string> messages;
std::atomic<int> pieces_of_memory;
thread_local std::optional<unsigned int> thread_index;

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

const MemorySuite memory_functions = {[](void*, std::size_t bytes, void** data) {
                                        *data = std::malloc(bytes);
                                        if (!*data) return failed;
                                        ++pieces_of_memory;
                                        return ok;
                                      },
                                      [](void* data) {
                                        --pieces_of_memory;
                                        std::free(data);
                                        return ok;
                                      }};

Status multi_thread(ThreadFunction* function, unsigned int count, void* argument) {
  if (thread_index || count == 0) return failed;
  std::vector<std::thread> threads;
  for (unsigned int i = 0; i < count; ++i)
    threads.emplace_back([=] {
      thread_index = i;
      function(i, count, argument);
    });
  for (std::thread& thread : threads) thread.join();
  return ok;
}

Status create_mutex(Mutex* mutex, int locks) {
  *mutex = new MutexStruct;
  for (int i = 0; i < locks; ++i) (*mutex)->mutex.lock();
  return ok;
}

const MultiThreadSuite multi_thread_functions = {
    multi_thread,
    [](unsigned int* count) { return *count = std::max(1u, std::thread::hardware_concurrency()), ok; },
    [](unsigned int* index) { return *index = thread_index.value_or(0), ok; },
    [] { return thread_index ? 1 : 0; },
    create_mutex,
    [](Mutex m) { return delete m, ok; },
    [](Mutex m) { return m->mutex.lock(), ok; },
    [](Mutex m) { return m->mutex.unlock(), ok; },
    [](Mutex m) { return m->mutex.try_lock() ? ok : failed; }};

}  // namespace

const void* suite(PropertySet, const char* name, int version) {
  if (version != 1 || name == missing_suite) return nullptr;
  const std::map<std::string, const void*> all = {
      {property_suite, &property_functions},   {image_effect_suite, &effect_functions},
      {parameter_suite, &parameter_functions}, {message_suite, &message_functions},
      {memory_suite, &memory_functions},       {multi_thread_suite, &multi_thread_functions}};
  const auto found = all.find(name);
  return found == all.end() ? nullptr : found->second;
}

void leave_out_suite(const std::string& name) { missing_suite = name; }

std::vector<std::string> take_messages() {
  const std::lock_guard guard(message_lock);
  return std::exchange(messages, {});
}

int memory_in_use() { return pieces_of_memory; }

}  // namespace scotopic::test
