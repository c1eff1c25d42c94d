// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/version.h"

namespace wscvt {

// The build knows it from the project's one definition.
const char* version() { return WSCVT_VERSION; }

}  // namespace wscvt
