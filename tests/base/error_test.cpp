// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/error.h"

#include <gtest/gtest.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <iterator>
#include <string>

#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/holds.h"
#include "wscvt/base/input_file.h"
#include "wscvt/base/machine_refused.h"
#include "wscvt/base/option.h"

namespace wscvt {
namespace {

std::string in_brackets(const NamedOption& option) {
  return "<" + option.key + "|" + option.value + ">";
}

TEST(Sentence, SaysItsOptionsInTheWordsOfEachDoor) {
  const Sentence sentence = "Raise " + mention("max-overhang", "30") + ", or set " +
                            mention("points", "true") + " (or " + mention("degree") + ").";
  EXPECT_EQ(sentence.text(), "Raise --max-overhang 30, or set --points (or --degree).");
  EXPECT_EQ(sentence.in(in_brackets),
            "Raise <max-overhang|30>, or set <points|true> (or <degree|>).");
  // Joined to others, also to itself, and without options.
  Sentence twice = "A. " + sentence;
  twice += twice;
  EXPECT_EQ(twice.in(in_brackets),
            "A. " + sentence.in(in_brackets) + "A. " + sentence.in(in_brackets));
  EXPECT_EQ(Sentence("a--b --c").in(in_brackets), "a--b --c");
  EXPECT_EQ(mention("degree").in(in_brackets), "<degree|>");
  EXPECT_TRUE(Sentence().empty());
}

TEST(Sentence, NamesOptionsByTheirTables) {
  constexpr NumberOption<double> ratio = {"edge-ratio", "mean edge ratio", 1.0, 2.0};
  constexpr FlagOption flag = {"points", "ignore faces", ""};
  EXPECT_EQ(mention(ratio).in(in_brackets), "<edge-ratio|>");
  EXPECT_EQ(mention(ratio, 1.4).in(in_brackets), "<edge-ratio|1.4>");
  EXPECT_EQ(mention(flag).in(in_brackets), "<points|true>");
}

TEST(Sentence, OfAnErrorKeepsItsOptions) {
  try {
    refuse("Use " + mention("placement", "fitted") + ".");
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "Use --placement fitted.");
    const Error again(error.code(), "scan.ply: " + error.sentence());
    EXPECT_EQ(again.sentence().in(in_brackets), "scan.ply: Use <placement|fitted>.");
  }
}

}  // namespace

namespace {

/// Whether the machine is at fault, by what is thrown; and the sentence.
bool is_of_the_machine(const std::string& path, int error_number, std::string& sentence) {
  try {
    refuse_to_open(path, error_number);
  } catch (const MachineRefused& error) {
    EXPECT_EQ(error.code(), ErrorCode::InputOutput);
    sentence = error.what();
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InputOutput);
    sentence = error.what();
    return false;
  }
}

TEST(MachineRefused, IsAFileThatIsThereAndCannotBeOpened) {
  const std::string folder = std::filesystem::temp_directory_path().string();
  std::string sentence;
  for (const int number : {ENOENT, EACCES, EISDIR, ENOTDIR, ELOOP, ENAMETOOLONG, EPERM, 0}) {
    EXPECT_FALSE(is_of_the_machine(folder + "/no.ply", number, sentence)) << number;
    EXPECT_TRUE(test::holds(sentence, "/no.ply\" cannot be opened. "));
  }
  for (const int number : {EMFILE, ENFILE, ENOMEM, EIO, ESTALE, EINTR}) {
    EXPECT_TRUE(is_of_the_machine(folder + "/no.ply", number, sentence)) << number;
  }
  EXPECT_TRUE(is_of_the_machine("no.ply", EMFILE, sentence));
  EXPECT_TRUE(test::holds(sentence, "Too many open files"));
}

TEST(MachineRefused, IsAFolderThatIsGone) {
  std::string sentence;
  EXPECT_FALSE(is_of_the_machine("no.ply", ENOENT, sentence));
  EXPECT_TRUE(is_of_the_machine("no such folder/no.ply", ENOENT, sentence));
  EXPECT_TRUE(test::holds(sentence, "the folder \"no such folder\" is not there"));
}

/// A file of Linux that can be opened, and whose first byte the system refuses to read.
constexpr const char* unreadable = "/proc/self/mem";

TEST(InputFile, EveryWayToReadTellsWhatTheSystemRefuses) {
  InputFile by_line(unreadable);
  std::string text;
  EXPECT_THROW(std::getline(by_line, text), MachineRefused);
  InputFile by_block(unreadable);
  std::array<char, 100000> block{};
  EXPECT_THROW(by_block.read(block.data(), block.size()), MachineRefused);
  InputFile by_number(unreadable);
  double number = 0.0;
  EXPECT_THROW(by_number >> number, MachineRefused);
  try {
    file_content(unreadable);
    FAIL();
  } catch (const MachineRefused& error) {
    EXPECT_STREQ(error.what(), "\"/proc/self/mem\" could not be read to its end. Check the disk.");
  }
}

class InputFiles : public test::FileFolder {};

TEST_F(InputFiles, AreReadToTheirEndsWhateverTheirLengths) {
  for (const std::size_t length : {0U, 1U, 8191U, 8192U, 8193U, 100001U}) {
    std::string content;
    for (std::size_t k = 0; k < length; ++k) content += static_cast<char>(k * k % 251);
    EXPECT_EQ(file_content(file("f", content)), content);
    InputFile stream(path("f"));
    std::string start(length / 3, '\0');
    stream.read(start.data(), static_cast<std::streamsize>(start.size()));
    EXPECT_EQ(start + std::string(std::istreambuf_iterator<char>(stream), {}), content);
  }
}

TEST_F(InputFiles, ThatAreMissingAreRefusedOrEmpty) {
  EXPECT_THROW(InputFile(path("no.csv")), FileMissing);
  InputFile empty(path("no.csv"), MissingFile::IsEmpty);
  std::string line;
  EXPECT_FALSE(std::getline(empty, line));
  EXPECT_EQ(file_content(path("no.csv")), "");
  EXPECT_EQ(file_content(path("no folder/no.csv")), "");
  EXPECT_ERROR(file_content(path(".")), InputOutput);
  EXPECT_ERROR(InputFile("/dev/zero"), InputOutput);
}

}  // namespace
}  // namespace wscvt
