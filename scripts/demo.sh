#!/bin/sh
# The main job on a real image: installs, builds, runs the exact operator and the OCIO look on a night panorama
# (blender-data's night.exr, CC0), prints how well they agree, and shows both beside the original.
#   scripts/demo.sh [LA]   adaptation luminance: one of the ladder's, 3 1 0.3 0.1 0.03 0.01 (default) 0.003 0.001
set -eu
cd "$(dirname "$0")/.."
la=${1:-0.01}
scripts/install_packages.sh
scripts/build.sh release scotopic
scotopic=build/release/src/cli/scotopic
night=/usr/share/blender/datafiles/studiolights/world/night.exr
config=ocio_config/config.ocio
mkdir -p demo

look=$(sed -n "s/^ *name: \"\{0,1\}\(Mesopic $la nit[^\"]*\|Scotopic $la nit[^\"]*\)\"\{0,1\}\$/\1/p" "$config" | head -n 1)
[ -n "$look" ] || { echo "demo.sh: the config has no look at $la cd/m2" >&2; exit 2; }

echo "exact: scotopic apply --adaptation $la"
"$scotopic" apply "$night" -o demo/exact.exr --adaptation "$la"
echo "look:  oiiotool --ociolook \"$look\""
oiiotool --colorconfig "$config" "$night" \
  --ociolook:from=scene_linear:to=scene_linear "$look" --compression zip -o demo/look.exr
echo "agreement of the look with the operator, every pixel exposed to mid-grey:"
"$scotopic" check "$config" "$look" --image "$night"

# The same part of each, one exposure, highlights kept.
for picture in "$night" demo/exact.exr demo/look.exr; do
  oiiotool --colorconfig "$config" "$picture" --cut 420x250+40+110 --mulc 3 \
    --ociodisplay:from=scene_linear "sRGB - Display" "Highlight-safe" \
    --clamp:min=0:max=1 -d uint8 -o "demo/$(basename "$picture" .exr).png"
done
oiiotool demo/night.png demo/exact.png demo/look.png --mosaic:pad=6 3x1 -o demo/side_by_side.png
echo "look at demo/side_by_side.png: as a camera shows it, exact operator, OCIO look"
