#!/bin/sh
# The main job on a real image: installs, builds, runs the exact operator and the OCIO view and look on a street at night
# (tests/data/street.exr, docs/scene.md), prints how well look and operator agree, and shows all beside each other.
#   scripts/demo.sh [LA]   adaptation luminance: one of the ladder's, 3 1 0.3 0.1 (default) 0.03 0.01 0.003 0.001
set -eu
cd "$(dirname "$0")/.."
la=${1:-0.1}
scripts/install_packages.sh
scripts/build.sh release scotopic
scotopic=build/release/src/cli/scotopic
street=tests/data/street.exr
night=demo/scene.exr
config=ocio_config/config.ocio
mkdir -p demo

look=$(sed -n "s/^ *name: \"\{0,1\}\(Mesopic $la nit[^\"]*\|Scotopic $la nit[^\"]*\)\"\{0,1\}\$/\1/p" "$config" | head -n 1)
[ -n "$look" ] || { echo "demo.sh: the config has no look at $la cd/m2" >&2; exit 2; }
view="Night ${look#* }"

# Looks and views do not know what value 1 stands for: they take 0.18 for the luminance adapted to. Here 1 is 10 cd/m2.
oiiotool "$street" --mulc "$(awk "BEGIN { print 1.8 / $la }")" --eraseattrib whiteLuminance -o "$night"

echo "the finished picture: scotopic apply --adaptation $la street.exr -o night.png"
"$scotopic" apply "$street" -o demo/program.png --adaptation "$la"
echo "colour, luminance and display alone, as a view of the OCIO config: oiiotool --ociodisplay \"sRGB - Display\" \"$view\""
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

for picture in camera program view; do
  oiiotool "demo/$picture.png" --resize 640x360 -o "demo/cut_$picture.png"
done
oiiotool demo/cut_camera.png demo/cut_program.png demo/cut_view.png --mosaic:pad=6 3x1 -o demo/side_by_side.png
rm demo/cut_*.png
echo "look at demo/side_by_side.png: as a camera shows it, as the eye sees it (program), as the OCIO view shows it,"
echo "which knows no neighbours: no glare around lamps, all detail"
