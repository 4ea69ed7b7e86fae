// What the module knows of light without an image: receptors, mesopic photometry, pupil, thresholds,
// adaptation in time.
#pragma once

#include <pybind11/pybind11.h>

namespace scotopic {

/// Adds the functions to the module.
void add_photometry(pybind11::module_& module);

}  // namespace scotopic
