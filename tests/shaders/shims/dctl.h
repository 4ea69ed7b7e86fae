// What DaVinci Resolve gives a DCTL: for compiling one as C++. Sliders are variables with C names.
#pragma once

#include <cmath>

struct float3 {
  float x, y, z;
};
inline float3 make_float3(float x, float y, float z) { return {x, y, z}; }

#define __DEVICE__ static inline
#define DEFINE_UI_PARAMS(name, label, type, value, least, greatest, step) \
  extern "C" {                                                            \
  float name = type(value, least, greatest, step);                        \
  }
constexpr float DCTLUI_SLIDER_FLOAT(double value, double least, double greatest, double step) {
  return least <= value && value <= greatest && step > 0 ? static_cast<float>(value)
                                                         : throw "a slider out of its range";
}

inline float _fminf(float a, float b) { return std::fmin(a, b); }
inline float _fmaxf(float a, float b) { return std::fmax(a, b); }
inline float _fabs(float x) { return std::fabs(x); }
inline float _sqrtf(float x) { return std::sqrt(x); }
inline float _expf(float x) { return std::exp(x); }
inline float _logf(float x) { return std::log(x); }
inline float _powf(float x, float y) { return std::pow(x, y); }
