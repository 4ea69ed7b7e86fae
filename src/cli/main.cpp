// scotopic VERB IN... -o OUT [options]
#include "cli/verbs/verbs.h"

int main(int argc, char** argv) { return scotopic::run_program(argc, argv, scotopic::verbs()); }
