// scotopic VERB IN... -o OUT [options]
#include "cli/verbs/verbs.h"

int main(int argc, char** argv) {
  using namespace scotopic;
  // In the order in which help lists them.
  return run_program(argc, argv, {add_apply, add_lmsr, add_explain, add_bake, add_check, add_time});
}
