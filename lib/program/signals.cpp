// SPDX-License-Identifier: GPL-3.0-or-later
#include "signals.h"

#include <csignal>
#include <initializer_list>

namespace wscvt::program {

namespace {

// A handler has nowhere else to put what it saw.
volatile std::sig_atomic_t noted = 0;

void note(int number) { noted = number; }

}  // namespace

void note_signals() {
  struct sigaction action {};
  action.sa_handler = note;
  sigemptyset(&action.sa_mask);
  // No restart: a wait for a pipe that nobody reads ends too.
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    // The limit of the time of work sends its signal every second, until it is heard.
    action.sa_flags = number == SIGXCPU ? 0 : static_cast<int>(SA_RESETHAND);
    struct sigaction before {};
    // Whoever started the program with a signal ignored (nohup, a shell's background) meant it.
    if (sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(number, &action, nullptr);
  }
}

void ignore_file_size_signal() { std::signal(SIGXFSZ, SIG_IGN); }

int noted_signal() { return noted; }

}  // namespace wscvt::program
