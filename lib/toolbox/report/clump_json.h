// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toolbox/clump/clump_options.h"
#include "wscvt/report/json.h"

namespace wscvt {

/// Every option of a clump with the name and value of the command line.
Json json_of(const ClumpOptions& options);

}  // namespace wscvt
