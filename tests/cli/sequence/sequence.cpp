#include "cli/sequence/sequence.h"

#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfRgbaFile.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace scotopic::test {

void Sequence::SetUp() { folder_ = work_folder(); }
void Sequence::TearDown() { std::filesystem::remove_all(folder_); }

void Sequence::write_frames(int count, double step, int width, int height) const {
  for (int frame = 1; frame <= count; ++frame) {
    char name[32];
    std::snprintf(name, sizeof name, "in.%04d.exr", frame);
    write_scaled_picture(path(name), width, height, std::pow(step, frame - 1));
  }
}

Outcome Sequence::run(std::vector<std::string> arguments) const {
  for (std::string& a : arguments)
    if (const std::size_t at = a.find("{}"); at != a.npos) a.replace(at, 2, folder_);
  return run_program(arguments);
}

Outcome Sequence::apply(std::vector<std::string> more) const {
  more.insert(more.begin(), {"apply", "{}/in.####.exr", "-o", "{}/seen.####.exr", "--white-luminance", "1"});
  return run(more);
}

nlohmann::json Sequence::applied(std::vector<std::string> more) const {
  more.insert(more.end(), {"--json", "-q"});
  const Outcome outcome = apply(more);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return nlohmann::json::parse(outcome.out, nullptr, false);
}

std::map<int, std::string> Sequence::statuses(const nlohmann::json& result) {
  std::map<int, std::string> out;
  for (const nlohmann::json& frame : result.at("frames")) out[frame.at("frame")] = frame.at("status");
  return out;
}

bool Sequence::exists(const std::string& name) const { return std::filesystem::exists(path(name)); }

std::string Sequence::bytes(const std::string& name) const {
  std::ostringstream out;
  out << std::ifstream(path(name), std::ios::binary).rdbuf();
  return out.str();
}

void Sequence::write(const std::string& name, const std::string& bytes) const {
  std::ofstream(path(name), std::ios::binary) << bytes;
}

std::size_t Sequence::files(const std::string& start) const {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    count += entry.path().filename().string().rfind(start, 0) == 0;
  return count;
}

void write_scaled_picture(const std::string& file, int width, int height, double scale) {
  Imf::RgbaOutputFile out(file.c_str(), width, height, Imf::WRITE_RGB);
  std::vector<Imf::Rgba> row(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto value = static_cast<float>(scale * (0.01 + 0.99 * ((x * 7 + y * 13) % 101) / 100.0));
      row[static_cast<std::size_t>(x)] = Imf::Rgba(value, value * 0.8f, value * 0.5f);
    }
    out.setFrameBuffer(row.data() - static_cast<std::ptrdiff_t>(y) * width, 1,
                       static_cast<std::size_t>(width));
    out.writePixels(1);
  }
}

double float_attribute(const std::string& file, const char* name) {
  const Imf::RgbaInputFile in(file.c_str());
  const auto* found = in.header().findTypedAttribute<Imf::FloatAttribute>(name);
  EXPECT_NE(found, nullptr) << name;
  return found ? static_cast<double>(found->value()) : 0;
}

}  // namespace scotopic::test
