#include "options/icc_options.h"

#include "options/values.h"

namespace scotopic {

void add_icc_options(CLI::App& verb, IccOptions& o) {
  const TextOptions add{verb, "Output"};
  add("--icc", o.profile, "Write values of the device that an ICC profile describes, and embed it", "FILE");
  add("--intent", o.intent, "With --icc: perceptual, relative (default), saturation, absolute", "NAME");
  add("--quality", o.jpeg_quality, "Of JPEG, 1 to 100 (default 95)", "N");
}

void parse(const IccOptions& o, ImageRequest& request) {
  request.jpeg_quality =
      static_cast<int>(number_in("--quality", o.jpeg_quality, 1, 100, "a quality from 1 to 100"));
  RenderingIntent intent = RenderingIntent::relative;
  if (!o.intent.empty())
    intent = choice<RenderingIntent>("--intent", o.intent,
                                     {{"perceptual", RenderingIntent::perceptual},
                                      {"relative", RenderingIntent::relative},
                                      {"saturation", RenderingIntent::saturation},
                                      {"absolute", RenderingIntent::absolute}});
  if (o.profile.empty()) {
    if (!o.intent.empty()) throw Error(ExitCode::usage, "", "--intent is of --icc, which is missing");
    return;
  }
  for (const auto& [name, given] : {std::pair("--output-colorspace", request.output_colourspace.has_value()),
                                    std::pair("--display", request.view.has_value())})
    if (given) throw Error(ExitCode::usage, "", std::string("either --icc or ") + name + ", not both");
  request.profile = std::make_shared<const IccProfile>(o.profile, intent);
}

}  // namespace scotopic
