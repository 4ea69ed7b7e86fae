#include "image/oiio_sink.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <algorithm>
#include <cstdio>

#include "image/error.h"
#include "image/oiio_source.h"

namespace scotopic {
namespace {

/// OpenImageIO's stream over an OutputFile. C libraries call it: nothing may be thrown here.
class Proxy : public OIIO::Filesystem::IOProxy {
 public:
  explicit Proxy(OutputFile& file) : IOProxy("", Write), file_(file) {}

  const char* proxytype() const override { return "scotopic"; }
  std::int64_t tell() override { return file_.tell(); }
  bool seek(std::int64_t offset) override {
    file_.seek(offset);
    return true;
  }
  std::size_t read(void* data, std::size_t n) override { return file_.read(data, n); }
  std::size_t write(const void* data, std::size_t n) override { return file_.write(data, n) ? n : 0; }
  std::size_t size() const override { return static_cast<std::size_t>(file_.size()); }

 private:
  OutputFile& file_;
};

OIIO::TypeDesc oiio_type(PixelType type) {
  switch (type) {
    case PixelType::uint8:
      return OIIO::TypeDesc::UINT8;
    case PixelType::uint16:
      return OIIO::TypeDesc::UINT16;
    case PixelType::uint32:
      return OIIO::TypeDesc::UINT32;
    case PixelType::half:
      return OIIO::TypeDesc::HALF;
    case PixelType::float32:
      return OIIO::TypeDesc::FLOAT;
  }
  return OIIO::TypeDesc::UNKNOWN;
}

std::string text_of(const AttributeValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* integer = std::get_if<int>(&value)) return std::to_string(*integer);
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.9g", std::get<double>(value));
  return buffer;
}

/// PNG holds any text; TIFF only that of its own tags, so there the description carries what was applied.
void set_stamps(OIIO::ImageSpec& spec, const std::string& format, const std::vector<Attribute>& stamps) {
  if (format == "png") {
    for (const Attribute& stamp : stamps) spec.attribute(stamp.name, text_of(stamp.value));
    return;
  }
  std::string description = spec.get_string_attribute("ImageDescription");
  for (const Attribute& stamp : stamps)
    description += (description.empty() ? "" : "\n") + stamp.name + "=" + text_of(stamp.value);
  spec.attribute("ImageDescription", description);
}

/// Whether OpenImageIO will write Exif tags: of sRGB it does.
bool has_exif(const OIIO::ImageSpec& spec) {
  const auto is_exif = [](const OIIO::ParamValue& p) {
    return OIIO::Strutil::starts_with(p.name(), "Exif:") || p.name() == "FNumber" ||
           p.name() == "ExposureTime";
  };
  return spec.get_string_attribute("oiio:ColorSpace") == "sRGB" ||
         std::any_of(spec.extra_attribs.begin(), spec.extra_attribs.end(), is_exif);
}

class OiioSink : public PixelSink {
 public:
  OiioSink(std::string format, OutputFile& file, PixelSource& source,
           const std::vector<OutputPicture>& pictures)
      : format_(std::move(format)), file_(file), proxy_(file), pictures_(pictures) {
    for (const OutputPicture& picture : pictures_) specs_.push_back(spec_of(source, picture));
    output_ = OIIO::ImageOutput::create(format_);
    if (!output_) fail("OpenImageIO here has no " + format_ + " writer");
    // OpenImageIO appends pages only to what it can open by name; and where it writes Exif tags into a TIFF
    // it reads the file's directory back, which its streams for writing cannot: the file would be none.
    const bool by_name = pictures_.size() > 1 || (format_ == "tiff" && has_exif(specs_.front()));
    name_ = by_name ? file_.open_name() : file_.path();
    if (!by_name) output_->set_ioproxy(&proxy_);
  }
  ~OiioSink() override {
    if (output_) output_->close();
  }
  OiioSink(const OiioSink&) = delete;
  OiioSink& operator=(const OiioSink&) = delete;

  bool interleaved() const override { return true; }

  void write(std::size_t index, const Band& band) override {
    if (!opened_ || index != current_) open(index);
    const OIIO::ImageSpec& spec = specs_[index];
    const int y1 = band.y0 + band.rows;
    const bool ok = spec.tile_width
                        ? output_->write_tiles(spec.x, spec.x + spec.width, band.y0, y1, 0, 1, spec.format,
                                               band.storage.data())
                        : output_->write_scanlines(band.y0, y1, 0, spec.format, band.storage.data());
    if (!ok) fail(output_->geterror());
    file_.check();
  }

  void copy(std::size_t) override { fail("chunks can only be copied from OpenEXR to OpenEXR"); }

  void finish() override {
    const bool closed = output_->close();
    file_.check();
    if (!closed) fail(output_->geterror());
    output_.reset();
  }

 private:
  void open(std::size_t index) {
    const auto mode = opened_ ? OIIO::ImageOutput::AppendSubimage : OIIO::ImageOutput::Create;
    if (!output_->open(name_, specs_[index], mode)) fail(output_->geterror());
    opened_ = true;
    current_ = index;
  }

  OIIO::ImageSpec spec_of(const PixelSource& source, const OutputPicture& out) const {
    const auto* oiio = dynamic_cast<const OiioSource*>(&source);
    const Picture& picture = out.picture;
    OIIO::ImageSpec spec = oiio ? oiio->spec(out.source) : OIIO::ImageSpec();
    set_geometry(spec, picture);
    if (!oiio) {
      spec.attribute("compression", "zip");
      for (const Attribute& a : source.attributes(out.source))
        if (const auto* text = std::get_if<std::string>(&a.value); text && a.name != "type")
          spec.attribute(a.name == "comments" ? "ImageDescription" : a.name, *text);
    }
    if (source.format() != format_) spec.tile_width = spec.tile_height = spec.tile_depth = 0;
    if (source.format() == "jpeg") spec.attribute("compression", "zip");  // pixels as computed, not lossy
    if (format_ == "jpeg") {
      spec.attribute("compression", "jpeg:" + std::to_string(out.jpeg_quality));
      spec.attribute("jpeg:subsampling", "4:4:4");
    }
    spec.erase_attribute("oiio:BitsPerSample");
    if (out.new_space) spec.erase_attribute("ICCProfile");
    if (out.new_space || !oiio) spec.attribute("oiio:ColorSpace", out.srgb ? "sRGB" : "Linear");
    // The profile alone says what the values mean.
    if (out.profile) set_profile(spec, out.profile->bytes());
    spec.attribute("oiio:UnassociatedAlpha", picture.unassociated_alpha ? 1 : 0);
    set_stamps(spec, format_, out.stamps);
    return spec;
  }

  static void set_profile(OIIO::ImageSpec& spec, const std::vector<std::byte>& profile) {
    for (const char* name : {"oiio:ColorSpace", "oiio:Gamma", "png:gAMA", "Exif:ColorSpace"}) spec.erase_attribute(name);
    spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())), profile.data());
  }

  static void set_geometry(OIIO::ImageSpec& spec, const Picture& picture) {
    spec.x = picture.data.x0;
    spec.y = picture.data.y0;
    spec.width = picture.data.width();
    spec.height = picture.data.height();
    spec.depth = 1;
    spec.full_x = picture.display.x0;
    spec.full_y = picture.display.y0;
    spec.full_width = picture.display.width();
    spec.full_height = picture.display.height();
    spec.full_depth = 1;
    spec.nchannels = static_cast<int>(picture.channels.size());
    spec.channelformats.clear();
    spec.channelnames.clear();
    spec.alpha_channel = -1;
    for (const Channel& channel : picture.channels) {
      if (channel.name == "A") spec.alpha_channel = static_cast<int>(spec.channelnames.size());
      spec.channelnames.push_back(channel.name);
    }
    spec.set_format(oiio_type(picture.channels.front().type));
  }

  [[noreturn]] void fail(const std::string& what) const {
    file_.check();
    std::string line = what;
    std::replace(line.begin(), line.end(), '\n', ' ');
    throw Error(ExitCode::output, file_.path(), "cannot write: " + line);
  }

  std::string format_;
  std::string name_;
  OutputFile& file_;
  Proxy proxy_;
  std::vector<OutputPicture> pictures_;
  std::vector<OIIO::ImageSpec> specs_;
  std::unique_ptr<OIIO::ImageOutput> output_;
  bool opened_ = false;
  std::size_t current_ = 0;
};

}  // namespace

std::unique_ptr<PixelSink> open_oiio_sink(const std::string& format, OutputFile& file, PixelSource& source,
                                          const std::vector<OutputPicture>& pictures) {
  return std::make_unique<OiioSink>(format, file, source, pictures);
}

}  // namespace scotopic
