#include "color/icc/icc_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

namespace scotopic {
namespace {

using IccBytes = std::span<const std::byte>;

constexpr std::size_t header_size = 128;
constexpr std::size_t entry_size = 12;
constexpr std::uint32_t most_tags = 100;  // LittleCMS reads no more
constexpr std::uint64_t most_channels = 15;

/// Big-endian numbers; 0 beyond the end, so that every test after it fails.
std::uint32_t number(IccBytes bytes, std::size_t at, std::size_t width) {
  if (at + width > bytes.size()) return 0;
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < width; ++i) out = out << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
  return out;
}
std::uint32_t u8(IccBytes bytes, std::size_t at) { return number(bytes, at, 1); }
std::uint32_t u16(IccBytes bytes, std::size_t at) { return number(bytes, at, 2); }
std::uint32_t u32(IccBytes bytes, std::size_t at) { return number(bytes, at, 4); }

constexpr std::uint32_t sign(const char (&name)[5]) {
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < 4; ++i) out = out << 8 | static_cast<unsigned char>(name[i]);
  return out;
}

std::string text_of(std::uint32_t signature) {
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8)
    if (const char c = static_cast<char>(signature >> shift & 0xffu); c > ' ' && c < '\x7f') out += c;
  return out;
}

/// product of factors, no more than `most` + 1.
std::uint64_t product(std::initializer_list<std::uint64_t> factors, std::uint64_t most) {
  std::uint64_t out = 1;
  for (const std::uint64_t f : factors) out = f != 0 && out > most / f ? most + 1 : out * f;
  return out;
}

std::uint64_t power(std::uint64_t base, std::uint64_t exponent, std::uint64_t most) {
  std::uint64_t out = 1;
  for (std::uint64_t i = 0; i < exponent; ++i) out = product({out, base}, most);
  return out;
}

/// Bytes of a curve that begins here; more than there are where it does not fit.
std::uint64_t curve_bytes(IccBytes curve) {
  static constexpr std::size_t parameters[] = {1, 3, 4, 5, 7};
  const std::uint32_t type = u32(curve, 0);
  if (type == sign("curv") && curve.size() >= 12) return 12 + 2 * std::uint64_t{u32(curve, 8)};
  if (type == sign("para") && curve.size() >= 12 && u16(curve, 8) < std::size(parameters))
    return 12 + 4 * parameters[u16(curve, 8)];
  return curve.size() + 1;
}

bool fits_curve(IccBytes tag) { return curve_bytes(tag) <= tag.size(); }

/// One after the other, each on a multiple of four.
bool fits_curves(IccBytes tag, std::uint32_t offset, std::uint64_t count) {
  std::uint64_t at = offset;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (at >= tag.size()) return false;
    const std::uint64_t size = curve_bytes(tag.subspan(static_cast<std::size_t>(at)));
    if (size > tag.size() - at) return false;
    at += (size + 3) / 4 * 4;
  }
  return true;
}

/// lut8Type and lut16Type: ICC.1, 10.10 and 10.11.
bool fits_table(IccBytes tag, std::uint64_t width) {
  const std::uint64_t in = u8(tag, 8), out = u8(tag, 9), grid = u8(tag, 10);
  const bool wide = width == 2;
  const std::size_t start = wide ? 52 : 48;
  if (tag.size() < start || in == 0 || out == 0 || in > most_channels || out > most_channels || grid == 1)
    return false;
  const std::uint64_t entries_in = wide ? u16(tag, 48) : 256, entries_out = wide ? u16(tag, 50) : 256;
  if (entries_in < 2 || entries_out < 2 || entries_in > 4096 || entries_out > 4096) return false;
  const std::uint64_t room = tag.size() - start;
  const std::uint64_t nodes = product({power(grid, in, room), out}, room);
  return nodes <= room && width * (in * entries_in + nodes + out * entries_out) <= room;
}

bool fits_lattice(IccBytes tag, std::uint32_t offset, std::uint64_t in, std::uint64_t out) {
  if (offset > tag.size() || tag.size() - offset < 20) return false;
  const std::uint64_t room = tag.size() - offset - 20;
  const std::uint64_t width = u8(tag, offset + 16);
  std::uint64_t nodes = product({out, width}, room);
  for (std::size_t i = 0; i < in; ++i) {
    if (u8(tag, offset + i) < 2) return false;
    nodes = product({nodes, u8(tag, offset + i)}, room);
  }
  return (width == 1 || width == 2) && nodes <= room;
}

/// lutAToBType and lutBToAType: ICC.1, 10.12 and 10.13. `forward`: A curves take the inputs.
bool fits_stages(IccBytes tag, bool forward) {
  const std::uint64_t in = u8(tag, 8), out = u8(tag, 9);
  if (tag.size() < 32 || in == 0 || out == 0 || in > most_channels || out > most_channels) return false;
  const std::uint32_t b = u32(tag, 12), matrix = u32(tag, 16), m = u32(tag, 20), clut = u32(tag, 24),
                      a = u32(tag, 28);
  const std::uint64_t connection = forward ? out : in, device = forward ? in : out;
  return (b == 0 || fits_curves(tag, b, connection)) &&
         (matrix == 0 || std::uint64_t{matrix} + 48 <= tag.size()) &&
         (m == 0 || fits_curves(tag, m, connection)) && (clut == 0 || fits_lattice(tag, clut, in, out)) &&
         (a == 0 || fits_curves(tag, a, device));
}

/// multiLocalizedUnicodeType: ICC.1, 10.15.
bool fits_texts(IccBytes tag) {
  const std::uint64_t count = u32(tag, 8);
  if (tag.size() < 16 || u32(tag, 12) != 12 || count > (tag.size() - 16) / 12) return count == 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t length = u32(tag, 16 + 12 * i + 4), at = u32(tag, 16 + 12 * i + 8);
    if (at + length > tag.size()) return false;
  }
  return true;
}

/// profileSequenceDescType and others that only nest: LittleCMS goes by the tag's end.
bool fits(IccBytes tag) {
  switch (u32(tag, 0)) {
    case sign("curv"):
    case sign("para"):
      return fits_curve(tag);
    case sign("desc"):
      return tag.size() >= 12 && u32(tag, 8) <= tag.size() - 12;
    case sign("mluc"):
      return fits_texts(tag);
    case sign("XYZ "):
      return tag.size() >= 20;
    case sign("mft1"):
      return fits_table(tag, 1);
    case sign("mft2"):
      return fits_table(tag, 2);
    case sign("mAB "):
      return fits_stages(tag, true);
    case sign("mBA "):
      return fits_stages(tag, false);
    default:
      return true;
  }
}

struct Entry {
  std::uint64_t offset, size;
  bool operator<(const Entry& o) const { return offset != o.offset ? offset < o.offset : size < o.size; }
};

/// Tags may share an element; nothing else may overlap.
bool overlap(std::vector<Entry> entries) {
  std::sort(entries.begin(), entries.end());
  for (std::size_t i = 1; i < entries.size(); ++i) {
    const Entry &before = entries[i - 1], &here = entries[i];
    const bool shared = before.offset == here.offset && before.size == here.size;
    if (!shared && before.offset + before.size > here.offset) return true;
  }
  return false;
}

std::string fault_of_tags(IccBytes profile) {
  const std::uint32_t count = u32(profile, header_size);
  const std::uint64_t first = header_size + 4 + std::uint64_t{entry_size} * count;
  if (count > most_tags || first > profile.size())
    return fmt::format("it lists {} tags, which it cannot hold", count);
  std::vector<Entry> entries;
  std::set<std::uint32_t> names;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = header_size + 4 + entry_size * i;
    const Entry entry{u32(profile, at + 4), u32(profile, at + 8)};
    const std::string name = text_of(u32(profile, at));
    if (entry.offset < first || entry.size < 8 || entry.offset + entry.size > profile.size())
      return fmt::format("tag '{}' lies outside of it", name);
    if (!names.insert(u32(profile, at)).second) return fmt::format("it has two tags '{}'", name);
    if (!fits(profile.subspan(static_cast<std::size_t>(entry.offset), static_cast<std::size_t>(entry.size))))
      return fmt::format("tag '{}' is smaller than what it says it holds", name);
    entries.push_back(entry);
  }
  return overlap(entries) ? "its tags overlap" : "";
}

}  // namespace

bool is_icc(IccBytes bytes) { return u32(bytes, 36) == sign("acsp"); }

std::string fault_of_icc(IccBytes profile) {
  if (profile.size() > most_icc_bytes) return "it is larger than any profile";
  if (profile.size() < header_size + 4 || !is_icc(profile)) return "it has no ICC header";
  const std::uint32_t size = u32(profile, 0);
  if (size < header_size + 4 || size > profile.size())
    return fmt::format("it says it has {} bytes, and has {}", size, profile.size());
  if (u8(profile, 8) > 4)
    return fmt::format("it is of version {}, of which 2 to 4 can be read", u8(profile, 8));
  return fault_of_tags(profile.first(size));
}

}  // namespace scotopic
