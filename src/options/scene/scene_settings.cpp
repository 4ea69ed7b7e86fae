#include "options/scene/scene_settings.h"

#include <fstream>
#include <sstream>

#include "base/error.h"

namespace scotopic {
namespace {

/// The option's text, or a file's of that name.
TimeChoice history_of(const std::string& text) {
  TimeChoice out;
  if (text.empty()) return out;
  AdaptationHistory history = parse_adaptation_history(text);
  if (!history.problem.empty())
    if (std::ifstream file(text); file) {
      std::stringstream all;
      all << file.rdbuf();
      history = parse_adaptation_history(all.str());
      if (!history.problem.empty()) throw Error(ExitCode::input, text, history.problem);
    }
  if (!history.problem.empty())
    throw Error(ExitCode::usage, "",
                "--adaptation-history: '" + text + "' is no file, and: " + history.problem);
  out.history = std::move(history.periods);
  return out;
}

}  // namespace

void add_scene_options(CLI::App& verb, SceneOptions& o) {
  add_operator_options(verb, o.appearance, StagesShown::all);
  verb.add_option(
          "--adaptation-history", o.history,
          "Light that the eye was in before the first frame: LUMINANCE:SECONDS,... (cd/m2 or a name), or a "
          "file of them; default: ever in the scene's own")
      ->type_name("LIST|FILE")
      ->group("Time");
  add_viewing_options(verb, o.viewing);
}

ImageSettings parse(const SceneOptions& o) {
  OperatorChoice choice = parse(o.appearance);
  const ViewingChoice viewing = parse(o.viewing);
  TimeChoice time = history_of(o.history);
  ImageRequest request = parse(o.image);
  SpectralOptions spectral = parse(o.bands, choice.illuminant, o.image.layer);
  ImageSettings out(config_in_force(o.image));
  check_spaces(request, out.config);
  set_primaries(choice, out.config);
  out.choice = std::move(choice);
  out.viewing = viewing;
  out.time = std::move(time);
  out.request = std::move(request);
  out.limits = o.image.limits;
  out.spectral = std::move(spectral);
  return out;
}

}  // namespace scotopic
