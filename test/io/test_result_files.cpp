// Images, clouds, intermediate results and the report.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include <sys/stat.h>

#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/cloud_files.h"
#include "light_field_depth/io/disparity_image.h"
#include "light_field_depth/io/files.h"
#include "light_field_depth/io/image_files.h"
#include "light_field_depth/io/intermediate_files.h"
#include "light_field_depth/io/pfm.h"
#include "light_field_depth/io/pipeline_options_io.h"
#include "light_field_depth/io/report.h"
#include "support/limits.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::TemporaryFolder;

constexpr float NaN = std::numeric_limits<float>::quiet_NaN();

TEST(CloudFiles, RoundTripLeavesOutWhatIsUnknown)
{
  const TemporaryFolder folder;
  const std::vector<ColoredPoint> points = {
      {1.0F, -2.0F, 3.5F, 10, 20, 30, 0}, {NaN, NaN, NaN, 1, 2, 3, 0}, {0.25F, 0.5F, 9.0F, 255, 0, 128, 0}};
  EXPECT_EQ(writePly(folder / "cloud.ply", points), 2U);
  pcl::PointCloud<pcl::PointXYZRGB> cloud;
  ASSERT_EQ(pcl::io::loadPLYFile((folder / "cloud.ply").string(), cloud), 0);
  ASSERT_EQ(cloud.size(), 2U);
  EXPECT_EQ(cloud[0].x, 1.0F);
  EXPECT_EQ(cloud[0].y, -2.0F);
  EXPECT_EQ(cloud[0].z, 3.5F);
  EXPECT_EQ(cloud[0].b, 10);
  EXPECT_EQ(cloud[0].g, 20);
  EXPECT_EQ(cloud[0].r, 30);
  EXPECT_EQ(cloud[1].b, 255);
  EXPECT_EQ(cloud[1].r, 128);
  EXPECT_EQ(folder.fileCount(), 1U);
}

TEST(CloudFiles, WritesNoFileWithoutPointsAndSaysWhereItCannotWrite)
{
  const TemporaryFolder folder;
  EXPECT_EQ(writePly(folder / "cloud.ply", {{NaN, NaN, NaN, 0, 0, 0, 0}}), 0U);
  EXPECT_EQ(folder.fileCount(), 0U);
  EXPECT_THROW(writePly(folder / "absent/cloud.ply", {{1, 1, 1, 0, 0, 0, 0}}), InputError);
}

TEST(DisparityImage, ShowsNearRedFarBlueAndUnknownGrey)
{
  cv::Mat disparity(64, 64, CV_32FC1, cv::Scalar(-1.0));
  disparity.colRange(32, 64).setTo(2.0);
  disparity.row(0).setTo(NaN);
  const DisparityRange range = shownRange(disparity);
  EXPECT_FLOAT_EQ(range.min, -1.0F);
  EXPECT_FLOAT_EQ(range.max, 2.0F);
  const cv::Mat image = disparityWithScale(disparity, range);
  EXPECT_EQ(image.type(), CV_8UC3);
  EXPECT_EQ(image.rows, 64);
  EXPECT_GT(image.cols, 64);
  const auto far = image.at<cv::Vec3b>(30, 5);
  const auto near = image.at<cv::Vec3b>(30, 60);
  EXPECT_GT(far[0], far[2]);
  EXPECT_GT(near[2], near[0] + 50);
  EXPECT_EQ(image.at<cv::Vec3b>(0, 5), cv::Vec3b(128, 128, 128));
}

TEST(DisparityImage, ManagesFlatUnknownAndTinyMaps)
{
  for (const cv::Mat& map :
       {cv::Mat(16, 16, CV_32FC1, cv::Scalar(0.5)), cv::Mat(16, 16, CV_32FC1, cv::Scalar(NaN)),
        cv::Mat(1, 1, CV_32FC1, cv::Scalar(3.0)),
        cv::Mat(20, 20, CV_32FC1, cv::Scalar(std::numeric_limits<float>::infinity()))})
  {
    const DisparityRange range = shownRange(map);
    EXPECT_LT(range.min, range.max);
    EXPECT_EQ(disparityWithScale(map, range).rows, map.rows);
  }
}

TEST(IntermediateFiles, ChoosesTheFormatByTheType)
{
  const TemporaryFolder folder;
  const auto target = folder / "intermediate";
  writeIntermediate(target, "grey", cv::Mat(4, 5, CV_8UC1, cv::Scalar(7)));
  writeIntermediate(target, "wide", cv::Mat(4, 5, CV_16UC3, cv::Scalar(700, 800, 900)));
  writeIntermediate(target, "map", cv::Mat(4, 5, CV_32FC1, cv::Scalar(0.125)));
  writeIntermediate(target, "flow", cv::Mat(4, 5, CV_32FC2, cv::Scalar(1.5, -2.5)));
  writeIntermediate(target, "labels", cv::Mat(4, 5, CV_32SC1, cv::Scalar(-3)));
  writeIntermediate(target, "empty", cv::Mat());
  EXPECT_EQ(readImage(target / "grey.png").at<std::uint8_t>(3, 4), 7);
  EXPECT_EQ(readImage(target / "wide.png").at<cv::Vec3w>(3, 4), cv::Vec3w(700, 800, 900));
  EXPECT_EQ(readPfm(target / "map.pfm").at<float>(0, 0), 0.125F);
  EXPECT_EQ(readPfm(target / "flow_0.pfm").at<float>(0, 0), 1.5F);
  EXPECT_EQ(readPfm(target / "flow_1.pfm").at<float>(0, 0), -2.5F);
  EXPECT_EQ(readPfm(target / "labels.pfm").at<float>(0, 0), -3.0F);
  EXPECT_FALSE(std::filesystem::exists(target / "empty.pfm"));
}

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
  EXPECT_THROW(writePly(folder / "a.ply", std::vector<ColoredPoint>(200, {1, 2, 3, 4, 5, 6, 0})), InputError);
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

TEST(ImageFiles, SaysWhereItCannotWrite)
{
  const TemporaryFolder folder;
  const cv::Mat image(4, 4, CV_8UC1, cv::Scalar(3));
  EXPECT_THROW(writeImage(folder / "absent/a.png", image), InputError);
  EXPECT_THROW(writeImage(folder / "a.unknown", image), InputError);
  EXPECT_EQ(folder.fileCount(), 0U);
}

TEST(Report, HasAllThatIsToBeKnown)
{
  RunReport report;
  report.options.min_confidence = 0.1F;
  report.views_used = 17;
  report.size = {512, 384};
  report.disparity_range = {-1.5F, 2.0F};
  report.threads = 2;
  report.stage_times = {{"matching", 12.5}, {"fusion", 3.25}};
  report.decode_ms = 80.0;
  report.total_ms = 16.0;
  report.write_ms = 7.0;
  report.peak_memory_mb = peakMemoryMb();
  report.input = "a \"quoted\" \xFF name";
  report.photometric_error = std::numeric_limits<double>::quiet_NaN();
  const nlohmann::json json = nlohmann::json::parse(toJson(report));
  EXPECT_EQ(json["method"], toString(PipelineOptions().method));
  EXPECT_EQ(json["views_used"], 17);
  EXPECT_EQ(json["size"]["width"], 512);
  EXPECT_EQ(json["size"]["height"], 384);
  EXPECT_EQ(json["disparity_range"][0], -1.5);
  EXPECT_EQ(json["threads"], 2);
  EXPECT_EQ(json["timings_ms"]["decode"], 80.0);
  EXPECT_EQ(json["timings_ms"]["matching"], 12.5);
  EXPECT_EQ(json["timings_ms"]["total"], 16.0);
  EXPECT_EQ(json["timings_ms"]["write"], 7.0);
  EXPECT_GT(json["peak_memory_mb"], 1.0);
  EXPECT_EQ(json["options"]["min_confidence"], 0.1);
  EXPECT_EQ(json["options"].size(), listOptions(report.options).size());
  EXPECT_TRUE(json["calibration"].is_null());
  EXPECT_TRUE(json["photometric_error"].is_null());
}

}  // namespace
}  // namespace light_field_depth
