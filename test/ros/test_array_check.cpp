#include "light_field_depth/ros/array_check.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>

#include "light_field_depth/ros/view_messages.h"
#include "support/program.h"
#include "support/synthetic_scene.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using Severity = ArrayFinding::Severity;

constexpr int FRAMES = 4;
constexpr double PERIOD_S = 0.1;

testing::SyntheticLightField scene(std::vector<GridPosition> positions)
{
  testing::SceneSettings settings;
  settings.size = {160, 120};
  settings.positions = std::move(positions);
  settings.calibration = Calibration{160.0, {79.5, 59.5}, 0.1, 5.0};
  return testing::renderScene(testing::standardScene(settings.size), settings);
}

/// The messages of an array, to be spoiled before they are checked.
class CheckedArray
{
public:
  explicit CheckedArray(std::vector<GridPosition> positions) : scene_(scene(std::move(positions)))
  {
    std_msgs::Header header;
    header.frame_id = "optical";
    messages_ = viewMessages(scene_.light_field, *scene_.light_field.calibration, header);
    for (std::size_t i = 0; i < messages_.size(); ++i)
    {
      array_.views.push_back(
          {scene_.light_field.views[i].grid, messages_[i].image_topic, messages_[i].camera_info_topic});
      delays_s_.push_back(0.0);
    }
    array_.reference = scene_.light_field.reference_index;
  }

  ViewMessages& view(std::size_t index) { return messages_[index]; }
  double& delay(std::size_t index) { return delays_s_[index]; }

  std::vector<ArrayFinding> judge(const std::function<bool(std::size_t)>& is_there = {})
  {
    ArrayCheck check(array_, {});
    for (int frame = 0; frame < FRAMES; ++frame)
    {
      for (std::size_t i = 0; i < messages_.size(); ++i)
      {
        if (!is_there || is_there(i))
        {
          messages_[i].image->header.stamp = ros::Time(100.0 + PERIOD_S * frame + delays_s_[i]);
          check.add(i, sensor_msgs::ImageConstPtr(new sensor_msgs::Image(*messages_[i].image)));
          check.add(i, messages_[i].camera_info);
        }
      }
    }
    tolerance_s_ = check.neededToleranceS();
    Pipeline pipeline(2);
    return check.judge(pipeline);
  }

  double tolerance() const { return tolerance_s_; }
  const ViewArray& array() const { return array_; }

private:
  testing::SyntheticLightField scene_;
  std::vector<ViewMessages> messages_;
  std::vector<double> delays_s_;
  ViewArray array_;
  double tolerance_s_ = 0.0;
};

/// How many findings of a severity have the words.
std::size_t count(const std::vector<ArrayFinding>& findings, Severity severity, const std::string& words = "")
{
  return static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(),
                                                [&](const ArrayFinding& finding) {
                                                  return finding.severity == severity &&
                                                         finding.sentence.find(words) != std::string::npos;
                                                }));
}

std::string textOf(const std::vector<ArrayFinding>& findings)
{
  std::string text;
  for (const ArrayFinding& finding : findings)
  {
    text += std::to_string(static_cast<int>(finding.severity)) + " " + finding.sentence + "\n";
  }
  return text;
}

TEST(ArrayCheck, AGoodArrayHasNeitherErrorsNorWarnings)
{
  CheckedArray array(testing::gridPositions(3, 3));
  const auto findings = array.judge();
  EXPECT_EQ(count(findings, Severity::Error), 0U) << textOf(findings);
  EXPECT_EQ(count(findings, Severity::Warning), 0U) << textOf(findings);
  EXPECT_EQ(count(findings, Severity::Fine, "4 whole sets; their stamps are up to 0.000 ms apart"), 1U);
  EXPECT_EQ(count(findings, Severity::Fine, "9 of 9 views publish, at 10.00 to 10.00 Hz"), 1U)
      << textOf(findings);
  EXPECT_EQ(array.tolerance(), 0.0);
}

TEST(ArrayCheck, NamesAMissingViewByItsTopics)
{
  CheckedArray array(testing::gridPositions(1, 3));
  const auto findings = array.judge([](std::size_t view) { return view != 2; });
  EXPECT_EQ(count(findings, Severity::Error, "(view_0_2/image_rect_color): no image"), 1U)
      << textOf(findings);
  EXPECT_EQ(count(findings, Severity::Error, "no CameraInfo has come on 'view_0_2/camera_info'"), 1U);
}

TEST(ArrayCheck, SaysWhichToleranceStampsNeed)
{
  CheckedArray array(testing::gridPositions(1, 3));
  array.delay(0) = 0.004;
  const auto findings = array.judge();
  EXPECT_EQ(count(findings, Severity::Error, "set sync_tolerance to 0.0060"), 1U) << textOf(findings);
  EXPECT_NEAR(array.tolerance(), 0.006, 1e-6);
  EXPECT_EQ(count(findings, Severity::Fine, "Disparities go from"), 1U)
      << "the images are judged nevertheless";
  array.delay(0) = 0.05;
  EXPECT_EQ(count(array.judge(), Severity::Error, "trigger the cameras together"), 1U);
}

TEST(ArrayCheck, FindsViewsThatAreSwappedDarkOrOutOfPlace)
{
  CheckedArray swapped(testing::gridPositions(3, 3));
  for (std::size_t row = 0; row < 3; ++row)
  {
    std::swap(swapped.view(3 * row).image, swapped.view(3 * row + 2).image);
  }
  EXPECT_GE(count(swapped.judge(), Severity::Error), 1U) << "columns run from right to left";

  CheckedArray dark(testing::gridPositions(3, 3));
  sensor_msgs::Image& image = *dark.view(4 + 1).image;
  std::transform(image.data.begin(), image.data.end(), image.data.begin(),
                 [](std::uint8_t value) { return static_cast<std::uint8_t>(value / 2); });
  const auto of_dark = dark.judge();
  EXPECT_EQ(
      count(of_dark, Severity::Warning, "(view_1_2/image_rect_color): its images have to be multiplied by"),
      1U)
      << textOf(of_dark);

  CheckedArray low(testing::gridPositions(3, 3));
  const cv::Mat before = cv_bridge::toCvCopy(*low.view(5).image)->image;
  cv::Mat after = before.clone();
  before.rowRange(0, before.rows - 2).copyTo(after.rowRange(2, before.rows));
  low.view(5).image = cv_bridge::CvImage(low.view(5).image->header, "bgr8", after).toImageMsg();
  const auto of_low = low.judge();
  EXPECT_GE(count(of_low, Severity::Warning, "view_1_2") + count(of_low, Severity::Error, "view_1_2") +
                count(of_low, Severity::Error, "(1, 2)") + count(of_low, Severity::Warning, "(1, 2)"),
            1U)
      << textOf(of_low);
}

TEST(ArrayCheck, SaysWhatCannotBeCalibrated)
{
  CheckedArray array(testing::gridPositions(1, 3));
  array.view(2).camera_info->P[0] *= 1.5;
  const auto findings = array.judge();
  EXPECT_EQ(count(findings, Severity::Error), 1U) << textOf(findings);
}

/// check_array on a bag of the array; the bag's folder is for what it writes.
testing::Outcome runOnBag(CheckedArray& array, const testing::TemporaryFolder& folder)
{
  const std::string bag_file = (folder / "array.bag").string();
  {
    rosbag::Bag bag(bag_file, rosbag::bagmode::Write);
    for (int frame = 0; frame < FRAMES; ++frame)
    {
      for (std::size_t i = 0; i < array.array().views.size(); ++i)
      {
        const ros::Time stamp(100.0 + PERIOD_S * frame);
        array.view(i).image->header.stamp = stamp + ros::Duration(array.delay(i));
        bag.write("/" + array.view(i).image_topic, stamp, *array.view(i).image);
        bag.write("/" + array.view(i).camera_info_topic, stamp, *array.view(i).camera_info);
      }
    }
  }
  folder.write("array.yaml", "array: {rows: 1, columns: 3}\n");
  return testing::runProgram(std::string(CHECK_ARRAY_PROGRAM) + " --array-file " +
                             testing::quoted((folder / "array.yaml").string()) + " --bag " +
                             testing::quoted(bag_file) + " --write " +
                             testing::quoted((folder / "checked.yaml").string()));
}

TEST(ArrayCheck, TheProgramGivesAVerdictAnExitCodeAndAFile)
{
  CheckedArray array(testing::gridPositions(1, 3));
  const testing::TemporaryFolder folder;
  const testing::Outcome good = runOnBag(array, folder);
  EXPECT_EQ(good.exit_code, 0) << good.output << good.errors;
  EXPECT_NE(good.output.find("This array works."), std::string::npos) << good.output;
  array.delay(2) = 0.002;
  const testing::Outcome apart = runOnBag(array, folder);
  EXPECT_EQ(apart.exit_code, 3) << apart.output << apart.errors;
  EXPECT_NE(apart.output.find("This array does not work yet"), std::string::npos) << apart.output;
  const testing::Outcome mended =
      testing::runProgram(std::string(CHECK_ARRAY_PROGRAM) + " --array-file " +
                          testing::quoted((folder / "checked.yaml").string()) + " --bag " +
                          testing::quoted((folder / "array.bag").string()));
  EXPECT_EQ(mended.exit_code, 0) << "with the sync_tolerance that it wrote: " << mended.output
                                 << mended.errors;
}

}  // namespace
}  // namespace light_field_depth
