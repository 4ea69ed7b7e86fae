// One subimage's way through all stages: bands of the file in, bands of the output out.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "pipeline/apply_image.h"
#include "pipeline/rows/acuity_rows.h"
#include "pipeline/rows/row_codec.h"
#include "stages/spares.h"

namespace scotopic {

/// What it is given must outlive it. Rows are worked on by all threads.
class SubimageRun {
 public:
  /// `out` is of `layout`, and no copy; `layer`: of the layers of light in that subimage.
  SubimageRun(const PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
              const ImageStages& stages, const OutputSubimage& out, std::size_t layer = 0);

  /// Makes room for what becomes of `in`; `interleaved` as the sink wants it.
  void allocate(const Band& in, Band& out, bool interleaved) const;

  /// The layer's R, G, B of `out` from `in`, where there are no filters; of the first layer with the channels
  /// that are no light.
  void run(const Band& in, const Band& out) const;

  /// The same with filters at the end: a band may come out later than it went in, or several at once; `place`
  /// says where what becomes of one goes.
  void run(Band&& in, std::deque<AcuityRows>& filters,
           const std::function<const Band&(const Band& seen)>& place) const;

  /// What all stages up to the filters make of a band; `use(rows)` for each that comes out.
  void see_band(Band&& in, std::deque<AcuityRows>& filters,
                const std::function<void(const AcuityRows&)>& use) const;

  /// Room for the filters' rows, in their order.
  std::deque<AcuityRows> filter_rows(bool descending, bool keep_alpha) const;

  /// Pixels of the file that have passed and are not finite.
  NonFinitePixels non_finite() const { return tally_.found(); }

 private:
  /// Room for one row at work.
  struct Room {
    Room(std::size_t width, const ImageStages& stages);
    LightRow light;
    LightRow scene;                                  ///< as the pixel stages saw it; only for stages that ask
    std::vector<std::unique_ptr<RowMemory>> memory;  ///< of each of the stages after the filters
  };

  void each_row(const Band& band, const std::function<void(int row, Room& room)>& work) const;
  void run_piece(const Band& in, int x, int row, Room& room, const Band& out) const;
  bool copies() const;
  void copy_row(const Band& in, int x, int row, LightRow& room, const Band& out) const;
  std::vector<std::size_t> read_light(const Band& in, int x, int row, LightRow& light,
                                      NonFiniteTally* tally) const;
  void see_row(const Band& in, int x, int row, Room& room) const;
  void show_row(const Band& in, int x, int row, Room& room) const;
  void write_row(const Band& in, int x, int row, Room& room, const Band& out) const;
  NativeRow colour_row(const Band& in, int row, std::size_t c) const;
  void copy_others(const Band& in, int row, LightRow& room, const Band& out) const;
  void set_alpha(bool linear);
  void find_others(const std::vector<const LightSubimage*>& layers);

  const LightSubimage& light_;
  const Subimage& source_subimage_;
  const OutputSubimage& out_;
  const ImageStages& stages_;
  bool wraps_;
  const LightPlanes* frame_ = nullptr;
  LightReader reader_;
  LightWriter writer_;
  bool straightened_ = false;  ///< colour is divided by alpha, which the source had multiplied in
  bool whole_rows_ = false;    // for stages after the filters that look at the scene
  std::size_t layer_;
  std::size_t first_other_ = 3;      // of the output's channels: those before are R, G, B of each layer
  std::vector<std::size_t> others_;  // channel of the source for each from there on
  mutable NonFiniteTally tally_;
  mutable Spares<Room> rooms_;  // for whole rows: what stages remember of a row serves the next chunk's, too
};

}  // namespace scotopic
