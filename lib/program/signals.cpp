// SPDX-License-Identifier: GPL-3.0-or-later
#include "signals.h"

#include <csignal>
#ifdef _WIN32
#include <windows.h>

#include <atomic>
#else
#include <initializer_list>
#endif

namespace wscvt::program {

#ifdef _WIN32

namespace {

// Windows calls the function below in a thread of its own.
std::atomic<int> noted = 0;

BOOL WINAPI note(DWORD event) {
  const int number = event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT ? SIGINT : SIGTERM;
  // After the second one, Windows ends the program.
  if (int none = 0; !noted.compare_exchange_strong(none, number)) return FALSE;
  // When a console is closed, the program ends with this function. It has five seconds.
  if (number == SIGTERM) Sleep(5000);
  return TRUE;
}

}  // namespace

void note_signals() { SetConsoleCtrlHandler(note, TRUE); }

void ignore_file_size_signal() {}

#else

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

#endif

int noted_signal() { return noted; }

}  // namespace wscvt::program
