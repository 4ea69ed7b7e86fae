// OpenEXR: channels by other names and types, and headers that contradict.
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include "files/brothers/table.h"
#include "io/light_channels.h"

namespace scotopic {
namespace {

using test::Expected;
using test::FlatChannel;
using Header = Imf::Header;

struct Row {
  std::vector<FlatChannel> channels;
  std::function<void(Header&)> header;
  Expected expected;
};

const std::vector<FlatChannel> rgb_channels = {{"R", 0.6f}, {"G", 0.3f}, {"B", 0.1f}};
const std::vector<FlatChannel> xyz = {{"X", 0.41f}, {"Y", 0.21f}, {"Z", 0.02f}};
// By BT.709's matrix from CIE XYZ.
const test::Rgb xyz_light = {0.99598, -0.0026056, 0.0011126};

std::function<void(Header&)> primaries(Imath::V2f r, Imath::V2f g, Imath::V2f b, Imath::V2f white) {
  return [=](Header& h) { Imf::addChromaticities(h, {r, g, b, white}); };
}

std::function<void(Header&)> text(const char* name, const char* value) {
  return [=](Header& h) { h.insert(name, Imf::StringAttribute(value)); };
}

TEST(Brothers, channels_and_headers_of_openexr) {
  const auto cie_xyz = primaries({1, 0}, {0, 1}, {0, 0}, {1 / 3.f, 1 / 3.f});
  const auto p3 = primaries({0.68f, 0.32f}, {0.265f, 0.69f}, {0.15f, 0.06f}, {0.3127f, 0.3290f});
  const std::vector<Row> rows = {
      {{{"RED", 0.6f}, {"GREEN", 0.3f}, {"BLUE", 0.1f}},
       nullptr,
       {"capitals", {0.6, 0.3, 0.1}, 1e-4, "", "", {"RED", "GREEN", "BLUE"}}},
      {{{"R", 0.6f}, {"g", 0.3f}, {"b", 0.1f}},
       nullptr,
       {"some capitals", {0.6, 0.3, 0.1}, 1e-4, "", "", {"R", "g", "b"}}},
      {{{"R", 9}, {"r", 0.6f}, {"g", 0.3f}, {"b", 0.1f}},
       nullptr,
       {"R beside r, g, b", {0.6, 0.3, 0.1}, 1e-4, "", "", {"r", "g", "b"}}},
      {{{"R", 9}, {"r", 0.6f}, {"G", 0.3f}, {"b", 0.1f}},
       nullptr,
       {"R and r, which?", {}, 0, "", "has no channels R, G, B"}},
      {{{"R", 0.6f}, {"G", 0.3f}, {"B", 0.1f}, {"Y", 9}, {"RY", 9}, {"BY", 9}},
       nullptr,
       {"R, G, B beside Y, RY, BY", {0.6, 0.3, 0.1}}},
      {{{"Y", 9}, {"RY", 9}, {"BY", 9}}, nullptr, {"chroma at every pixel", {}, 0, "", "it has BY, RY, Y"}},
      {{{"R", 1, 0}, {"G", 1, 0}, {"B", 1, 0}}, nullptr, {"integers", {}, 0, "", "R (uint: no light)"}},
      {{{"Y", 0.5f}}, cie_xyz, {"Y alone is grey", {0.5, 0.5, 0.5}}},
      {{{"Y", 0.5f}}, p3, {"Y of P3 is grey", {0.5, 0.5, 0.5}}},
      {xyz, nullptr, {"X, Y, Z", xyz_light}},
      {xyz, cie_xyz, {"X, Y, Z that say so", xyz_light}},
      {xyz, p3, {"X, Y, Z of P3", xyz_light, 1e-4, "channels X, Y, Z and the file's chromaticities"}},
      {xyz,
       text("colorInteropID", "lin_ap1_scene"),
       {"X, Y, Z of ACEScg", xyz_light, 1e-4, "channels X, Y, Z and the file's colorInteropID"}},
      {rgb_channels,
       primaries({0.64f, 0.33f}, {0.3f, 0.6f}, {0.15f, 0.06f}, {0.9f, 0.05f}),
       {"a white that is none", {}, 0, "", "span no colour space"}},
      {rgb_channels,
       text("chromaticities", "BT.709"),
       {"of type string", {0.6, 0.3, 0.1}, 1e-4, "chromaticities is of type string"}},
      {rgb_channels,
       text("whiteLuminance", "100"),
       {"a luminance as text", {0.6, 0.3, 0.1}, 1e-4, "whiteLuminance is of type string"}},
      {rgb_channels,
       [](Header& h) { h.insert("whiteLuminance", Imf::DoubleAttribute(100)); },
       {"a luminance as double", {0.6, 0.3, 0.1}, 1e-4, "value 1 is 100 cd/m2"}},
      {rgb_channels,
       [](Header& h) { h.insert("whiteLuminance", Imf::FloatAttribute(1e30f)); },
       {"no luminance", {0.6, 0.3, 0.1}, 1e-4, "is no luminance, and ignored"}},
  };
  for (const Row& row : rows) {
    test::write_flat_exr(test::place("in.exr"), {{"", row.channels, row.header}});
    test::expect_row(test::place("in.exr"), row.expected);
  }
}

TEST(Brothers, what_of_a_spectrum_is_left_out_is_told) {
  std::vector<FlatChannel> channels;
  for (const char* set : {"S0", "S1", "S2", "S3", "T"})
    for (const char* band : {".450,0nm", ".550,0nm", ".650,0nm"})
      channels.push_back({set + std::string(band), 0.5f});
  test::write_flat_exr(test::place("in.exr"), {{"", channels}});
  const test::Run run = test::apply(test::place("in.exr"), test::place("out.exr"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const char* what : {"polarisation (S1 to S3) is ignored", "reflectance (T) is ignored"})
    EXPECT_NE(run.err.find(what), std::string::npos) << run.err;
}

TEST(Brothers, renderers_names_of_data) {
  for (const char* name : {"Pz",
                           "hitPz",
                           "ray:hitPz",
                           "Ns",
                           "Nn",
                           "__Nworld",
                           "dPdu",
                           "dPdtime",
                           "ZBuffer",
                           "VRayZDepth",
                           "VRayWireColor",
                           "VRaySampleRate",
                           "MultiMatte",
                           "PuzzleMatte",
                           "WorldPosition",
                           "UVCoord",
                           "CGeometry_UVWCoords",
                           "CMasking_ID",
                           "SHADING_NORMAL",
                           "MATERIAL_ID",
                           "Object Coordinates",
                           "primid",
                           "disparity",
                           "cputime",
                           "Denoising Normal",
                           "Denoising Depth",
                           "CryptoMaterial01",
                           "uCryptoAsset00",
                           "id0.ID",
                           "MotionVectors"})
    EXPECT_TRUE(is_data_name(name)) << name;
  for (const char* name : {"beauty", "diffuse", "specular_direct", "sun", "C", "Ci", "rgba", "Combined",
                           "emission", "indirect", "key", "nuke", "zenith", "idle", "pacific", "state"})
    EXPECT_FALSE(is_data_name(name)) << name;
}

TEST(Brothers, parts_of_houdini) {
  test::write_flat_exr(test::place("in.exr"),
                       {{"C", rgb_channels}, {"Pz", rgb_channels}, {"Op_Id", rgb_channels}});
  test::expect_row(test::place("in.exr"), {"C is the picture", {0.6, 0.3, 0.1}, 1e-4, "Pz, Op_Id"});
}

}  // namespace
}  // namespace scotopic
