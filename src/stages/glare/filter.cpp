#include "stages/glare/filter.h"

#include <cmath>
#include <optional>
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
  if (p.rule == GlareRule::above && !any_above(*plan_, picture, parallel_for)) return;
  const std::optional<glare::Constants> less = constants(*plan_, picture, parallel_for);
  if (!less) return;
  glare::Excess excess = excess_of(*plan_, picture);
  excess.less = *less;
  glare::Run(*plan_, picture, excess).apply(parallel_for);
}

}  // namespace scotopic
