// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt {

/// JavaScript that draws the figures of a sample's page from the JSON in its element "data". It
/// loads nothing.
extern const char* const sample_page_script;

}  // namespace wscvt
