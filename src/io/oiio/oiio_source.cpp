#include "io/oiio/oiio_source.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <array>
#include <map>
#include <mutex>

namespace scotopic {
namespace {

std::optional<PixelType> pixel_type(OIIO::TypeDesc type) {
  static const std::map<unsigned char, PixelType> types = {{OIIO::TypeDesc::UINT8, PixelType::uint8},
                                                           {OIIO::TypeDesc::UINT16, PixelType::uint16},
                                                           {OIIO::TypeDesc::HALF, PixelType::half},
                                                           {OIIO::TypeDesc::FLOAT, PixelType::float32}};
  const auto found = types.find(type.basetype);
  return found == types.end() ? std::nullopt : std::optional<PixelType>(found->second);
}

std::optional<double> float_attribute(const OIIO::ImageSpec& spec, const char* name) {
  if (!spec.find_attribute(name)) return std::nullopt;
  const auto value = static_cast<double>(spec.get_float_attribute(name, 0.0f));
  return value > 0 ? std::optional<double>(value) : std::nullopt;
}

/// libpng prints its complaints itself; while one of these lives, nobody hears them. They come back as return
/// values. Several threads may read at once: the first takes descriptor 2 away, the last gives it back.
class StderrHeld {
 public:
  StderrHeld() {
    const std::lock_guard guard(lock);
    if (holders++ > 0) return;
    before = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
    const int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (before >= 0 && nothing >= 0) dup2(nothing, STDERR_FILENO);
    if (nothing >= 0) close(nothing);
  }
  ~StderrHeld() {
    const std::lock_guard guard(lock);
    if (--holders > 0 || before < 0) return;
    dup2(before, STDERR_FILENO);
    close(before);
    before = -1;
  }
  StderrHeld(const StderrHeld&) = delete;
  StderrHeld& operator=(const StderrHeld&) = delete;

 private:
  static inline std::mutex lock;
  static inline int holders = 0;
  static inline int before = -1;
};

/// What OpenImageIO's readers keep: a tile, or the rows of a strip.
std::int64_t bytes_held_by_oiio(const OIIO::ImageSpec& spec) {
  const auto pixel = static_cast<std::int64_t>(spec.pixel_bytes(true));
  const std::int64_t strip =
      std::clamp(spec.get_int_attribute("tiff:RowsPerStrip", 1), 1, std::max(1, spec.height));
  if (spec.tile_width == 0) return pixel * spec.width * strip;
  return pixel * spec.tile_width * std::max(1, spec.tile_height);
}

/// A Radiance file that says of its format what OpenImageIO's reader knows: pixels of xyze are stored as
/// those of rgbe are.
class RadianceAsRgbe : public OIIO::Filesystem::IOFile {
 public:
  RadianceAsRgbe(const std::string& file, std::uint64_t at) : IOFile(file, Read), at_(at) {}

  std::size_t read(void* to, std::size_t size) override {
    const auto from = static_cast<std::uint64_t>(tell());
    return patched(to, from, IOFile::read(to, size));
  }
  std::size_t pread(void* to, std::size_t size, std::int64_t from) override {
    return patched(to, static_cast<std::uint64_t>(from), IOFile::pread(to, size, from));
  }

 private:
  std::size_t patched(void* to, std::uint64_t from, std::size_t got) const {
    constexpr char rgbe[] = "rgbe";
    for (std::uint64_t i = 0; i < 4; ++i)
      if (at_ + i >= from && at_ + i < from + got) static_cast<char*>(to)[at_ + i - from] = rgbe[i];
    return got;
  }

  std::uint64_t at_;
};

/// Grey images name their channel in many ways; EXR's is Y.
void name_grey(std::vector<Channel>& channels) {
  const bool alpha = channels.size() == 2 && channels[1].name == "A";
  if (channels.size() == 1 || alpha) channels[0].name.assign(1, 'Y');
}

}  // namespace

OiioSource::OiioSource(const std::string& file, const std::string& format, const Limits& limits)
    : PixelSource(file, format), input_(OIIO::ImageInput::create(format)) {
  if (!input_) fail("cannot be read: OpenImageIO here has no " + format + " reader");
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);  // alpha as the file has it
  OIIO::ImageSpec spec;
  const StderrHeld held;
  watch(file);
  scans_ = scan_image(file, format);
  // Before the library, whose own limits differ from release to release.
  for (const ImageScan& scan : scans_) {
    check_limit(file, "side", std::max(scan.width, scan.height), limits.side, "--max-side");
    check_limit_product(file, "pixels", scan.width, scan.height, limits.pixels, "--max-pixels");
  }
  if (!scans_.empty() && scans_.front().xyze_at > 0) read_xyze_as_rgbe(scans_.front().xyze_at);
  if (!input_->open(file, spec, hints)) fail("is not a valid " + format + " file: " + input_->geterror());
  for (int page = 0; input_->seek_subimage(page, 0); ++page) {
    add_subimage(page, input_->spec());
    check_limits(limits);
    if (input_->seek_subimage(page, 1))
      subimages_.back().notes.emplace_back("its smaller resolutions (mip levels) are left out");
  }
  (void)input_->geterror();  // "no such page" ended the loop
}

void OiioSource::read_xyze_as_rgbe(std::uint64_t at) {
  proxy_ = std::make_unique<RadianceAsRgbe>(file(), at);
  input_->set_ioproxy(proxy_.get());
}

void OiioSource::add_subimage(int page, const OIIO::ImageSpec& spec) {
  Subimage subimage;
  subimage.part = page;
  const std::optional<PixelType> type = pixel_type(spec.format);
  if (!type || !spec.channelformats.empty())
    fail("holds pixels of type " + std::string(spec.format.c_str()) +
         "; uint8, uint16, half and float can be read");
  if (spec.depth > 1) fail("is a volume, not an image");
  subimage.data = {spec.x, spec.y, spec.x + spec.width, spec.y + spec.height};
  subimage.display = {spec.full_x, spec.full_y, spec.full_x + spec.full_width,
                      spec.full_y + spec.full_height};
  for (int c = 0; c < spec.nchannels; ++c) subimage.channels.push_back({spec.channel_name(c), *type});
  name_grey(subimage.channels);
  // Strips need not be met: OpenImageIO buffers them.
  subimage.chunk_rows = spec.tile_width ? spec.tile_height : 1;
  subimage.library_bytes = bytes_held_by_oiio(spec);
  subimage.unassociated_alpha = spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0;
  subimage.white_luminance = float_attribute(spec, "whiteLuminance");
  scans_.resize(std::max(scans_.size(), subimages_.size() + 1));
  ImageScan& scan = scans_[subimages_.size()];
  // Of Radiance's order of pixels OpenImageIO tells by the same name, and two of eight wrongly.
  if (format() != "hdr") scan.orientation = spec.get_int_attribute("Orientation", scan.orientation);
  if (scan.orientation < 1 || scan.orientation > 8) scan.orientation = 1;
  subimage.pixel_aspect = usable_aspect(scan.pixel_aspect);
  if (turns(scan.orientation)) subimage.pixel_aspect = 1 / subimage.pixel_aspect;
  set_colour(subimage, scan);
  set_upright(subimage, scan);
  subimages_.push_back(subimage);
  specs_.push_back(spec);
}

void OiioSource::set_colour(Subimage& subimage, ImageScan& scan) const {
  if (scan.xyze_at > 0)
    for (std::size_t c = 0; c < 3 && c < subimage.channels.size(); ++c)
      subimage.channels[c].name = std::string(1, "XYZ"[c]);
  subimage.colour = scan.colour;
  subimage.panorama = scan.panorama && !turns(scan.orientation);
  subimage.notes.insert(subimage.notes.end(), scan.notes.begin(), scan.notes.end());
  if (scan.gain_map)
    subimage.notes.push_back("its gain map is left out: the picture is the rendition for SDR displays");
  else if (scan.images_behind > 0)
    subimage.notes.push_back(std::to_string(scan.images_behind) +
                             " more images of its Multi-Picture Format are left out");
  if (scan.exposure != 1 || scan.correction != std::array<double, 3>{1, 1, 1})
    subimage.notes.push_back("values are divided by its EXPOSURE and COLORCORR: they are light again");
}

/// A page that is to be turned is read whole, into memory that is planned for.
void OiioSource::set_upright(Subimage& subimage, const ImageScan& scan) const {
  if (scan.orientation == 1) return;
  const int width = subimage.data.width(), height = subimage.data.height();
  subimage.library_bytes += static_cast<std::int64_t>(row_bytes(subimage)) * height;
  subimage.data = turns(scan.orientation) ? Window{0, 0, height, width} : Window{0, 0, width, height};
  subimage.display = subimage.data;
  subimage.chunk_rows = 1;
  subimage.notes.push_back(std::string("is ") + orientation_words(scan.orientation) +
                           " to be upright, as its orientation has it");
}

void OiioSource::read_stored(std::size_t index, int y0, int rows, std::byte* out) {
  const OIIO::ImageSpec& spec = specs_[index];
  const int page = subimages_[index].part;
  const StderrHeld held;
  const bool ok =
      spec.tile_width
          ? input_->read_tiles(page, 0, spec.x, spec.x + spec.width, y0, y0 + rows, spec.z, spec.z + 1, 0,
                               spec.nchannels, spec.format, out)
          : input_->read_scanlines(page, 0, y0, y0 + rows, spec.z, 0, spec.nchannels, spec.format, out);
  if (!ok || input_->has_error()) fail("is truncated or damaged: " + input_->geterror());
}

void OiioSource::read_upright(std::size_t index, int y0, int rows, std::byte* out) {
  const OIIO::ImageSpec& spec = specs_[index];
  if (page_index_ != index) {
    page_.width = static_cast<std::size_t>(spec.width);
    page_.height = static_cast<std::size_t>(spec.height);
    page_.pixel = spec.pixel_bytes(true);
    page_.bytes.resize(page_.width * page_.height * page_.pixel);
    read_stored(index, spec.y, spec.height, page_.bytes.data());
    page_index_ = index;
  }
  copy_upright(page_, scans_[index].orientation, static_cast<std::size_t>(y0), static_cast<std::size_t>(rows),
               out);
}

void OiioSource::correct_exposure(const ImageScan& scan, Band& band) const {
  if (scan.exposure == 1 && scan.correction == std::array<double, 3>{1, 1, 1}) return;
  const std::size_t values = band.storage.size() / sizeof(float);
  const std::size_t channels = band.channels.size();
  auto* const at = reinterpret_cast<float*>(band.storage.data());
  for (std::size_t i = 0; i < values; ++i)
    at[i] =
        static_cast<float>(at[i] / (scan.exposure * scan.correction[std::min<std::size_t>(i % channels, 2)]));
}

void OiioSource::read(std::size_t index, int y0, int rows, Band& band) {
  const Subimage& subimage = subimages_[index];
  band.allocate_interleaved(subimage.channels, y0, rows, subimage.data.width());
  if (scans_[index].orientation == 1)
    read_stored(index, y0, rows, band.storage.data());
  else
    read_upright(index, y0, rows, band.storage.data());
  correct_exposure(scans_[index], band);
}

std::vector<Attribute> OiioSource::attributes(std::size_t index) const {
  std::vector<Attribute> out;
  for (const OIIO::ParamValue& p : specs_[index].extra_attribs) {
    const std::string name(p.name());
    if (p.type() == OIIO::TypeString) out.push_back({name, p.get_string()});
    if (p.type() == OIIO::TypeFloat) out.push_back({name, static_cast<double>(p.get_float())});
    if (p.type() == OIIO::TypeInt) out.push_back({name, p.get_int()});
  }
  return out;
}

std::unique_ptr<PixelSource> open_oiio_source(const std::string& file, const std::string& format,
                                              const Limits& limits) {
  return std::make_unique<OiioSource>(file, format, limits);
}

}  // namespace scotopic
