#include "io/spectral/spectral_files.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <fmt/format.h>

#include <new>
#include <set>
#include <utility>

#include "base/error.h"
#include "io/exr/exr_headers.h"
#include "io/exr/open_exr.h"

namespace scotopic {

std::string one_line(const std::string& text) {
  std::string line = text.substr(0, text.find('\n'));
  while (!line.empty() && line.back() == '.') line.pop_back();
  return line;
}

void SpectralFiles::add(const std::string& name, const Limits& limits) {
  names_.push_back(name);
  check_exr_headers(name, limits);
  const std::size_t file_index = files_.size();
  files_.push_back(open_exr(name));
  Imf::MultiPartInputFile& opened = *files_.back();
  for (int part = 0; part < opened.parts(); ++part) {
    if (!opened.partComplete(part))
      throw Error(ExitCode::input, name, "is truncated: it was not written to its end");
    if (opened.header(part).hasType() && !Imf::isImage(opened.header(part).type())) continue;  // deep
    const Imf::ChannelList& list = opened.header(part).channels();
    for (auto channel = list.begin(); channel != list.end(); ++channel) {
      const bool whole = channel.channel().xSampling == 1 && channel.channel().ySampling == 1;
      if (whole) channels_.push_back({file_index, part, channel.name(), channel.channel().type});
    }
  }
}

std::vector<const Imf::Header*> SpectralFiles::headers() const {
  std::vector<const Imf::Header*> out;
  for (int part = 0; part < files_.front()->parts(); ++part) out.push_back(&files_.front()->header(part));
  return out;
}

void SpectralFiles::read(int y0, int rows, const std::vector<ChannelTarget>& targets) {
  std::set<std::pair<std::size_t, int>> parts;
  for (const ChannelTarget& target : targets) parts.insert({target.place->file, target.place->part});
  for (const auto& [file, part] : parts) {
    Imf::FrameBuffer frame;
    for (const ChannelTarget& target : targets)
      if (target.place->file == file && target.place->part == part)
        frame.insert(target.place->channel, target.slice);
    Imf::InputPart input(*files_[file], part);
    input.setFrameBuffer(frame);
    try {
      input.readPixels(y0, y0 + rows - 1);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      throw Error(ExitCode::input, names_[file],
                  fmt::format("damaged or cut short: {}", one_line(error.what())));
    }
  }
}

}  // namespace scotopic
