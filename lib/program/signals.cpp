// SPDX-License-Identifier: GPL-3.0-or-later
#include "signals.h"

#include <csignal>
#include <initializer_list>

namespace wscvt::program {

namespace {

// A signal handler can only store into such a variable.
volatile std::sig_atomic_t noted = 0;

void note(int number) { noted = number; }

}  // namespace

void note_signals() {
  struct sigaction action {};
  action.sa_handler = note;
  sigemptyset(&action.sa_mask);
  // No restart, so that a wait for a pipe without a reader also ends.
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    // The limit of CPU time sends its signal every second, until the program ends.
    action.sa_flags = number == SIGXCPU ? 0 : static_cast<int>(SA_RESETHAND);
    struct sigaction before {};
    // If the program was started with a signal ignored (nohup, a shell's background), it stays
    // ignored.
    if (sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(number, &action, nullptr);
  }
}

void ignore_file_size_signal() { std::signal(SIGXFSZ, SIG_IGN); }

int noted_signal() { return noted; }

}  // namespace wscvt::program
