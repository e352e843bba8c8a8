// check_array on the topics of a running array.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "array_fixture.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace light_field_depth::testing
{
namespace
{
constexpr std::size_t COLUMNS = 3;
constexpr std::chrono::milliseconds PERIOD(40);

class CheckArrayTest : public ArrayFixture
{
protected:
  /// check_array beside an array of 3 x 3 cameras that publishes those views.
  Outcome check(ArrayPublisher& array, const std::function<bool(std::size_t)>& is_there)
  {
    std::atomic<bool> stop{false};
    std::thread cameras(
        [&]
        {
          while (!stop)
          {
            const ros::Time stamp = nextStamp();
            array.publishInfos(stamp, is_there);
            array.publishImages(stamp, is_there);
            std::this_thread::sleep_for(PERIOD);
          }
        });
    const TemporaryFolder folder;
    folder.write("array.yaml", "array: {rows: 3, columns: 3}\n");
    Outcome outcome =
        runProgram("ROS_NAMESPACE=" + quoted(array_space_->getNamespace()) + " " + CHECK_ARRAY_PROGRAM +
                   " --seconds 2 --threads 1 --array-file " + quoted((folder / "array.yaml").string()));
    stop = true;
    cameras.join();
    return outcome;
  }
};

bool all(std::size_t)
{
  return true;
}

TEST_F(CheckArrayTest, PassesAGoodArray)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(3, COLUMNS), {160, 120});
  ArrayPublisher array(*array_space_, scene.light_field);
  const Outcome outcome = check(array, all);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output << outcome.errors;
  EXPECT_NE(outcome.output.find("This array works."), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("9 of 9 views publish"), std::string::npos) << outcome.output;
}

TEST_F(CheckArrayTest, RefusesSwappedRows)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(3, COLUMNS), {160, 120});
  ArrayPublisher array(*array_space_, scene.light_field);
  for (std::size_t column = 0; column < COLUMNS; ++column)
  {
    std::swap(array.image(column), array.image(2 * COLUMNS + column));
  }
  const Outcome outcome = check(array, all);
  EXPECT_NE(outcome.exit_code, 0) << outcome.output << outcome.errors;
  EXPECT_NE(outcome.output.find("ERROR    The images fit a grid whose rows"), std::string::npos)
      << outcome.output;
  EXPECT_NE(outcome.output.find("This array does not work yet"), std::string::npos) << outcome.output;
}

TEST_F(CheckArrayTest, NamesAMissingView)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(3, COLUMNS), {160, 120});
  ArrayPublisher array(*array_space_, scene.light_field);
  const Outcome outcome = check(array, [](std::size_t view) { return view != COLUMNS; });
  EXPECT_NE(outcome.exit_code, 0) << outcome.output << outcome.errors;
  EXPECT_NE(outcome.output.find("ERROR    View (1, 0) (view_1_0/image_rect_color): no image has come"),
            std::string::npos)
      << outcome.output;
  EXPECT_NE(outcome.output.find("no CameraInfo has come on 'view_1_0/camera_info'"), std::string::npos)
      << outcome.output;
}

}  // namespace
}  // namespace light_field_depth::testing
