#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/files.h"
#include "light_field_depth/io/pfm.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::TemporaryFolder;

std::string readingError(const std::filesystem::path& path)
{
  return testing::messageOf<InputError>([&] { readPfm(path); });
}

TEST(Pfm, RoundTripKeepsEveryBit)
{
  const TemporaryFolder folder;
  cv::Mat values = (cv::Mat_<float>(2, 3) << 1.5F, -2.25F, 3e-30F, std::nanf(""), 0.0F,
                    std::numeric_limits<float>::infinity());
  writePfm(folder / "a.pfm", values);
  const cv::Mat read = readPfm(folder / "a.pfm");
  ASSERT_EQ(read.size(), values.size());
  ASSERT_EQ(read.type(), CV_32FC1);
  for (int y = 0; y < 2; ++y)
  {
    for (int x = 0; x < 3; ++x)
    {
      const float expected = values.at<float>(y, x);
      const float found = read.at<float>(y, x);
      EXPECT_TRUE(expected == found || (std::isnan(expected) && std::isnan(found))) << y << " " << x;
    }
  }
  EXPECT_EQ(folder.fileCount(), 1U) << "no temporary file stays behind";
}

TEST(Pfm, WritesAPartOfAMatrixThatIsNotContinuous)
{
  const TemporaryFolder folder;
  const cv::Mat whole = (cv::Mat_<float>(3, 3) << 1, 2, 3, 4, 5, 6, 7, 8, 9);
  writePfm(folder / "a.pfm", whole(cv::Rect(1, 1, 2, 2)));
  const cv::Mat expected = (cv::Mat_<float>(2, 2) << 5, 6, 8, 9);
  EXPECT_EQ(cv::norm(readPfm(folder / "a.pfm"), expected, cv::NORM_INF), 0.0);
}

TEST(Pfm, ReadsBothByteOrdersWithTheLastRowFirst)
{
  const TemporaryFolder folder;
  const std::string one_little("\x00\x00\x80\x3f", 4);
  const std::string two_little("\x00\x00\x00\x40", 4);
  const std::string one_big("\x3f\x80\x00\x00", 4);
  const std::string two_big("\x40\x00\x00\x00", 4);
  folder.write("little.pfm", "Pf\n1 2\n-1.0\n" + one_little + two_little);
  folder.write("big.pfm", "Pf 1 2 1\n" + one_big + two_big);
  for (const char* const name : {"little.pfm", "big.pfm"})
  {
    const cv::Mat values = readPfm(folder / name);
    ASSERT_EQ(values.size(), cv::Size(1, 2)) << name;
    EXPECT_EQ(values.at<float>(0, 0), 2.0F) << name;
    EXPECT_EQ(values.at<float>(1, 0), 1.0F) << name;
  }
}

TEST(Pfm, RefusesFilesThatLieAboutTheirSize)
{
  const TemporaryFolder folder;
  const std::string value(4, '\0');
  EXPECT_NE(readingError(folder.write("short.pfm", "Pf\n2 2\n-1\n" + value + value)).find("damaged"),
            std::string::npos);
  EXPECT_NE(readingError(folder.write("long.pfm", "Pf\n1 1\n-1\n" + value + value)).find("damaged"),
            std::string::npos);
  for (const char* const size : {"0 5", "-3 4", "4 -3", "99999999 99999999", "9223372036854775807 2",
                                 "99999999999999999999999 1", "65537 1", "4294967297 4294967297"})
  {
    const auto path = folder.write("size.pfm", "Pf\n" + std::string(size) + "\n-1\n" + value);
    EXPECT_NE(readingError(path), "") << size;
    EXPECT_NE(readingError(path).find("size.pfm"), std::string::npos) << size;
  }
  EXPECT_NE(readingError(folder.write("huge.pfm", "Pf\n65536 65536\n-1\n" + value)).find("damaged"),
            std::string::npos);
}

TEST(Pfm, RefusesOtherFilesAndBrokenHeaders)
{
  const TemporaryFolder folder;
  EXPECT_NE(readingError(folder.write("color.pfm", "PF\n1 1\n-1\n" + std::string(12, '\0'))).find("three"),
            std::string::npos);
  for (const char* const content :
       {"", "P", "Pf", "Pf\n", "Pf 4", "Pf 4 4", "Pf 4 4 -1", "Pf\nx y\n-1\n0000", "Pf\n1 1\n0\n0000",
        "Pf\n1 1\nnan\n0000", "Pf\n1 1\nscale\n0000", "\x89PNG\r\n", "Pf\n1.5 1\n-1\n0000"})
  {
    EXPECT_NE(readingError(folder.write("broken.pfm", content)), "") << content;
  }
  EXPECT_NE(readingError(folder / "absent.pfm").find("absent.pfm"), std::string::npos);
  EXPECT_NE(readingError(folder.path()).find("folder"), std::string::npos);
}

/// Headers with random damage either read as what they say or are refused, whatever the damage is.
TEST(Pfm, SurvivesRandomDamage)
{
  const TemporaryFolder folder;
  const std::string intact = "Pf\n3 2\n-1.0\n" + std::string(24, '\x11');
  std::mt19937 random(7);
  int refused = 0;
  for (int trial = 0; trial < 400; ++trial)
  {
    std::string content = intact;
    for (std::size_t damage = 0; damage < 1 + random() % 3; ++damage)
    {
      content[random() % 14] = static_cast<char>(random() % 256);
    }
    content.resize(random() % 4 == 0 ? random() % content.size() : content.size());
    const auto path = folder.write("damaged.pfm", content);
    try
    {
      const cv::Mat values = readPfm(path);
      EXPECT_LE(values.total() * 4, content.size());
    }
    catch (const InputError&)
    {
      ++refused;
    }
  }
  EXPECT_GT(refused, 200);
}

TEST(Pfm, ComplainsWhereItCannotWrite)
{
  const TemporaryFolder folder;
  const cv::Mat values = cv::Mat::zeros(2, 2, CV_32FC1);
  const std::string message =
      testing::messageOf<InputError>([&] { writePfm(folder / "absent/a.pfm", values); });
  EXPECT_NE(message.find("absent/a.pfm"), std::string::npos) << message;
}

}  // namespace
}  // namespace light_field_depth
