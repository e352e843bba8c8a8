// Folders that are not what they claim to be, through the program: each is put right, refused with a
// sentence, or warned about; none that is right is warned about.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "light_field_depth/io/pfm.h"
#include "support/mis_set_cases.h"
#include "support/named_scenes.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::Outcome;
using testing::quoted;
using testing::TemporaryFolder;

enum ExitCode
{
  FINE = 0,
  REFUSED = 1,
  DOUBTFUL = 3
};

using NameOf = std::function<std::string(const GridPosition&)>;

std::string twoNumbers(const GridPosition& place)
{
  return "view_" + std::to_string(place.row) + "_" + std::to_string(place.column) + ".png";
}

void writeViews(const LightField& light_field, const TemporaryFolder& folder,
                const NameOf& name_of = twoNumbers)
{
  for (const View& view : light_field.views)
  {
    ASSERT_TRUE(cv::imwrite((folder / name_of(view.grid)).string(), view.image));
  }
}

Outcome estimate(const TemporaryFolder& folder, const TemporaryFolder& results, const std::string& more = "")
{
  return testing::runProgram(quoted(ESTIMATE_PROGRAM) + " --strict --preset realtime --threads 2 --input " +
                             quoted(folder.path().string()) + " --output " +
                             quoted((results / "out").string()) + " " + more);
}

/// Share of the pixels that are off by more than a quarter of a pixel.
double shareOff(const std::filesystem::path& map_file, const cv::Mat& truth)
{
  const cv::Mat map = readPfm(map_file);
  cv::Mat difference;
  cv::absdiff(map, truth, difference);
  return 1.0 - cv::countNonZero(difference <= 0.25) / static_cast<double>(truth.total());
}

constexpr double MAX_SHARE_OFF = 0.03;  // of the right folder it is 0.01

/// Warned about, refused with a sentence, or right in the end.
void expectNoSilentGarbage(const Outcome& outcome, const TemporaryFolder& results, const cv::Mat& truth)
{
  switch (outcome.exit_code)
  {
    case DOUBTFUL:
      EXPECT_NE((outcome.output + outcome.errors).find("Warning: "), std::string::npos) << outcome.output;
      break;
    case REFUSED:
      EXPECT_GT(outcome.errors.size(), 40U) << outcome.errors;
      break;
    default:
      ASSERT_EQ(outcome.exit_code, FINE) << outcome.errors;
      EXPECT_LT(shareOff(results / "out/disparity.pfm", truth), MAX_SHARE_OFF) << outcome.output;
  }
}

TEST(MisSetFolders, EachIsPutRightOrWarnedAbout)
{
  const testing::SyntheticLightField right = testing::rightScene();
  for (const testing::MisSetCase& mis_set : testing::misSetCases())
  {
    SCOPED_TRACE(mis_set.name);
    LightField field = right.light_field;
    mis_set.spoil(field);
    const TemporaryFolder folder;
    const TemporaryFolder results;
    writeViews(field, folder);
    std::ostringstream range;
    if (mis_set.range)
    {
      range << "--range " << mis_set.range->min << "," << mis_set.range->max;
    }
    expectNoSilentGarbage(estimate(folder, results, range.str()), results, right.truth);
  }
}

TEST(MisSetFolders, GridsThatAreWrongArePutRightOrWarnedAbout)
{
  const testing::SyntheticLightField right = testing::rightScene();
  const auto index = [](const GridPosition& place) { return 5 * place.row + place.column; };
  struct WrongGrid
  {
    const char* name;
    NameOf name_of;
    const char* options;
  };
  const auto numbered = [](int number) { return std::to_string(1000 + number) + ".png"; };
  for (const WrongGrid& wrong :
       {WrongGrid{"an index, column by column",
                  [&](const GridPosition& p) { return numbered(5 * p.column + p.row); }, ""},
        WrongGrid{"an index, back and forth",
                  [&](const GridPosition& p)
                  { return numbered(p.row % 2 == 0 ? index(p) : 5 * p.row + 4 - p.column); },
                  ""},
        WrongGrid{"an index, told to be one row", [&](const GridPosition& p) { return numbered(index(p)); },
                  "--grid 1x25"},
        WrongGrid{"an index in a wider grid", [&](const GridPosition& p) { return numbered(index(p)); },
                  "--grid 4x7"},
        WrongGrid{"told to be column-major", twoNumbers, "--order column-major"},
        WrongGrid{"told to be flipped", twoNumbers, "--flip rows"},
        WrongGrid{"near is far, by an option", twoNumbers, "--flip both"}})
  {
    SCOPED_TRACE(wrong.name);
    const TemporaryFolder folder;
    const TemporaryFolder results;
    writeViews(right.light_field, folder, wrong.name_of);
    expectNoSilentGarbage(estimate(folder, results, wrong.options), results, right.truth);
  }
}

TEST(MisSetFolders, NoRightFolderIsWarnedAbout)
{
  std::vector<testing::SyntheticLightField> scenes = {testing::rightScene()};
  for (testing::NamedScene scene :
       {testing::repeatedTexture(), testing::gradients(), testing::sparseArray(),
        testing::exposureDifferences(), testing::strongOcclusion(), testing::singleRow()})
  {
    scene.settings.samples = 1;
    scenes.push_back(scene.render());
  }
  for (std::size_t i = 0; i < scenes.size(); ++i)
  {
    const TemporaryFolder folder;
    const TemporaryFolder results;
    writeViews(scenes[i].light_field, folder);
    const Outcome outcome = estimate(folder, results);
    EXPECT_EQ(outcome.exit_code, FINE) << i << "\n" << outcome.output << outcome.errors;
  }
}

}  // namespace
}  // namespace light_field_depth
