// The host's suites, and its property sets as C++ values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ofx/api.h"

namespace scotopic::ofx {

/// Those that are used; all there after fetch().
struct Suites {
  const PropertySuite* property = nullptr;
  const ImageEffectSuite* effect = nullptr;
  const ParameterSuite* parameter = nullptr;
  const MessageSuite* message = nullptr;  ///< may be missing
};

/// Of the host that loaded the plug-in.
const Suites& suites() noexcept;
void set_host(Host* host) noexcept;
/// False if the host lacks one that is needed.
bool fetch_suites() noexcept;

/// A property set. Setting goes on silently where a host does not know a property; reading has a default.
class Properties {
 public:
  explicit Properties(PropertySet set) : set_(set) {}

  void set(const char* name, const std::string& value, int index = 0) const;
  void set(const char* name, const char* value, int index = 0) const;
  void set(const char* name, int value, int index = 0) const;
  void set(const char* name, double value, int index = 0) const;
  void set_pointer(const char* name, void* value) const;

  std::string text(const char* name) const;
  int integer(const char* name, int otherwise) const;
  double number(const char* name, double otherwise, int index = 0) const;
  void* pointer(const char* name) const;
  std::optional<RectI> rectangle(const char* name) const;

 private:
  PropertySet set_;
};

/// The host's own.
Properties host_properties() noexcept;

/// Tells the user of the host.
void show_error(ImageEffect effect, const std::string& text) noexcept;

}  // namespace scotopic::ofx
