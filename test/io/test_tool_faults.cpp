// Disks that become full, signals and limits: the old results or the new ones, and a sentence.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include <opencv2/imgcodecs.hpp>

#include "light_field_depth/io/files.h"
#include "light_field_depth/io/pfm.h"
#include "support/program.h"
#include "support/synthetic_scene.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::Outcome;
using testing::quoted;
using testing::TemporaryFolder;

/// A small calibrated scene, and a folder with results of an earlier one that had a cloud.
class ToolFaults : public ::testing::Test
{
protected:
  ToolFaults()
  {
    testing::SceneSettings settings;
    settings.size = {64, 48};
    settings.positions = testing::gridPositions(3, 3);
    settings.samples = 1;
    const auto scene = testing::renderScene(testing::standardScene(settings.size), settings);
    for (const View& view : scene.light_field.views)
    {
      const std::string name =
          "view_" + std::to_string(view.grid.row) + "_" + std::to_string(view.grid.column) + ".png";
      std::filesystem::create_directories(folder_ / "scene");
      cv::imwrite((folder_ / "scene" / name).string(), view.image);
    }
    folder_.write("results/dense_cloud.ply", "old");
    folder_.write("results/disparity.pfm", "old");
    folder_.write("results/report.json", R"({"files": ["dense_cloud.ply", "disparity.pfm", "report.json"]})");
  }

  std::string command(const std::string& more = "") const
  {
    return quoted(ESTIMATE_PROGRAM) + " --input " + quoted((folder_ / "scene").string()) + " --output " +
           quoted((folder_ / "results").string()) + " --preset fast --threads 2 " + more;
  }

  std::set<std::string> names() const
  {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "results"))
    {
      names.insert(entry.path().filename().string());
    }
    return names;
  }

  void expectOldResults() const
  {
    EXPECT_EQ(names(), (std::set<std::string>{"dense_cloud.ply", "disparity.pfm", "report.json"}));
    EXPECT_EQ(readFile(folder_ / "results/disparity.pfm"), "old");
    expectNothingBeside();
  }

  void expectNewResults() const
  {
    EXPECT_EQ(names(),
              (std::set<std::string>{"confidence.pfm", "disparity.pfm", "disparity.png", "report.json"}));
    EXPECT_NE(readFile(folder_ / "results/disparity.pfm"), "old");
    expectNothingBeside();
  }

  void expectNothingBeside() const
  {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
    {
      const std::string name = entry.path().filename().string();
      EXPECT_TRUE(name == "scene" || name == "results") << name;
    }
  }

  TemporaryFolder folder_;
};

TEST_F(ToolFaults, ResultsOfAnEarlierSceneDoNotStay)
{
  const Outcome outcome = testing::runProgram(command());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  expectNewResults();
}

TEST_F(ToolFaults, AFullDiskLeavesTheOldResults)
{
  // Blocks of 512 bytes: the maps of 64 x 48 floats take 12 kB.
  const Outcome outcome = testing::runProgram("ulimit -f 8; " + command());
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.errors.find("cannot be written"), std::string::npos) << outcome.errors;
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  expectOldResults();
}

TEST_F(ToolFaults, SignalsLeaveTheOldResultsOrTheNewOnes)
{
  for (const std::string signal : {"TERM", "HUP"})
  {
    // The hidden folder tells that the work has begun.
    const Outcome outcome = testing::runProgram("(" + command("--save-intermediate") + " & program=$!; cd " +
                                                quoted(folder_.path().string()) +
                                                "; until ls -d .light_field_depth.partial-* >&2 || ! kill -0 "
                                                "$program; do :; done 2>/dev/null; kill -" +
                                                signal + " $program 2>/dev/null; wait $program)");
    if (outcome.exit_code == 130)
    {
      expectOldResults();
      EXPECT_NE(outcome.errors.find("interrupted"), std::string::npos) << outcome.errors;
    }
    else
    {
      EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
      return;
    }
  }
}

TEST_F(ToolFaults, OutputThatCannotBeWrittenIsAnError)
{
  for (const std::string& program : {command(), quoted(ESTIMATE_PROGRAM) + " --help"})
  {
    const Outcome outcome = testing::runProgram("(" + program + " >/dev/full)");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.errors.find("Standard output cannot be written"), std::string::npos) << outcome.errors;
  }
}

TEST_F(ToolFaults, TooLittleMemoryIsASentence)
{
  const std::string limit = "ulimit -v 700000; ";
  if (testing::runProgram(limit + quoted(ESTIMATE_PROGRAM) + " --help").exit_code != 0)
  {
    GTEST_SKIP() << "the program does not start in so little memory, as with sanitizers";
  }
  std::filesystem::remove_all(folder_ / "scene");
  for (const char* const name : {"scene/view_0_0.png", "scene/view_0_1.png"})
  {
    folder_.write(name, "");
    cv::imwrite((folder_ / name).string(), cv::Mat(5000, 5000, CV_8UC3, cv::Scalar(1, 2, 3)));
  }
  const Outcome outcome = testing::runProgram(limit + command());
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.errors.find("memory does not suffice"), std::string::npos) << outcome.errors;
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  expectOldResults();
}

TEST_F(ToolFaults, WhatNeedsMoreMemoryThanAllowedIsRefusedBeforeItIsRead)
{
  // The last view cannot be read: nobody tries to.
  folder_.write("scene/view_2_2.png", "no picture");
  const Outcome refused =
      testing::runProgram(command("--views all --order row-major --flip none --max-memory 70.2"));
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.errors.find("9 views of 64 x 48 pixels may need up to 71 MB, but 70 MB are allowed; "),
            std::string::npos)
      << refused.errors;
  EXPECT_NE(refused.errors.find("would fit"), std::string::npos) << refused.errors;
  EXPECT_EQ(std::count(refused.errors.begin(), refused.errors.end(), '\n'), 1) << refused.errors;
  expectOldResults();
  const Outcome read = testing::runProgram(command("--views all --max-memory 80"));
  EXPECT_NE(read.errors.find("view_2_2.png"), std::string::npos) << read.errors;
  EXPECT_EQ(testing::runProgram(command("--max-memory nan")).exit_code, 1);
}

TEST_F(ToolFaults, MoreViewsOrPixelsThanAllowedAreRefusedWithWhatWouldFit)
{
  const Outcome views = testing::runProgram(command("--views all --max-views 8"));
  EXPECT_EQ(views.exit_code, 1);
  EXPECT_NE(views.errors.find("9 views are too many: 8 would fit"), std::string::npos) << views.errors;
  const Outcome pixels = testing::runProgram(command("--max-megapixels 0.003"));
  EXPECT_EQ(pixels.exit_code, 1);
  EXPECT_NE(pixels.errors.find("64 x 48 pixels, which are too many: 63 x 47 would fit"), std::string::npos)
      << pixels.errors;
  expectOldResults();
  // What says to be larger than it is costs nothing either.
  std::string lie = readFile(folder_ / "scene/view_0_0.png");
  lie.replace(16, 8, std::string("\x00\x00\x75\x30\x00\x00\x75\x30", 8));
  folder_.write("scene/view_0_0.png", lie);
  const Outcome lies = testing::runProgram(command());
  EXPECT_EQ(lies.exit_code, 1);
  EXPECT_NE(lies.errors.find("30000 x 30000 pixels, which are too many: 20000 x 20000"), std::string::npos)
      << lies.errors;
  expectOldResults();
}

TEST_F(ToolFaults, TilesThatDoNotFitOrAreTooLargeAreRefused)
{
  const std::string sheet = (folder_ / "scene/sheet.png").string();
  cv::imwrite(sheet, cv::Mat(48, 192, CV_8UC1, cv::Scalar(90)));
  const auto estimate = [&](const std::string& more)
  {
    return testing::runProgram(quoted(ESTIMATE_PROGRAM) + " --input " + quoted(sheet) + " --output " +
                               quoted((folder_ / "results").string()) + " " + more);
  };
  const Outcome cut = estimate("--tiles 1x5");
  EXPECT_EQ(cut.exit_code, 1);
  EXPECT_NE(cut.errors.find("192 x 48 pixels cannot be cut into 1 x 5"), std::string::npos) << cut.errors;
  const Outcome large = estimate("--tiles 1x3 --max-megapixels 0.009");
  EXPECT_EQ(large.exit_code, 1);
  EXPECT_NE(large.errors.find("192 x 48 pixels, which are too many"), std::string::npos) << large.errors;
  expectOldResults();
}

TEST_F(ToolFaults, MapsOfAllViewsAndTheDenseCloudComeWithTheOtherResults)
{
  const Outcome outcome =
      testing::runProgram(command("--dense --view-maps --focal-length 60 --baseline 0.1"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const std::filesystem::path maps = folder_ / "results/view_maps";
  for (const char* const name : {"disparity_00_00.pfm", "confidence_02_01.pfm"})
  {
    EXPECT_EQ(readPfm(maps / name).size(), cv::Size(64, 48)) << name;
  }
  EXPECT_EQ(cv::imread((maps / "origin_01_01.png").string(), cv::IMREAD_UNCHANGED).size(), cv::Size(64, 48));
  EXPECT_GT(std::filesystem::file_size(folder_ / "results/dense_cloud.ply"), 1000U);
  expectNothingBeside();
}

TEST(EvaluateFaults, AMapWithoutValuesIsBadWhateverTheTruth)
{
  const TemporaryFolder folder;
  writePfm(folder / "truth.pfm", cv::Mat(60, 70, CV_32FC1, cv::Scalar(1.5)));
  writePfm(folder / "result.pfm", cv::Mat(60, 70, CV_32FC1, cv::Scalar(std::nan(""))));
  const std::string command = quoted(EVALUATE_PROGRAM) + " --truth " +
                              quoted((folder / "truth.pfm").string()) + " --result " +
                              quoted((folder / "result.pfm").string());
  const Outcome unknown = testing::runProgram(command);
  EXPECT_NE(unknown.output.find("mse_100 100.000"), std::string::npos) << unknown.output;
  EXPECT_NE(unknown.output.find("badpix_007 100.000"), std::string::npos) << unknown.output;
  writePfm(folder / "result.pfm", cv::Mat(50, 64, CV_32FC1, cv::Scalar(1.5)));
  const Outcome smaller = testing::runProgram(command);
  EXPECT_EQ(smaller.exit_code, 0);
  EXPECT_NE(smaller.errors.find("64 x 50 pixels, the truth 70 x 60"), std::string::npos) << smaller.errors;
}

}  // namespace
}  // namespace light_field_depth
