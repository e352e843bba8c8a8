// Results in the formats that other programs read.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <opencv2/imgcodecs.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/files.h"
#include "light_field_depth/io/image_files.h"
#include "light_field_depth/io/map_files.h"
#include "light_field_depth/io/pfm.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::TemporaryFolder;

constexpr float NaN = std::numeric_limits<float>::quiet_NaN();

cv::Mat someMap()
{
  cv::Mat map(17, 20, CV_32FC1, cv::Scalar(1.25));
  map.at<float>(0, 1) = -2.5F;
  map.at<float>(0, 2) = NaN;
  map.at<float>(16, 19) = 3.0F;
  return map;
}

TEST(MapFiles, PfmAndExrKeepEveryValue)
{
  const TemporaryFolder folder;
  const cv::Mat map = someMap();
  EXPECT_EQ(writeMap(folder / "disparity", map, MapFormat::Pfm, {}), "disparity.pfm");
  EXPECT_EQ(readPfm(folder / "disparity.pfm").at<float>(0, 1), -2.5F);
  EXPECT_EQ(writeMap(folder / "disparity", map, MapFormat::Exr, {}), "disparity.exr");
  const cv::Mat read = readImage(folder / "disparity.exr");
  ASSERT_EQ(read.depth(), CV_32F);
  EXPECT_EQ(read.reshape(1).at<float>(16, 19 * read.channels()), 3.0F);
  EXPECT_TRUE(std::isnan(read.reshape(1).at<float>(0, 2 * read.channels())));
}

TEST(MapFiles, NpyIsWhatNumpyExpects)
{
  const TemporaryFolder folder;
  EXPECT_EQ(writeMap(folder / "depth", someMap(), MapFormat::Npy, {}), "depth.npy");
  const std::string bytes = readFile(folder / "depth.npy");
  EXPECT_EQ(bytes.substr(0, 6), "\x93NUMPY");
  const std::size_t header =
      10 + static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
  EXPECT_EQ(header % 64, 0U);
  EXPECT_EQ(bytes[header - 1], '\n');
  EXPECT_NE(bytes.find("'shape': (17, 20)"), std::string::npos);
  ASSERT_EQ(bytes.size(), header + 17 * 20 * 4);
  EXPECT_EQ(bytes.substr(header, 8), std::string("\x00\x00\xA0\x3F\x00\x00\x20\xC0", 8)) << "1.25 and -2.5";
}

TEST(MapFiles, Png16HasItsScaleAndZeroWhereUnknown)
{
  const TemporaryFolder folder;
  const cv::Mat map = someMap();
  const Png16Scale scale = disparityPng16Scale(map);
  EXPECT_EQ(scale.scale, 256.0);
  EXPECT_EQ(scale.offset, -4.0);
  EXPECT_EQ(writeMap(folder / "disparity", map, MapFormat::Png16, scale), "disparity_16.png");
  const cv::Mat levels = readImage(folder / "disparity_16.png");
  ASSERT_EQ(levels.type(), CV_16UC1);
  EXPECT_EQ(levels.at<std::uint16_t>(5, 5) / scale.scale + scale.offset, 1.25);
  EXPECT_EQ(levels.at<std::uint16_t>(0, 1) / scale.scale + scale.offset, -2.5);
  EXPECT_EQ(levels.at<std::uint16_t>(0, 2), 0);
  EXPECT_EQ(disparityPng16Scale(cv::Mat(4, 4, CV_32FC1, cv::Scalar(700.0))).scale, 64.0);
  EXPECT_EQ(disparityPng16Scale(cv::Mat(4, 4, CV_32FC1, cv::Scalar(NaN))).offset, 0.0);
}

TEST(MapFiles, KnowsItsFormatsByName)
{
  EXPECT_EQ(mapFormatsFromString("npy,pfm,npy"), (std::vector<MapFormat>{MapFormat::Npy, MapFormat::Pfm}));
  EXPECT_THROW(mapFormatsFromString("pfm,jpg"), InputError);
  EXPECT_THROW(mapFormatsFromString(""), InputError);
}

}  // namespace
}  // namespace light_field_depth
