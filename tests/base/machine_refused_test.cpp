// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/machine_refused.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <string>

#include "support/expect_error.h"
#include "wscvt/base/error.h"

namespace wscvt {
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
    EXPECT_NE(sentence.find("/no.ply\" cannot be opened. "), std::string::npos) << sentence;
  }
  for (const int number : {EMFILE, ENFILE, ENOMEM, EIO, ESTALE, EINTR}) {
    EXPECT_TRUE(is_of_the_machine(folder + "/no.ply", number, sentence)) << number;
  }
  EXPECT_TRUE(is_of_the_machine("no.ply", EMFILE, sentence));
  EXPECT_NE(sentence.find("Too many open files"), std::string::npos) << sentence;
}

TEST(MachineRefused, IsAFolderThatIsGone) {
  std::string sentence;
  EXPECT_FALSE(is_of_the_machine("no.ply", ENOENT, sentence));
  EXPECT_TRUE(is_of_the_machine("no such folder/no.ply", ENOENT, sentence));
  EXPECT_NE(sentence.find("the folder \"no such folder\" is not there"), std::string::npos)
      << sentence;
}

}  // namespace
}  // namespace wscvt
