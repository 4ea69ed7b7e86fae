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
view="Night ${look#* }"

echo "the finished picture: scotopic apply --adaptation $la -o night.png"
"$scotopic" apply "$night" -o demo/program.png --adaptation "$la" --effects shift,luminance,chroma
echo "the same as a view of the OCIO config: oiiotool --ociodisplay \"sRGB - Display\" \"$view\""
oiiotool --colorconfig "$config" "$night" --ociodisplay:from=scene_linear "sRGB - Display" "$view" -d uint8 -o demo/view.png
echo "as a camera shows it"
oiiotool --colorconfig "$config" "$night" --ociodisplay:from=scene_linear "sRGB - Display" "Un-tone-mapped" \
  --clamp:min=0:max=1 -d uint8 -o demo/camera.png
echo "linear light, for compositing: scotopic apply -o exact.exr, and the look"
"$scotopic" apply "$night" -o demo/exact.exr --adaptation "$la"
oiiotool --colorconfig "$config" "$night" \
  --ociolook:from=scene_linear:to=scene_linear "$look" --compression zip -o demo/look.exr
echo "agreement of the look with the operator, every pixel exposed to mid-grey:"
"$scotopic" check "$config" "$look" --image "$night"

# The same part of each.
for picture in camera program view; do
  oiiotool "demo/$picture.png" --cut 420x250+40+110 -o "demo/cut_$picture.png"
done
oiiotool demo/cut_camera.png demo/cut_program.png demo/cut_view.png --mosaic:pad=6 3x1 -o demo/side_by_side.png
rm demo/cut_*.png
echo "look at demo/side_by_side.png: as a camera shows it, as the eye sees it (program), as the OCIO view shows it"
