#include "cli/verbs/verbs.h"

namespace scotopic {

std::vector<AddVerb> verbs() { return {add_apply, add_lmsr, add_explain, add_bake, add_check, add_time}; }

}  // namespace scotopic
