#include "files/made_files.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <lcms2.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "cli/run_program.h"

namespace scotopic::test {
namespace {

constexpr int side = 4;

Imf::Header header_of(const FlatPart& part) {
  Imf::Header header(side, side);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.setType(Imf::SCANLINEIMAGE);
  if (!part.name.empty()) header.setName(part.name);
  for (const FlatChannel& c : part.channels)
    header.channels().insert(c.name, Imf::Channel(static_cast<Imf::PixelType>(c.type)));
  if (part.more) part.more(header);
  return header;
}

}  // namespace

void write_flat_exr(const std::string& file, const std::vector<FlatPart>& parts) {
  std::vector<Imf::Header> headers;
  for (const FlatPart& part : parts) headers.push_back(header_of(part));
  Imf::MultiPartOutputFile out(file.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (std::size_t p = 0; p < parts.size(); ++p) {
    std::vector<std::vector<char>> values(parts[p].channels.size());
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < values.size(); ++c) {
      const FlatChannel& channel = parts[p].channels[c];
      const Imf::Channel& made = *headers[p].channels().findChannel(channel.name);
      const Imath::half half(channel.value);
      const auto integer = static_cast<std::uint32_t>(channel.value);
      const std::size_t size = channel.type == Imf::HALF ? 2 : 4;
      const void* const value = channel.type == Imf::UINT   ? static_cast<const void*>(&integer)
                                : channel.type == Imf::HALF ? static_cast<const void*>(&half)
                                                            : static_cast<const void*>(&channel.value);
      values[c].resize(side * side * size);
      for (std::size_t i = 0; i < side * side; ++i) std::memcpy(values[c].data() + i * size, value, size);
      frame.insert(channel.name, Imf::Slice(made.type, values[c].data(), size,
                                            size * static_cast<std::size_t>(side / made.xSampling),
                                            made.xSampling, made.ySampling));
    }
    Imf::OutputPart part(out, static_cast<int>(p));
    part.setFrameBuffer(frame);
    part.writePixels(side);
  }
}

void write_flat_exr(const std::string& file, const Rgb& rgb, const std::function<void(Imf::Header&)>& more) {
  write_flat_exr(file, {{"",
                         {{"R", static_cast<float>(rgb[0])},
                          {"G", static_cast<float>(rgb[1])},
                          {"B", static_cast<float>(rgb[2])}},
                         more}});
}

std::string big_endian(std::uint32_t value, int bytes) {
  std::string out;
  for (int i = bytes - 1; i >= 0; --i) out += static_cast<char>(value >> (8 * i) & 0xffu);
  return out;
}

std::string packed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
           bytes.size());
  out.resize(size);
  return out;
}

std::string flat_png(const std::vector<std::uint16_t>& pixel, const std::vector<Chunk>& chunks) {
  const auto chunk = [](const std::string& type, const std::string& data) {
    const std::string body = type + data;
    const auto crc = static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size())));
    return big_endian(static_cast<std::uint32_t>(data.size())) + body + big_endian(crc);
  };
  std::string row(1, '\0');  // filter: none
  for (int x = 0; x < side; ++x)
    for (const std::uint16_t v : pixel) row += big_endian(v, 2);
  std::string rows;
  for (int y = 0; y < side; ++y) rows += row;
  const char colour = pixel.size() == 4 ? 6 : pixel.size() == 3 ? 2 : 0;
  std::string out = "\x89PNG\r\n\x1a\n";
  out += chunk("IHDR", big_endian(side) + big_endian(side) + std::string({16, colour, 0, 0, 0}));
  for (const auto& [type, data] : chunks) out += chunk(type, data);
  return out + chunk("IDAT", packed(rows)) + chunk("IEND", "");
}

Chunk png_profile(const std::string& profile) { return {"iCCP", std::string("p\0\0", 3) + packed(profile)}; }

void write_bytes(const std::string& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string adobe_profile() {
  const cmsCIExyY white = {0.3127, 0.3290, 1};
  const cmsCIExyYTRIPLE primaries = {{0.64, 0.33, 1}, {0.21, 0.71, 1}, {0.15, 0.06, 1}};
  cmsToneCurve* const curve = cmsBuildGamma(nullptr, 563.0 / 256);
  cmsToneCurve* const curves[3] = {curve, curve, curve};
  const cmsHPROFILE profile = cmsCreateRGBProfile(&white, &primaries, curves);
  cmsUInt32Number size = 0;
  cmsSaveProfileToMem(profile, nullptr, &size);
  std::string out(size, '\0');
  cmsSaveProfileToMem(profile, out.data(), &size);
  cmsCloseProfile(profile);
  cmsFreeToneCurve(curve);
  return out;
}

void write_flat_oiio(const std::string& file, const std::vector<float>& pixel, bool sixteen_bits,
                     const std::string& profile, const std::vector<std::pair<std::string, int>>& attributes) {
  OIIO::ImageSpec spec(8, 8, static_cast<int>(pixel.size()),
                       sixteen_bits ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8);
  if (!profile.empty())
    spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())),
                   profile.data());
  for (const auto& [name, value] : attributes) spec.attribute(name, value);
  std::vector<float> pixels;
  for (int i = 0; i < 64; ++i) pixels.insert(pixels.end(), pixel.begin(), pixel.end());
  const auto out = OIIO::ImageOutput::create(file);
  ASSERT_TRUE(out && out->open(file, spec) && out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) &&
              out->close());
}

Run apply(const std::string& in, const std::string& out, std::vector<std::string> more) {
  std::vector<std::string> arguments = {"apply", in, "-o", out};
  if (std::find(more.begin(), more.end(), "--adaptation") == more.end())
    arguments.insert(arguments.end(), {"--adaptation", "10"});
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = run_program(arguments);
  return {outcome.exit_code, outcome.err};
}

Run apply_parts(const std::vector<FlatPart>& parts, std::vector<std::string> more,
                const std::vector<std::string>& also, const std::string& out) {
  write_flat_exr(place("in.exr"), parts);
  more.insert(more.end(), also.begin(), also.end());
  return apply(place("in.exr"), place(out), std::move(more));
}

std::vector<float> pixel_of(const std::string& file, const std::vector<std::string>& channels, int part,
                            int x, int y) {
  Imf::MultiPartInputFile in(file.c_str());
  const Imath::Box2i box = in.header(part).dataWindow();
  const auto width = static_cast<std::size_t>(box.max.x - box.min.x + 1);
  const auto height = static_cast<std::size_t>(box.max.y - box.min.y + 1);
  std::vector<std::vector<float>> planes(channels.size(), std::vector<float>(width * height));
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < channels.size(); ++c)
    frame.insert(channels[c], Imf::Slice::Make(Imf::FLOAT, planes[c].data(), box, 4, 4 * width));
  Imf::InputPart input(in, part);
  input.setFrameBuffer(frame);
  input.readPixels(box.min.y, box.max.y);
  std::vector<float> out;
  for (const auto& plane : planes)
    out.push_back(plane[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)]);
  return out;
}

double float_attribute(const std::string& file, const std::string& name) {
  Imf::MultiPartInputFile in(file.c_str());
  const auto* found = in.header(0).findTypedAttribute<Imf::FloatAttribute>(name);
  return found ? static_cast<double>(found->value()) : std::numeric_limits<double>::quiet_NaN();
}

std::string place(const std::string& name) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto folder = std::filesystem::path(::testing::TempDir()) /
                      ("scotopic-files-" + std::to_string(getpid())) / test->name();
  std::filesystem::create_directories(folder);
  return (folder / name).string();
}

}  // namespace scotopic::test
