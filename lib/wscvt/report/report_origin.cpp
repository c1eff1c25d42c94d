// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/version.h"
#include "wscvt/report/report.h"

namespace wscvt {

std::string made_by() { return std::string("wscvt ") + version(); }

std::string origin_sentence(const ReportOrigin& origin) {
  return "Made " + (origin.source.empty() ? "" : "from " + origin.source + " ") + "by " +
         made_by() + (origin.date.empty() ? "" : " on " + origin.date) + ".";
}

}  // namespace wscvt
