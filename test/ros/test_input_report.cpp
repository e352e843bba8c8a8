#include "ros/input_report.h"

#include <gtest/gtest.h>
#include <boost/make_shared.hpp>

namespace light_field_depth
{
namespace
{
ViewArray array()
{
  ViewArray result;
  for (int column = 0; column < 3; ++column)
  {
    const std::string name = "cam" + std::to_string(column);
    result.views.push_back({{0, column}, name + "/image", name + "/info"});
  }
  return result;
}

ViewSynchronizerStatistics statistics(const std::vector<std::uint64_t>& received, std::uint64_t complete)
{
  ViewSynchronizerStatistics result;
  result.sets_complete = complete;
  for (const std::uint64_t count : received)
  {
    result.views.push_back({count, 0, 0, static_cast<std::int64_t>(count) * 1000000});
  }
  return result;
}

void expectParts(const std::string& text, const std::vector<std::string>& parts)
{
  for (const std::string& part : parts)
  {
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
  }
}

TEST(DiagnoseMissingInput, NamesTheTopicsThatAreSilent)
{
  const auto before = statistics({5, 5, 5}, 5);
  expectParts(diagnoseMissingInput(array(), before, statistics({9, 5, 9}, 5), {}, 5.0, 5),
              {"View (0, 1) (cam1/image)", "5 s", "leave these views out"});
  expectParts(diagnoseMissingInput(array(), before, statistics({9, 5, 5}, 5), {}, 5.0, 5),
              {"1 more: (0, 2)"});
  expectParts(diagnoseMissingInput(array(), before, before, {}, 5.0, 5),
              {"No images", "cam0/image", "2 views"});
}

TEST(DiagnoseMissingInput, TellsStampsThatDoNotMatch)
{
  expectParts(diagnoseMissingInput(array(), statistics({0, 0, 0}, 0), statistics({5, 6, 7}, 0), {}, 5.0, 5),
              {"All 3 views", "2 ms", "sync_tolerance"});
}

TEST(DiagnoseMissingInput, TellsLateImagesFromStampsThatDoNotMatch)
{
  auto now = statistics({5, 6, 7}, 0);
  now.views[1].late = 4;
  now.views[1].late_by_sets = 20;
  expectParts(diagnoseMissingInput(array(), statistics({0, 0, 0}, 0), now, {}, 5.0, 5),
              {"View (0, 1) (cam1/image)", "20 sets", "queue_size (5)"});
}

TEST(DiagnoseMissingInput, SaysThatTheReferenceIsMissing)
{
  expectParts(diagnoseMissingInput(array(), statistics({5, 5, 5}, 5), statistics({5, 9, 9}, 5), {}, 5.0, 5),
              {"View (0, 0) (cam0/image)", "reference view", "'reference'"});
}

TEST(DiagnoseMissingInput, NamesTheCameraInfoThatIsMissing)
{
  const auto info = boost::make_shared<const sensor_msgs::CameraInfo>();
  expectParts(diagnoseMissingInput(array(), statistics({0, 0, 0}, 0), statistics({5, 5, 5}, 5),
                                   {info, info, nullptr}, 5.0, 5),
              {"View (0, 2)", "cam2/info", "use_camera_info"});
}

TEST(DiagnoseMissingInput, SaysNothingWhenNothingIsWrong)
{
  EXPECT_EQ(diagnoseMissingInput(array(), statistics({0, 0, 0}, 0), statistics({5, 5, 5}, 5), {}, 5.0, 5),
            "");
}

}  // namespace
}  // namespace light_field_depth
