// Files of the field, made here from what their formats say, and what the program makes of them.
#pragma once

#include <OpenEXR/ImfHeader.h>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace scotopic::test {

using Rgb = std::array<double, 3>;

/// A channel of one value everywhere.
struct FlatChannel {
  std::string name;
  float value = 0;
  int type = 2;  ///< Imf::UINT 0, HALF 1, FLOAT 2
};

/// A part of 4 x 4 pixels.
struct FlatPart {
  std::string name;
  std::vector<FlatChannel> channels;
  std::function<void(Imf::Header&)> more = nullptr;
};

/// One part is written as a file of one part.
void write_flat_exr(const std::string& file, const std::vector<FlatPart>& parts);
/// R, G, B of float.
void write_flat_exr(const std::string& file, const Rgb& rgb,
                    const std::function<void(Imf::Header&)>& more = nullptr);

/// A chunk or segment by its type.
using Chunk = std::pair<std::string, std::string>;
/// Big-endian bytes.
std::string big_endian(std::uint32_t value, int bytes = 4);
/// RGB (or RGBA) of 16 bits, 4 x 4 pixels of one value, with chunks before IDAT.
std::string flat_png(const std::vector<std::uint16_t>& pixel, const std::vector<Chunk>& chunks);
/// iCCP's bytes.
Chunk png_profile(const std::string& profile);
/// zlib's stream.
std::string packed(const std::string& bytes);

void write_bytes(const std::string& file, const std::string& bytes);

/// An Adobe RGB (1998) profile, gamma 563/256, made with LittleCMS.
std::string adobe_profile();
/// A TIFF or JPEG by OpenImageIO, 8 x 8 pixels of one value (0..1), with an ICC profile where it is not
/// empty.
void write_flat_oiio(const std::string& file, const std::vector<float>& pixel, bool sixteen_bits,
                     const std::string& profile,
                     const std::vector<std::pair<std::string, int>>& attributes = {});

/// What a run of the program says and leaves.
struct Run {
  int exit_code = 0;
  std::string err;
};
/// scotopic apply IN -o OUT --adaptation 10 (daylight: light comes out as it went in) and more.
Run apply(const std::string& in, const std::string& out, std::vector<std::string> more = {});

inline const std::vector<std::string> night_options = {"--adaptation", "0.02", "--effects", "all"};
/// apply of a file of these parts to OUT.
Run apply_parts(const std::vector<FlatPart>& parts, std::vector<std::string> more = {},
                const std::vector<std::string>& also = night_options, const std::string& out = "out.exr");

inline bool says(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

/// Channels of a pixel of a part, as float; 0 for those that are not there.
std::vector<float> pixel_of(const std::string& file, const std::vector<std::string>& channels, int part = 0,
                            int x = 0, int y = 0);
/// A float attribute; NaN where there is none.
double float_attribute(const std::string& file, const std::string& name);

/// A folder of the test's own.
std::string place(const std::string& name);

}  // namespace scotopic::test
