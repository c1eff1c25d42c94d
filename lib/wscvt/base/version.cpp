// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/version.h"

namespace wscvt {

// The build sets it from the project's version.
const char* version() { return WSCVT_VERSION; }

}  // namespace wscvt
