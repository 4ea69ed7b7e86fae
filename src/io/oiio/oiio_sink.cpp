#include "io/oiio/oiio_sink.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "base/error.h"
#include "io/oiio/oiio_source.h"
#include "io/scan/stale_metadata.h"

namespace scotopic {
namespace {

/// OpenImageIO's stream over an OutputFile. C libraries call it: nothing may be thrown here. Nothing says
/// `override`: tell() is const from OpenImageIO 3.0 on, so that one of its two forms overrides nothing.
class Proxy : public OIIO::Filesystem::IOProxy {
 public:
  explicit Proxy(OutputFile& file) : IOProxy("", Write), file_(file) {}

  const char* proxytype() const { return "scotopic"; }
  std::int64_t tell() { return file_.tell(); }
  std::int64_t tell() const { return file_.tell(); }
  bool seek(std::int64_t offset) {
    file_.seek(offset);
    return true;
  }
  std::size_t read(void* data, std::size_t n) { return file_.read(data, n); }
  std::size_t write(const void* data, std::size_t n) { return file_.write(data, n) ? n : 0; }
  std::size_t size() const { return static_cast<std::size_t>(file_.size()); }

 private:
  OutputFile& file_;
};

/// FNV-1a, gone on with from `hash`.
std::uint64_t hash_of(const std::vector<std::byte>& bytes, std::uint64_t hash) {
  for (const std::byte b : bytes) hash = (hash ^ static_cast<std::uint64_t>(b)) * 0x100000001b3u;
  return hash;
}

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
           const std::vector<OutputSubimage>& subimages)
      : format_(std::move(format)), file_(file), proxy_(file), subimages_(subimages) {
    for (const OutputSubimage& subimage : subimages_) specs_.push_back(spec_of(source, subimage));
    output_ = OIIO::ImageOutput::create(format_);
    if (!output_) fail("OpenImageIO here has no " + format_ + " writer");
    // OpenImageIO appends pages only to what it can open by name; and where it writes Exif tags into a TIFF
    // it reads the file's directory back, which its streams for writing cannot: the file would be none. What
    // goes wrong in a file opened by name it does not always report: such files are made in memory.
    if (by_name()) memory_ = memfd_create("scotopic-pages", MFD_CLOEXEC);
    if (by_name() && memory_ < 0) fail(std::strerror(errno));
    name_ = by_name() ? "/proc/self/fd/" + std::to_string(memory_) : file_.path();
    if (!by_name()) output_->set_ioproxy(&proxy_);
    hashes_.resize(subimages_.size());
  }
  ~OiioSink() override {
    if (output_) output_->close();
    if (memory_ >= 0) close(memory_);
  }
  OiioSink(const OiioSink&) = delete;
  OiioSink& operator=(const OiioSink&) = delete;

  bool interleaved() const override { return true; }

  void write(std::size_t index, const Band& band) override {
    if (!opened_ || index != current_) open(index);
    const OIIO::ImageSpec& spec = specs_[index];
    const int y0 = band.y0 - subimages_[index].subimage.data.y0 + spec.y, y1 = y0 + band.rows;
    const bool ok = spec.tile_width ? output_->write_tiles(spec.x, spec.x + spec.width, y0, y1, 0, 1,
                                                           spec.format, band.storage.data())
                                    : output_->write_scanlines(y0, y1, 0, spec.format, band.storage.data());
    if (!ok) fail(output_->geterror());
    file_.check();
    hashes_[index] = hash_of(band.storage, hashes_[index]);
  }

  void copy(std::size_t) override { fail("chunks can only be copied from OpenEXR to OpenEXR"); }

  void finish() override {
    const bool closed = output_->close();
    file_.check();
    if (!closed) fail(output_->geterror());
    output_.reset();
    if (!by_name()) return;
    read_back();
    copy_from_memory();
  }

 private:
  bool by_name() const { return subimages_.size() > 1 || (format_ == "tiff" && has_exif(specs_.front())); }

  void copy_from_memory() {
    std::vector<std::byte> piece(std::size_t{1} << 20);
    for (std::int64_t at = 0;;) {
      const ssize_t n = pread(memory_, piece.data(), piece.size(), at);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail(std::strerror(errno));
      if (n == 0) break;
      file_.write(piece.data(), static_cast<std::size_t>(n));
      at += n;
    }
    file_.check();
  }

  /// What libtiff itself writes it does not report: pages are compared with what was to be written.
  void read_back() const {
    const auto input = OIIO::ImageInput::create(format_);
    OIIO::ImageSpec spec, hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    if (!input || !input->open(name_, spec, hints)) fail("it cannot be read back");
    for (std::size_t page = 0; page < subimages_.size(); ++page)
      if (!same_page(*input, page))
        fail("page " + std::to_string(page + 1) + " reads back as something else");
  }

  bool same_page(OIIO::ImageInput& input, std::size_t page) const {
    if (!input.seek_subimage(static_cast<int>(page), 0)) return false;
    const OIIO::ImageSpec& meant = specs_[page];
    const OIIO::ImageSpec got = input.spec();
    if (got.width != meant.width || got.height != meant.height || got.nchannels != meant.nchannels ||
        got.format != meant.format ||
        got.get_string_attribute("ImageDescription") != meant.get_string_attribute("ImageDescription"))
      return false;
    const int rows = got.tile_width ? got.tile_height : 16;
    std::vector<std::byte> pixels;
    std::uint64_t hash = 0;
    for (int y = got.y; y < got.y + got.height; y += rows) {
      const int end = std::min(y + rows, got.y + got.height);
      pixels.resize(static_cast<std::size_t>(end - y) * got.scanline_bytes(true));
      const bool ok = got.tile_width
                          ? input.read_tiles(static_cast<int>(page), 0, got.x, got.x + got.width, y, end,
                                             got.z, got.z + 1, 0, got.nchannels, got.format, pixels.data())
                          : input.read_scanlines(static_cast<int>(page), 0, y, end, got.z, 0, got.nchannels,
                                                 got.format, pixels.data());
      if (!ok) return false;
      hash = hash_of(pixels, hash);
    }
    return hash == hashes_[page];
  }

  void open(std::size_t index) {
    const auto mode = opened_ ? OIIO::ImageOutput::AppendSubimage : OIIO::ImageOutput::Create;
    if (!output_->open(name_, specs_[index], mode)) fail(output_->geterror());
    opened_ = true;
    current_ = index;
  }

  OIIO::ImageSpec spec_of(const PixelSource& source, const OutputSubimage& out) const {
    const auto* oiio = dynamic_cast<const OiioSource*>(&source);
    const Subimage& subimage = out.subimage;
    OIIO::ImageSpec spec = oiio ? oiio->spec(out.source) : OIIO::ImageSpec();
    set_geometry(spec, subimage);
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
    // zlib's 4 takes half the time of its 6 for 1 to 9 % more bytes (PNG of 1080p, 16 and 8 bits: 0.48 for
    // 0.88 s, 0.26 for 0.41; TIFF of 16 bits, 2 megapixels: 0.49 for 1.07).
    if (format_ == "png") spec.attribute("png:compressionLevel", 4);
    if (format_ == "tiff") spec.attribute("tiff:zipquality", 4);
    spec.erase_attribute("oiio:BitsPerSample");
    spec.attribute("Orientation", 1);  // sources are upright
    set_aspect(spec, subimage.pixel_aspect);
    erase_if(spec, describes_pixels);
    spec.attribute("ImageDescription", without_pixel_facts(spec.get_string_attribute("ImageDescription")));
    if (const bool anew = out.new_tags || out.tags.icc; anew) {
      erase_if(spec, describes_colours);
      if (out.tags.srgb) spec.attribute("oiio:ColorSpace", "sRGB");
      if (out.tags.linear) spec.attribute("oiio:ColorSpace", "Linear");
    }
    if (needs_profile(out.tags)) set_profile(spec, *out.tags.icc);
    spec.attribute("oiio:UnassociatedAlpha", subimage.unassociated_alpha ? 1 : 0);
    set_stamps(spec, format_, out.stamps);
    return spec;
  }

  static void erase_if(OIIO::ImageSpec& spec, bool (*stale)(std::string_view)) {
    std::vector<std::string> names;
    for (const OIIO::ParamValue& p : spec.extra_attribs)
      if (stale(p.name().string())) names.push_back(p.name().string());
    for (const std::string& name : names) spec.erase_attribute(name);
  }

  /// By pixels per unit across and down; OpenImageIO's own way inverts it in JPEG.
  void set_aspect(OIIO::ImageSpec& spec, double aspect) const {
    constexpr float across = 100;
    spec.erase_attribute("PixelAspectRatio");
    if (aspect == 1) return;
    if (format_ != "jpeg") spec.attribute("PixelAspectRatio", static_cast<float>(aspect));
    spec.attribute("XResolution", across);
    spec.attribute("YResolution", static_cast<float>(across * aspect));
    spec.attribute("ResolutionUnit", "none");
  }

  /// Linear light of BT.709 is what float TIFF is taken to be, and gAMA 1 says it in PNG.
  bool needs_profile(const WrittenTags& tags) const {
    if (!tags.icc) return false;
    const NamedPrimaries* known = tags.linear && tags.primaries ? match_primaries(*tags.primaries) : nullptr;
    const bool usual = known && known->name == "rec709";
    return !usual || !(format_ == "png" || !is_integer(subimages_.front().subimage.channels.front().type));
  }

  static void set_profile(OIIO::ImageSpec& spec, const std::vector<std::byte>& profile) {
    // The profile alone says what the values mean.
    for (const char* name : {"oiio:ColorSpace", "oiio:Gamma", "png:gAMA", "Exif:ColorSpace"})
      spec.erase_attribute(name);
    spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())),
                   profile.data());
  }

  void set_geometry(OIIO::ImageSpec& spec, const Subimage& subimage) const {
    spec.x = subimage.data.x0;
    spec.y = subimage.data.y0;
    spec.width = subimage.data.width();
    spec.height = subimage.data.height();
    spec.depth = 1;
    spec.full_x = subimage.display.x0;
    spec.full_y = subimage.display.y0;
    spec.full_width = subimage.display.width();
    spec.full_height = subimage.display.height();
    spec.full_depth = 1;
    // PNG and JPEG have no place for an offset, TIFF none for a negative one.
    if (format_ != "tiff" || spec.x < 0 || spec.y < 0) {
      spec.x = spec.y = spec.full_x = spec.full_y = 0;
      spec.full_width = spec.width;
      spec.full_height = spec.height;
    }
    spec.nchannels = static_cast<int>(subimage.channels.size());
    spec.channelformats.clear();
    spec.channelnames.clear();
    spec.alpha_channel = -1;
    for (const Channel& channel : subimage.channels) {
      if (channel.name == "A") spec.alpha_channel = static_cast<int>(spec.channelnames.size());
      spec.channelnames.push_back(channel.name);
    }
    spec.set_format(oiio_type(subimage.channels.front().type));
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
  std::vector<OutputSubimage> subimages_;
  std::vector<OIIO::ImageSpec> specs_;
  int memory_ = -1;                    // a file of several pages, until it is whole
  std::vector<std::uint64_t> hashes_;  // of the pixels of each page
  std::unique_ptr<OIIO::ImageOutput> output_;
  bool opened_ = false;
  std::size_t current_ = 0;
};

}  // namespace

std::unique_ptr<PixelSink> open_oiio_sink(const std::string& format, OutputFile& file, PixelSource& source,
                                          const std::vector<OutputSubimage>& subimages) {
  return std::make_unique<OiioSink>(format, file, source, subimages);
}

}  // namespace scotopic
