// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace wscvt {

/// What a report is about and when it was made. Whoever asks for the report says so: the library
/// looks at no clock, so that the same work gives the same bytes.
struct ReportOrigin {
  std::string source;  ///< name of the scan's file or layer; empty: not told
  std::string date;    ///< such as "2026-11-21"; empty: not told
};

/// What reports say they were made by: "wscvt 1.0.0".
std::string made_by();

/// "Made from scan.ply by wscvt 1.0.0 on 2026-11-21.", without what is not told.
std::string origin_sentence(const ReportOrigin& origin);

}  // namespace wscvt
