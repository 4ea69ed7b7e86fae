#include "looks/chain/chain_text.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <stdexcept>

#include "looks/chain/number_text.h"
#include "base/error.h"

namespace scotopic {
namespace {

using Buffer = fmt::memory_buffer;

template <typename... Args>
void put(Buffer& out, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

/// Readers keep floats: a number that is none there, or so small that their processors stumble over it, must
/// not stand in a file.
double plain(double value) {
  const auto single = static_cast<float>(value);
  if (!std::isfinite(single))
    throw Error(ExitCode::check_failed, "", "a LUT of these numbers would hold values that are not finite");
  return single != 0 && !std::isnormal(single) ? 0.0 : value;
}

void put_triplet(Buffer& out, const double* v, int decimals) {
  put(out, "{} {} {}\n", fixed_text(plain(v[0]), decimals), fixed_text(plain(v[1]), decimals),
      fixed_text(plain(v[2]), decimals));
}

constexpr const char* depths = R"(inBitDepth="32f" outBitDepth="32f")";

/// Writes one step as a ProcessNode.
struct NodeWriter {
  Buffer& out;

  void operator()(const RangeStep& step) const {
    put(out, "  <Range {}>\n", depths);
    bound("minInValue", step.low);
    bound("maxInValue", step.high);
    bound("minOutValue", step.low);
    bound("maxOutValue", step.high);
    put(out, "  </Range>\n");
  }
  void operator()(const MatrixStep& step) const {
    const bool offset = step.offset != Vec3<double>{};
    put(out, "  <Matrix {}>\n    <Array dim=\"3 {}\">\n", depths, offset ? 4 : 3);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& row = step.matrix[i];
      put(out, "{} {} {}", number_text(plain(row[0])), number_text(plain(row[1])),
          number_text(plain(row[2])));
      if (offset) put(out, " {}", number_text(plain(step.offset[i])));
      put(out, "\n");
    }
    put(out, "    </Array>\n  </Matrix>\n");
  }
  void operator()(const LogStep& step) const {
    put(out, "  <Log {} style=\"{}\"/>\n", depths, step.style == LogStyle::log2 ? "log2" : "antiLog2");
  }
  void operator()(const Lut1DStep& step) const {
    put(out, "  <LUT1D {} interpolation=\"linear\">\n    <Array dim=\"{} 3\">\n", depths, step.length);
    for (std::size_t i = 0; i < step.values.size(); i += 3) put_triplet(out, &step.values[i], step.decimals);
    put(out, "    </Array>\n  </LUT1D>\n");
  }
  void operator()(const Lut3DStep& step) const {
    put(out, "  <LUT3D {0} interpolation=\"tetrahedral\">\n    <Array dim=\"{1} {1} {1} 3\">\n", depths,
        step.edge);
    for (std::size_t i = 0; i < step.values.size(); i += 3) put_triplet(out, &step.values[i], step.decimals);
    put(out, "    </Array>\n  </LUT3D>\n");
  }

 private:
  void bound(const char* tag, double value) const {
    if (std::isfinite(value)) put(out, "    <{0}>{1}</{0}>\n", tag, number_text(plain(value)));
  }
};

}  // namespace

std::string xml_text(const Chain& chain, ChainFormat format) {
  Buffer out;
  put(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
  const std::string id = escaped(chain.id), name = escaped(chain.name);
  if (format == ChainFormat::clf)
    put(out, "<ProcessList xmlns=\"urn:AMPAS:CLF:v3.0\" compCLFversion=\"3\" id=\"{}\" name=\"{}\">\n", id,
        name);
  else
    put(out, "<ProcessList version=\"2.0\" id=\"{}\" name=\"{}\">\n", id, name);
  for (const std::string& text : chain.descriptions)
    put(out, "  <Description>{}</Description>\n", escaped(text));
  put(out, "  <InputDescriptor>{}</InputDescriptor>\n", escaped(chain.input));
  put(out, "  <OutputDescriptor>{}</OutputDescriptor>\n", escaped(chain.output));
  if (!chain.info.empty()) {
    put(out, "  <Info>\n");
    for (const auto& [key, value] : chain.info) put(out, "    <{0}>{1}</{0}>\n", key, escaped(value));
    put(out, "  </Info>\n");
  }
  for (const Step& step : chain.steps) std::visit(NodeWriter{out}, step);
  put(out, "</ProcessList>\n");
  return fmt::to_string(out);
}

const Lut3DStep& only_lut3d(const Chain& chain) {
  const Lut3DStep* only = nullptr;
  for (const Step& step : chain.steps) {
    if (std::holds_alternative<RangeStep>(step)) continue;
    const auto* lut = std::get_if<Lut3DStep>(&step);
    if (!lut || only) throw std::logic_error("a chain of more than one 3D LUT cannot be a plain LUT file");
    only = lut;
  }
  if (!only) throw std::logic_error("a chain without a 3D LUT cannot be a plain LUT file");
  return *only;
}

std::string cube_text(const Chain& chain) {
  const Lut3DStep& lut = only_lut3d(chain);
  Buffer out;
  put(out, "# {}\n", chain.name);
  for (const std::string& text : chain.descriptions) put(out, "# {}\n", text);
  put(out, "# in: {}\n# out: {}\n", chain.input, chain.output);
  for (const auto& [key, value] : chain.info) put(out, "# {}: {}\n", key, value);
  put(out, "TITLE \"{}\"\nLUT_3D_SIZE {}\n", chain.name, lut.edge);
  const std::size_t n = lut.edge;
  for (std::size_t b = 0; b < n; ++b)
    for (std::size_t g = 0; g < n; ++g)
      for (std::size_t r = 0; r < n; ++r)
        put_triplet(out, &lut.values[3 * ((r * n + g) * n + b)], lut.decimals);
  return fmt::to_string(out);
}

std::string spi3d_text(const Lut3DStep& lut) {
  Buffer out;
  put(out, "SPILUT 1.0\n3 3\n{0} {0} {0}\n", lut.edge);
  std::size_t i = 0;
  for (std::size_t r = 0; r < lut.edge; ++r)
    for (std::size_t g = 0; g < lut.edge; ++g)
      for (std::size_t b = 0; b < lut.edge; ++b, i += 3) {
        put(out, "{} {} {} ", r, g, b);
        put_triplet(out, &lut.values[i], lut.decimals);
      }
  return fmt::to_string(out);
}

}  // namespace scotopic
