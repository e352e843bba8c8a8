// The program dataset_to_bag: a whole bag or the old one, and topics and numbers that make sense.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CompressedImage.h>
#include <opencv2/imgcodecs.hpp>

#include "support/program.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::Outcome;
using testing::quoted;

class DatasetToBag : public ::testing::Test
{
protected:
  DatasetToBag()
  {
    cv::Mat image(64, 64, CV_8UC3);
    for (const char* const name : {"view_0_0.png", "view_0_1.png", "view_1_0.png", "view_1_1.png"})
    {
      cv::randu(image, 0, 255);
      std::filesystem::create_directories(folder_ / "scene");
      cv::imwrite((folder_ / "scene" / name).string(), image);
    }
    folder_.write("out/views.bag", "old");
  }

  std::string command(const std::string& more) const
  {
    return quoted(DATASET_TO_BAG_PROGRAM) + " --input " + quoted((folder_ / "scene").string()) +
           " --output " + quoted((folder_ / "out/views.bag").string()) + " " + more;
  }

  void expectOldBag() const
  {
    EXPECT_EQ(std::filesystem::file_size(folder_ / "out/views.bag"), 3U);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "out"), {}), 1);
  }

  void expectSentence(const std::string& command, const std::string& part) const
  {
    const Outcome outcome = testing::runProgram(command);
    EXPECT_EQ(outcome.exit_code, 1) << command;
    EXPECT_NE(outcome.errors.find(part), std::string::npos) << outcome.errors;
    expectOldBag();
  }

  testing::TemporaryFolder folder_;
};

TEST_F(DatasetToBag, ReplacesTheOldBagByAWholeOne)
{
  const Outcome outcome = testing::runProgram(command("--count 3"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  rosbag::Bag bag((folder_ / "out/views.bag").string());
  EXPECT_EQ(rosbag::View(bag).size(), 3U * 4U * 2U);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "out"), {}), 1);
}

TEST_F(DatasetToBag, WritesImagesAsTheCompressedTransportHasThem)
{
  const Outcome outcome = testing::runProgram(command("--jpeg 90"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  rosbag::Bag bag((folder_ / "out/views.bag").string());
  rosbag::View view(bag, rosbag::TopicQuery("view_0_1/image_rect_color/compressed"));
  ASSERT_GT(view.size(), 0U);
  const auto image = view.begin()->instantiate<sensor_msgs::CompressedImage>();
  ASSERT_NE(image, nullptr);
  EXPECT_NE(image->format.find("; jpeg compressed "), std::string::npos) << image->format;
  EXPECT_FALSE(cv::imdecode(image->data, cv::IMREAD_UNCHANGED).empty());
}

TEST_F(DatasetToBag, AFullDiskLeavesTheOldBag)
{
  // 200 kB of blocks of 512 bytes for 5 MB.
  expectSentence("ulimit -f 400; " + command("--count 100"), "space on the disk");
}

TEST_F(DatasetToBag, ASignalLeavesTheOldBag)
{
  // It would take 5 GB; the hidden file tells that it has begun.
  const Outcome outcome = testing::runProgram("(" + command("--count 100000") + " & program=$!; cd " +
                                              quoted((folder_ / "out").string()) +
                                              "; until ls -d .light_field_depth.partial-* || ! kill -0 "
                                              "$program; do :; done >&2 2>/dev/null; kill -TERM "
                                              "$program; wait $program)");
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_NE(outcome.errors.find("interrupted"), std::string::npos) << outcome.errors;
  expectOldBag();
}

TEST_F(DatasetToBag, RefusesNumbersAndTopicsThatMakeNoSense)
{
  expectSentence(command("--baseline nan --focal-length 100"), "not a finite number");
  expectSentence(command("--baseline 0.1 --focal-length inf"), "not a finite number");
  expectSentence(command("--rate nan"), "not a finite number");
  expectSentence(command("--image-topic camera/image"), "put {row} and {column} into it");
  expectSentence(command("--camera-info-topic 'view_{row}/camera_info'"), "(0, 0) and (0, 1)");
}

}  // namespace
}  // namespace light_field_depth
