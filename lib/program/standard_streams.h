// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt::program {

/// Fills the places of closed standard streams, so that no file of ours opens in one of them and
/// takes what is meant for it; writing to a place so filled goes on being an error.
void fill_closed_streams();

}  // namespace wscvt::program
