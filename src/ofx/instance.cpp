#include "ofx/instance.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "adaptation/time/dark_adaptation.h"
#include "base/error.h"
#include "scotopic/controls.h"
#include "ofx/colour.h"
#include "ofx/image.h"

namespace scotopic::ofx {
namespace {

constexpr const char* history = "adaptation_history";

/// Memory that the host may hand out uncleared: where the source has no pixels the output is black.
void clear(const MemoryPixels& p) {
  const std::size_t row = static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.pixel_stride);
  for (int y = 0; y < p.height; ++y) std::memset(p.at(0, y, 0), 0, row);
}

int frame_of(Time time) {
  constexpr double greatest = std::numeric_limits<int>::max();
  return static_cast<int>(std::clamp(std::floor(time), -greatest, greatest));
}

/// Leaves of the source what `written` depends on, where that is not all of it.
void cut(const HostOperator& op, const Image& source, const RectI& written, MemoryJob& job) {
  const std::optional<int> reach = op.reach(job);
  if (!reach || !holds(source.frame(), source.bounds())) return;
  const RectI wanted = common(grown(written, *reach), source.frame());
  const RectI tile = common(wanted, source.bounds());
  if (tile.x2 <= tile.x1) return;
  job.in = source.pixels(tile);
  job.header.data = window_in(tile, source.frame());
  // Of a host that brings less than it was asked for, what it brings is taken for the whole.
  if (holds(source.bounds(), wanted)) job.header.whole = window_in(source.frame(), source.frame());
}

/// By so many lengths on each side, within `all`.
RectD grown(const RectD& region, double x, double y, const RectD& all) {
  return {std::max(region.x1 - x, all.x1), std::max(region.y1 - y, all.y1), std::min(region.x2 + x, all.x2),
          std::min(region.y2 + y, all.y2)};
}

/// As many as a length, at least one.
int pixels(double length) { return static_cast<int>(std::clamp(length, 1.0, 1e9)); }

AdaptationState first_state(const Parameters& parameters, double luminance) {
  const auto given = parameters.find(history);
  if (given == parameters.end()) return adapted_state(luminance);
  const AdaptationHistory past = parse_adaptation_history(given->second);
  if (!past.problem.empty()) throw Error(ExitCode::usage, "", "--adaptation-history: " + past.problem);
  return state_after(past.periods);
}

}  // namespace

Instance::Instance(ImageEffect effect)
    : effect_(effect), panel_([&] {
        ParamSet set = nullptr;
        (void)suites().effect->get_param_set(effect, &set);
        return set;
      }()) {
  const bool clips =
      suites().effect->clip_get_handle(effect, source_clip, &source_, &source_properties_) == ok &&
      suites().effect->clip_get_handle(effect, output_clip, &output_, nullptr) == ok;
  if (!clips) throw Error(ExitCode::internal, "", "the host has no clips Source and Output");
}

std::shared_ptr<const HostOperator> Instance::operator_for(const Parameters& parameters) {
  const std::lock_guard guard(lock_);
  if (!current_ || current_parameters_ != parameters) {
    current_ = std::make_shared<const HostOperator>(parameters);
    current_parameters_ = parameters;
  }
  return current_;
}

Properties Instance::properties() const {
  PropertySet set = nullptr;
  (void)suites().effect->get_property_set(effect_, &set);
  return Properties(set);
}

double Instance::frame_rate() const {
  const double rate = properties().number(property::frame_rate, 0);
  return rate > 0 && rate <= 1e6 ? rate : 24;
}

double Instance::pixel_aspect() const {
  const double stated = Properties(source_properties_).number(property::pixel_aspect, 1);
  return stated > 0 ? stated : 1;
}

TrackedAdaptation Instance::track(const PanelState& panel, Time time) const {
  const auto given = panel.parameters.find("fps");
  const double rate = given == panel.parameters.end() ? frame_rate() : std::stod(given->second);
  const int last = frame_of(time);
  const int first = std::min(last, frame_of(Properties(source_properties_).number(property::frame_range, 0)));
  std::vector<double> luminances;
  for (int frame = first; frame <= last; ++frame) luminances.push_back(panel_.slider(frame));
  TrackedAdaptation out;
  out.luminance = panel.slider;
  out.source = "the slider";
  out.state = track_states(first_state(panel.parameters, luminances.front()), luminances, rate).back();
  return out;
}

std::string Instance::source_space() const {
  if (colour_style(properties()) == ColourStyle::none || !config_in_force()) return "";
  const std::string said = Properties(source_properties_).text(property::colourspace);
  return said.empty() ? "" : space_for(said, *config_in_force());
}

PanelState Instance::ask(const Moment& moment, MemoryJob& job) const {
  PanelState panel = panel_.at(moment.time, moment.scale_x);
  if (panel.moves) job.frame = frame_of(moment.time);
  if (panel.adapts) job.adaptation = track(panel, moment.time);
  if (panel.adapts) panel.parameters.erase(history);
  if (panel.parameters.count("fps") == 0) panel.parameters["fps"] = parameter_text(frame_rate());
  if (panel.host_space) {
    const std::string space = source_space();
    if (!space.empty()) panel.parameters[colour_space] = space;
  }
  return panel;
}

void Instance::render(const Moment& moment, const RectI& window) {
  MemoryJob job;
  const PanelState panel = ask(moment, job);
  const std::shared_ptr<const HostOperator> op = operator_for(panel.parameters);
  const Image source(source_, moment.time);
  const Image target(output_, moment.time);
  const RectI written = common(window, target.bounds());
  if (written.x2 <= written.x1) return;
  job.header.name = "";
  job.header.data = window_in(source.bounds(), source.frame());
  job.header.display = window_in(source.frame(), source.frame());
  job.header.straight = source.straight();
  job.header.pixel_aspect = source.pixel_aspect() * moment.scale_y / moment.scale_x;
  job.in = source.pixels(source.bounds());
  job.window = window_in(written, source.frame());
  job.out = target.pixels(written);
  if (job.in.channels != job.out.channels || job.in.type != job.out.type)
    throw Error(ExitCode::input, "", "source and output have different components or depths");
  cut(*op, source, written, job);
  clear(target.pixels(written));
  (void)op->apply(job, {});
}

bool Instance::is_identity(const Moment& moment) {
  MemoryJob job;
  const PanelState panel = ask(moment, job);
  const Image source(source_, moment.time);
  job.header.data = job.header.display = window_in(source.frame(), source.frame());
  job.in = source.pixels(source.bounds());
  return operator_for(panel.parameters)->changes_nothing(job);
}

std::optional<RectD> Instance::source_region(const Moment& moment, const RectD& wanted) {
  RectD all = {};
  if (suites().effect->clip_get_region_of_definition(source_, moment.time, &all) != ok) return std::nullopt;
  MemoryJob job;
  const PanelState panel = ask(moment, job);
  // No pixel is looked at: the frame's size is what counts.
  std::byte none[16] = {};
  job.in = {none, 1, 1, 4, 16, 16, 4, SampleType::float32};
  job.header.data = {0, 0, 1, 1};
  const double x = pixel_aspect() / moment.scale_x, y = 1 / moment.scale_y;  // lengths of a pixel
  job.header.display = {0, 0, pixels((all.x2 - all.x1) / x), pixels((all.y2 - all.y1) / y)};
  const std::optional<int> reach = operator_for(panel.parameters)->reach(job);
  if (!reach) return all;
  if (*reach == 0) return std::nullopt;
  // One more: hosts round regions to pixels.
  return grown(wanted, (*reach + 1) * x, (*reach + 1) * y, all);
}

const char* Instance::preferred_space() const {
  const bool asks = colour_style(properties()) != ColourStyle::none && panel_.at(0, 1).host_space;
  return asks ? colour::scene_linear : nullptr;
}

std::string Instance::output_space() {
  const ColourStyle style = colour_style(properties());
  if (style == ColourStyle::none) return "";
  MemoryJob job;
  const std::shared_ptr<const HostOperator> op = operator_for(ask({}, job).parameters);
  const std::optional<ColourSpace> other = op->new_space();
  return other ? identifier_of(*other, op->settings().config, style) : colour::of_source;
}

}  // namespace scotopic::ofx
