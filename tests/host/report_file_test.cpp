// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_file.h"

#include <gtest/gtest.h>

#include <QFile>
#include <QTemporaryDir>

#include "wscvt/base/error.h"

namespace wscvt::host_test {
namespace {

std::string refusal_of(const std::string& path) {
  try {
    filter::check_remesh_report_file(path);
    filter::check_descriptor_report_file(path, true);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ReportFile, IsRefusedBeforeTheWorkWhenItCannotBeWrittenAfterIt) {
  QTemporaryDir folder;
  const auto in_folder = [&](const char* name) { return folder.filePath(name).toStdString(); };
  for (const char* good : {"a.html", "b.c.JSON", "b.Csv"}) {
    EXPECT_EQ(refusal_of(in_folder(good)), "") << good;
  }
  EXPECT_EQ(refusal_of(""), "");
  for (const char* bad : {"b.txt", "csv", "no/a.html"}) {
    const std::string sentence = refusal_of(in_folder(bad));
    EXPECT_NE(sentence.find("ReportFile"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("Nothing was changed"), std::string::npos) << sentence;
  }
  QFile table(folder.filePath("other.csv"));
  ASSERT_TRUE(table.open(QIODevice::WriteOnly));
  table.write("a,b\r\n1,2\r\n");
  table.close();
  EXPECT_NE(refusal_of(in_folder("other.csv")).find("new file"), std::string::npos);
}

}  // namespace
}  // namespace wscvt::host_test
