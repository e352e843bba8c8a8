#include "light_field_depth/core/input_limits.h"

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "light_field_depth/core/error.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::messageOf;

std::string encoded(const std::string& extension, const cv::Mat& image)
{
  std::vector<std::uint8_t> bytes;
  EXPECT_TRUE(cv::imencode(extension, image, bytes)) << extension;
  return std::string(bytes.begin(), bytes.end());
}

TEST(InputLimits, TheSizeOfAnImageIsKnownBeforeItIsDecoded)
{
  for (const char* const extension : {".png", ".jpg", ".bmp", ".pgm", ".ppm"})
  {
    for (const cv::Size& size : {cv::Size(301, 17), cv::Size(1, 1), cv::Size(5, 700)})
    {
      const int type = std::string(extension) == ".pgm" ? CV_8UC1 : CV_8UC3;
      const std::string bytes = encoded(extension, cv::Mat(size, type, cv::Scalar::all(7)));
      EXPECT_EQ(encodedSize(bytes), size) << extension;
    }
  }
  EXPECT_EQ(encodedSize("P2 # width\n# and height\n 12\t34\n255\n"), cv::Size(12, 34));
}

TEST(InputLimits, BytesThatDoNotSayHaveNoSize)
{
  for (const char* const extension : {".png", ".jpg", ".bmp", ".ppm"})
  {
    const std::string bytes = encoded(extension, cv::Mat(20, 30, CV_8UC3, cv::Scalar::all(7)));
    for (std::size_t length = 0; length < 30 && length < bytes.size(); ++length)
    {
      const auto size = encodedSize(bytes.substr(0, length));
      // A text may end within a number.
      EXPECT_TRUE(!size || std::string(extension) == ".ppm" || *size == cv::Size(30, 20))
          << extension << " " << length;
    }
  }
  EXPECT_FALSE(encodedSize("RIFF....WEBP"));
  EXPECT_FALSE(encodedSize("P5 x"));
  EXPECT_FALSE(encodedSize(std::string("\xFF\xD8\xFF\xDA\x00\x02\x00\x00\x00\x00\x00\x00", 12)));
  EXPECT_FALSE(encodedSize("P6 99999999999999999999 1\n")) << "beyond any image";
}

TEST(InputLimits, WhatFitsIsTakenAndOfTheRestIsSaidWhatWould)
{
  EXPECT_NO_THROW(requireViews(289, 289, ""));
  EXPECT_EQ(messageOf<InputError>([] { requireViews(290, 289, "Raise it."); }),
            "290 views are too many: 289 would fit. Raise it.");

  EXPECT_NO_THROW(requirePixels({2000, 500}, 1.0, "It", ""));
  EXPECT_EQ(messageOf<InputError>(
                [] {
                  requirePixels({4000, 1000}, 1.0, "It", "Reduce it.");
                }),
            "It has 4000 x 1000 pixels, which are too many: 2000 x 500 would fit. Reduce it.");
  EXPECT_NO_THROW(requirePixels({2000, 500}, 1.0, "It", "")) << "as the sentence said";
  EXPECT_THROW(requirePixels({2147483647, 2147483647}, 400.0, "It", ""), InputError) << "no overflow";

  EXPECT_NO_THROW(requireMessageSize(2'000'000, 2.0, "It", ""));
  EXPECT_EQ(messageOf<InputError>([] { requireMessageSize(2'000'001, 2.0, "It", "Raise it."); }),
            "It has 3 MB, which are too many: 2 MB would fit. Raise it.");
}

}  // namespace
}  // namespace light_field_depth
