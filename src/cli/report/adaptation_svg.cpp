// The adaptation luminance of a sequence's frames as a drawing.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adaptation/mesopic.h"
#include "cli/verbs/explain_frames.h"

namespace scotopic {
namespace {

constexpr double width = 720, height = 320, left = 60, right = 700, top = 20, bottom = 260;

/// Frames to the right, luminance upwards, a decade as far as another.
struct Scale {
  double first, last, low, high;

  double x(double frame) const { return last > first ? left + (right - left) * (frame - first) / (last - first) : (left + right) / 2; }
  double y(double luminance) const {
    return bottom - (bottom - top) * std::log(std::clamp(luminance, low, high) / low) / std::log(high / low);
  }
};

Scale scale_of(const std::vector<FrameLight>& frames) {
  const auto [a, b] = std::minmax_element(frames.begin(), frames.end(),
                                          [](const FrameLight& p, const FrameLight& q) { return p.frame < q.frame; });
  double low = frames.front().numbers.adaptation, high = low;
  for (const FrameLight& f : frames) {
    low = std::min(low, f.numbers.adaptation);
    high = std::max(high, f.numbers.adaptation);
  }
  // Whole decades, so that there are at least two numbers at the axis.
  low = std::pow(10, std::floor(std::log10(low * 0.999)));
  high = std::pow(10, std::ceil(std::log10(high * 1.001)));
  return {static_cast<double>(a->frame), static_cast<double>(b->frame), low, high};
}

std::string axes(const Scale& s) {
  std::string svg;
  for (double decade = s.low; decade < s.high * 1.01; decade *= 10)
    svg += fmt::format("<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#ccc\"/>\n"
                       "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5:.3g}</text>\n",
                       left, right, s.y(decade), left - 6, s.y(decade) + 4, decade);
  for (const double frame : {s.first, s.last})
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{:.0f}</text>\n", s.x(frame), bottom + 16, frame);
  return svg + fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">frame; adaptation luminance, cd/m2 (dashed: the shot's median)</text>\n",
                           (left + right) / 2, height - 12);
}

std::string change_text(const PlanChange& c) {
  std::string text;
  for (const std::string& e : c.begins) text += "+" + e + " ";
  for (const std::string& e : c.ends) text += "-" + e + " ";
  return text;
}

}  // namespace

std::string adaptation_svg(const std::vector<FrameLight>& frames, double shot, const std::vector<PlanChange>& changes) {
  const Scale s = scale_of(frames);
  std::string svg = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
                                "font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
                                width, height);
  const double light = s.y(mesopic_photopic_limit()), dark = s.y(mesopic_scotopic_limit());
  if (dark > light)
    svg += fmt::format("<rect x=\"{}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\" fill=\"#dde4f5\"/>\n<text x=\"{}\" y=\"{:.1f}\">mesopic</text>\n",
                       left, light, right - left, dark - light, left + 4, light + 12);
  svg += axes(s);
  for (std::size_t i = 0; i < changes.size(); ++i)
    svg += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#c03030\"/>\n<text x=\"{3:.1f}\" y=\"{4}\" fill=\"#c03030\">{5}</text>\n",
                       s.x(changes[i].frame), top, bottom, s.x(changes[i].frame) + 3, bottom - 6 - 12 * static_cast<double>(i % 8), change_text(changes[i]));
  svg += fmt::format("<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#405080\" stroke-dasharray=\"6 4\"/>\n<polyline fill=\"none\" stroke=\"#405080\" stroke-width=\"2\" points=\"",
                     left, right, s.y(shot));
  for (const FrameLight& f : frames) svg += fmt::format("{:.1f},{:.1f} ", s.x(f.frame), s.y(f.numbers.adaptation));
  svg += "\"/>\n";
  if (frames.size() <= 100)
    for (const FrameLight& f : frames)
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" fill=\"#405080\"/>\n", s.x(f.frame), s.y(f.numbers.adaptation));
  return svg + "</svg>\n";
}

}  // namespace scotopic
