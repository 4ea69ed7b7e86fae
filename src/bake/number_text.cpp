#include "bake/number_text.h"

#include <fmt/format.h>

namespace scotopic {

std::string float_text(float value) { return fmt::format("{}", value); }

}  // namespace scotopic
