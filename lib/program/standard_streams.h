// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt::program {

/// Opens /dev/null in place of closed standard streams, so that no other file gets their numbers
/// and their output. Writing to such a stream is still an error.
void fill_closed_streams();

}  // namespace wscvt::program
