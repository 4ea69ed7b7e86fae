// Which channels, layers and parts of a file are light, and which are data, told by their names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/subimage.h"

namespace scotopic {

/// Whether a layer or part of that name holds data, not light: identifiers, normals, depth, positions,
/// motion, as the renderers call them (Cryptomatte; Blender's IndexOB, Vector, Mist; Arnold's N, P, Z,
/// motionvector, crypto_object; RenderMan's Nn, Pworld, id; V-Ray's VRayVelocity, VRayNormals, VRayRenderID).
/// A word of the name decides; single letters only where they are all of it.
bool is_data_name(std::string_view name);

/// Whether it is the picture itself among passes: beauty, Combined, rgba, Ci, ...
bool is_beauty_name(std::string_view name);

/// Whether a channel has a wavelength or the number of a band in its name.
bool looks_spectral(std::string_view channel);

/// Where the light of a picture is. `layer`: a channel prefix to look under ("" chooses by itself: topmost R,
/// G, B (or red, green, blue; or X, Y, Z); else the only layer that has them and is no data; else the one of
/// several with the name of a beauty; else L, M, S, R; else a single Y, topmost or the only layer's).
/// Channels of type uint are none. Several candidates are an Error(usage).
ColourChannels find_colour(const Subimage& subimage, const std::string& layer, const std::string& file);

/// All layers of a picture that have R, G, B, or L, M, S, R, or Y; "" is the topmost.
std::vector<std::string> colour_layers(const Subimage& subimage);

/// Layers that hold the other views of what a layer shows, named as OpenEXR has it: "right" beside the
/// topmost, "diffuse.right" beside "diffuse". Views are those of multiView; without it, left and right.
/// Several of those are none: they are lights on the left and on the right.
std::vector<std::string> other_views(const Subimage& subimage, const std::string& layer);

/// Whether a layer's name is, or ends with, that of a view.
bool names_a_view(const Subimage& subimage, const std::string& layer);

/// Names of all channels of all pictures, each once, at most 16: "R, G, B, diffuse.R, ... (40 in all)".
std::string channel_list(const std::vector<Subimage>& subimages);

/// "a, b, c", the first `most` and how many there are.
std::string name_list(const std::vector<std::string>& names, std::size_t most = 8);

/// ASCII capitals made small.
std::string lowered(std::string_view text);

}  // namespace scotopic
