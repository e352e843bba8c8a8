#include "io/jpeg_check.h"

#include <cstddef>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/files.h"
#include "light_field_depth/io/image_files.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::TemporaryFolder;

TEST(JpegCheck, FindsDamageInTheMiddle)
{
  const TemporaryFolder folder;
  cv::Mat image(200, 240, CV_8UC3);
  cv::randu(image, 0, 255);
  for (const int progressive : {0, 1})
  {
    for (const int restart_interval : {0, 8})
    {
      ASSERT_TRUE(cv::imwrite(
          (folder / "a.jpg").string(), image,
          {cv::IMWRITE_JPEG_PROGRESSIVE, progressive, cv::IMWRITE_JPEG_RST_INTERVAL, restart_interval}));
      EXPECT_EQ(readImage(folder / "a.jpg").size(), image.size());
      const std::string whole = readFile(folder / "a.jpg");
      EXPECT_FALSE(isDamagedJpeg(whole));
      for (const double place : {0.3, 0.5, 0.8})
      {
        std::string damaged = whole;
        damaged.replace(static_cast<std::size_t>(place * static_cast<double>(whole.size())), 40, 40, '\0');
        damaged.replace(static_cast<std::size_t>(place * static_cast<double>(whole.size())), 6,
                        "\xFF\xC4 ab\xFE");
        folder.write("a.jpg", damaged);
        EXPECT_NE(testing::messageOf<InputError>([&] { readImage(folder / "a.jpg"); }).find("is damaged"),
                  std::string::npos)
            << progressive << restart_interval << place;
      }
    }
  }
}

TEST(JpegCheck, LetsBytesToSparePass)
{
  const TemporaryFolder folder;
  cv::Mat image(40, 48, CV_8UC1);
  cv::randu(image, 0, 255);
  ASSERT_TRUE(cv::imwrite((folder / "a.jpg").string(), image));
  std::string bytes = readFile(folder / "a.jpg");
  bytes.insert(bytes.size() - 2, 6, '\0');  // before the end marker, as some cameras write them
  EXPECT_FALSE(isDamagedJpeg(bytes));
  EXPECT_TRUE(isDamagedJpeg("\xFF\xD8 and no more"));
}

}  // namespace
}  // namespace light_field_depth
