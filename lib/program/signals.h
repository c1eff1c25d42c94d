// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt::program {

/// From now on the first SIGINT (Ctrl-C) or SIGTERM is noted instead of ending the program, so that
/// nothing half written stays behind; a second one ends it.
void note_signals();

/// Number of the signal that came; 0 while none has.
int noted_signal();

}  // namespace wscvt::program
