// What a file will become: which of its subimages are light, in whose colours, and how the output is laid
// out.
//
// Files of receptor signals: channels L, M, S, R (or a layer of them, "lmsr.L" ...), in luminance units: D65
// of 1 cd/m2 has L + M = 1 and R = .4986. The float attribute "scotopic:lmsrUnit" says how many cd/m2 a value
// of 1 stands for; without it "whiteLuminance" does.
//
// Alpha: light is what alpha has been multiplied into. Straight colour (PNG, some TIFF) is multiplied by its
// alpha before the operator sees it and divided after; so the same picture is the same light whichever way it
// is stored. Where values are encoded with a curve alpha stands after the curve: encoded straight colour,
// times alpha.
//
// A single luminance channel (Y, or a grey TIFF or PNG) becomes R, G, B: the eye in the dark does not see
// grey as grey alone.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "color/colour_config.h"
#include "io/pixel_sink.h"
#include "io/pixel_source.h"
#include "stages/display/night_display.h"

namespace scotopic {

/// Whether the display stage runs: on pictures that are looked at as they are (PNG, JPEG, TIFF of whole
/// numbers, where neither a colour space nor a profile is asked for), always, or never.
enum class NightDisplayMode { where_looked_at, always, never };

/// What the user says about a file's colour and its output; what is not said is found in the file.
struct ImageRequest {
  std::string layer;                       ///< --layer: a channel prefix, or the name of a part or view
  std::vector<std::string> layers;         ///< --layers: several of them, treated alike; "RGB" is the topmost
  std::optional<std::string> colourspace;  ///< of the input
  std::optional<std::string> output_colourspace;
  std::optional<std::string> view;  ///< --display: [DISPLAY/]VIEW, in place of a colour space
  NightDisplayMode night = NightDisplayMode::where_looked_at;
  std::string night_display;                            ///< whose encoding; empty: the output file's
  std::shared_ptr<const IccProfile> profile = nullptr;  ///< --icc, likewise
  int jpeg_quality = 95;
  std::optional<PixelType> type;  ///< of the output's colour channels
  double exposure = 0;            ///< EV, applied to the result
  bool dither = true;             ///< of what is encoded for a display in 8 bits
};

/// A subimage of the source that holds light, and the space its values are in.
struct LightSubimage {
  std::size_t index = 0;  ///< the same for several layers of one subimage
  ColourChannels channels;
  std::string name;     ///< of the layer, part or view: for messages
  bool metered = true;  ///< one eye adapts to it: not to each layer of a beauty again
  ColourSpace space;
  std::string space_reason;            ///< how the space was found
  std::vector<std::string> conflicts;  ///< tags of the file that say something else
};

/// The display that a result is encoded for.
struct NightOutput {
  Matrix3<double> xyz_from_display = identity3<double>();
  Shoulder shoulder = Shoulder::bend;
  double greatest = 0;  ///< that the input can hold, in working RGB; 0: no bound
};

/// What a file will become; no pixel is read. `notes` are for the user: what the output cannot hold.
struct ImageLayout {
  std::string format;
  std::vector<LightSubimage> light;  ///< at least one
  std::vector<OutputSubimage> outputs;
  ColourSpace output_space;
  double exposure = 0;
  std::optional<NightOutput> night;  ///< the display stage runs
  bool dither = false;               ///< codes of 8 bits are rounded by their place
  bool wraps = false;                ///< a panorama: its last column lies beside its first
  std::vector<std::string> notes;

  /// All light of that subimage of the source, layer by layer: an output has their R, G, B in this order.
  std::vector<const LightSubimage*> lights_of(std::size_t source_index) const;
  /// The first of it; nullptr: it holds none.
  const LightSubimage* light_of(std::size_t source_index) const;
};

/// Throws Error for a layer, space or type that does not exist or does not fit the output's format.
ImageLayout plan_layout(const PixelSource& source, const std::string& output, const ColourConfig& config,
                        const ImageRequest& request);

/// Where the light is, for who writes nothing: in all parts of an OpenEXR file, in the first page of others.
ImageLayout read_layout(const PixelSource& source, const ColourConfig& config, const ImageRequest& request);

/// Marks the layout's colour subimages with what was applied.
void set_stamps(ImageLayout& layout, const std::vector<Attribute>& stamps);

}  // namespace scotopic
