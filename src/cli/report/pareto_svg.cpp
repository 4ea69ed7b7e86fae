#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/report/time_report.h"

namespace scotopic {
namespace {

/// A decimal axis on the page.
struct Axis {
  int low, high;    // powers of ten
  double from, to;  // where on the page

  double at(double value) const { return from + (std::log10(value) - low) / (high - low) * (to - from); }
};

Axis axis_over(const std::vector<double>& values, double from, double to) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const int low = static_cast<int>(std::floor(std::log10(*least)));
  return {low, std::max(low + 1, static_cast<int>(std::ceil(std::log10(*greatest)))), from, to};
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else
      out += c;
  }
  return out;
}

std::string text_at(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     escaped(text));
}

std::string line(double x0, double y0, double x1, double y1) {
  return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#ccc\"/>\n", x0, y0, x1, y1);
}

std::string power_of_ten(int exponent) {
  return exponent >= 0 && exponent < 5 ? fmt::format("{:.0f}", std::pow(10, exponent))
                                       : fmt::format("1e{}", exponent);
}

std::string grid(const Axis& x, const Axis& y) {
  std::string out;
  for (int e = x.low; e <= x.high; ++e) {
    const double at = x.at(std::pow(10, e));
    out += line(at, y.from, at, y.to) + text_at(at, y.from + 18, "middle", power_of_ten(e));
  }
  const int step = y.high - y.low > 8 ? 2 : 1;
  for (int e = y.low; e <= y.high; e += step) {
    const double at = y.at(std::pow(10, e));
    out += line(x.from, at, x.to, at) + text_at(x.from - 6, at + 4, "end", power_of_ten(e));
  }
  return out;
}

}  // namespace

std::string pareto_svg(const std::vector<WayRow>& rows, const std::string& group,
                       const std::string& caption) {
  std::vector<const WayRow*> shown;
  std::vector<double> times, errors;
  for (const WayRow& row : rows) {
    if (row.group != group || !row.error || !(row.error->difference.max > 0)) continue;
    shown.push_back(&row);
    times.push_back(row.time.median);
    errors.push_back(row.error->difference.max);
  }
  std::string out =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 720 440\" font-family=\"sans-serif\" "
      "font-size=\"13\">\n"
      "<rect width=\"720\" height=\"440\" fill=\"#fff\"/>\n";
  if (!shown.empty()) {
    const Axis x = axis_over(times, 70, 690), y = axis_over(errors, 370, 40);
    out += grid(x, y);
    std::sort(shown.begin(), shown.end(),
              [](const WayRow* a, const WayRow* b) { return a->time.median < b->time.median; });
    std::string front, points;
    for (const WayRow* row : shown) {
      const double px = x.at(row->time.median), py = y.at(row->error->difference.max);
      if (!row->dominated) front += fmt::format("{}{:.1f} {:.1f}", front.empty() ? "M" : "L", px, py);
      points += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" stroke=\"#036\" fill=\"{}\"/>\n", px,
                            py, row->dominated ? "#fff" : "#036");
      // Beside the point: ways of one speed are told apart by their error.
      points += text_at(px + (px > 560 ? -9 : 9), py + 4, px > 560 ? "end" : "start", row->name);
    }
    out += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#036\"/>\n", front) + points;
  }
  out += text_at(380, 408, "middle", "nanoseconds per pixel, one thread");
  out += text_at(70, 24, "start", "greatest CIEDE2000, pixels exposed to Y = .184");
  out += text_at(380, 430, "middle", caption);
  return out + "</svg>\n";
}

}  // namespace scotopic
