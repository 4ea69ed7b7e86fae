#include "python/photometry.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adaptation/time/dark_adaptation.h"
#include "adaptation/named_adaptations.h"
#include "adaptation/mesopic.h"
#include "adaptation/pupil.h"
#include "adaptation/thresholds.h"
#include "receptors/illuminant.h"
#include "receptors/receptor_space.h"
#include "receptors/spectral_weights.h"

namespace scotopic {
namespace {

namespace py = pybind11;
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

double luminance(double value) {
  if (!(value >= 0) || !std::isfinite(value))
    throw py::value_error("a luminance is a finite number of cd/m2, 0 or more");
  return value;
}

double coefficient(double photopic, double sp_ratio) {
  if (!(sp_ratio > 0) || !std::isfinite(sp_ratio)) throw py::value_error("an S/P ratio is a number above 0");
  return mesopic_coefficient(luminance(photopic), sp_ratio);
}

double mesopic(double photopic, double sp_ratio) {
  return mesopic_luminance(photopic, photopic * sp_ratio, coefficient(photopic, sp_ratio));
}

/// Bands along the last axis; signals take their place, each times its factor.
using Weighed = std::vector<std::pair<Signal, double>>;
py::array_t<double> weigh(const Doubles& spectrum, const std::vector<double>& wavelengths, bool bins,
                          const Weighed& signals) {
  const auto bands = static_cast<py::ssize_t>(wavelengths.size());
  if (spectrum.ndim() < 1 || spectrum.shape(spectrum.ndim() - 1) != bands)
    throw py::value_error("the last axis of spectrum must be as long as wavelengths");
  const bool ascend =
      std::adjacent_find(wavelengths.begin(), wavelengths.end(), std::greater_equal<>()) == wavelengths.end();
  if (bands < 2 || !ascend || !(wavelengths.front() > 0) || !std::isfinite(wavelengths.back()))
    throw py::value_error("wavelengths are two or more numbers of nm above 0, ascending");
  const SpectralWeights weights = emissive_weights(
      BandGrid(wavelengths), bins ? BandSampling::bin : BandSampling::point, BandUnit::per_nm);
  std::vector<py::ssize_t> shape(spectrum.shape(), spectrum.shape() + spectrum.ndim());
  shape.back() = static_cast<py::ssize_t>(signals.size());
  py::array_t<double> out(shape);
  const double* in = spectrum.data();
  double* to = out.mutable_data();
  for (py::ssize_t i = 0; i < spectrum.size() / bands; ++i, in += bands)
    for (const auto& [signal, factor] : signals) {
      const std::vector<double>& weight = weights.of[index(signal)];
      double sum = 0;
      for (std::size_t band = 0; band < weight.size(); ++band) sum += weight[band] * in[band];
      *to++ = factor * sum;
    }
  return out;
}

py::array_t<double> lmsr(const Doubles& spectrum, const std::vector<double>& wavelengths, bool bins) {
  return weigh(spectrum, wavelengths, bins,
               {{Signal::l, 1}, {Signal::m, 1}, {Signal::s, 1}, {Signal::rod, 1}});
}

py::array_t<double> luminances(const Doubles& spectrum, const std::vector<double>& wavelengths, bool bins) {
  return weigh(spectrum, wavelengths, bins,
               {{Signal::y, 1}, {Signal::rod, 1 / rod_signal_per_scotopic_luminance()}});
}

std::vector<py::tuple> illuminants() {
  std::vector<py::tuple> out;
  for (const NamedIlluminant& light : named_illuminants())
    out.push_back(py::make_tuple(std::string(light.name), light.sp_ratio, std::string(light.description)));
  return out;
}

/// Wavelengths in whole nm, and relative power.
py::tuple illuminant(const std::string& name) {
  const std::optional<Spectrum> light = illuminant_spectrum(name);
  if (!light) throw py::value_error("unknown illuminant '" + name + "'; there are " + illuminant_names());
  std::vector<double> nm, power;
  for (int i = 380; i <= 780; i += 5) {
    nm.push_back(i);
    power.push_back(light->curve().at(i));
  }
  return py::make_tuple(Doubles(py::cast(nm)), Doubles(py::cast(power)));
}

std::vector<py::tuple> adaptations() {
  std::vector<py::tuple> out;
  for (const NamedAdaptation& step : named_adaptations)
    out.push_back(py::make_tuple(std::string(step.name), step.adaptation, std::string(step.scene)));
  return out;
}

/// Of an eye adapted to it: visible difference in cd/m2; thresholds of rods and cones.
std::array<double, 4> thresholds(double value) {
  const AdaptationThresholds t = thresholds_of(adapted_state(luminance(value)), value);
  return {value > 0 ? visible_difference(value) : std::pow(10.0, -2.86), t.rod_log10, t.cone_log10, t.log10};
}

AdaptationState first_state(const std::vector<double>& luminances, const std::string& history) {
  if (history.empty()) return adapted_state(luminances.front());
  const AdaptationHistory past = parse_adaptation_history(history);
  if (!past.problem.empty()) throw py::value_error("history: " + past.problem);
  return state_after(past.periods);
}

/// One row a frame: the state, then the thresholds; see the names in __init__.py.
py::array_t<double> adaptation_track(const std::vector<double>& luminances, double dt,
                                     const std::string& history) {
  if (luminances.empty()) throw py::value_error("luminance holds no frame");
  if (!(dt > 0) || !std::isfinite(dt)) throw py::value_error("dt is a number of seconds above 0");
  for (const double value : luminances) (void)luminance(value);
  const std::vector<AdaptationState> states =
      track_states(first_state(luminances, history), luminances, 1 / dt);
  py::array_t<double> out({static_cast<py::ssize_t>(states.size()), py::ssize_t{11}});
  double* to = out.mutable_data();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const AdaptationState& s = states[i];
    const AdaptationThresholds t = thresholds_of(s, luminances[i]);
    for (const double value :
         {s.rod_bleached, s.rod_product, s.cone_bleached, s.rod_neural, s.cone_neural, t.rod_luminance,
          t.cone_luminance, t.rod_log10, t.cone_log10, t.log10, t.exposure})
      *to++ = value;
  }
  return out;
}

}  // namespace

void add_photometry(py::module_& m) {
  m.def("lmsr", lmsr, py::arg("spectrum"), py::arg("wavelengths"), py::arg("bins"));
  m.def("luminances", luminances, py::arg("spectrum"), py::arg("wavelengths"), py::arg("bins"));
  m.def("mes2_coefficient", py::vectorize(coefficient));
  m.def("mes2_luminance", py::vectorize(mesopic));
  m.def("pupil", py::vectorize([](double value) { return pupil_diameter_mm(luminance(value)); }));
  m.def("trolands", py::vectorize([](double value) { return trolands_per_luminance(luminance(value)); }));
  m.def("thresholds", thresholds);
  m.def("adaptation_track", adaptation_track);
  m.def("illuminants", illuminants);
  m.def("illuminant", illuminant);
  m.def("adaptations", adaptations);
}

}  // namespace scotopic
