// Command lines, one argument a line. Verbs on images run, on the files that lie in the scratch folder; paths
// are kept inside it. Verbs that bake are only parsed: each takes seconds. They speak on stdout and stderr:
// see -close_fd_mask.
#include <CLI/CLI.hpp>
#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfRgbaFile.h>

#include <algorithm>
#include <memory>
#include <sstream>

#include "cli/program.h"
#include "fuzz/target.h"
#include "base/error.h"

namespace scotopic::fuzz {

std::vector<Bytes> seeds() {
  return {bytes_of("apply\nin.exr\n-o\nout.exr\n--adaptation\n0.1\n--model=kirk2011\n--gamut\nrec709\n"),
          bytes_of("explain\nin.exr\n--json\n--fov\n45\n"),
          bytes_of("lmsr\nin.exr\n-o\nout.exr\n--rods\nquadratic\n"),
          bytes_of("apply\nin.exr\n-o\nout.exr\n--effects\nshift,chroma\n--strength\n.5\n--"
                   "nonfinite\nclean\n-d\nhalf\n"),
          bytes_of("bake\n-o\nout\n--adaptation\n1e-3\n"),
          bytes_of("apply\n--help\n")};
}

namespace {

std::vector<std::string> arguments_of(std::string text) {
  std::vector<std::string> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line) && out.size() < 40;) {
    std::replace(line.begin(), line.end(), '/', '_');
    line.erase(std::remove(line.begin(), line.end(), '\0'), line.end());
    if (line != "..") out.push_back(line);
  }
  return out;
}

void enter_scratch() {
  static const bool once = [] {
    std::filesystem::current_path(scratch());
    Imf::Array2D<Imf::Rgba> pixels(4, 4);
    for (int i = 0; i < 16; ++i) pixels[i / 4][i % 4] = Imf::Rgba(0.1f * static_cast<float>(i), 0.5f, 1.5f);
    Imf::RgbaOutputFile file("in.exr", 4, 4);
    file.setFrameBuffer(&pixels[0][0], 1, 4);
    file.writePixels(4);
    return true;
  }();
  (void)once;
}

}  // namespace
}  // namespace scotopic::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scotopic;
  fuzz::enter_scratch();
  std::vector<std::string> arguments = fuzz::arguments_of(fuzz::text_of(data, size));
  const bool runs =
      !arguments.empty() && (arguments[0] == "apply" || arguments[0] == "explain" || arguments[0] == "lmsr");
  CLI::App program("fuzz", "scotopic");
  program.require_subcommand(1);
  Invocation invocation;
  for (const AddVerb add : {add_apply, add_lmsr, add_explain, add_bake, add_check, add_time})
    add(program, invocation);
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes vectors
  try {
    program.parse(arguments);
    if (runs && invocation.run) invocation.run();
  } catch (const CLI::Error&) {
  } catch (const Error&) {
  }
  return 0;
}
