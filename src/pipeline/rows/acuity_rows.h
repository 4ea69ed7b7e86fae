// Bands of light on their way through a filter that looks at the rows around a band too (acuity, a display's
// base layer): each band waits until they have come.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "io/subimage.h"
#include "pipeline/rows/row_codec.h"
#include "stages/acuity/filter.h"

namespace scotopic {

/// A band of a file, and what the writer wants of its light besides R, G and B.
struct WaitingBand {
  Band band;
  std::vector<float> alpha;           ///< rows * width; empty where the subimage has none
  std::vector<std::uint8_t> touched;  ///< rows * width
};

/// Bytes that AcuityRows will keep of a subimage: planned before any is allocated.
std::int64_t acuity_bytes(const SpatialFilter& filter, const Subimage& subimage, bool wraps = false);

/// Rows of one subimage, from its top or (descending) its bottom. Holds the rows of the bands that wait and
/// of the halo: memory does not grow with the height.
class AcuityRows {
 public:
  /// `filter` must outlive it; `data` is the subimage's window; `alpha`: keep it beside the light; `wraps`:
  /// the last column lies beside the first, as in a lat-long panorama.
  AcuityRows(const SpatialFilter& filter, const Window& data, bool descending, bool alpha,
             bool wraps = false);

  /// Makes room for the next band, and says where it lies until next() takes it.
  const Band* add(Band&& band);
  /// Takes row `row` of the band that was added last; any thread.
  void set_row(int row, const LightRow& light);

  /// Works out the oldest band of those that have all the rows they need; false: there is none. A pixel that
  /// the filter changed counts as touched.
  bool next();
  /// The band worked out.
  const Band& band() const { return now_.band; }
  /// The same, for the next filter; its rows can still be got.
  Band take_band() { return std::move(now_.band); }
  /// Row `row` of it; any thread.
  void get_row(int row, LightRow& light) const;

 private:
  const float* plane_row(int channel, int y) const;
  float* plane_row(int channel, int y);
  void forget_rows();
  void filter_band();
  void mark_changes();

  const SpatialFilter& filter_;
  Window data_;
  bool descending_;
  bool alpha_;
  int pad_;     // columns of the other side, left and right of each row
  int stride_;  // floats of a row with them
  std::deque<WaitingBand> waiting_;
  WaitingBand now_;
  std::vector<float> in_[3];   // rows in the order of their coming
  std::vector<float> out_[3];  // of the band worked out, from its top
  int forgotten_ = 0;          // rows that have come and gone
  int come_ = 0;               // rows that have come
};

}  // namespace scotopic
