// What Nuke gives a BlinkScript kernel: for compiling one as C++. A picture of one pixel.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

struct float4 {
  float x, y, z, w;
  float4() : x(0), y(0), z(0), w(0) {}
  float4(float a, float b, float c, float d) : x(a), y(b), z(c), w(d) {}
};

enum Granularity { ePixelWise };
enum Access { eRead, eWrite };
enum Pattern { eAccessPoint };
enum Edge { eEdgeClamped };

template <Access, Pattern = eAccessPoint, Edge = eEdgeClamped>
struct Image {
  float4& operator()() { return pixel; }
  float4 pixel;
};

template <Granularity>
struct ImageComputationKernel {
  std::map<std::string, float*> parameters;
};

#define kernel struct
#define param public
#define local public
#define SampleType(image) float4
#define defineParam(name, label, value)          \
  do {                                           \
    static_assert(sizeof(label) > 1, "a label"); \
    name = value;                                \
    this->parameters[#name] = &name;             \
  } while (false)

// Blink's own functions; those of the C library are of double.
using std::exp;
using std::fabs;
using std::log;
using std::max;
using std::min;
using std::pow;
using std::sqrt;
