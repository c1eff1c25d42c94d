// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/terminal/terminal.h"

#ifdef _WIN32
#include <windows.h>
// The header above comes first.
#include <io.h>

#include <atomic>
#endif
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <initializer_list>

#include "wscvt/base/text.h"

namespace wscvt::program {

#ifdef _WIN32

StandardStreams::StandardStreams() : code_page_(GetConsoleOutputCP()) {
  for (const int stream : {0, 1, 2}) {
    if (_get_osfhandle(stream) < 0) _open("NUL", stream == 0 ? _O_WRONLY : _O_RDONLY);
    // The same bytes as on other systems, also in a file or a pipe.
    _setmode(stream, _O_BINARY);
  }
  if (code_page_ != 0) SetConsoleOutputCP(CP_UTF8);
  const HANDLE console = GetStdHandle(STD_ERROR_HANDLE);
  DWORD mode = 0;
  constexpr DWORD takes_escapes = 4;  // ENABLE_VIRTUAL_TERMINAL_PROCESSING
  if (GetConsoleMode(console, &mode) != 0) SetConsoleMode(console, mode | takes_escapes);
}

StandardStreams::~StandardStreams() {
  if (code_page_ != 0) SetConsoleOutputCP(code_page_);
}

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

StandardStreams::StandardStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1) continue;
    // open returns the lowest free number, which is this one. The mode is the wrong one for its
    // use.
    if (open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) != stream) return;
  }
}

StandardStreams::~StandardStreams() = default;

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

ProgressLine::ProgressLine(bool wanted) : is_shown_(wanted && isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(double fraction, const std::string& stage) {
  if (!is_shown_) return;
  const std::string text =
      std::to_string(static_cast<int>(100.0 * fraction)) + " %  " + wscvt::readable(stage, "");
  if (text == drawn_) return;
  // Carriage return, the text, and the rest of the line cleared.
  std::fprintf(stderr, "\r%s\033[K", text.c_str());
  std::fflush(stderr);
  drawn_ = text;
}

void ProgressLine::clear() {
  if (!is_shown_ || drawn_.empty()) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn_.clear();
}

}  // namespace wscvt::program
