#include "pipeline/lmsr_image.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <deque>

#include "base/error.h"
#include "io/pixels/row_bands.h"
#include "pipeline/rows/row_codec.h"
#include "receptors/receptor_space.h"

namespace scotopic {
namespace {

constexpr std::array<const char*, 4> receptor_names = {"L", "M", "S", "R"};

/// One picture's light as L, M, S, R.
class ReceptorRun {
 public:
  ReceptorRun(const PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
              const RodChoice& rods, const OutputSubimage& out, std::size_t layer)
      : picture_(source.subimages()[out.source]),
        light_(*layout.lights_of(out.source).at(layer)),
        out_(out),
        reader_(light_.channels, config, light_.space),
        xyz_from_rgb_(config.xyz_from_working()),
        rods_(rods),
        first_(receptor_names.size() * layer),
        tally_(picture_) {
    if (layer == 0) find_others(layout.lights_of(out.source));
  }

  void allocate(const Band& in, Band& out) const {
    out.allocate_planar(out_.subimage.channels, in.y0, in.rows, in.width);
  }

  void run(const Band& in, const Band& out) const {
    parallel_rows(in.rows, 8, [&](int first, int last) {
      LightRow light(static_cast<std::size_t>(in.width));
      for (int row = first; row < last; ++row) run_row(in, row, light, out);
    });
  }

  /// Pixels of the source that are not.
  NonFinitePixels non_finite() const { return tally_.found(); }

 private:
  void find_others(const std::vector<const LightSubimage*>& layers) {
    const std::vector<Channel>& from = picture_.channels;
    const auto is_light = [&](std::size_t c) {
      return std::any_of(layers.begin(), layers.end(),
                         [&](const LightSubimage* l) { return l->channels.is_colour(c); });
    };
    for (std::size_t o = receptor_names.size() * layers.size(); o < out_.subimage.channels.size(); ++o)
      for (std::size_t c = 0; c < from.size(); ++c)
        if (!is_light(c) && (from[c].name == out_.subimage.channels[o].name ||
                             (light_.channels.alpha == c && out_.subimage.channels[o].name == "A")))
          others_.emplace_back(o, c);
  }

  void run_row(const Band& in, int row, LightRow& light, const Band& out) const {
    const auto width = static_cast<std::size_t>(in.width);
    if (light_.channels.kind == ColourChannels::Kind::computed) {
      bool finite = true;
      for (std::size_t s = 0; s < receptor_names.size(); ++s) {
        const float* signals = in.signals[s].data() + width * static_cast<std::size_t>(row);
        store_row(signals, width, out.channels[first_ + s].row(row));
        finite = finite && !any_non_finite(signals, width);
      }
      if (!finite) {
        reader_.read(in, row, light);
        count(in, row, light);
      }
    } else {
      reader_.read(in, row, light);
      count(in, row, light);
      if (!reader_.receptors()) see(light);
      const std::vector<float>* planes[] = {&light.cone_l, &light.cone_m, &light.cone_s, &light.rod};
      for (std::size_t s = 0; s < receptor_names.size(); ++s)
        store_row(planes[s]->data(), width, out.channels[first_ + s].row(row));
    }
    for (const auto& [to, from] : others_)
      copy(in.channels[from].row(row), out.channels[to].row(row), light.r);
  }

  void count(const Band& in, int row, LightRow& light) const {
    tally_.add(non_finite_of(light.pixels(reader_.receptors())), picture_.data.x0, in.y0 + row);
  }

  /// Receptor signals of working RGB.
  void see(LightRow& light) const {
    const Matrix3<double> cones = lms_from_xyz() * xyz_from_rgb_;
    const double rod_per_luminance = rod_signal_per_scotopic_luminance();
    for (std::size_t i = 0; i < light.r.size(); ++i) {
      const Vec3<double> rgb = {light.r[i], light.g[i], light.b[i]};
      const Vec3<double> lms = cones * rgb;
      light.cone_l[i] = static_cast<float>(lms[0]);
      light.cone_m[i] = static_cast<float>(lms[1]);
      light.cone_s[i] = static_cast<float>(lms[2]);
      light.rod[i] =
          static_cast<float>(rod_per_luminance * scotopic_luminance_from_xyz(xyz_from_rgb_ * rgb,
                                                                             rods_.estimate, rods_.sp_ratio));
    }
  }

  static void copy(const NativeRow& from, const NativeRow& to, std::vector<float>& room) {
    const std::size_t size = size_of(from.type);
    if (from.type == to.type) {
      for (std::size_t i = 0; i < room.size(); ++i)
        std::memcpy(to.data + static_cast<std::ptrdiff_t>(i) * to.stride,
                    from.data + static_cast<std::ptrdiff_t>(i) * from.stride, size);
    } else {
      load_row(from, room.size(), room.data());
      store_row(room.data(), room.size(), to);
    }
  }

  const Subimage& picture_;
  const LightSubimage& light_;
  const OutputSubimage& out_;
  LightReader reader_;
  Matrix3<double> xyz_from_rgb_;
  RodChoice rods_;
  std::size_t first_;  // of the output's channels that this layer becomes
  std::vector<std::pair<std::size_t, std::size_t>> others_;  // output channel, source channel
  mutable NonFiniteTally tally_;
};

}  // namespace

void make_lmsr_layout(ImageLayout& layout, const std::string& output) {
  if (layout.format != "openexr")
    throw Error(ExitCode::usage, output, "receptor signals are written as OpenEXR only");
  for (OutputSubimage& out : layout.outputs) {
    if (out.copy) continue;
    const std::vector<const LightSubimage*> layers = layout.lights_of(out.source);
    std::vector<std::string> made;
    for (const LightSubimage* light : layers)
      for (const char* name : receptor_names)
        made.push_back((light->channels.layer.empty() ? "" : light->channels.layer + ".") + name);
    std::vector<Channel> channels;
    for (const std::string& name : made) channels.push_back({name, out.subimage.channels[0].type});
    for (std::size_t c = 3 * layers.size(); c < out.subimage.channels.size(); ++c)
      if (std::find(made.begin(), made.end(), out.subimage.channels[c].name) == made.end())
        channels.push_back(out.subimage.channels[c]);
    out.subimage.channels = std::move(channels);
    out.new_space = true;
    out.new_tags = true;
    out.tags = {};
  }
}

NonFinitePixels write_lmsr(PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                           const RodChoice& rods, OutputFile& file, const Progress& progress) {
  const std::unique_ptr<PixelSink> sink = open_sink(layout.format, file, source, layout.outputs);
  const std::int64_t total = rows_to_write(layout);
  std::int64_t done = 0;
  NonFinitePixels non_finite;
  Band in;
  Band out;
  for (std::size_t i = 0; i < layout.outputs.size(); ++i) {
    if (layout.outputs[i].copy) {
      sink->copy(i);
      continue;
    }
    std::deque<ReceptorRun> runs;
    for (std::size_t layer = 0; layer < layout.lights_of(layout.outputs[i].source).size(); ++layer)
      runs.emplace_back(source, layout, config, rods, layout.outputs[i], layer);
    const Subimage& subimage = source.subimages()[layout.outputs[i].source];
    each_band(subimage, subimage.descending, [&](int y0, int rows) {
      source.read(layout.outputs[i].source, y0, rows, in);
      runs.front().allocate(in, out);
      for (const ReceptorRun& run : runs) run.run(in, out);
      sink->write(i, out);
      done += rows;
      if (progress) progress(done, total);
    });
    for (const ReceptorRun& run : runs) non_finite.add(run.non_finite());
  }
  sink->finish();
  source.require_unchanged();
  file.commit();
  return non_finite;
}

}  // namespace scotopic
