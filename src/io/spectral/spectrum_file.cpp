#include "io/spectral/spectrum_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <vector>

#include "base/error.h"
#include "base/input_file.h"

namespace scotopic {
namespace {

constexpr std::int64_t max_bytes = std::int64_t{1} << 20;
constexpr double first_nm = 300.0;
constexpr double last_nm = 900.0;

struct Row {
  double nm, power;
};

[[noreturn]] void fail_line(const std::string& file, std::size_t line, const std::string& what) {
  throw Error(ExitCode::input, file, fmt::format("line {}: {}", line, what));
}

bool is_separator(char c) { return c == ' ' || c == '\t' || c == ',' || c == ';'; }

// The numbers of a line; empty if anything else stands there.
std::vector<double> numbers(std::string_view line) {
  std::vector<double> out;
  const char* at = line.data();
  const char* const end = at + line.size();
  while (true) {
    while (at != end && is_separator(*at)) ++at;
    if (at == end) return out;
    double value = 0.0;
    const auto [stop, error] = std::from_chars(at, end, value);
    if (error != std::errc() || (stop != end && !is_separator(*stop))) return {};
    out.push_back(value);
    at = stop;
  }
}

void check_row(const std::vector<Row>& rows, const std::vector<double>& cells, const std::string& file,
               std::size_t line) {
  if (cells.size() != 2) fail_line(file, line, "not two numbers, wavelength in nm and power");
  if (!std::isfinite(cells[0]) || !(cells[0] > 0.0))
    fail_line(file, line, "the wavelength is not a positive number");
  if (!std::isfinite(cells[1]) || cells[1] < 0.0)
    fail_line(file, line, "the power is not a number of 0 or more");
  if (!rows.empty() && !(cells[0] > rows.back().nm)) fail_line(file, line, "wavelengths do not ascend");
}

std::vector<Row> parse(std::string_view text, const std::string& file) {
  std::vector<Row> rows;
  bool title = false;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view content = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (!content.empty() && (content.back() == '\r' || is_separator(content.back())))
      content.remove_suffix(1);
    if (content.empty() || content.front() == '#') continue;
    const std::vector<double> cells = numbers(content);
    if (cells.empty() && rows.empty() && !title) {
      title = true;
      continue;
    }
    check_row(rows, cells, file, line);
    rows.push_back({cells[0], cells[1]});
  }
  if (rows.size() < 2)
    throw Error(ExitCode::input, file, "holds no spectrum: fewer than two rows of numbers");
  return rows;
}

// Area under the straight lines between rows, from the first row to `nm`.
double area_to(const std::vector<Row>& rows, double nm) {
  double area = 0.0;
  for (std::size_t i = 1; i < rows.size() && rows[i - 1].nm < nm; ++i) {
    const Row& a = rows[i - 1];
    const Row& b = rows[i];
    const double end = std::min(nm, b.nm);
    const double power = a.power + (b.power - a.power) * (end - a.nm) / (b.nm - a.nm);
    area += 0.5 * (a.power + power) * (end - a.nm);
  }
  return area;
}

double between_rows(const std::vector<Row>& rows, double nm) {
  const auto above =
      std::lower_bound(rows.begin(), rows.end(), nm, [](const Row& r, double x) { return r.nm < x; });
  if (above == rows.end() || (above == rows.begin() && above->nm != nm)) return 0.0;
  if (above->nm == nm) return above->power;
  const Row& below = *(above - 1);
  return below.power + (above->power - below.power) * (nm - below.nm) / (above->nm - below.nm);
}

bool closer_than_a_nanometre(const std::vector<Row>& rows) {
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (rows[i].nm - rows[i - 1].nm < 0.999) return true;
  return false;
}

}  // namespace

Spectrum spectrum_from_text(std::string_view text, const std::string& file) {
  const std::vector<Row> rows = parse(text, file);
  const bool fine = closer_than_a_nanometre(rows);
  Spectrum spectrum{first_nm, 1.0, {}};
  for (double nm = first_nm; nm <= last_nm; nm += 1.0)
    spectrum.values.push_back(fine ? area_to(rows, nm + 0.5) - area_to(rows, nm - 0.5)
                                   : between_rows(rows, nm));
  if (!(photopic_luminance(spectrum.curve()).cdm2 > 0.0))
    throw Error(ExitCode::input, file, "the spectrum has no visible light");
  return spectrum;
}

Spectrum read_spectrum_file(const std::string& file) {
  return spectrum_from_text(read_input_file(file, ExitCode::input, max_bytes, ""), file);
}

}  // namespace scotopic
