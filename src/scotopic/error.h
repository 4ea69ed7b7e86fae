// Here a way to base/error.h, which is what is installed under this name.
#pragma once

#include "base/error.h"
