#include "pipeline/apply_image.h"

#include <OpenEXR/ImfThreading.h>
#include <OpenImageIO/thread.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <deque>
#include <mutex>
#include <thread>

#include "pipeline/acuity_rows.h"
#include "pipeline/frame_light.h"
#include "io/copy_pixels.h"
#include "pipeline/non_finite.h"
#include "io/row_bands.h"

namespace scotopic {
namespace {

const RowOperator nothing_shown;

/// One picture's way through the operator.
class PictureRun {
 public:
  PictureRun(const PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
             const RowOperator& apply, const OutputPicture& out, const RowOperator& show = nothing_shown,
             const FrameLight* frame = nullptr)
      : light_(*layout.light_of(out.source)),
        source_picture_(source.pictures()[out.source]),
        out_(out),
        apply_(apply),
        show_(show),
        frame_(frame),
        reader_(light_.channels, config, light_.space) {
    writer_.from_working = config.from_working(layout.output_space);
    writer_.gain = static_cast<float>(std::exp2(layout.exposure));
    find_others();
    set_alpha(config.linear_xyz(layout.output_space).has_value());
    const bool same_alpha = !light_.channels.alpha || source_picture_.unassociated_alpha == out.picture.unassociated_alpha;
    writer_.keep_untouched = !out.new_space && writer_.gain == 1 && same_alpha;
  }

  /// Fills `out` from `in`; `interleaved` as the sink wants it.
  void run(const Band& in, Band& out, bool interleaved) const {
    allocate(in, out, interleaved);
    // Receptors' signals have no columns of their own to take pieces of.
    if (reader_.receptors() || frame_)
      return each_row(in, [&](int row, LightRow& light) { run_piece(in, row, light, out); });
    const std::vector<Band> from = pieces(in), to = pieces(out);
    parallel_rows(in.rows, 8, [&](int first, int last) {
      // All pieces are of one width, but for the last.
      LightRow light(static_cast<std::size_t>(from.front().width)), rest(static_cast<std::size_t>(from.back().width));
      for (int row = first; row < last; ++row)
        for (std::size_t i = 0; i < from.size(); ++i)
          run_piece(from[i], row, i + 1 < from.size() ? light : rest, to[i]);
    });
  }

  /// The same, with filters at the end: a band may come out later than it went in, or several at once.
  template <typename Write>
  void run(Band&& in, std::deque<AcuityRows>& filters, Band& out, bool interleaved, Write write) const {
    see_band(std::move(in), filters, [&](const AcuityRows& rows) {
      allocate(rows.band(), out, interleaved);
      each_row(rows.band(), [&](int row, LightRow& light) {
        rows.get_row(row, light);
        write_row(rows.band(), row, light, out);
      });
      write(out);
    });
  }

  /// What the operator and all filters make of a band; `use(rows)` for each that comes out.
  template <typename Use>
  void see_band(Band&& in, std::deque<AcuityRows>& filters, Use use) const {
    AcuityRows& first = filters.front();
    const Band* band = first.add(std::move(in));
    each_row(*band, [&](int row, LightRow& light) {
      see_row(*band, row, light);
      first.set_row(row, light);
    });
    pass_on(filters, 0, use);
  }

  /// Pixels with a component that is not finite that no operator has seen.
  std::uint64_t unseen_non_finite() const noexcept { return unseen_non_finite_; }

  bool has_alpha() const { return light_.channels.alpha.has_value(); }

 private:
  template <typename Use>
  static void pass_on(std::deque<AcuityRows>& filters, std::size_t at, Use& use) {
    AcuityRows& rows = filters[at];
    while (rows.next()) {
      if (at + 1 == filters.size()) {
        use(rows);
        continue;
      }
      AcuityRows& next = filters[at + 1];
      const Band* band = next.add(rows.take_band());
      each_row(*band, [&](int row, LightRow& light) {
        rows.get_row(row, light);
        next.set_row(row, light);
      });
      pass_on(filters, at + 1, use);
    }
  }

  /// A row goes piece by piece from the file's bytes to the file's bytes, while it is in the nearest cache; a piece that
  /// nothing is done to keeps the bytes it has.
  static constexpr int piece_width = 512;

  /// Views of a band's columns.
  static std::vector<Band> pieces(const Band& band) {
    std::vector<Band> out(static_cast<std::size_t>((band.width + piece_width - 1) / piece_width));
    int x = 0;
    for (Band& piece : out) {
      piece.y0 = band.y0;
      piece.rows = band.rows;
      piece.width = std::min(piece_width, band.width - x);
      piece.channels = band.channels;
      for (ChannelRows& channel : piece.channels) channel.data += x * channel.stride;
      x += piece_width;
    }
    return out;
  }

  void run_piece(const Band& in, int row, LightRow& light, const Band& out) const {
    if (copies()) return copy_row(in, row, light, out);
    see_row(in, row, light);
    write_row(in, row, light, out);
  }

  void allocate(const Band& in, Band& out, bool interleaved) const {
    const std::vector<Channel>& channels = out_.picture.channels;
    if (interleaved)
      out.allocate_interleaved(channels, in.y0, in.rows, in.width);
    else
      out.allocate_planar(channels, in.y0, in.rows, in.width);
  }

  template <typename Work>
  static void each_row(const Band& band, Work work) {
    parallel_rows(band.rows, 8, [&](int first, int last) {
      LightRow light(static_cast<std::size_t>(band.width));
      for (int row = first; row < last; ++row) work(row, light);
    });
  }

  /// Nothing is called for, and nothing else changes values: the file's own bytes go through.
  bool copies() const { return !apply_ && !show_ && !frame_ && writer_.keep_untouched && !reader_.receptors(); }

  void copy_row(const Band& in, int row, LightRow& room, const Band& out) const {
    bool finite = true;
    for (std::size_t c = 0; c < 3; ++c) {
      const NativeRow from = colour_row(in, row, c);
      copy_other(from, out.channels[c].row(row), room.r);
      finite = finite && !any_non_finite(from, room.r.size());
    }
    copy_others(in, row, room, out);
    if (finite) return;
    reader_.read(in, row, room);
    unseen_non_finite_ += count_non_finite(room.pixels(false));
  }

  void see_row(const Band& in, int row, LightRow& light) const {
    reader_.read(in, row, light);
    const PixelRows pixels = light.pixels(reader_.receptors());
    std::fill(light.touched.begin(), light.touched.end(), std::uint8_t{0});
    if (frame_) take_frame(in, row, light);
    if (apply_) return apply_over(pixels, light);
    unseen_non_finite_ += count_non_finite(pixels);
  }

  /// Light of the whole picture's stages; pixels they changed count as touched.
  void take_frame(const Band& in, int row, LightRow& light) const {
    LightRow before = light;
    frame_->get_row(in.y0 - source_picture_.data.y0 + row, light);
    for (std::size_t i = 0; i < light.r.size(); ++i)
      light.touched[i] = std::memcmp(&before.r[i], &light.r[i], sizeof(float)) != 0 ||
                         std::memcmp(&before.g[i], &light.g[i], sizeof(float)) != 0 ||
                         std::memcmp(&before.b[i], &light.b[i], sizeof(float)) != 0;
  }

  void apply_over(const PixelRows& pixels, LightRow& light) const {
    if (!frame_) return apply_(pixels, light.touched.data());
    std::vector<std::uint8_t> before = light.touched;
    apply_(pixels, light.touched.data());
    for (std::size_t i = 0; i < before.size(); ++i) light.touched[i] |= before[i];
  }

  void write_row(const Band& in, int row, LightRow& light, const Band& out) const {
    if (show_) show_(light.pixels(false), light.touched.data());
    const NativeRow targets[3] = {out.channels[0].row(row), out.channels[1].row(row),
                                  out.channels[2].row(row)};
    if (reader_.receptors()) {
      writer_.write(light, targets, nullptr);
    } else {
      const NativeRow sources[3] = {colour_row(in, row, 0), colour_row(in, row, 1), colour_row(in, row, 2)};
      writer_.write(light, targets, &sources);
    }
    copy_others(in, row, light, out);
  }

  /// R, G or B of the file, or its grey.
  NativeRow colour_row(const Band& in, int row, std::size_t c) const {
    const bool grey = light_.channels.kind == ColourChannels::Kind::grey;
    return in.channels[light_.channels.index[grey ? 0 : c]].row(row);
  }

  void copy_others(const Band& in, int row, LightRow& room, const Band& out) const {
    for (std::size_t i = 0; i < others_.size(); ++i)
      copy_other(in.channels[others_[i]].row(row), out.channels[3 + i].row(row), room.r);
  }

  /// Without alpha beside it colour is written as the light it is.
  void set_alpha(bool linear) {
    const std::optional<std::size_t>& alpha = light_.channels.alpha;
    if (!alpha || std::find(others_.begin(), others_.end(), *alpha) == others_.end()) return;
    const bool straight = out_.picture.unassociated_alpha;
    writer_.divide_by_alpha = straight || !linear;
    writer_.multiply_by_alpha = !straight && !linear;
  }

  /// Channels that are not colour follow R, G, B, in the file's order.
  void find_others() {
    for (std::size_t o = 3; o < out_.picture.channels.size(); ++o) {
      const std::string& name = out_.picture.channels[o].name;
      for (std::size_t c = 0; c < source_picture_.channels.size(); ++c) {
        const bool alpha = light_.channels.alpha == c;
        if (light_.channels.is_colour(c) ||
            (source_picture_.channels[c].name != name && !(alpha && name == "A")))
          continue;
        others_.push_back(c);
        break;
      }
    }
  }

  static void copy_other(const NativeRow& from, const NativeRow& to, std::vector<float>& room) {
    if (from.type == to.type) {
      copy_pixels(from, room.size(), to);
    } else {
      load_row(from, room.size(), room.data());
      store_row(room.data(), room.size(), to);
    }
  }

  const LightPicture& light_;
  const Picture& source_picture_;
  const OutputPicture& out_;
  const RowOperator& apply_;
  const RowOperator& show_;
  const FrameLight* frame_;
  LightReader reader_;
  LightWriter writer_;
  std::vector<std::size_t> others_;  // channel of the source for each output channel after R, G, B
  mutable std::atomic<std::uint64_t> unseen_non_finite_{0};
};

/// What both windows hold; empty where they do not meet.
Window common(const Window& a, const Window& b) {
  const Window both = {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
  return both.width() > 0 && both.height() > 0 ? both : Window{a.x0, a.y0, a.x0, a.y0};
}

PixelRows columns(PixelRows rows, std::uint64_t first, int count) {
  for (float** plane : {&rows.r, &rows.g, &rows.b}) *plane += first;
  for (const float** plane : {&rows.cone_l, &rows.cone_m, &rows.cone_s, &rows.rod})
    if (*plane) *plane += first;
  rows.count = static_cast<std::size_t>(count);
  return rows;
}

/// A picture's way through each filter, in their order.
std::deque<AcuityRows> filter_rows(const SpatialFilters& filters, const Picture& picture, bool descending, bool alpha,
                                   bool wraps) {
  std::deque<AcuityRows> out;
  const bool whole = picture.data.x0 == picture.display.x0 && picture.data.x1 == picture.display.x1;
  for (const SpatialFilter* filter : filters) out.emplace_back(*filter, picture.data, descending, alpha, wraps && whole);
  return out;
}

}  // namespace

std::int64_t rows_to_write(const ImageLayout& layout) {
  std::int64_t rows = 0;
  for (const OutputPicture& out : layout.outputs) rows += out.copy ? 0 : out.picture.data.height();
  return rows;
}

void set_threads(int count) {
  const int threads = count > 0 ? count : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  // The caller works too: pools are the others.
  OIIO::default_thread_pool()->resize(threads - 1);
  Imf::setGlobalThreadCount(threads > 1 ? threads : 0);
}

SceneStatistics measure_image(PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                              const AppearanceParameters& parameters, const std::optional<Window>& region) {
  std::uint64_t pixels = 0;
  for (const LightPicture& light : layout.light) {
    const Window& w = source.pictures()[light.index].data;
    pixels += static_cast<std::uint64_t>(w.width()) * static_cast<std::uint64_t>(w.height());
  }
  const SceneMeter meter(parameters, pixels);
  SceneStatistics all;
  std::uint64_t before = 0;
  for (const LightPicture& light : layout.light) {
    const Picture& picture = source.pictures()[light.index];
    if (picture.level_x != 0 || picture.level_y != 0) continue;
    const LightReader reader(light.channels, config, light.space);
    const auto width = static_cast<std::uint64_t>(picture.data.width());
    const Window meter_in = common(picture.data, region.value_or(picture.data));
    each_band(picture, false, [&](int y0, int rows) {
      if (y0 >= meter_in.y1 || y0 + rows <= meter_in.y0) return;
      Band band;
      source.read(light.index, y0, rows, band);
      // Few large parts, added in their order, so that samples do not depend on which thread was first.
      const int part_rows = std::max(1, (rows + 15) / 16);
      std::vector<SceneStatistics> parts(static_cast<std::size_t>((rows + part_rows - 1) / part_rows));
      parallel_rows(rows, part_rows, [&](int first, int last) {
        LightRow row_light(static_cast<std::size_t>(width));
        for (int row = first; row < last; ++row) {
          if (y0 + row < meter_in.y0 || y0 + row >= meter_in.y1) continue;
          reader.read(band, row, row_light);
          const auto y = static_cast<std::uint64_t>(y0 - picture.data.y0 + row);
          const auto x = static_cast<std::uint64_t>(meter_in.x0 - picture.data.x0);
          meter.measure(columns(row_light.pixels(reader.receptors()), x, meter_in.width()),
                        before + y * width + x, parts[static_cast<std::size_t>(row / part_rows)]);
        }
      });
      for (const SceneStatistics& part : parts) all.add(part);
    });
    before += width * static_cast<std::uint64_t>(picture.data.height());
  }
  source.require_unchanged();
  return all;
}

LuminanceHistogram measure_base(PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                                const RowOperator& apply, const SpatialFilters& filters) {
  LuminanceHistogram all;
  std::mutex lock;
  Band in;
  for (const OutputPicture& out : layout.outputs) {
    const Picture& picture = source.pictures()[out.source];
    if (out.copy || picture.level_x != 0 || picture.level_y != 0) continue;
    const PictureRun run(source, layout, config, apply, out);
    std::deque<AcuityRows> rows_of_filters = filter_rows(filters, picture, false, false, layout.wraps);
    each_band(picture, false, [&](int y0, int rows) {
      source.read(out.source, y0, rows, in);
      run.see_band(std::move(in), rows_of_filters, [&](const AcuityRows& seen) {
        const auto width = static_cast<std::size_t>(seen.band().width);
        parallel_rows(seen.band().rows, std::max(1, (seen.band().rows + 15) / 16), [&](int first, int last) {
          LuminanceHistogram part;
          LightRow light(width);
          for (int row = first; row < last; ++row) {
            seen.get_row(row, light);
            for (const float luminance : light.r)
              if (luminance > 0) part.add(luminance);
          }
          const std::lock_guard guard(lock);
          all.add(part);
        });
      });
      in = Band();
    });
  }
  return all;
}

std::uint64_t apply_image(PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                          const RowOperator& apply, OutputFile& file, const Progress& progress,
                          const SpatialFilters& filters, const RowOperator& show, const FrameLights* frames) {
  const std::unique_ptr<PixelSink> sink = open_sink(layout.format, file, source, layout.outputs);
  const std::int64_t total = rows_to_write(layout);
  std::int64_t done = 0;
  std::uint64_t unseen_non_finite = 0;
  Band in;
  Band out;
  for (std::size_t i = 0; i < layout.outputs.size(); ++i) {
    if (layout.outputs[i].copy) {
      sink->copy(i);
      continue;
    }
    const auto frame = frames ? frames->find(layout.outputs[i].source) : FrameLights::const_iterator();
    const PictureRun run(source, layout, config, apply, layout.outputs[i], show,
                         frames && frame != frames->end() ? &frame->second : nullptr);
    const Picture& picture = source.pictures()[layout.outputs[i].source];
    // OpenEXR wants the rows in the order that its header states, the other formats from the top.
    const bool descending = picture.descending && layout.format == "openexr";
    std::deque<AcuityRows> rows_of_filters = filter_rows(filters, picture, descending, run.has_alpha(), layout.wraps);
    const auto write = [&](const Band& seen) {
      sink->write(i, seen);
      done += seen.rows;
      if (progress) progress(done, total);
    };
    each_band(picture, descending, [&](int y0, int rows) {
      source.read(layout.outputs[i].source, y0, rows, in);
      if (!filters.empty()) {
        run.run(std::move(in), rows_of_filters, out, sink->interleaved(), write);
        in = Band();
      } else {
        run.run(in, out, sink->interleaved());
        write(out);
      }
    });
    unseen_non_finite += run.unseen_non_finite();
  }
  sink->finish();
  source.require_unchanged();
  file.commit();
  return unseen_non_finite;
}

}  // namespace scotopic
