// line::format(), for the subcommands.
#pragma once

#include "line/Format.h"

namespace tool {

using line::format;

}  // namespace tool
