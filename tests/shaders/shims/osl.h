// What an OSL renderer gives a shader, for compiling its body as C++: colours, and functions of float.
#pragma once

#include <algorithm>
#include <cmath>

struct color {
  float v[3];
  color() : v{0, 0, 0} {}
  color(float r, float g, float b) : v{r, g, b} {}
  float operator[](int i) const { return v[i]; }
};

using std::exp;
using std::fabs;
using std::log;
using std::max;
using std::min;
using std::pow;
using std::sqrt;
