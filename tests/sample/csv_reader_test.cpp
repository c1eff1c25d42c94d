// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/csv_reader.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "wscvt/base/text_format.h"

namespace wscvt {
namespace {

using Fields = std::vector<std::string>;

TEST(CsvReader, ReadsBackWhatIsWritten) {
  const std::vector<Fields> records = {
      {"plain", "", "with, comma", "with \"quotes\"", "\"", "\"\"", "two\r\nlines"},
      {"\r", "\n", "lone\rreturn", "lone\nfeed", ",", "last\r"},
      {"", ""},
      {"one"}};
  std::string text;
  for (const Fields& record : records) text += csv_record(record);
  std::istringstream stream(text);
  CsvReader reader(stream);
  std::string read;
  Fields fields;
  for (const Fields& record : records) {
    ASSERT_TRUE(reader.next(fields));
    EXPECT_EQ(fields, record);
    EXPECT_EQ(reader.text(), csv_record(record));
    read += reader.text();
    EXPECT_EQ(reader.size(), read.size());
  }
  EXPECT_FALSE(reader.next(fields));
  EXPECT_EQ(fields, records.back());
  EXPECT_FALSE(reader.is_cut());
  EXPECT_EQ(read, text);
}

TEST(CsvReader, TellsARecordThatIsCut) {
  const std::string whole = csv_record({"a", "b\r\nc"});
  const std::string next = csv_record({"d", "e\r\nf"});
  for (std::size_t size = 1; size < next.size(); ++size) {
    SCOPED_TRACE(size);
    std::istringstream stream(whole + next.substr(0, size));
    CsvReader reader(stream);
    Fields fields;
    EXPECT_TRUE(reader.next(fields));
    EXPECT_FALSE(reader.next(fields));
    EXPECT_TRUE(reader.is_cut());
    EXPECT_EQ(reader.size(), whole.size());
    EXPECT_EQ(reader.text(), whole);
  }
}

TEST(CsvReader, TakesALastRecordWithoutALineBreakIfAsked) {
  std::istringstream stream("a;b\n1,5;\"2;3\"");
  CsvReader reader(stream, Separator::OfFirstRecord);
  Fields fields;
  EXPECT_FALSE(reader.last(fields));
  ASSERT_TRUE(reader.next(fields));
  EXPECT_EQ(fields, (Fields{"a", "b"}));
  ASSERT_FALSE(reader.next(fields));
  ASSERT_TRUE(reader.last(fields));
  EXPECT_EQ(fields, (Fields{"1,5", "2;3"}));
  EXPECT_FALSE(reader.last(fields));
  std::istringstream open("a,b\n1,\"2");
  CsvReader of_open(open);
  ASSERT_TRUE(of_open.next(fields));
  ASSERT_FALSE(of_open.next(fields));
  EXPECT_FALSE(of_open.last(fields));
}

}  // namespace
}  // namespace wscvt
