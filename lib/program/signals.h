// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt::program {

/// From now on the first SIGINT (Ctrl-C), SIGTERM or SIGHUP (closed terminal) is noted and does not
/// end the program, so that no half-written file remains. A second one ends the program. Every
/// SIGXCPU (limit of CPU time, ulimit -t) is noted. On Windows, Ctrl-C and Ctrl-Break are SIGINT,
/// and the end of the console or of the session is SIGTERM.
void note_signals();

/// From now on a file larger than the machine's limit (ulimit -f) is a write error with a message
/// and does not end the program.
void ignore_file_size_signal();

/// Returns the number of the noted signal; 0 if there was no signal.
int noted_signal();

}  // namespace wscvt::program
