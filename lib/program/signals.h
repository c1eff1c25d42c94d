// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt::program {

/// From now on the first SIGINT (Ctrl-C), SIGTERM or SIGHUP (a terminal that is closed) is noted
/// instead of ending the program, so that nothing half written stays behind; a second one ends it.
/// So is every SIGXCPU (the limit of the time of work, ulimit -t).
void note_signals();

/// From now on a file that grows beyond the limit of the machine (ulimit -f) is an error of
/// writing, with its sentence, instead of the end of the program.
void ignore_file_size_signal();

/// Number of the signal that came; 0 while none has.
int noted_signal();

}  // namespace wscvt::program
