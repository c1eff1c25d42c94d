// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt {

/// JavaScript that draws the figures of a sample's HTML report from the JSON in its element "data".
/// It loads no other files.
extern const char* const sample_page_script;

}  // namespace wscvt
