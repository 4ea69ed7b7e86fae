#include "ofx/image.h"

#include <algorithm>
#include <string>

#include "base/error.h"

namespace scotopic::ofx {
namespace {

[[noreturn]] void fail(const std::string& what) { throw Error(ExitCode::input, "", what); }

bool is_empty(const RectI& r) { return r.x2 <= r.x1 || r.y2 <= r.y1; }

int channels_of(const std::string& components) {
  if (components == rgba) return 4;
  if (components == rgb) return 3;
  fail("the image is neither RGB nor RGBA: " + components);
}

SampleType type_of(const std::string& depth) {
  if (depth == depth_float) return SampleType::float32;
  if (depth == depth_half) return SampleType::half;
  fail("the image is neither of float nor of half: " + depth);
}

}  // namespace

Image::Image(Clip clip, Time time) {
  if (suites().effect->clip_get_image(clip, time, nullptr, &set_) != ok || !set_) {
    set_ = nullptr;
    fail("the host has no image at this time");
  }
  try {
    const Properties p(set_);
    channels_ = channels_of(p.text(property::components));
    type_ = type_of(p.text(property::pixel_depth));
    data_ = static_cast<std::byte*>(p.pointer(property::data));
    row_bytes_ = p.integer(property::row_bytes, 0);
    bounds_ = p.rectangle(property::bounds).value_or(RectI{});
    frame_ = p.rectangle(property::region_of_definition).value_or(bounds_);
    if (is_empty(frame_)) frame_ = bounds_;
    if (!data_ || is_empty(bounds_)) fail("the host's image has no pixels");
  } catch (...) {
    (void)suites().effect->clip_release_image(set_);
    throw;
  }
}

Image::~Image() { (void)suites().effect->clip_release_image(set_); }

MemoryPixels Image::pixels(const RectI& window) const {
  MemoryPixels out;
  out.type = type_;
  out.channels = channels_;
  out.channel_stride = static_cast<std::ptrdiff_t>(size_of(type_));
  out.pixel_stride = channels_ * out.channel_stride;
  out.row_stride = -row_bytes_;
  out.width = window.x2 - window.x1;
  out.height = window.y2 - window.y1;
  out.data = data_ + (window.y2 - 1 - bounds_.y1) * row_bytes_ + (window.x1 - bounds_.x1) * out.pixel_stride;
  return out;
}

bool Image::straight() const { return Properties(set_).text(property::premultiplication) == unpremultiplied; }

double Image::pixel_aspect() const { return Properties(set_).number(property::pixel_aspect, 1); }

Window window_in(const RectI& window, const RectI& frame) {
  return {window.x1 - frame.x1, frame.y2 - window.y2, window.x2 - frame.x1, frame.y2 - window.y1};
}

RectI grown(const RectI& window, int by) {
  return {window.x1 - by, window.y1 - by, window.x2 + by, window.y2 + by};
}

bool holds(const RectI& a, const RectI& b) {
  return a.x1 <= b.x1 && a.y1 <= b.y1 && a.x2 >= b.x2 && a.y2 >= b.y2;
}

RectI common(const RectI& a, const RectI& b) {
  const RectI both = {std::max(a.x1, b.x1), std::max(a.y1, b.y1), std::min(a.x2, b.x2), std::min(a.y2, b.y2)};
  return is_empty(both) ? RectI{a.x1, a.y1, a.x1, a.y1} : both;
}

}  // namespace scotopic::ofx
