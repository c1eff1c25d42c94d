// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/volume_error.h"

#include "wscvt/base/error.h"

namespace wscvt {

void refuse_volume(const std::string& path, const Sentence& what) {
  throw Error(ErrorCode::InputOutput, "\"" + path + "\" " + what);
}

}  // namespace wscvt
