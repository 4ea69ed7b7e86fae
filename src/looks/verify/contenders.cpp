#include "looks/verify/contenders.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "batch/batch.h"
#include "batch/half_rows.h"
#include "io/pixels/row_bands.h"
#include "stages/reference.h"

namespace scotopic {
namespace {

using SharedWorkplace = std::shared_ptr<Workplace>;

/// Slow evaluators see but a part of the picture.
constexpr std::size_t slow_share = 16;

std::size_t slow_rows(const SharedWorkplace& place) {
  return std::max<std::size_t>(1, place->rows() / slow_share);
}

TimedRun timed_rows(const SharedWorkplace& place, std::size_t rows, const RowOperator& apply,
                    bool threaded = false) {
  const std::size_t pixels = place->restore(rows);
  const auto some = [place, apply](int first, int last) {
    for (int y = first; y < last; ++y) apply(place->row(static_cast<std::size_t>(y)), nullptr);
  };
  const int count = static_cast<int>(rows);
  return {[place, rows] { (void)place->restore(rows); },
          [some, count, threaded] { threaded ? parallel_rows(count, 8, some) : some(0, count); }, pixels};
}

Contender contender(std::string group, std::string name, EvaluatorError error, TimedRun run) {
  Contender out;
  out.row.group = std::move(group);
  out.row.name = std::move(name);
  out.row.error = std::move(error);
  out.run = std::move(run);
  return out;
}

Contender scalar_contender(const AppearanceParameters& p, const SharedWorkplace& place,
                           const Colours& colours) {
  const auto reference = std::make_shared<AppearanceReference>(p);
  const RowOperator apply = [reference](const PixelRows& rows, std::uint8_t*) {
    for (std::size_t i = 0; i < rows.count; ++i) {
      const Vec3<double> out = (*reference)({{rows.r[i], rows.g[i], rows.b[i]}});
      rows.r[i] = static_cast<float>(out[0]);
      rows.g[i] = static_cast<float>(out[1]);
      rows.b[i] = static_cast<float>(out[2]);
    }
  };
  return contender("operator", "double, scalar", evaluator_error(p, apply, colours),
                   timed_rows(place, slow_rows(place), apply));
}

std::vector<std::uint16_t> halves(const std::vector<float>& values) {
  std::vector<std::uint16_t> out(values.size());
  halves_from_floats(values.data(), values.size(), out.data());
  return out;
}

std::vector<float> floats(const std::vector<std::uint16_t>& values) {
  std::vector<float> out(values.size());
  floats_from_halves(values.data(), values.size(), out.data());
  return out;
}

/// Colours as a file's pixels hold them, computed in place.
class HalfPlanes {
 public:
  static constexpr const char* name = "float, half planes in and out";
  explicit HalfPlanes(const Colours& c) : planes_{halves(c.r), halves(c.g), halves(c.b)} {}
  Colours colours() const { return {floats(planes_[0]), floats(planes_[1]), floats(planes_[2])}; }
  void apply(const AppearanceBatch& batch) {
    batch.apply(HalfRows{planes_[0].data(), planes_[1].data(), planes_[2].data(), planes_[0].size()});
  }

 private:
  std::array<std::vector<std::uint16_t>, 3> planes_;
};

class Rgba {
 public:
  static constexpr const char* name = "float, RGBA float";
  explicit Rgba(const Colours& c) {
    for (std::size_t i = 0; i < c.size(); ++i) pixels_.insert(pixels_.end(), {c.r[i], c.g[i], c.b[i], 1.0f});
  }
  Colours colours() const {
    Colours out;
    for (std::size_t i = 0; i < pixels_.size(); i += 4) {
      out.r.push_back(pixels_[i]);
      out.g.push_back(pixels_[i + 1]);
      out.b.push_back(pixels_[i + 2]);
    }
    return out;
  }
  void apply(const AppearanceBatch& batch) { batch.apply_rgba(pixels_.data(), pixels_.size() / 4); }

 private:
  std::vector<float> pixels_;
};

template <class Layout>
Contender layout_contender(const AppearanceParameters& p, const TimedPicture& picture,
                           const Colours& colours) {
  const auto batch = std::make_shared<AppearanceBatch>(p);
  Layout compared(colours);
  const Colours in = compared.colours();
  compared.apply(*batch);
  const auto from = std::make_shared<const Layout>(picture.pixels);
  const auto work = std::make_shared<Layout>(*from);
  return contender(
      "files", Layout::name, evaluator_error(p, in, compared.colours()),
      {[from, work] { *work = *from; }, [work, batch] { work->apply(*batch); }, picture.pixels.size()});
}

}  // namespace

std::size_t Workplace::restore(std::size_t rows) {
  const std::size_t count = rows * picture_.width;
  std::copy_n(picture_.pixels.r.begin(), count, work_.r.begin());
  std::copy_n(picture_.pixels.g.begin(), count, work_.g.begin());
  std::copy_n(picture_.pixels.b.begin(), count, work_.b.begin());
  return count;
}

PixelRows Workplace::row(std::size_t y) {
  const std::size_t at = y * picture_.width;
  PixelRows rows;
  rows.r = work_.r.data() + at;
  rows.g = work_.g.data() + at;
  rows.b = work_.b.data() + at;
  rows.count = picture_.width;
  return rows;
}

Contender evaluator_contender(const AppearanceParameters& p, const EvaluatorKind& kind,
                              const SharedWorkplace& place, const Colours& colours) {
  PreparedEvaluator prepared = prepare_evaluator(p, kind);
  const std::size_t rows = kind.edge > 0 ? slow_rows(place) : place->rows();
  Contender out = contender("operator", std::string(kind.name), evaluator_error(p, prepared.apply, colours),
                            timed_rows(place, rows, prepared.apply));
  out.row.seconds = prepared.seconds;
  out.row.bytes = prepared.bytes;
  out.apply = std::move(prepared.apply);
  return out;
}

TimedPicture night_picture(std::size_t width, std::size_t height, const AppearanceParameters& p) {
  TimedPicture out;
  out.width = width;
  const double ground = p.adaptation / p.white_luminance;
  const double lamp = 20 / p.white_luminance;  // cd/m2: photopic whatever La is
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const double u = static_cast<double>(x) / 97, v = static_cast<double>(y) / 89;
      const bool lit = x % 512 < 24 && y % 384 < 24;
      const double level =
          lit ? lamp : ground * std::exp2(2 * std::sin(u) * std::cos(v) + std::sin(7 * u + 5 * v));
      out.pixels.r.push_back(static_cast<float>(level * (1.1 + 0.9 * std::sin(0.31 * u + v))));
      out.pixels.g.push_back(static_cast<float>(level * (1.0 + 0.3 * std::cos(0.57 * v - u))));
      out.pixels.b.push_back(static_cast<float>(level * (1.1 + 0.9 * std::cos(0.43 * u + 2 * v))));
    }
  return out;
}

TimedPicture repeated(const TimedPicture& picture, std::size_t pixels) {
  TimedPicture out;
  out.width = picture.width;
  const std::size_t rows = std::max<std::size_t>(1, (pixels + picture.width - 1) / picture.width);
  for (std::size_t y = 0; y < rows; ++y) {
    const auto first = static_cast<std::ptrdiff_t>(y % picture.rows() * picture.width);
    const auto last = first + static_cast<std::ptrdiff_t>(picture.width);
    const auto append = [&](std::vector<float>& to, const std::vector<float>& from) {
      to.insert(to.end(), from.begin() + first, from.begin() + last);
    };
    append(out.pixels.r, picture.pixels.r);
    append(out.pixels.g, picture.pixels.g);
    append(out.pixels.b, picture.pixels.b);
  }
  return out;
}

std::vector<Contender> operator_contenders(const AppearanceParameters& p, const TimedPicture& picture,
                                           const Colours& colours, int threads) {
  const auto place = std::make_shared<Workplace>(picture);
  std::vector<Contender> out = {scalar_contender(p, place, colours)};
  for (const EvaluatorKind& kind : evaluator_kinds)
    out.push_back(evaluator_contender(p, kind, place, colours));
  for (const char* name : {"double", "float"}) {
    if (threads < 2) break;
    Contender c = evaluator_contender(p, evaluator_named(name), place, colours);
    c.row.group = fmt::format("operator, {} threads", threads);
    c.row.name = fmt::format("{}, {} threads", name, threads);
    c.run = timed_rows(place, place->rows(), c.apply, true);
    out.push_back(std::move(c));
  }
  for (const RodEstimate rods : {RodEstimate::linear, RodEstimate::quadratic}) {
    AppearanceParameters q = p;
    q.rods = rods;
    Contender c = evaluator_contender(q, evaluator_named("float"), place, colours);
    // Two models: neither can dominate the other.
    c.row.group = rods == RodEstimate::linear ? "linear rods" : "quadratic rods";
    c.row.name = "float, " + c.row.group;
    out.push_back(std::move(c));
  }
  out.push_back(layout_contender<Rgba>(p, picture, colours));
  out.push_back(layout_contender<HalfPlanes>(p, picture, colours));
  return out;
}

}  // namespace scotopic
