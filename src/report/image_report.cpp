#include "report/image_report.h"

#include "pipeline/scene/open_image.h"

namespace scotopic {
namespace {

nlohmann::ordered_json measured_json(const std::vector<EvaluatorMeasure>& measured) {
  nlohmann::ordered_json out;
  for (const EvaluatorMeasure& one : measured)
    out.push_back(
        {{"evaluator", one.name}, {"maxDeltaE00", one.max_error}, {"nanosecondsPerPixel", one.nanoseconds}});
  return out;
}

}  // namespace

nlohmann::ordered_json image_json(const ImageReport& r) {
  nlohmann::ordered_json out;
  out["input"] = r.input;
  out["output"] = r.output;
  out["colorspace"] = r.input_space;
  out["colorspaceSource"] = r.input_space_reason;
  out["outputColorspace"] = r.output_space;
  out["adaptationSource"] = r.scene.numbers.adaptation_source;
  out["whiteLuminanceSource"] = r.scene.numbers.white_luminance_source;
  for (const Attribute& stamp : r.stamps)
    std::visit([&](const auto& value) { out["applied"][stamp.name] = value; }, stamp.value);
  out["notes"] = r.notes;
  if (r.scene.spectral) out["spectral"] = spectral_json(r.scene.spectral);
  out["effects"] = plan_json(r.scene.plan);
  if (r.scene.adapting) out["state"] = adapting_json(r.scene.adapting->state, r.scene.adapting->thresholds);
  out["nonFinite"] = r.non_finite.count;
  out["clipped"] = r.clipped;
  if (!r.evaluator->measured.empty()) out["evaluators"] = measured_json(r.evaluator->measured);
  if (r.tone)
    out["display"] = {{"low", r.tone->low},
                      {"high", r.tone->high},
                      {"compression", r.tone->compression},
                      {"sigma", r.tone->sigma}};
  if (r.night)
    out["display"] = {{"space", r.night->space},
                      {"peak", r.night->peak},
                      {"stops", r.night->stops},
                      {"scale", r.night->scale},
                      {"shoulder", r.night->bends}};
  return out;
}

nlohmann::ordered_json adapting_json(const AdaptationState& state, const AdaptationThresholds& thresholds) {
  return {{"rodLog10Threshold", thresholds.rod_log10},
          {"coneLog10Threshold", thresholds.cone_log10},
          {"exposure", thresholds.exposure},
          {"equivalentLuminance", thresholds.rod_luminance},
          {"rodBleached", state.rod_bleached},
          {"rodProduct", state.rod_product},
          {"coneBleached", state.cone_bleached},
          {"rodNeural", state.rod_neural},
          {"coneNeural", state.cone_neural}};
}

nlohmann::ordered_json plan_json(const ScenePlan& plan) {
  nlohmann::ordered_json out;
  for (const EffectDecision& e : plan.effects)
    out[std::string(e.effect)] = {{"asked", e.asked},         {"needed", e.needed},
                                  {"runs", e.runs()},         {"number", e.number},
                                  {"threshold", e.threshold}, {"unit", e.unit},
                                  {"share", e.share},         {"largestDifference", e.difference},
                                  {"reason", e.reason}};
  return out;
}

nlohmann::ordered_json spectral_json(const std::optional<SpectralReport>& found) {
  if (!found) return nullptr;
  const SpectralReport& report = *found;
  nlohmann::ordered_json out;
  out["kind"] = report.kind == SpectralKind::emissive     ? "radiance"
                : report.kind == SpectralKind::reflective ? "reflectance"
                                                          : "receptors";
  out["notes"] = report.notes;
  if (report.kind == SpectralKind::receptors) return out;
  out["bands"] = report.bands;
  out["firstNm"] = report.first_nm;
  out["lastNm"] = report.last_nm;
  for (const Signal signal : all_signals)
    out["outside"][signal_names[index(signal)]] = report.outside[index(signal)];
  return out;
}

void tell_non_finite(const NonFinitePixels& pixels, const std::string& file, const std::string& done,
                     const Console& console) {
  if (pixels.count > 0) console.note(file + ": " + describe(pixels) + "; " + done);
}

}  // namespace scotopic
