// Images as cameras, scanners and renderers write them.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include <opencv2/imgcodecs.hpp>

#include "dataset_files.h"
#include "light_field_depth/io/dataset.h"
#include "light_field_depth/io/files.h"
#include "light_field_depth/io/image_files.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::readingError;
using testing::says;
using testing::TemporaryFolder;

const cv::Scalar ORANGE(50, 100, 200);

std::string bytesOf(const std::string& hexadecimal)
{
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hexadecimal.size(); i += 2)
  {
    bytes += static_cast<char>(std::stoi(hexadecimal.substr(i, 2), nullptr, 16));
  }
  return bytes;
}

/// 16 x 16 pixels of the second of two colours of a palette.
const char* const PALETTE_PNG =
    "89504e470d0a1a0a0000000d4948445200000010000000100803000000282d0f5300000006504c54450a141ec8643277a0b39c"
    "0000000f4944415478da636044030c235b000089100101c5cda66b0000000049454e44ae426082";
/// 16 x 16 pixels of one colour in the four channels of a printer, as image editors write them.
const char* const CMYK_JPEG =
    "ffd8ffee000e41646f626500640000000000ffdb0043000302020302020303030304030304050805050404050a070706080c0a"
    "0c0c0b0a0b0b0d0e12100d0e110e0b0b1016101113141515150c0f171816141812141514ffc000140800100010044311004d11"
    "005911004b1100ffc40017000101010100000000000000000000000000080709ffc40014100100000000000000000000000000"
    "000000ffda000e0443004d0059004b00003f00b019a22f754c000001ffd9";

TEST(ImageFiles, ReadsEveryFormat)
{
  const TemporaryFolder folder;
  for (const char* const name : {"a.png", "a.PNG", "a.jpg", "a.JPEG", "a.tif", "a.bmp", "a.ppm", "a.webp"})
  {
    ASSERT_TRUE(isImageFile(name)) << name;
    ASSERT_TRUE(cv::imwrite((folder / name).string(), cv::Mat(20, 24, CV_8UC3, ORANGE))) << name;
    const cv::Mat image = readImage(folder / name);
    ASSERT_EQ(image.type(), CV_8UC3) << name;
    EXPECT_LE(cv::norm(image, cv::Mat(20, 24, CV_8UC3, ORANGE), cv::NORM_INF), 4.0) << name;
  }
  ASSERT_TRUE(cv::imwrite((folder / "a.pgm").string(), cv::Mat(20, 24, CV_16UC1, cv::Scalar(40000))));
  EXPECT_EQ(readImage(folder / "a.pgm").at<std::uint16_t>(3, 4), 40000);
}

TEST(ImageFiles, PalettesAndPrintersColoursBecomeBgr)
{
  const TemporaryFolder folder;
  for (const auto& [name, bytes] :
       {std::make_pair("palette.png", PALETTE_PNG), std::make_pair("printer.jpg", CMYK_JPEG)})
  {
    folder.write(name, bytesOf(bytes));
    const cv::Mat image = readImage(folder / name);
    ASSERT_EQ(image.type(), CV_8UC3) << name;
    EXPECT_LE(cv::norm(image, cv::Mat(16, 16, CV_8UC3, ORANGE), cv::NORM_INF), 4.0) << name;
  }
}

TEST(ImageFiles, AnOrientationTagTurnsTheImageUpright)
{
  const TemporaryFolder folder;
  cv::Mat image(16, 32, CV_8UC1, cv::Scalar(20));
  image.colRange(0, 8).setTo(220);
  ASSERT_TRUE(cv::imwrite((folder / "a.jpg").string(), image));
  std::string bytes = readFile(folder / "a.jpg");
  // APP1: Exif, big endian, one entry: tag 0x0112 (orientation), type short, 1 value: 6, a quarter turn
  // clockwise.
  bytes.insert(2, bytesOf("ffe100224578696600004d4d002a00000008000101120003000000010006000000000000"));
  folder.write("a.jpg", bytes);
  const cv::Mat upright = readImage(folder / "a.jpg");
  ASSERT_EQ(upright.size(), cv::Size(16, 32));
  EXPECT_GT(upright.at<std::uint8_t>(2, 8), 200) << "the left side is on top";
  EXPECT_LT(upright.at<std::uint8_t>(28, 8), 40);
}

TEST(ImageFiles, LinearFloatsHaveOneWhiteInAllViews)
{
  const TemporaryFolder folder;
  constexpr float NaN = std::numeric_limits<float>::quiet_NaN();
  for (const int column : {0, 1, 2})
  {
    cv::Mat image(20, 24, CV_32FC3, cv::Scalar::all(column == 0 ? 4.0 : 1.0));
    image.at<cv::Vec3f>(3, 3) = {NaN, -1.0F, 100.0F};
    if (!cv::imwrite((folder / ("00_0" + std::to_string(column) + ".exr")).string(), image))
    {
      GTEST_SKIP() << "this OpenCV has no OpenEXR";
    }
  }
  const LightField light_field = readDataset(folder.path()).light_field;
  ASSERT_EQ(light_field.reference().image.type(), CV_16UC3);
  EXPECT_EQ(light_field.views[0].image.at<cv::Vec3w>(9, 9), cv::Vec3w(65535, 65535, 65535));
  EXPECT_EQ(light_field.views[0].image.at<cv::Vec3w>(3, 3), cv::Vec3w(0, 0, 65535));
  // The curve of sRGB at a quarter: 1.055 * 0.25^(1 / 2.4) - 0.055.
  EXPECT_NEAR(light_field.views[2].image.at<cv::Vec3w>(9, 9)[1], 65535.0 * 0.5371, 10.0);
}

TEST(ImageFiles, OneGreyViewAmongColouredOnesBecomesColour)
{
  const TemporaryFolder folder;
  testing::writeView(folder, "00_00.png", 70);
  testing::writeView(folder, "00_01.png", 90, CV_8UC3);
  testing::writeView(folder, "00_02.png", 90, CV_8UC3);
  const Dataset dataset = readDataset(folder.path());
  EXPECT_EQ(dataset.light_field.views[0].image.at<cv::Vec3b>(4, 4), cv::Vec3b(70, 70, 70));
  ASSERT_EQ(dataset.notes.size(), 1U);
  EXPECT_TRUE(says(dataset.notes.front(), {"1 grey"}));
}

TEST(ImageFiles, RefusesDevicesInTheViewsPlace)
{
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/zero", folder / "00_00.png");
  EXPECT_TRUE(says(testing::messageOf<InputError>([&] { readImage(folder / "00_00.png"); }),
                   {"00_00.png", "device"}));
}

TEST(ImageFiles, TheAlphaOfAPngIsTheMaskOfAView)
{
  const TemporaryFolder folder;
  cv::Mat image(20, 24, CV_8UC4, cv::Scalar(50, 100, 200, 255));
  image.colRange(0, 3).setTo(cv::Scalar(0, 0, 0, 0));
  ASSERT_TRUE(cv::imwrite((folder / "view_00_00.png").string(), image));
  ASSERT_TRUE(cv::imwrite((folder / "view_00_01.png").string(), cv::Mat(20, 24, CV_8UC3, ORANGE)));
  const LightField light_field = readDataset(folder.path()).light_field;
  ASSERT_EQ(light_field.views.size(), 2U);
  EXPECT_EQ(cv::countNonZero(light_field.views[0].mask), 21 * 20);
  EXPECT_TRUE(light_field.views[1].mask.empty());
}

TEST(ImageFiles, BlackBordersAreMaskedOnRequest)
{
  const TemporaryFolder folder;
  cv::Mat image(20, 24, CV_8UC3, ORANGE);
  image.colRange(0, 3).setTo(cv::Scalar(0, 0, 0));
  ASSERT_TRUE(cv::imwrite((folder / "view_00_00.png").string(), image));
  ASSERT_TRUE(cv::imwrite((folder / "view_00_01.png").string(), image));
  DatasetOptions options;
  EXPECT_TRUE(readDataset(folder.path(), options).light_field.views[1].mask.empty());
  options.mask_black = true;
  EXPECT_EQ(cv::countNonZero(readDataset(folder.path(), options).light_field.views[1].mask), 20 * 20);
}

}  // namespace
}  // namespace light_field_depth
