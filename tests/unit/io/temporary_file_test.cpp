// SPDX-License-Identifier: BSD-3-Clause
#include "io/temporary_file.hpp"

#include "formats/output_files.hpp"
#include "trime/core/error.hpp"
#include "trime/io/mesh_file.hpp"

#include "support/temporary_directory.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace trime::io {
namespace {

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(TemporaryFile, ReplacesALargeFileThatOthersMayStillRead) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.path() + "/mesh.h5";
  const std::string old_text(3 << 20, 'a'), new_text(2 << 20, 'b');
  write_text_file(path, old_text, nullptr);
  std::ifstream reader(path, std::ios::binary);
  for (int round = 0; round < 3; ++round)
    write_text_file(path, new_text, nullptr);
  EXPECT_EQ(contents(path), new_text);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(reader), {}), old_text);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory.path()), {}), 1);
}

TEST(TemporaryFile, OneOfManyIsWholeAtOnceAndReplacesItsElder) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.path() + "/loop_1.txt";
  RunFiles files;
  write_text_file(path, "elder", &files);
  write_text_file_of_many(path, "1 2 3", &files);
  EXPECT_EQ(contents(path), "1 2 3");
  synchronise_file_system(path);
  EXPECT_EQ(contents(path), "1 2 3");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory.path()), {}), 1);
  EXPECT_THROW(write_text_file_of_many(directory.path() + "/none/loop.txt", "", &files), FileError);
  EXPECT_THROW(synchronise_file_system(directory.path() + "/none/loop.txt"), FileError);
}

TEST(TemporaryFile, NamesThatFileSystemsCannotHoldAreTold) {
  const std::string long_name(longest_file_name, 'x');
  EXPECT_EQ(length_problem("", 0), "");
  EXPECT_EQ(length_problem("/a/" + long_name, 0), "");
  EXPECT_EQ(length_problem(long_name + "/b", longest_temporary_ending), "");
  EXPECT_NE(length_problem("/a/" + long_name + "x/b", 0).find("at most 255 bytes, found 'xxx"), std::string::npos);
  EXPECT_NE(length_problem(long_name, 1).find("at most 254 bytes, since"), std::string::npos);
  std::string deep;
  for (int k = 0; k < 2000; ++k)
    deep += "/ab";
  EXPECT_NE(length_problem(deep, 0).find("6000 bytes, expected fewer than 4096"), std::string::npos);
}

TEST(TemporaryFile, ATemporaryNameIsNotLongerThanItMayBe) {
  const char* given = std::getenv("SLURM_JOB_ID");
  const std::string kept = given ? given : "";
  setenv("SLURM_JOB_ID", std::string(100, '7').c_str(), 1);
  EXPECT_EQ(temporary_name("a").size(), 1 + longest_temporary_ending);
  given ? setenv("SLURM_JOB_ID", kept.c_str(), 1) : unsetenv("SLURM_JOB_ID");
}

TEST(OutputFiles, EndingsAreNotLongerThanTheyMayBe) {
  const std::string longest = "m_2147483647_bdry_vertices_coords_CCW_1234567890.txt";
  EXPECT_TRUE(formats::is_text_mesh_file(longest, "m"));
  EXPECT_EQ(longest.size(), 1 + formats::longest_ending);
}

TEST(TemporaryFile, LeavesAPipeWhereItIs) {
  const test::TemporaryDirectory directory;
  const std::string pipe = directory.path() + "/pipe", link = directory.path() + "/link";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::filesystem::create_symlink(pipe, link);
  EXPECT_THROW(write_text_file(pipe, "text", nullptr), FileError);
  EXPECT_THROW(write_text_file(link, "text", nullptr), FileError);
  EXPECT_THROW(write_text_file_of_many(pipe, "text", nullptr), FileError);
  EXPECT_THROW(replace_link("mesh.h5", pipe), FileError);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory.path()), {}), 2);
}

TEST(TemporaryFile, IsKnownToASignalHandlerWhileItIsWritten) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.path() + "/mesh.h5.tmp-1", final_path = directory.path() + "/mesh.h5";
  RunFiles files;
  {
    TemporaryFile temporary(path, &files);
    std::ofstream(path) << "half";
    files.remove_temporary();
    EXPECT_FALSE(std::filesystem::exists(path));
    std::ofstream(path) << "whole";
    temporary.publish(final_path);
    std::ofstream(path) << "of somebody else";
    files.remove_temporary();
    EXPECT_TRUE(std::filesystem::exists(path));
  }
  EXPECT_EQ(contents(final_path), "whole");
  EXPECT_FALSE(files.final_mesh_written());
}

TEST(TemporaryFile, NeverWritesToWhatSomebodyPutThere) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.path() + "/mesh.h5.tmp-1", victim = directory.path() + "/victim";
  std::ofstream(victim) << "precious";
  std::filesystem::create_symlink(victim, path);
  RunFiles files;
  EXPECT_THROW(TemporaryFile(path, &files), FileError);
  files.remove_temporary();
  EXPECT_TRUE(std::filesystem::is_symlink(path)) << "which is not ours to remove";
  std::filesystem::remove(path);
  std::filesystem::create_symlink(directory.path() + "/absent", path);
  EXPECT_THROW(TemporaryFile(path, nullptr), FileError);
  EXPECT_FALSE(std::filesystem::exists(directory.path() + "/absent"));
  EXPECT_EQ(contents(victim), "precious");
}

TEST(TemporaryFile, HasANameThatNobodyCanForesee) {
  const std::string first = temporary_name("mesh.h5"), second = temporary_name("mesh.h5");
  EXPECT_TRUE(first.starts_with("mesh.h5.tmp-"));
  EXPECT_NE(first, second);
}

TEST(TemporaryFile, DoesNotReplaceWhatCameMeanwhile) {
  const test::TemporaryDirectory directory;
  const std::string final_path = directory.path() + "/mesh.h5";
  {
    TemporaryFile temporary(temporary_name(final_path), nullptr);
    std::ofstream(final_path) << "of another run";
    EXPECT_THROW(temporary.rename_to(final_path, false), FileError);
  }
  EXPECT_EQ(contents(final_path), "of another run");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory.path()), {}), 1);
  std::filesystem::remove(final_path);
  TemporaryFile temporary(temporary_name(final_path), nullptr);
  temporary.rename_to(final_path, false);
  EXPECT_EQ(contents(final_path), "");
}

} // namespace
} // namespace trime::io
