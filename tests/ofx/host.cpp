#include "ofx/host.h"

#include <dlfcn.h>

#include <stdexcept>

#include "ofx/host_suites.h"

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

using namespace ofx;

namespace {

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
  const auto get = reinterpret_cast<ofx::Plugin* (*)(int)>(dlsym(module_, "OfxGetPlugin"));
  if (!count || !get || count() != 1 || get(1)) throw std::runtime_error("not one plug-in");
  plugin_ = get(0);
  leave_out_suite(lacking);
  host_ = {&host_properties_, suite};
  plugin_->set_host(&host_);
}

// The module stays loaded, as in most hosts: OpenImageIO's threads live on in it.
TestHost::~TestHost() { (void)call(action::unload, nullptr); }

Status TestHost::call(const char* action, ImageEffect effect, PropertySet in, PropertySet out) const {
  return plugin_->main_entry(action, effect, in, out);
}

void TestHost::offer_colour(const std::string& style) {
  if (style.empty()) return;
  host_properties_.set(property::colour_style, {style});
  host_properties_.set(property::colour_configs, {std::string(colour::native_config)});
}

Status TestHost::open(const char* context) {
  description_ = {};
  if (const Status status = call(action::load, nullptr); status != ok) return status;
  if (const Status status = call(action::describe, &description_); status != ok) return status;
  PropertySetStruct in;
  in.set(property::context, {std::string(context)});
  return call(action::describe_in_context, &description_, &in);
}

// The lesser of what both can, as the API's specification has it; nothing where one says nothing.
void TestHost::agree_on_colour(ImageEffectStruct& effect) const {
  const std::string offered = host_properties_.text(property::colour_style);
  effect.properties.values.erase(property::colour_style);
  if (offered.empty()) return;
  const bool both = description_.properties.count(property::colour_style) > 0;
  const bool less = offered == colour::basic;
  effect.properties.set(property::colour_style, {std::string(!both  ? colour::none
                                                             : less ? colour::basic
                                                                    : colour::core)});
}

std::unique_ptr<ImageEffectStruct> TestHost::instance() {
  auto out = std::make_unique<ImageEffectStruct>(description_);
  for (auto& [name, param] : out->params.params) {
    param.number = param.properties.number(property::initial);
    param.integer = param.properties.integer(property::initial);
    param.text = param.properties.text(property::initial);
  }
  out->properties.set(property::frame_rate, {24.0});
  agree_on_colour(*out);
  if (call(action::create_instance, out.get()) != ok) throw std::runtime_error("no instance");
  return out;
}

std::vector<std::string> TestHost::take_messages() { return test::take_messages(); }

}  // namespace scotopic::test
