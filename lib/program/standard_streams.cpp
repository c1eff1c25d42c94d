// SPDX-License-Identifier: GPL-3.0-or-later
#ifdef _WIN32
#include <windows.h>
// The header above comes first.
#include <io.h>
#endif
#include <fcntl.h>

#ifndef _WIN32
#include <unistd.h>
#endif

#include <initializer_list>

#include "standard_streams.h"

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

#endif

}  // namespace wscvt::program
