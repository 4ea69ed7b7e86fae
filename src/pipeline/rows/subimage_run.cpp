#include "pipeline/rows/subimage_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/pixels/copy_pixels.h"
#include "io/pixels/row_bands.h"

namespace scotopic {
namespace {

/// A row goes piece by piece from the file's bytes to the file's bytes, while it is in the nearest cache; a
/// piece that nothing is done to keeps the bytes it has.
constexpr int piece_width = 512;

/// Views of a band's columns.
std::vector<Band> pieces(const Band& band) {
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

void copy_other(const NativeRow& from, const NativeRow& to, std::vector<float>& room) {
  if (from.type == to.type) {
    copy_pixels(from, room.size(), to);
  } else {
    load_row(from, room.size(), room.data());
    store_row(room.data(), room.size(), to);
  }
}

/// A subimage's way through the filters from the one at `at` on.
void pass_on(std::deque<AcuityRows>& filters, std::size_t at,
             const std::function<void(const AcuityRows&)>& use) {
  AcuityRows& rows = filters[at];
  while (rows.next()) {
    if (at + 1 == filters.size()) {
      use(rows);
      continue;
    }
    AcuityRows& next = filters[at + 1];
    const Band* band = next.add(rows.take_band());
    parallel_rows(band->rows, 8, [&](int first, int last) {
      LightRow light(static_cast<std::size_t>(band->width));
      for (int row = first; row < last; ++row) {
        rows.get_row(row, light);
        next.set_row(row, light);
      }
    });
    pass_on(filters, at + 1, use);
  }
}

bool asks_for_scene(const ImageStages& stages) {
  return std::any_of(stages.after.begin(), stages.after.end(),
                     [](const RowStage* stage) { return stage->asks_for_scene(); });
}

const LightPlanes* frame_of(const ImageStages& stages, const ImageLayout& layout,
                            const LightSubimage& light) {
  return stages.frames ? stages.frames->of(static_cast<std::size_t>(&light - layout.light.data())) : nullptr;
}

}  // namespace

SubimageRun::SubimageRun(const PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                         const ImageStages& stages, const OutputSubimage& out, std::size_t layer)
    : light_(*layout.lights_of(out.source).at(layer)),
      source_subimage_(source.subimages()[out.source]),
      out_(out),
      stages_(stages),
      wraps_(layout.wraps),
      frame_(frame_of(stages, layout, light_)),
      reader_(light_.channels, config, light_.space),
      layer_(layer),
      tally_(source_subimage_) {
  writer_.from_working = config.from_working(layout.output_space);
  writer_.gain = static_cast<float>(std::exp2(layout.exposure));
  writer_.dither = layout.dither;
  find_others(layout.lights_of(out.source));
  set_alpha(config.linear_xyz(layout.output_space).has_value());
  const bool same_alpha =
      !light_.channels.alpha || source_subimage_.unassociated_alpha == out.subimage.unassociated_alpha;
  writer_.keep_untouched = !out.new_space && writer_.gain == 1 && same_alpha;
  whole_rows_ = asks_for_scene(stages);
}

SubimageRun::Room::Room(std::size_t width, const ImageStages& stages)
    : light(width), scene(asks_for_scene(stages) ? width : 0) {
  for (const RowStage* stage : stages.after) memory.push_back(stage->memory());
}

void SubimageRun::run(const Band& in, const Band& out) const {
  // Receptors' signals have no columns of their own to take pieces of.
  if (reader_.receptors() || whole_rows_)
    return each_row(in, [&](int row, Room& room) { run_piece(in, 0, row, room, out); });
  const std::vector<Band> from = pieces(in), to = pieces(out);
  parallel_rows(in.rows, 8, [&](int first, int last) {
    // All pieces are of one width, but for the last.
    Room usual(static_cast<std::size_t>(from.front().width), stages_);
    Room rest(static_cast<std::size_t>(from.back().width), stages_);
    for (int row = first; row < last; ++row)
      for (std::size_t i = 0; i < from.size(); ++i)
        run_piece(from[i], static_cast<int>(i) * piece_width, row, i + 1 < from.size() ? usual : rest, to[i]);
  });
}

void SubimageRun::run(Band&& in, std::deque<AcuityRows>& filters,
                      const std::function<const Band&(const Band& seen)>& place) const {
  see_band(std::move(in), filters, [&](const AcuityRows& rows) {
    const Band& out = place(rows.band());
    each_row(rows.band(), [&](int row, Room& room) {
      rows.get_row(row, room.light);
      write_row(rows.band(), 0, row, room, out);
    });
  });
}

void SubimageRun::see_band(Band&& in, std::deque<AcuityRows>& filters,
                           const std::function<void(const AcuityRows&)>& use) const {
  AcuityRows& first = filters.front();
  const Band* band = first.add(std::move(in));
  each_row(*band, [&](int row, Room& room) {
    see_row(*band, 0, row, room);
    first.set_row(row, room.light);
  });
  pass_on(filters, 0, use);
}

std::deque<AcuityRows> SubimageRun::filter_rows(bool descending, bool keep_alpha) const {
  std::deque<AcuityRows> out;
  const Subimage& p = source_subimage_;
  const bool whole = p.data.x0 == p.display.x0 && p.data.x1 == p.display.x1;
  const bool alpha = keep_alpha && light_.channels.alpha.has_value();
  for (const SpatialFilter* filter : stages_.filters)
    out.emplace_back(*filter, p.data, descending, alpha, wraps_ && whole);
  return out;
}

void SubimageRun::each_row(const Band& band, const std::function<void(int row, Room& room)>& work) const {
  parallel_rows(band.rows, 8, [&](int first, int last) {
    rooms_.with([&] { return std::make_unique<Room>(static_cast<std::size_t>(band.width), stages_); },
                [&](Room& room) {
                  for (int row = first; row < last; ++row) work(row, room);
                });
  });
}

void SubimageRun::run_piece(const Band& in, int x, int row, Room& room, const Band& out) const {
  if (copies()) return copy_row(in, x, row, room.light, out);
  see_row(in, x, row, room);
  write_row(in, x, row, room, out);
}

void SubimageRun::allocate(const Band& in, Band& out, bool interleaved) const {
  const std::vector<Channel>& channels = out_.subimage.channels;
  if (interleaved)
    out.allocate_interleaved(channels, in.y0, in.rows, in.width);
  else
    out.allocate_planar(channels, in.y0, in.rows, in.width);
}

// Nothing is called for, and nothing else changes values: the file's own bytes go through.
bool SubimageRun::copies() const {
  const bool nothing = !stages_.evaluator && stages_.after.empty() && !frame_ && !stages_.light &&
                       stages_.non_finite != NonFinite::clean;
  return nothing && writer_.keep_untouched && !reader_.receptors();
}

void SubimageRun::copy_row(const Band& in, int x, int row, LightRow& room, const Band& out) const {
  bool finite = true;
  for (std::size_t c = 0; c < 3; ++c) {
    const NativeRow from = colour_row(in, row, c);
    copy_other(from, out.channels[3 * layer_ + c].row(row), room.r);
    finite = finite && !any_non_finite(from, room.r.size());
  }
  copy_others(in, row, room, out);
  if (!finite) (void)read_light(in, x, row, room, &tally_);
}

// Light as the operator sees it; returns the pixels of it that are not finite, which are clean by now if they
// are to be.
std::vector<std::size_t> SubimageRun::read_light(const Band& in, int x, int row, LightRow& light,
                                                 NonFiniteTally* tally) const {
  reader_.read(in, row, light);
  const PixelRows pixels = light.pixels(reader_.receptors());
  std::vector<std::size_t> bad = non_finite_of(pixels);
  if (tally) tally->add(bad, source_subimage_.data.x0 + x, in.y0 + row);
  light.changed.clear();
  if (frame_) {
    frame_->replace(in.y0 + row - source_subimage_.data.y0, x, light);
    bad = non_finite_of(pixels);
  }
  if (stages_.non_finite == NonFinite::clean) clean(pixels, bad);
  if (stages_.light) apply_matrices(*stages_.light, reader_.receptors(), light);
  return bad;
}

void SubimageRun::see_row(const Band& in, int x, int row, Room& room) const {
  LightRow& light = room.light;
  const std::vector<std::size_t> bad = read_light(in, x, row, light, &tally_);
  if (whole_rows_ && stages_.filters.empty()) room.scene = light;
  if (stages_.evaluator)
    (*stages_.evaluator)(light.pixels(reader_.receptors()), light.touched.data());
  else
    std::fill(light.touched.begin(), light.touched.end(), std::uint8_t{0});
  for (std::size_t i = 0; i < light.changed.size(); ++i)
    light.touched[i] = static_cast<std::uint8_t>(light.touched[i] | light.changed[i]);
  if (stages_.non_finite == NonFinite::clean)
    for (const std::size_t i : bad) light.touched[i] = 1;
}

// The stages after those that look around.
void SubimageRun::show_row(const Band& in, int x, int row, Room& room) const {
  const Window& d = source_subimage_.display;
  RowSight sight;
  sight.at = {source_subimage_.data.x0 + x, in.y0 + row, d.x0, d.y0, d.x1, d.y1, stages_.moment};
  // Behind filters a row comes back later than it was seen: then it is read again rather than kept.
  if (whole_rows_ && !stages_.filters.empty()) (void)read_light(in, x, row, room.scene, nullptr);
  for (std::size_t i = 0; i < stages_.after.size(); ++i) {
    const RowStage& stage = *stages_.after[i];
    sight.scene = stage.asks_for_scene() ? room.scene.pixels(reader_.receptors()) : PixelRows();
    sight.memory = room.memory[i].get();
    stage.apply(room.light.pixels(false), sight, room.light.touched.data());
  }
}

void SubimageRun::write_row(const Band& in, int x, int row, Room& room, const Band& out) const {
  if (!stages_.after.empty()) show_row(in, x, row, room);
  LightRow& light = room.light;
  const auto target = [&](std::size_t c) { return out.channels[3 * layer_ + c].row(row); };
  const NativeRow targets[3] = {target(0), target(1), target(2)};
  const bool counts = source_subimage_.is_full_resolution();
  if (counts && straightened_ && stages_.behind_alpha)
    *stages_.behind_alpha += pixels_behind_alpha(light, writer_.gain);
  bool changed = false;
  if (reader_.receptors()) {
    changed = writer_.write(light, targets, nullptr, x, in.y0 + row);
  } else {
    const NativeRow sources[3] = {colour_row(in, row, 0), colour_row(in, row, 1), colour_row(in, row, 2)};
    changed = writer_.write(light, targets, &sources, x, in.y0 + row);
  }
  if (counts && changed && stages_.clipped) *stages_.clipped += clipped_pixels(light, targets[0].type);
  copy_others(in, row, light, out);
}

// R, G or B of the file, or its grey.
NativeRow SubimageRun::colour_row(const Band& in, int row, std::size_t c) const {
  const bool grey = light_.channels.kind == ColourChannels::Kind::grey;
  return in.channels[light_.channels.index[grey ? 0 : c]].row(row);
}

void SubimageRun::copy_others(const Band& in, int row, LightRow& room, const Band& out) const {
  if (layer_ > 0) return;
  for (std::size_t i = 0; i < others_.size(); ++i)
    copy_other(in.channels[others_[i]].row(row), out.channels[first_other_ + i].row(row), room.r);
}

// Without alpha beside it colour is written as the light it is.
void SubimageRun::set_alpha(bool linear) {
  const std::optional<std::size_t>& alpha = light_.channels.alpha;
  if (!alpha || std::find(others_.begin(), others_.end(), *alpha) == others_.end()) return;
  const bool straight = out_.subimage.unassociated_alpha;
  writer_.divide_by_alpha = straight || !linear;
  straightened_ = straight && !source_subimage_.unassociated_alpha;
  writer_.multiply_by_alpha = !straight && !linear;
}

// Channels that are not colour follow R, G, B of all layers, in the file's order.
void SubimageRun::find_others(const std::vector<const LightSubimage*>& layers) {
  const auto is_light = [&](std::size_t c) {
    return std::any_of(layers.begin(), layers.end(),
                       [&](const LightSubimage* l) { return l->channels.is_colour(c); });
  };
  first_other_ = 3 * layers.size();
  for (std::size_t o = first_other_; o < out_.subimage.channels.size(); ++o) {
    const std::string& name = out_.subimage.channels[o].name;
    for (std::size_t c = 0; c < source_subimage_.channels.size(); ++c) {
      const bool alpha = light_.channels.alpha == c;
      if (is_light(c) || (source_subimage_.channels[c].name != name && !(alpha && name == "A"))) continue;
      others_.push_back(c);
      break;
    }
  }
}

}  // namespace scotopic
