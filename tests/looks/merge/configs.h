// Configs built as those that people have: layout, roles, views, search path.
#pragma once

namespace scotopic::test {

// As people write them: comments, odd spacing, no looks.
inline constexpr const char* studio = R"(ocio_profile_version: 2

# Our show.
search_path: "luts:shared/luts"
strictparsing: true
luma: [0.2126, 0.7152, 0.0722]

roles:
  scene_linear: lin   # everything
  default: lin
  data: raw
  aces_interchange: ap0

displays:
  monitor:
    - !<View> {name: Raw, colorspace: raw}   # first, on purpose
    - !<View> {name: Graded, colorspace: out}

  "wall 2":
    - !<View> {name: Graded, colorspace: out}

active_displays: []
active_views: [Graded, Raw]

colorspaces:
  # The reference.
  - !<ColorSpace>
    name: lin
    isdata: false

  - !<ColorSpace>
    name: ap0
    isdata: false
    to_reference: !<MatrixTransform> {matrix: [2.52168618674388, -1.13413098823972, -0.387555198504164, 0, -0.276479914229922, 1.37271908766826, -0.096239173438334, 0, -0.0153780649660342, -0.152975335867399, 1.16835340083343, 0, 0, 0, 0, 1]}

  - !<ColorSpace>
    name: out
    isdata: false
    from_reference: !<ExponentTransform> {value: [2.2, 2.2, 2.2, 1], direction: inverse}

  - !<ColorSpace>
    name: raw
    isdata: true
# The end.
)";

// As OpenColorIO's own ACES configs: an empty search path, shared views that take the display's name, one
// view that most displays begin with and one that has its own, categories; AP1.
inline constexpr const char* aces = R"(ocio_profile_version: 2.1

environment:
  {}
search_path: ""
strictparsing: true
luma: [0.2126, 0.7152, 0.0722]
name: aces-like

roles:
  aces_interchange: ACES2065-1
  cie_xyz_d65_interchange: CIE-XYZ-D65
  data: Raw
  scene_linear: ACEScg

file_rules:
  - !<Rule> {name: Default, colorspace: ACES2065-1}

shared_views:
  - !<View> {name: SDR, view_transform: SDR, display_colorspace: <USE_DISPLAY_NAME>}
  - !<View> {name: HDR, view_transform: HDR, display_colorspace: <USE_DISPLAY_NAME>}
  - !<View> {name: Un-tone-mapped, view_transform: Un-tone-mapped, display_colorspace: <USE_DISPLAY_NAME>}

displays:
  sRGB - Display:
    - !<View> {name: Raw, colorspace: Raw}
    - !<Views> [SDR, Un-tone-mapped]
  P3-D65 - Display:
    - !<View> {name: Raw, colorspace: Raw}
    - !<Views> [SDR, Un-tone-mapped]
  PQ - Display:
    - !<View> {name: Raw, colorspace: Raw}
    - !<Views> [HDR,
       Un-tone-mapped]

active_displays: [sRGB - Display, P3-D65 - Display, PQ - Display]
active_views: [SDR, HDR, Un-tone-mapped, Raw]

looks:
  - !<Look>
    name: Gamut compression
    process_space: ACES2065-1
    description: |
      Two paragraphs, of which the second has 'quotes" and [brackets

      active_views: [not this]
    transform: !<BuiltinTransform> {style: ACES-LMT - ACES 1.3 Reference Gamut Compression}


default_view_transform: Un-tone-mapped

view_transforms:
  - !<ViewTransform>
    name: SDR
    from_scene_reference: !<BuiltinTransform> {style: ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0}

  - !<ViewTransform>
    name: HDR
    from_scene_reference: !<BuiltinTransform> {style: ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - HDR-VIDEO-1000nit-15nit-P3lim_1.1}

  - !<ViewTransform>
    name: Un-tone-mapped
    from_scene_reference: !<BuiltinTransform> {style: UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD}

display_colorspaces:
  - !<ColorSpace>
    name: CIE-XYZ-D65
    family: ""
    equalitygroup: ""
    bitdepth: 32f
    isdata: false
    allocation: uniform

  - !<ColorSpace>
    name: sRGB - Display
    family: Display
    equalitygroup: ""
    bitdepth: 32f
    isdata: false
    encoding: sdr-video
    allocation: uniform
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_sRGB}

  - !<ColorSpace>
    name: P3-D65 - Display
    family: Display
    equalitygroup: ""
    bitdepth: 32f
    isdata: false
    encoding: sdr-video
    allocation: uniform
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_G2.6-P3-D65}

  - !<ColorSpace>
    name: PQ - Display
    family: Display
    equalitygroup: ""
    bitdepth: 32f
    isdata: false
    encoding: hdr-video
    allocation: uniform
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_ST2084-P3-D65}

colorspaces:
  - !<ColorSpace>
    name: ACES2065-1
    aliases: [aces2065_1]
    family: ACES
    equalitygroup: ""
    bitdepth: 32f
    isdata: false
    categories: [file-io]
    encoding: scene-linear
    allocation: uniform

  - !<ColorSpace>
    name: ACEScg
    aliases: [lin_ap1]
    family: ACES
    equalitygroup: ""
    bitdepth: 32f
    isdata: false
    categories: [file-io, working-space]
    encoding: scene-linear
    allocation: uniform
    to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}

  - !<ColorSpace>
    name: Raw
    family: Utility
    equalitygroup: ""
    bitdepth: 32f
    isdata: true
    categories: [file-io]
    encoding: data
    allocation: uniform
)";

// As AgX of Troy Sobotka: no interchange roles, lists at the indentation of their keys, equality groups.
inline constexpr const char* no_interchange = R"(ocio_profile_version: 2

environment:
  {}
search_path: LUTs
roles:
  default: sRGB
  reference: Linear BT.709
  scene_linear: Linear BT.709

file_rules:
- !<Rule> {name: Default, colorspace: default}

displays:
  sRGB:
  - !<View> {name: Display Native, colorspace: sRGB}
  Broken:
  - !<View> {name: Lost, colorspace: lost}

active_displays: []
active_views: []

looks: []

colorspaces:
- !<ColorSpace>
  name: Linear BT.709
  equalitygroup: linear
  bitdepth: 32f
  isdata: false

- !<ColorSpace>
  name: sRGB
  equalitygroup: srgb
  bitdepth: 32f
  isdata: false
  from_scene_reference: !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}

- !<ColorSpace>
  name: lost
  isdata: false
  from_scene_reference: !<FileTransform> {src: not_there.spi1d, interpolation: linear}
)";

// As filmic-blender: profile 1, no search path, no active views, an active display that is not there.
inline constexpr const char* profile_1 = R"(# For Blender.
ocio_profile_version: 1

strictparsing: true
luma: [0.2126, 0.7152, 0.0722]

description: A filmlike encoding

roles:
  default: Linear
  scene_linear: Linear

displays:
  sRGB:
    - !<View> {name: Raw, colorspace: Raw}
    - !<View> {name: sRGB OETF, colorspace: sRGB OETF, looks: +Contrast}

active_displays: [sRGB, None]

looks:
  - !<Look>
    name: Contrast
    process_space: Linear
    transform: !<CDLTransform> {slope: [1.1, 1.1, 1.1]}

colorspaces:
  - !<ColorSpace>
    name: Linear
    family: scene
    equalitygroup:
    bitdepth: 32f
    description: |
      Scene light
    isdata: false
    allocation: lg2
    allocationvars: [-12.473931188, 12.526068812]

  - !<ColorSpace>
    name: Raw
    isdata: true

  - !<ColorSpace>
    name: sRGB OETF
    isdata: false
    from_reference: !<ExponentTransform> {value: [2.2, 2.2, 2.2, 1], direction: inverse}
)";

}  // namespace scotopic::test
