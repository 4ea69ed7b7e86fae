// OpenEXR output: the source's headers with new colour channels; whatever else they say is kept.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfDeepScanLineInputPart.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfDeepTiledInputPart.h>
#include <OpenEXR/ImfDeepTiledOutputPart.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledOutputPart.h>

#include <map>
#include <new>
#include <set>
#include <stdexcept>

#include "base/error.h"
#include "io/exr/exr_source.h"
#include "io/exr/open_exr.h"
#include "io/pixel_sink.h"
#include "io/scan/stale_metadata.h"

namespace scotopic {
namespace {

/// OpenEXR's stream over an OutputFile. Its own destructors swallow failures; the file remembers them.
class ExrStream : public Imf::OStream {
 public:
  explicit ExrStream(OutputFile& file) : Imf::OStream(file.path().c_str()), file_(file) {}

  void write(const char data[], int size) override {
    if (!file_.write(data, static_cast<std::size_t>(size))) file_.check();
  }
  std::uint64_t tellp() override { return static_cast<std::uint64_t>(file_.tell()); }
  void seekp(std::uint64_t position) override { file_.seek(static_cast<std::int64_t>(position)); }

 private:
  OutputFile& file_;
};

/// The same file, read back.
class ExrReadBack : public Imf::IStream {
 public:
  explicit ExrReadBack(OutputFile& file) : Imf::IStream(file.path().c_str()), file_(file) { file_.seek(0); }

  bool read(char data[], int size) override {
    const auto wanted = static_cast<std::size_t>(size);
    if (file_.read(data, wanted) != wanted) throw std::runtime_error("it ends too early");
    return file_.tell() < file_.size();
  }
  std::uint64_t tellg() override { return static_cast<std::uint64_t>(file_.tell()); }
  void seekg(std::uint64_t position) override { file_.seek(static_cast<std::int64_t>(position)); }

 private:
  OutputFile& file_;
};

void set_attribute(Imf::Header& header, const Attribute& attribute) {
  const char* name = attribute.name.c_str();
  header.erase(name);  // OpenEXR holds to the type that it had
  if (const auto* text = std::get_if<std::string>(&attribute.value))
    header.insert(name, Imf::StringAttribute(*text));
  else if (const auto* number = std::get_if<double>(&attribute.value))
    header.insert(name, Imf::FloatAttribute(static_cast<float>(*number)));
  else
    header.insert(name, Imf::IntAttribute(std::get<int>(attribute.value)));
}

void set_channels(Imf::Header& header, const std::vector<Channel>& channels) {
  const Imf::ChannelList before = header.channels();
  Imf::ChannelList list;
  for (const Channel& channel : channels) {
    const Imf::Channel* known = before.findChannel(channel.name);
    Imf::Channel made = known ? *known : Imf::Channel();
    made.type = exr_type(channel.type);
    list.insert(channel.name, made);
  }
  header.channels() = list;
}

/// Text, numbers and dates of other formats under the names that OpenEXR users look for.
void set_foreign_attributes(Imf::Header& header, const std::vector<Attribute>& attributes) {
  static const std::map<std::string, std::string> standard = {
      {"ImageDescription", "comments"}, {"Copyright", "owner"}, {"DateTime", "capDate"}};
  // What describes the other file's storage says nothing of this one.
  static const std::set<std::string> storage = {"compression",  "planarconfig",    "Software",
                                                "Orientation",  "XResolution",     "YResolution",
                                                "rowsperstrip", "PixelAspectRatio"};
  for (const Attribute& attribute : attributes) {
    const bool foreign =
        attribute.name.find(':') != std::string::npos && attribute.name.rfind("scotopic:", 0) != 0;
    const auto renamed = standard.find(attribute.name);
    Attribute out = attribute;
    if (renamed != standard.end()) out.name = renamed->second;
    if (foreign || storage.count(out.name) || header.find(out.name.c_str()) != header.end()) continue;
    set_attribute(header, out);
  }
}

/// Compressions that change pixels would undo the promise that an untouched one keeps its bits, and they
/// spend their precision on daylight: such subimages are written with ZIP.
void make_lossless(Imf::Header& header) {
  const Imf::Compression c = header.compression();
  const bool lossy = c == Imf::B44_COMPRESSION || c == Imf::B44A_COMPRESSION || c == Imf::DWAA_COMPRESSION ||
                     c == Imf::DWAB_COMPRESSION || c == Imf::PXR24_COMPRESSION;
  if (!lossy) return;
  header.compression() = Imf::ZIP_COMPRESSION;
  header.erase("dwaCompressionLevel");
}

Imf::Header make_header(const PixelSource& source, const Subimage& subimage, std::size_t index) {
  const auto box = [](const Window& w) { return Imath::Box2i({w.x0, w.y0}, {w.x1 - 1, w.y1 - 1}); };
  Imf::Header header(box(subimage.display), box(subimage.data), static_cast<float>(subimage.pixel_aspect));
  header.setType(Imf::SCANLINEIMAGE);
  header.compression() = Imf::ZIP_COMPRESSION;
  set_foreign_attributes(header, source.attributes(index));
  return header;
}

class ExrSink : public PixelSink {
 public:
  ExrSink(OutputFile& file, PixelSource& source, const std::vector<OutputSubimage>& subimages)
      : file_(file), stream_(file), source_(dynamic_cast<ExrSource*>(&source)), subimages_(subimages) {
    // Resolutions of one part are subimages of their own, but share a header.
    std::map<int, int> part_of_source;
    for (const OutputSubimage& out : subimages_) {
      const auto [found, added] =
          part_of_source.emplace(out.subimage.part, static_cast<int>(headers_.size()));
      parts_.push_back(found->second);
      if (added) headers_.push_back(header_of(source, out));
    }
    guarded([&] {
      exr_ = std::make_unique<Imf::MultiPartOutputFile>(stream_, headers_.data(),
                                                        static_cast<int>(headers_.size()));
    });
  }

  bool interleaved() const override { return false; }

  void write(std::size_t index, const Band& band) override {
    guarded([&] {
      const Subimage& subimage = subimages_[index].subimage;
      const Imf::FrameBuffer frame = frame_buffer(subimage.channels, band, subimage.data.x0);
      const int part = parts_[index];
      if (headers_[static_cast<std::size_t>(part)].hasTileDescription()) {
        write_tiles(subimage, frame, part, band);
      } else {
        Imf::OutputPart out(*exr_, part);
        out.setFrameBuffer(frame);
        out.writePixels(band.rows);
      }
    });
  }

  void copy(std::size_t index) override {
    guarded([&] {
      const int from = subimages_[index].subimage.part;
      const Imf::Header& header = source_->header(from);
      const std::string type = header.hasType() ? header.type() : "";
      if (type == Imf::DEEPSCANLINE)
        copy_part<Imf::DeepScanLineOutputPart, Imf::DeepScanLineInputPart>(parts_[index], from);
      else if (type == Imf::DEEPTILE)
        copy_part<Imf::DeepTiledOutputPart, Imf::DeepTiledInputPart>(parts_[index], from);
      else if (header.hasTileDescription())
        copy_part<Imf::TiledOutputPart, Imf::TiledInputPart>(parts_[index], from);
      else
        copy_part<Imf::OutputPart, Imf::InputPart>(parts_[index], from);
    });
  }

  void finish() override {
    guarded([&] { exr_.reset(); });  // writes the chunk tables
    // Where memory ends within a thread of its own OpenEXR leaves a chunk out and says nothing.
    guarded([&] {
      ExrReadBack stream(file_);
      const auto written = open_exr(stream);
      for (int part = 0; part < written->parts(); ++part)
        if (!written->partComplete(part)) throw std::runtime_error("a chunk of it is missing");
    });
  }

 private:
  static Imf::Header header_of(const PixelSource& source, const OutputSubimage& out) {
    const auto* exr = dynamic_cast<const ExrSource*>(&source);
    if (exr && out.copy) return exr->header(out.subimage.part);
    Imf::Header header = exr ? exr->header(out.subimage.part) : make_header(source, out.subimage, out.source);
    set_channels(header, out.subimage.channels);
    make_lossless(header);
    erase_if(header, describes_pixels);
    if (out.new_tags) {
      erase_if(header, describes_colours);
      if (out.tags.primaries) set_primaries(header, *out.tags.primaries);
      if (out.tags.adopted_neutral) Imf::addAdoptedNeutral(header, v2f(*out.tags.adopted_neutral));
    }
    if (out.for_a_device) header.erase("whiteLuminance");
    for (const Attribute& stamp : out.stamps) set_attribute(header, stamp);
    return header;
  }

  static void erase_if(Imf::Header& header, bool (*stale)(std::string_view)) {
    std::vector<std::string> names;
    for (auto it = header.begin(); it != header.end(); ++it)
      if (stale(it.name())) names.push_back(it.name());
    for (const std::string& name : names) header.erase(name);
  }

  static Imath::V2f v2f(Xy c) { return {static_cast<float>(c.x), static_cast<float>(c.y)}; }

  static void set_primaries(Imf::Header& header, const Primaries& p) {
    Imf::addChromaticities(header, Imf::Chromaticities(v2f(p.red), v2f(p.green), v2f(p.blue), v2f(p.white)));
  }

  void write_tiles(const Subimage& subimage, const Imf::FrameBuffer& frame, int part, const Band& band) {
    Imf::TiledOutputPart out(*exr_, part);
    out.setFrameBuffer(frame);
    const int first = (band.y0 - subimage.data.y0) / subimage.chunk_rows;
    const int last = (band.y0 + band.rows - 1 - subimage.data.y0) / subimage.chunk_rows;
    out.writeTiles(0, out.numXTiles(subimage.level_x) - 1, first, last, subimage.level_x, subimage.level_y);
  }

  template <typename Out, typename In>
  void copy_part(int to, int from) {
    In in(source_->exr(), from);
    Out out(*exr_, to);
    out.copyPixels(in);
  }

  template <typename Action>
  void guarded(Action action) {
    try {
      action();
    } catch (const Error&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& e) {
      file_.check();
      throw Error(ExitCode::output, file_.path(), std::string("cannot write: ") + e.what());
    }
    file_.check();
  }

  OutputFile& file_;
  ExrStream stream_;
  ExrSource* source_;
  std::vector<OutputSubimage> subimages_;
  std::vector<int> parts_;  // of the output, one for each subimage
  std::vector<Imf::Header> headers_;
  std::unique_ptr<Imf::MultiPartOutputFile> exr_;
};

}  // namespace

std::unique_ptr<PixelSink> open_exr_sink(OutputFile& file, PixelSource& source,
                                         const std::vector<OutputSubimage>& subimages) {
  return std::make_unique<ExrSink>(file, source, subimages);
}

}  // namespace scotopic
