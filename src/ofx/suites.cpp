#include "ofx/suites.h"

namespace scotopic::ofx {
namespace {

/// Set once by the host, before anything else.
Host* host = nullptr;
Suites all;

template <class Suite>
const Suite* fetch(const char* name) {
  return static_cast<const Suite*>(host->fetch_suite(host->host, name, 1));
}

}  // namespace

const Suites& suites() noexcept { return all; }

void set_host(Host* given) noexcept { host = given; }

bool fetch_suites() noexcept {
  if (!host || !host->fetch_suite) return false;
  all = {fetch<PropertySuite>(property_suite), fetch<ImageEffectSuite>(image_effect_suite),
         fetch<ParameterSuite>(parameter_suite), fetch<MessageSuite>(message_suite)};
  return all.property && all.effect && all.parameter;
}

void Properties::set(const char* name, const std::string& value, int index) const {
  (void)all.property->set_string(set_, name, index, value.c_str());
}
void Properties::set(const char* name, const char* value, int index) const {
  (void)all.property->set_string(set_, name, index, value);
}
void Properties::set(const char* name, int value, int index) const {
  (void)all.property->set_int(set_, name, index, value);
}
void Properties::set(const char* name, double value, int index) const {
  (void)all.property->set_double(set_, name, index, value);
}
void Properties::set_pointer(const char* name, void* value) const {
  (void)all.property->set_pointer(set_, name, 0, value);
}

std::string Properties::text(const char* name) const {
  char* value = nullptr;
  return all.property->get_string(set_, name, 0, &value) == ok && value ? value : "";
}

int Properties::integer(const char* name, int otherwise) const {
  int value = 0;
  return all.property->get_int(set_, name, 0, &value) == ok ? value : otherwise;
}

double Properties::number(const char* name, double otherwise, int index) const {
  double value = 0;
  return all.property->get_double(set_, name, index, &value) == ok ? value : otherwise;
}

void* Properties::pointer(const char* name) const {
  void* value = nullptr;
  return all.property->get_pointer(set_, name, 0, &value) == ok ? value : nullptr;
}

std::optional<RectI> Properties::rectangle(const char* name) const {
  int v[4] = {};
  if (all.property->get_ints(set_, name, 4, v) != ok) return std::nullopt;
  return RectI{v[0], v[1], v[2], v[3]};
}

Properties host_properties() noexcept { return Properties(host ? host->host : nullptr); }

void show_error(ImageEffect effect, const std::string& text) noexcept {
  if (all.message && all.message->message)
    (void)all.message->message(effect, message_error, "scotopic", "%s", text.c_str());
}

}  // namespace scotopic::ofx
