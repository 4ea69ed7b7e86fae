#include <algorithm>
#include <deque>
#include <mutex>

#include "io/pixels/row_bands.h"
#include "pipeline/apply_image.h"
#include "pipeline/rows/subimage_run.h"

namespace scotopic {
namespace {

/// What both windows hold; empty where they do not meet.
Window common(const Window& a, const Window& b) {
  const Window both = {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1),
                       std::min(a.y1, b.y1)};
  return both.width() > 0 && both.height() > 0 ? both : Window{a.x0, a.y0, a.x0, a.y0};
}

PixelRows columns(PixelRows rows, std::uint64_t first, int count) {
  for (float** plane : {&rows.r, &rows.g, &rows.b}) *plane += first;
  for (const float** plane : {&rows.cone_l, &rows.cone_m, &rows.cone_s, &rows.rod})
    if (*plane) *plane += first;
  rows.count = static_cast<std::size_t>(count);
  return rows;
}

/// Pixels of all subimages with light, smaller resolutions included.
std::uint64_t pixels_of(const PixelSource& source, const ImageLayout& layout) {
  std::uint64_t pixels = 0;
  for (const LightSubimage& light : layout.light) {
    if (!light.metered) continue;
    const Window& w = source.subimages()[light.index].data;
    pixels += static_cast<std::uint64_t>(w.width()) * static_cast<std::uint64_t>(w.height());
  }
  return pixels;
}

/// A pass over one subimage.
class SubimageMeter {
 public:
  SubimageMeter(const Subimage& subimage, const LightReader& reader, const LightPlanes* frame,
                const SceneMeter& meter, const MeterRequest& request, std::uint64_t before)
      : picture_(subimage),
        reader_(reader),
        frame_(frame),
        meter_(meter),
        whole_(request.whole ? subimage.data : Window{}),
        region_(request.region ? common(subimage.data, *request.region) : Window{}),
        before_(before),
        tally_(subimage) {}

  /// Whether any of these rows counts.
  bool wants(int y0, int rows) const { return meets(whole_, y0, rows) || meets(region_, y0, rows); }

  void measure(const Band& band, int y0, int rows, MeasuredLight& all) {
    // Few large parts, added in their order, so that samples do not depend on which thread was first.
    const int part_rows = std::max(1, (rows + 15) / 16);
    std::vector<MeasuredLight> parts(static_cast<std::size_t>((rows + part_rows - 1) / part_rows));
    parallel_rows(rows, part_rows, [&](int first, int last) {
      LightRow light(static_cast<std::size_t>(picture_.data.width()));
      for (int row = first; row < last; ++row)
        measure_row(band, y0, row, light, parts[static_cast<std::size_t>(row / part_rows)]);
    });
    for (const MeasuredLight& part : parts) {
      all.whole.add(part.whole);
      all.region.add(part.region);
    }
  }

  NonFinitePixels non_finite() const { return tally_.found(); }

 private:
  static bool meets(const Window& w, int y0, int rows) {
    return w.width() > 0 && y0 < w.y1 && y0 + rows > w.y0;
  }

  void measure_row(const Band& band, int y0, int row, LightRow& light, MeasuredLight& out) {
    if (!wants(y0 + row, 1)) return;
    if (frame_)
      frame_->get(y0 - picture_.data.y0 + row, light);
    else
      reader_.read(band, row, light);
    const std::uint64_t bad = out.whole.non_finite;
    measure_columns(whole_, y0 + row, light, out.whole);
    measure_columns(region_, y0 + row, light, out.region);
    if (out.whole.non_finite > bad)
      tally_.add(non_finite_of(light.pixels(reader_.receptors())), picture_.data.x0, y0 + row);
  }

  void measure_columns(const Window& window, int y, LightRow& light, SceneStatistics& out) const {
    if (!meets(window, y, 1)) return;
    const auto width = static_cast<std::uint64_t>(picture_.data.width());
    const auto row = static_cast<std::uint64_t>(y - picture_.data.y0);
    const auto x = static_cast<std::uint64_t>(window.x0 - picture_.data.x0);
    meter_.measure(columns(light.pixels(reader_.receptors()), x, window.width()), before_ + row * width + x,
                   out);
  }

  const Subimage& picture_;
  const LightReader& reader_;
  const LightPlanes* frame_;
  const SceneMeter& meter_;
  Window whole_, region_;
  std::uint64_t before_;
  NonFiniteTally tally_;
};

}  // namespace

MeasuredLight measure_light(PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                            const AppearanceParameters& parameters, const MeterRequest& request,
                            const FrameLights* frames) {
  const SceneMeter meter(parameters, pixels_of(source, layout));
  MeasuredLight all;
  std::uint64_t before = 0;
  for (std::size_t i = 0; i < layout.light.size(); ++i) {
    const LightSubimage& light = layout.light[i];
    const Subimage& subimage = source.subimages()[light.index];
    if (!light.metered || !subimage.is_full_resolution()) continue;
    const LightReader reader(light.channels, config, light.space);
    const LightPlanes* const frame = frames ? frames->of(i) : nullptr;
    SubimageMeter of_picture(subimage, reader, frame, meter, request, before);
    each_band(subimage, false, [&](int y0, int rows) {
      if (!of_picture.wants(y0, rows)) return;
      Band band;
      if (!frame) source.read(light.index, y0, rows, band);
      of_picture.measure(band, y0, rows, all);
    });
    all.non_finite.add(of_picture.non_finite());
    before += static_cast<std::uint64_t>(subimage.data.width()) *
              static_cast<std::uint64_t>(subimage.data.height());
  }
  source.require_unchanged();
  return all;
}

SceneStatistics measure_image(PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                              const AppearanceParameters& parameters, const std::optional<Window>& region) {
  const MeasuredLight measured = measure_light(source, layout, config, parameters, {!region, region});
  return region ? measured.region : measured.whole;
}

LuminanceHistogram measure_base(PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                                const ImageStages& stages) {
  LuminanceHistogram all;
  std::mutex lock;
  Band in;
  const auto add = [&](const AcuityRows& seen) {
    parallel_rows(seen.band().rows, std::max(1, (seen.band().rows + 15) / 16), [&](int first, int last) {
      LuminanceHistogram part;
      LightRow light(static_cast<std::size_t>(seen.band().width));
      for (int row = first; row < last; ++row) {
        seen.get_row(row, light);
        for (const float luminance : light.r)
          if (luminance > 0) part.add(luminance);
      }
      const std::lock_guard guard(lock);
      all.add(part);
    });
  };
  for (const OutputSubimage& out : layout.outputs) {
    const Subimage& subimage = source.subimages()[out.source];
    if (out.copy || !subimage.is_full_resolution()) continue;
    const std::vector<const LightSubimage*> layers = layout.lights_of(out.source);
    for (std::size_t layer = 0; layer < layers.size(); ++layer) {
      if (!layers[layer]->metered) continue;
      const SubimageRun run(source, layout, config, stages, out, layer);
      std::deque<AcuityRows> filters = run.filter_rows(false, false);
      each_band(subimage, false, [&](int y0, int rows) {
        source.read(out.source, y0, rows, in);
        run.see_band(std::move(in), filters, add);
        in = Band();
      });
    }
  }
  return all;
}

}  // namespace scotopic
