// scotopic VERB IN... -o OUT [options]
#include "cli/program.h"

int main(int argc, char** argv) {
  return scotopic::run_program(
      argc, argv, {scotopic::add_apply, scotopic::add_lmsr, scotopic::add_explain, scotopic::add_bake, scotopic::add_check,
                   scotopic::add_time});
}
