#include "looks/verify/contenders.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "batch/batch.h"
#include "stages/reference.h"
#include "io/pixels/pixel_type.h"
#include "io/pixels/row_bands.h"

namespace scotopic {
namespace {

/// A copy of the picture that each run spoils and the next restores.
struct Workplace {
  const TimedPicture& picture;
  Colours work;

  explicit Workplace(const TimedPicture& p) : picture(p), work(p.pixels) {}

  void restore(std::size_t count) {
    std::copy_n(picture.pixels.r.begin(), count, work.r.begin());
    std::copy_n(picture.pixels.g.begin(), count, work.g.begin());
    std::copy_n(picture.pixels.b.begin(), count, work.b.begin());
  }
  PixelRows row(std::size_t y) {
    PixelRows rows;
    rows.r = work.r.data() + y * picture.width;
    rows.g = work.g.data() + y * picture.width;
    rows.b = work.b.data() + y * picture.width;
    rows.count = picture.width;
    return rows;
  }
};

using Place = std::shared_ptr<Workplace>;

/// Slow ways see but a part of the picture.
constexpr std::size_t slow_share = 16;

TimedRun timed_rows(const Place& place, std::size_t rows, const RowOperator& apply) {
  const std::size_t pixels = rows * place->picture.width;
  return {[place, pixels] { place->restore(pixels); },
          [place, rows, apply] {
            for (std::size_t y = 0; y < rows; ++y) apply(place->row(y), nullptr);
          },
          pixels};
}

TimedRun threaded_rows(const Place& place, const RowOperator& apply) {
  const std::size_t rows = place->picture.rows();
  return {[place, rows] { place->restore(rows * place->picture.width); },
          [place, rows, apply] {
            parallel_rows(static_cast<int>(rows), 8, [&](int first, int last) {
              for (int y = first; y < last; ++y) apply(place->row(static_cast<std::size_t>(y)), nullptr);
            });
          },
          rows * place->picture.width};
}

Contender scalar_contender(const AppearanceParameters& p, const Place& place, const Colours& colours) {
  const auto reference = std::make_shared<AppearanceReference>(p);
  const RowOperator apply = [reference](const PixelRows& rows, std::uint8_t*) {
    for (std::size_t i = 0; i < rows.count; ++i) {
      const Vec3<double> out = (*reference)({{rows.r[i], rows.g[i], rows.b[i]}});
      rows.r[i] = static_cast<float>(out[0]);
      rows.g[i] = static_cast<float>(out[1]);
      rows.b[i] = static_cast<float>(out[2]);
    }
  };
  Contender out;
  out.row.group = "operator";
  out.row.name = "double, scalar";
  out.row.error = evaluator_error(p, apply, colours);
  out.run = timed_rows(place, std::max<std::size_t>(1, place->picture.rows() / slow_share), apply);
  return out;
}

Contender evaluator_contender(const AppearanceParameters& p, const EvaluatorKind& kind, const Place& place,
                              const Colours& colours) {
  const PreparedEvaluator prepared = prepare_evaluator(p, kind);
  Contender out;
  out.row.group = "operator";
  out.row.name = kind.name;
  out.row.error = evaluator_error(p, prepared.apply, colours);
  out.row.seconds = prepared.seconds;
  out.row.bytes = prepared.bytes;
  const std::size_t rows = place->picture.rows();
  out.run =
      timed_rows(place, kind.edge > 0 ? std::max<std::size_t>(1, rows / slow_share) : rows, prepared.apply);
  return out;
}

NativeRow half_row(std::vector<std::uint16_t>& values, std::size_t first = 0, std::size_t step = 1) {
  return {reinterpret_cast<std::byte*>(values.data() + first), static_cast<std::ptrdiff_t>(2 * step),
          PixelType::half};
}

std::vector<std::uint16_t> halves(const std::vector<float>& values) {
  std::vector<std::uint16_t> out(values.size());
  store_row(values.data(), values.size(), half_row(out));
  return out;
}

std::vector<float> floats(std::vector<std::uint16_t>& values) {
  std::vector<float> out(values.size());
  load_row(half_row(values), values.size(), out.data());
  return out;
}

/// Planes of halves, and what they were.
struct HalfPlanes {
  std::array<std::vector<std::uint16_t>, 3> from, work;

  explicit HalfPlanes(const Colours& c) : from{halves(c.r), halves(c.g), halves(c.b)}, work(from) {}
  void restore() { work = from; }
  void apply(const AppearanceBatch& batch) {
    batch.apply(HalfRows{work[0].data(), work[1].data(), work[2].data(), work[0].size()});
  }
  static Colours colours(std::array<std::vector<std::uint16_t>, 3>& planes) {
    return {floats(planes[0]), floats(planes[1]), floats(planes[2])};
  }
};

Contender half_contender(const AppearanceParameters& p, const TimedPicture& picture, const Colours& colours) {
  const auto batch = std::make_shared<AppearanceBatch>(p);
  HalfPlanes compared(colours);
  compared.apply(*batch);
  Contender out;
  out.row.group = "files";
  out.row.name = "float, half planes in and out";
  out.row.error = evaluator_error(p, HalfPlanes::colours(compared.from), HalfPlanes::colours(compared.work));
  const auto planes = std::make_shared<HalfPlanes>(picture.pixels);
  out.run = {[planes] { planes->restore(); }, [planes, batch] { planes->apply(*batch); },
             picture.pixels.size()};
  return out;
}

Contender rgba_contender(const AppearanceParameters& p, const TimedPicture& picture, const Colours& colours) {
  const auto batch = std::make_shared<AppearanceBatch>(p);
  const auto interleaved = [](const Colours& c) {
    std::vector<float> out(4 * c.size(), 1.0f);
    for (std::size_t i = 0; i < c.size(); ++i)
      out[4 * i] = c.r[i], out[4 * i + 1] = c.g[i], out[4 * i + 2] = c.b[i];
    return out;
  };
  std::vector<float> compared = interleaved(colours);
  batch->apply_rgba(compared.data(), colours.size());
  Colours got = colours;
  for (std::size_t i = 0; i < got.size(); ++i)
    got.r[i] = compared[4 * i], got.g[i] = compared[4 * i + 1], got.b[i] = compared[4 * i + 2];
  const auto from = std::make_shared<std::vector<float>>(interleaved(picture.pixels));
  const auto work = std::make_shared<std::vector<float>>(*from);
  Contender out;
  out.row.group = "files";
  out.row.name = "float, RGBA float";
  out.row.error = evaluator_error(p, colours, got);
  out.run = {[from, work] { *work = *from; },
             [work, batch] { batch->apply_rgba(work->data(), work->size() / 4); }, picture.pixels.size()};
  return out;
}

}  // namespace

TimedPicture night_picture(std::size_t width, std::size_t height, const AppearanceParameters& p) {
  TimedPicture out;
  out.width = width;
  for (auto* plane : {&out.pixels.r, &out.pixels.g, &out.pixels.b}) plane->reserve(width * height);
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
    c.run = threaded_rows(place, prepare_evaluator(p, evaluator_named(name)).apply);
    out.push_back(std::move(c));
  }
  out.push_back(rgba_contender(p, picture, colours));
  out.push_back(half_contender(p, picture, colours));
  return out;
}

std::vector<Contender> rod_contenders(const AppearanceParameters& p, const TimedPicture& picture,
                                      const Colours& colours) {
  const auto place = std::make_shared<Workplace>(picture);
  std::vector<Contender> out;
  for (const RodEstimate rods : {RodEstimate::linear, RodEstimate::quadratic}) {
    AppearanceParameters q = p;
    q.rods = rods;
    Contender c = evaluator_contender(q, evaluator_named("float"), place, colours);
    // Two models: neither can dominate the other.
    c.row.group = rods == RodEstimate::linear ? "linear rods" : "quadratic rods";
    c.row.name = "float, " + c.row.group;
    out.push_back(std::move(c));
  }
  return out;
}

}  // namespace scotopic
