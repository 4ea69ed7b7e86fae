// Failure, as the caller of a verb sees it; it is part of what is installed.
#pragma once

#include "scotopic/error.h"
