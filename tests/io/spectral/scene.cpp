#include "io/spectral/scene.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfTiledOutputPart.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "receptors/illuminant.h"
#include "receptors/receptor_space.h"
#include "receptors/tables.h"
#include "support/csv.h"

namespace scotopic::test {
namespace {

template <typename T>
std::vector<T> converted(const std::vector<float>& values) {
  return {values.begin(), values.end()};
}

// One plane of a channel, kept alive while OpenEXR reads it.
struct Plane {
  std::vector<Imath::half> halves;
  std::vector<float> floats;
  std::vector<unsigned> integers;
  Imf::PixelType type = Imf::FLOAT;
  char* data = nullptr;
  std::size_t size = 0;

  explicit Plane(const TestChannel& channel) {
    if (channel.type == TestChannel::Type::half) {
      halves = converted<Imath::half>(channel.values);
      data = reinterpret_cast<char*>(halves.data());
      type = Imf::HALF;
      size = 2;
    } else if (channel.type == TestChannel::Type::float32) {
      floats = channel.values;
      data = reinterpret_cast<char*>(floats.data());
      size = 4;
    } else {
      for (const float value : channel.values) integers.push_back(static_cast<unsigned>(value));
      data = reinterpret_cast<char*>(integers.data());
      type = Imf::UINT;
      size = 4;
    }
  }
  Plane(Plane&&) = default;
  Plane(const Plane&) = delete;
};

std::string patch_name(std::size_t patch) {
  std::string name = std::to_string(patch);
  name.insert(name.begin(), 'r');
  return name;
}

Imf::PixelType type_of(const TestChannel& channel) {
  return channel.type == TestChannel::Type::half      ? Imf::HALF
         : channel.type == TestChannel::Type::float32 ? Imf::FLOAT
                                                      : Imf::UINT;
}

Imf::Header header_of(const TestImage& image, std::size_t part) {
  const Imath::Box2i window({image.x0, image.y0}, {image.x0 + image.width - 1, image.y0 + image.height - 1});
  Imf::Header header(window, window);
  header.compression() = static_cast<Imf::Compression>(image.compression);
  header.setType(image.tiled ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
  if (image.parts.size() > 1) header.setName("part" + std::to_string(part));
  if (image.tiled) header.setTileDescription(Imf::TileDescription(16, 8, Imf::ONE_LEVEL));
  for (const auto& [name, text] : image.text_attributes) header.insert(name, Imf::StringAttribute(text));
  for (const auto& [name, number] : image.number_attributes) header.insert(name, Imf::FloatAttribute(number));
  for (const TestChannel& channel : image.parts[part])
    header.channels().insert(channel.name, Imf::Channel(type_of(channel)));
  return header;
}

}  // namespace

std::vector<SceneSpectrum> reflectances(const std::string& name) {
  const auto rows = read_csv(std::string(SCOTOPIC_TEST_DATA) + "/reflectances_" + name + ".csv");
  std::vector<SceneSpectrum> patches;
  for (std::size_t patch = 1; rows[0].number.count(patch_name(patch)) != 0; ++patch) {
    const std::string column = patch_name(patch);
    SceneSpectrum spectrum;
    for (int nm = scene_first_nm; nm <= scene_last_nm; ++nm) {
      const double x = std::clamp<double>(nm, rows.front()["nm"], rows.back()["nm"]);
      std::size_t above = 1;
      while (above + 1 < rows.size() && rows[above]["nm"] < x) ++above;
      const CsvRow &a = rows[above - 1], &b = rows[above];
      spectrum.push_back(a[column] + (b[column] - a[column]) * (x - a["nm"]) / (b["nm"] - a["nm"]));
    }
    patches.push_back(spectrum);
  }
  return patches;
}

SceneSpectrum lamp(const std::string& name) {
  SceneSpectrum spectrum(scene_last_nm - scene_first_nm + 1, 0.0);
  if (name == "lps") {
    spectrum[589 - scene_first_nm] = 2.0;
    spectrum[590 - scene_first_nm] = 1.0;  // 589.6 belongs to the nanometre from 589.5 to 590.5
    return spectrum;
  }
  const auto known = illuminant_spectrum(name);
  if (!known) throw std::runtime_error("no lamp " + name);
  for (int nm = scene_first_nm; nm <= scene_last_nm; ++nm)
    spectrum[static_cast<std::size_t>(nm - scene_first_nm)] = known->curve().at(nm);
  return spectrum;
}

std::vector<SceneSpectrum> lit(const std::vector<SceneSpectrum>& patches, const SceneSpectrum& lamp,
                               double cdm2) {
  const double scale = cdm2 / true_signals(lamp)[index(Signal::y)];
  std::vector<SceneSpectrum> out = patches;
  for (SceneSpectrum& spectrum : out)
    for (std::size_t i = 0; i < spectrum.size(); ++i) spectrum[i] *= lamp[i] * scale;
  return out;
}

std::array<double, signal_count> true_signals(const SceneSpectrum& spectrum) {
  const TabulatedCurve* curves[] = {&tables::cones_stockman_sharpe_2000_2deg_l,
                                    &tables::cones_stockman_sharpe_2000_2deg_m,
                                    &tables::cones_stockman_sharpe_2000_2deg_s,
                                    &tables::scotopic_cie_1951_v_prime,
                                    &tables::xyz_cie_1931_2deg_x,
                                    &tables::xyz_cie_1931_2deg_y,
                                    &tables::xyz_cie_1931_2deg_z};
  std::array<double, signal_count> out{};
  for (std::size_t s = 0; s < signal_count; ++s) {
    long double sum = 0.0L;
    for (std::size_t i = 0; i < spectrum.size(); ++i)
      sum += static_cast<long double>(spectrum[i]) * curves[s]->at(scene_first_nm + static_cast<double>(i));
    out[s] =
        static_cast<double>(sum * static_cast<long double>(s < 4 ? luminance_units_per_watt() : 683.002L));
  }
  return out;
}

long double curve_area(const TabulatedCurve& curve, double nm) {
  long double area = 0.0L;
  for (std::size_t i = 0; i + 1 < curve.values.size(); ++i) {
    const long double low = curve.first_nm + static_cast<double>(i) * curve.step_nm;
    const long double share = std::clamp<long double>((nm - low) / curve.step_nm, 0.0L, 1.0L);
    const long double a = curve.values[i], b = curve.values[i + 1];
    area += curve.step_nm * share * (a + 0.5L * share * (b - a));
  }
  return area;
}

std::vector<double> band_centres(double first, double step, double last) {
  std::vector<double> centres;
  for (int i = 0; first + step * i <= last + 1e-9; ++i) centres.push_back(first + step * i);
  return centres;
}

double band_mean(const SceneSpectrum& spectrum, double low, double high) {
  double sum = 0.0;
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    const double nm = scene_first_nm + static_cast<double>(i);
    sum += spectrum[i] * std::max(0.0, std::min(high, nm + 0.5) - std::max(low, nm - 0.5));
  }
  return sum / (high - low);
}

std::vector<TestChannel> band_channels(const std::vector<SceneSpectrum>& pixels, int count,
                                       const std::vector<double>& centres, double step,
                                       const std::function<std::string(double)>& name) {
  std::vector<TestChannel> channels;
  for (const double centre : centres) {
    TestChannel channel{name(centre), {}, TestChannel::Type::float32};
    std::vector<float> of_patch;
    for (const SceneSpectrum& spectrum : pixels)
      of_patch.push_back(static_cast<float>(band_mean(spectrum, centre - step / 2, centre + step / 2)));
    for (int i = 0; i < count; ++i)
      channel.values.push_back(of_patch[static_cast<std::size_t>(i) % of_patch.size()]);
    channels.push_back(channel);
  }
  return channels;
}

std::string stokes_name(double nm) {
  std::string digits = std::to_string(nm);
  std::replace(digits.begin(), digits.end(), '.', ',');
  return "S0." + digits + "nm";
}

void write_exr(const std::string& path, const TestImage& image) {
  std::vector<Imf::Header> headers;
  for (std::size_t part = 0; part < image.parts.size(); ++part) headers.push_back(header_of(image, part));
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (std::size_t part = 0; part < image.parts.size(); ++part) {
    std::vector<Plane> planes;
    for (const TestChannel& channel : image.parts[part]) planes.emplace_back(channel);
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < planes.size(); ++c) {
      const auto row = planes[c].size * static_cast<std::size_t>(image.width);
      char* const origin = planes[c].data - image.x0 * static_cast<std::ptrdiff_t>(planes[c].size) -
                           image.y0 * static_cast<std::ptrdiff_t>(row);
      frame.insert(image.parts[part][c].name, Imf::Slice(planes[c].type, origin, planes[c].size, row));
    }
    if (image.tiled) {
      Imf::TiledOutputPart out(file, static_cast<int>(part));
      out.setFrameBuffer(frame);
      out.writeTiles(0, out.numXTiles() - 1, 0, out.numYTiles() - 1);
    } else {
      Imf::OutputPart out(file, static_cast<int>(part));
      out.setFrameBuffer(frame);
      out.writePixels(image.height);
    }
  }
}

std::vector<SceneSpectrum> write_macbeth(const std::string& file, const std::string& lamp_name, double cdm2,
                                         int rows) {
  const auto light = lit(reflectances("macbeth"), lamp(lamp_name), cdm2);
  TestImage image;
  image.width = macbeth_patches;
  image.height = rows;
  image.parts = {band_channels(light, rows * macbeth_patches, band_centres(360, 1, 830), 1, stokes_name)};
  image.text_attributes = {{"emissiveUnits", "W.m^-2.sr^-1.nm^-1"}};
  write_exr(file, image);
  return light;
}

TemporaryFolder::TemporaryFolder() {
  path_ = std::filesystem::temp_directory_path() / "scotopic-spectral-XXXXXX";
  if (mkdtemp(path_.data()) == nullptr) throw std::runtime_error("no temporary folder");
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace scotopic::test
