#include "faults/inputs.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "faults/rig.h"
#include "color/base_config.h"

namespace scotopic::test {
namespace {

namespace fs = std::filesystem;

float value_at(int x, int y, std::size_t channel) {
  return 0.001f +
         0.05f * static_cast<float>((x * 7 + y * 13 + static_cast<int>(channel) * 29) % 101) / 100.0f;
}

void write_exr(const std::string& file, int width, int height, const std::vector<std::string>& channels) {
  Imf::Header header(width, height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frame;
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<std::vector<half>> planes(channels.size(), std::vector<half>(pixels));
  for (std::size_t c = 0; c < channels.size(); ++c) {
    header.channels().insert(channels[c], Imf::Channel(Imf::HALF));
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        planes[c][static_cast<std::size_t>(y * width + x)] = half(value_at(x, y, c));
    frame.insert(channels[c], Imf::Slice(Imf::HALF, reinterpret_cast<char*>(planes[c].data()), sizeof(half),
                                         sizeof(half) * static_cast<std::size_t>(width)));
  }
  Imf::OutputFile out(file.c_str(), header);
  out.setFrameBuffer(frame);
  out.writePixels(height);
}

void write_pages(const std::string& file) {
  OIIO::ImageSpec spec(24, 20, 3, OIIO::TypeDesc::FLOAT);
  const std::vector<OIIO::ImageSpec> pages(2, spec);
  std::vector<float> pixels(24 * 20 * 3);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = value_at(static_cast<int>(i), 0, 0);
  const auto out = OIIO::ImageOutput::create("tiff");
  out->open(file, 2, pages.data());
  out->write_image(spec.format, pixels.data());
  out->open(file, pages[1], OIIO::ImageOutput::AppendSubimage);
  out->write_image(spec.format, pixels.data());
  out->close();
}

void make(const std::string& name, const std::string& file) {
  const std::vector<std::string> rgb = {"R", "G", "B"};
  if (name == "in.exr") write_exr(file, 24, 20, rgb);
  if (name == "big.exr") write_exr(file, 1024, 768, rgb);
  if (name == "spectral.exr")
    write_exr(file, 24, 20,
              {"S0.400nm", "S0.450nm", "S0.500nm", "S0.550nm", "S0.600nm", "S0.650nm", "S0.700nm"});
  if (name == "pages.tif") write_pages(file);
  if (name == "studio.ocio") {
    std::ofstream out(file);
    const OCIO_NAMESPACE::ConfigRcPtr config = make_base_config();
    config->setSearchPath("luts");
    config->serialize(out);
  }
}

}  // namespace

std::string input(const std::string& name) {
  const std::string file = work_folder("inputs") + "/" + name;
  if (!fs::exists(file)) make(name, file);
  return file;
}

}  // namespace scotopic::test
