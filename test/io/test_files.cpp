#include "light_field_depth/io/files.h"

#include <filesystem>
#include <string>
#include <vector>

#include <sys/stat.h>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/cloud_files.h"
#include "light_field_depth/io/image_files.h"
#include "support/limits.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::TemporaryFolder;

TEST(Files, LeavesTheOldFileWhenWritingFails)
{
  const TemporaryFolder folder;
  folder.write("a.txt", "old");
  {
    const testing::FileSizeLimit limit(1000);
    const std::string message =
        testing::messageOf<InputError>([&] { writeFile(folder / "a.txt", std::string(5000, 'x')); });
    EXPECT_NE(message.find("a.txt"), std::string::npos) << message;
    EXPECT_NE(message.find("space on the disk"), std::string::npos) << message;
  }
  EXPECT_EQ(readFile(folder / "a.txt"), "old");
  EXPECT_EQ(folder.fileCount(), 1U) << "the temporary file is gone";
  writeFile(folder / "a.txt", "new");
  EXPECT_EQ(readFile(folder / "a.txt"), "new");
}

TEST(Files, CloudsAndImagesFailLikeAnyFile)
{
  const TemporaryFolder folder;
  const testing::FileSizeLimit limit(1000);
  EXPECT_THROW(writePly(folder / "a.ply", std::vector<ColoredPoint>(200, {1, 2, 3, 4, 5, 6, 0, 1})),
               InputError);
  cv::Mat noise(64, 64, CV_8UC3);
  cv::randu(noise, 0, 255);
  EXPECT_THROW(writeImage(folder / "a.png", noise), InputError);
  EXPECT_EQ(folder.fileCount(), 0U);
}

TEST(Files, ReplacesALinkAndFollowsNone)
{
  const TemporaryFolder folder;
  folder.write("precious.txt", "precious");
  std::filesystem::create_symlink(folder / "precious.txt", folder / "link.txt");
  writeFile(folder / "link.txt", "new");
  EXPECT_EQ(readFile(folder / "precious.txt"), "precious");
  EXPECT_EQ(readFile(folder / "link.txt"), "new");
  EXPECT_THROW(writeFile("/dev/full", "x"), InputError);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(Files, ReadsNoPipeNoDeviceAndNoHalfFile)
{
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("circle", folder / "circle");
  const auto message = [](const std::filesystem::path& path)
  { return testing::messageOf<InputError>([&] { readFile(path); }); };
  EXPECT_NE(message(folder / "pipe").find("pipe or a device"), std::string::npos);
  EXPECT_NE(message("/dev/zero").find("pipe or a device"), std::string::npos);
  EXPECT_NE(message(folder.path()).find("is a folder"), std::string::npos);
  EXPECT_NE(message(folder / "circle").find("cannot be read: "), std::string::npos);
  EXPECT_NE(message(folder / std::string(300, 'n')).find("cannot be read: "), std::string::npos);
  // Its first page cannot be read: an error, and no end of the file.
  EXPECT_NE(message("/proc/self/mem").find("cannot be read: "), std::string::npos);
  EXPECT_GT(readFile("/proc/self/status").size(), 100U) << "of size 0, as it says";
}

TEST(Files, SaysWhyAFolderCannotBeMade)
{
  const TemporaryFolder folder;
  folder.write("file", "");
  makeFolder(folder / "a/b/c");
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a/b/c"));
  for (const char* const path : {"file", "file/below"})
  {
    const std::string message = testing::messageOf<InputError>([&] { makeFolder(folder / path); });
    EXPECT_NE(message.find(path), std::string::npos) << message;
  }
}

TEST(Files, OfImagesSayWhereTheyCannotBeWritten)
{
  const TemporaryFolder folder;
  const cv::Mat image(4, 4, CV_8UC1, cv::Scalar(3));
  EXPECT_THROW(writeImage(folder / "absent/a.png", image), InputError);
  EXPECT_THROW(writeImage(folder / "a.unknown", image), InputError);
  EXPECT_EQ(folder.fileCount(), 0U);
}

}  // namespace
}  // namespace light_field_depth
