#include "stages/glare/filter.h"

#include <cmath>
#include <stdexcept>

#include "stages/glare/plan.h"
#include "stages/glare/run.h"

namespace scotopic {
namespace {

const GlareParameters& checked(const GlareParameters& p) {
  if (p.rule == GlareRule::above && !(p.threshold > 0 && std::isfinite(static_cast<float>(p.threshold))))
    throw std::invalid_argument("glare: the threshold must be > 0 and finite");
  return p;
}

}  // namespace

float greatest_component(const std::array<const float*, 3>& rgb, int width) {
  return glare::greatest_of_row(rgb, width);
}

GlareFilter::GlareFilter(const GlareParameters& parameters)
    : plan_(std::make_unique<const glare::Plan>(checked(parameters))) {}
GlareFilter::~GlareFilter() = default;
GlareFilter::GlareFilter(GlareFilter&&) noexcept = default;
GlareFilter& GlareFilter::operator=(GlareFilter&&) noexcept = default;

double GlareFilter::most_lost() const noexcept { return plan_->ladder.most; }

std::size_t GlareFilter::bytes(int planes, int threads) const {
  return glare::Run::bytes(*plan_, planes, threads);
}

void GlareFilter::apply(const GlarePicture& picture, const ParallelFor& parallel_for) const {
  glare::check_subimage(*plan_, picture);
  const GlareParameters& p = plan_->parameters;
  if (p.grid.strength == 0) return;
  if (p.rule == GlareRule::above && count_above(*plan_, picture, parallel_for) == 0) return;
  glare::Excess excess = excess_of(*plan_, picture);
  // Found at once in a night; a picture that scatters whole has no such pixel as a rule.
  if (p.rule == GlareRule::all || !glare::some_pixel_keeps_all(*plan_, picture)) {
    const glare::Extremes found = extremes(*plan_, picture, parallel_for);
    if (found.flat()) return;
    for (std::size_t k = 0; k < picture.light.size(); ++k) excess.less[k] = found.constant(k);
  }
  glare::Run(*plan_, picture, excess).apply(parallel_for);
}

}  // namespace scotopic
