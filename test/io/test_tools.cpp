// The programs estimate and evaluate, as a user calls them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>
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

Outcome estimate(const std::filesystem::path& input, const std::filesystem::path& output,
                 const std::string& more = "")
{
  return testing::runProgram(quoted(ESTIMATE_PROGRAM) + " --input " + quoted(input.string()) + " --output " +
                             quoted(output.string()) + " " + more);
}

nlohmann::json reportIn(const std::filesystem::path& folder)
{
  return nlohmann::json::parse(readFile(folder / "report.json"));
}

std::string nameOf(const View& view)
{
  return "view_0" + std::to_string(view.grid.row) + "_0" + std::to_string(view.grid.column) + ".png";
}

/// A synthetic scene on disk, described by a light_field.yaml.
class SceneFolder
{
public:
  explicit SceneFolder(bool calibrated = true)
  {
    testing::SceneSettings settings;
    settings.size = {96, 80};
    settings.positions = testing::gridPositions(5, 5);
    settings.samples = 2;
    scene_ = testing::renderScene(testing::standardScene(settings.size), settings);
    for (const View& view : scene_.light_field.views)
    {
      cv::imwrite((folder_ / nameOf(view)).string(), view.image);
    }
    writePfm(folder_ / "truth.pfm", scene_.truth);
    if (calibrated)
    {
      folder_.write("light_field.yaml",
                    "pattern: 'view_{row:02}_{column:02}.png'\ngrid: {rows: 5, columns: 5}\n"
                    "focal_length_px: 100\nbaseline_m: 0.1\nfocus_distance_m: 2.5\ntruth: truth.pfm\n");
    }
  }

  const TemporaryFolder& folder() const { return folder_; }
  const std::filesystem::path& path() const { return folder_.path(); }
  const cv::Mat& truth() const { return scene_.truth; }

private:
  TemporaryFolder folder_;
  testing::SyntheticLightField scene_;
};

TEST(EstimateTool, WritesAllResultsOfACalibratedFolder)
{
  const SceneFolder scene;
  const TemporaryFolder output;
  const auto folder = output / "new/folder";
  const Outcome outcome = estimate(scene.path(), folder, "--dense --save-intermediate");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "") << "no progress bar without a terminal";
  EXPECT_NE(outcome.output.find("disparity.pfm"), std::string::npos);
  const cv::Mat disparity = readPfm(folder / "disparity.pfm");
  ASSERT_EQ(disparity.size(), scene.truth().size());
  EXPECT_LT(testing::meanAbsoluteError(disparity, scene.truth()), 0.3);
  const cv::Mat confidence = readPfm(folder / "confidence.pfm");
  double smallest = 0.0;
  double largest = 0.0;
  cv::minMaxIdx(confidence, &smallest, &largest);
  EXPECT_GE(smallest, 0.0);
  EXPECT_LE(largest, 1.0);
  const cv::Mat depth = readPfm(folder / "depth.pfm");
  EXPECT_NEAR(depth.at<float>(40, 30), 10.0 / (disparity.at<float>(40, 30) + 4.0), 1e-4);
  for (const char* const name : {"disparity.png", "cloud.ply", "dense_cloud.ply", "report.json"})
  {
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  }
  const nlohmann::json report = reportIn(folder);
  EXPECT_EQ(report["views_found"], 25);
  EXPECT_EQ(report["disparity_range_source"], "found");
  for (const char* const stage : {"decode", "total", "write"})
  {
    EXPECT_GT(report["timings_ms"][stage], 0.0) << stage;
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    EXPECT_EQ(entry.path().filename().string().find("partial"), std::string::npos) << entry.path();
  }
}

TEST(EstimateTool, WritesNoDepthWithoutCalibrationAndSaysSo)
{
  const SceneFolder scene(false);
  const TemporaryFolder output;
  const Outcome outcome = estimate(scene.path(), output.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("no calibration"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(output / "depth.pfm"));
  EXPECT_FALSE(std::filesystem::exists(output / "cloud.ply"));
  EXPECT_TRUE(reportIn(output.path())["calibration"].is_null());
}

TEST(EstimateTool, HeedsItsOptions)
{
  const SceneFolder scene;
  const TemporaryFolder output;
  const auto config =
      output.write("options.yaml", "views: all\nmin_confidence: 0.25\ndense_cloud_voxel_size_m: 0.5\n");
  const Outcome outcome =
      estimate(scene.path(), output.path(),
               "--views row --reference 1,3 --disparity-range -2.5,3 --flip none "
               "--threads 2 --set dense_cloud_voxel_size_m=0.125 --method paper2017 --config " +
                   quoted(config.string()));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const nlohmann::json report = reportIn(output.path());
  EXPECT_EQ(report["method"], "paper2017");
  EXPECT_EQ(report["options"]["views"], "row") << "the command line wins over the file";
  EXPECT_EQ(report["options"]["min_confidence"], 0.25);
  EXPECT_EQ(report["options"]["dense_cloud_voxel_size_m"], 0.125);
  EXPECT_EQ(report["reference"]["row"], 1);
  EXPECT_EQ(report["reference"]["column"], 3);
  EXPECT_EQ(report["reference"]["file"], "view_01_03.png");
  EXPECT_EQ(report["disparity_range"], nlohmann::json({-2.5, 3.0}));
  EXPECT_EQ(report["disparity_range_source"], "given");
  EXPECT_EQ(report["views_used"], 5);
  EXPECT_EQ(report["threads"], 2);
}

TEST(EstimateTool, KnowsTheNamesThatPeopleTypeAndTheLongerOnes)
{
  const SceneFolder scene;
  const TemporaryFolder output;
  ASSERT_EQ(
      estimate(scene.path(), output / "short", "--preset fast --temporal true --range -2.5,3").exit_code, 0);
  ASSERT_EQ(estimate(scene.path(), output / "long",
                     "--set multiview_preset=fast --set multiview_temporal=true --disparity-range -2.5,3")
                .exit_code,
            0);
  EXPECT_EQ(reportIn(output / "short")["options"], reportIn(output / "long")["options"]);
  EXPECT_EQ(reportIn(output / "short")["options"]["multiview_preset"], "fast");
  EXPECT_EQ(reportIn(output / "short")["options"]["multiview_temporal"], true);
  EXPECT_EQ(readFile(output / "short" / "disparity.pfm"), readFile(output / "long" / "disparity.pfm"));
}

TEST(EstimateTool, WritesEachFrameOfASequenceToItsFolder)
{
  const SceneFolder scene;
  const TemporaryFolder sequence;
  for (const char* const frame : {"frame_007", "frame_008", "frame_009"})
  {
    std::filesystem::copy(scene.path(), sequence / frame);
  }
  const TemporaryFolder output;
  const Outcome outcome =
      estimate(sequence.path(), output.path(), "--frames 8:9 --set multiview_preset=fast");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_FALSE(std::filesystem::exists(output / "frame_007"));
  EXPECT_EQ(reportIn(output / "frame_008")["options"]["multiview_temporal"], true);
  EXPECT_EQ(reportIn(output / "frame_009")["views_found"], 25);
  EXPECT_TRUE(std::filesystem::exists(output / "frame_009/depth.pfm"));
  EXPECT_EQ(estimate(sequence.path(), output.path(), "--frames 9:8").exit_code, 1);
  EXPECT_EQ(estimate(scene.path(), output.path(), "--frames all").exit_code, 1);
}

TEST(EstimateTool, WritesTheFilesThatAreAskedFor)
{
  const SceneFolder scene(false);
  const TemporaryFolder output;
  const Outcome outcome = estimate(scene.path(), output.path(),
                                   "--set multiview_preset=fast --format npy,png16 --preview --y-up "
                                   "--focal-length 100 --baseline 0.1,0.2 --focus-distance 2.5");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  for (const char* const name :
       {"disparity.npy", "disparity_16.png", "depth_16.png", "preview.png", "cloud.ply"})
  {
    EXPECT_TRUE(std::filesystem::exists(output / name)) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(output / "disparity.pfm"));
  const nlohmann::json report = reportIn(output.path());
  EXPECT_EQ(report["disparity_png16"]["scale"], 256.0);
  EXPECT_NEAR(report["calibration"]["disparity_offset_px"].get<double>(), 4.0, 1e-6);
  EXPECT_EQ(estimate(scene.path(), output.path(), "--focal-length 100").exit_code, 1);
  EXPECT_EQ(estimate(scene.path(), output.path(), "--format gif").exit_code, 1);
}

TEST(EstimateTool, GivesTheSameResultOnAnyNumberOfThreads)
{
  const SceneFolder scene;
  const TemporaryFolder output;
  ASSERT_EQ(estimate(scene.path(), output / "one", "--threads 1").exit_code, 0);
  ASSERT_EQ(estimate(scene.path(), output / "three", "--threads 3").exit_code, 0);
  for (const char* const file : {"disparity.pfm", "confidence.pfm", "depth.pfm", "cloud.ply"})
  {
    EXPECT_EQ(readFile(output / "one" / file), readFile(output / "three" / file)) << file;
  }
}

TEST(EstimateTool, SaysInOneSentenceWhatIsWrong)
{
  const SceneFolder scene;
  const TemporaryFolder output;
  const auto target = output / "results";
  const auto expect = [&](const Outcome& outcome, const std::string& part)
  {
    EXPECT_EQ(outcome.exit_code, 1) << part;
    EXPECT_EQ(outcome.output, "") << part;
    EXPECT_NE(outcome.errors.find(part), std::string::npos) << outcome.errors;
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
    EXPECT_FALSE(std::filesystem::exists(target)) << part;
  };
  expect(estimate(output / "absent", target), "does not exist");
  expect(estimate(scene.path(), target, "--method magic"), "magic");
  expect(estimate(scene.path(), target, "--views some"), "some");
  expect(estimate(scene.path(), target, "--flip sideways"), "sideways");
  expect(estimate(scene.path(), target, "--reference 9,9"), "(9, 9)");
  expect(estimate(scene.path(), target, "--reference 1"), "--reference");
  expect(estimate(scene.path(), target, "--reference a,b"), "--reference");
  expect(estimate(scene.path(), target, "--disparity-range 3,-3"), "disparity_range");
  expect(estimate(scene.path(), target, "--disparity-range nan,3"), "disparity_range");
  expect(estimate(scene.path(), target, "--range 3,-3"), "disparity_range");
  expect(estimate(scene.path(), target, "--preset hasty"), "hasty");
  expect(estimate(scene.path(), target, "--temporal sometimes"), "sometimes");
  expect(estimate(scene.path(), target, "--method paper2017 --preset fast"), "--preset belongs to");
  expect(estimate(scene.path(), target, "--set nonsense=1"), "nonsense");
  expect(estimate(scene.path(), target, "--set min_confidence=7"), "min_confidence");
  expect(estimate(scene.path(), target, "--set min_confidence"), "NAME=VALUE");
  expect(estimate(scene.path(), target, "--config " + quoted((output / "absent.yaml").string())),
         "absent.yaml");
  expect(estimate(scene.path(), target, "--nonsense"), "nonsense");
  expect(testing::runProgram(quoted(ESTIMATE_PROGRAM) + " --input x"), "--output");
  expect(estimate(scene.path(), output.write("file", "")), "file");
  std::filesystem::resize_file(scene.folder() / "view_02_02.png", 700);
  expect(estimate(scene.path(), target), "view_02_02.png");
}

TEST(EstimateTool, ExplainsItself)
{
  const Outcome outcome = testing::runProgram(quoted(ESTIMATE_PROGRAM) + " --help");
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* const option :
       {"--input", "--output", "--method", "--preset", "--temporal", "--views", "--reference", "--range",
        "--disparity-range", "--flip", "--dense", "--threads", "--save-intermediate", "--config", "--set"})
  {
    EXPECT_NE(outcome.output.find(option), std::string::npos) << option;
  }
}

class EvaluateTool : public ::testing::Test
{
protected:
  EvaluateTool()
  {
    cv::RNG random(3);
    truth_.create(60, 70, CV_32FC1);
    random.fill(truth_, cv::RNG::UNIFORM, -2.0, 3.0);
    cv::Mat noise(truth_.size(), CV_32FC1);
    random.fill(noise, cv::RNG::NORMAL, 0.0, 0.05);
    result_ = truth_ + noise;
    result_.at<float>(20, 20) = std::nanf("");
    result_.at<float>(30, 33) = INFINITY;
    writePfm(folder_ / "truth.pfm", truth_);
    writePfm(folder_ / "result.pfm", result_);
  }

  Outcome evaluate(const std::string& more = "") const
  {
    return testing::runProgram(quoted(EVALUATE_PROGRAM) + arguments() + more);
  }
  std::string arguments() const
  {
    return " --result " + quoted((folder_ / "result.pfm").string()) + " --truth " +
           quoted((folder_ / "truth.pfm").string()) + " ";
  }

  TemporaryFolder folder_;
  cv::Mat truth_;
  cv::Mat result_;
};

TEST_F(EvaluateTool, PrintsTheSameAsTheReferenceProgram)
{
  const std::filesystem::path reference = "../shared/tools/score_disparity.py";
  if (!std::filesystem::exists(reference) ||
      testing::runProgram("/usr/bin/python3 -c 'import numpy'").exit_code != 0)
  {
    GTEST_SKIP() << reference << " or numpy is not here";
  }
  const std::string files =
      quoted((folder_ / "result.pfm").string()) + " " + quoted((folder_ / "truth.pfm").string());
  for (const std::string border : {"", "--border 0", "--border 7"})
  {
    const Outcome expected =
        testing::runProgram("/usr/bin/python3 " + reference.string() + " " + files + " " + border);
    ASSERT_EQ(expected.exit_code, 0) << expected.errors;
    EXPECT_EQ(evaluate(border).output, expected.output) << border;
  }
  const auto expected = nlohmann::json::parse(
      testing::runProgram("/usr/bin/python3 " + reference.string() + " --json " + files).output);
  const auto found = nlohmann::json::parse(evaluate("--json").output);
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [name, value] : expected.items())
  {
    EXPECT_NEAR(found[name].get<double>(), value.get<double>(), 1e-4 * (1.0 + std::abs(value.get<double>())))
        << name;
  }
}

TEST(EvaluateToolOnClouds, ScoresTheCloudOfTheReferenceView)
{
  const SceneFolder scene;
  const TemporaryFolder output;
  ASSERT_EQ(estimate(scene.path(), output.path()).exit_code, 0);
  const std::string arguments = " --truth " + quoted(scene.path().string()) + " --json --cloud " +
                                quoted((output / "cloud.ply").string());
  const Outcome outcome = testing::runProgram(quoted(EVALUATE_PROGRAM) + arguments);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const auto score = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(score["points"], 96 * 80);
  EXPECT_GT(score["accuracy_1"], 80.0);
  EXPECT_GT(score["completeness_2"], 85.0);
  EXPECT_TRUE(score["hidden_2"].is_null()) << "no view but the reference has a truth";
  const Outcome of_both = testing::runProgram(quoted(EVALUATE_PROGRAM) + arguments + " --result a.pfm");
  EXPECT_NE(of_both.exit_code, 0);
}

TEST_F(EvaluateTool, HeedsTheMask)
{
  cv::Mat mask = cv::Mat::zeros(truth_.size(), CV_8UC3);
  mask(cv::Rect(18, 18, 5, 5)).setTo(cv::Scalar(0, 255, 0));
  ASSERT_TRUE(cv::imwrite((folder_ / "mask.png").string(), mask));
  const Outcome outcome = evaluate("--json --mask " + quoted((folder_ / "mask.png").string()));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NEAR(nlohmann::json::parse(outcome.output)["coverage"].get<double>(), 24.0 / 25.0, 1e-9);
}

TEST_F(EvaluateTool, ShowsHowTheErrorFallsWithTheLeastConfidentPixels)
{
  cv::Mat confidence(result_.size(), CV_32FC1);
  for (int y = 0; y < confidence.rows; ++y)
  {
    for (int x = 0; x < confidence.cols; ++x)
    {
      const float error = std::abs(result_.at<float>(y, x) - truth_.at<float>(y, x));
      confidence.at<float>(y, x) = std::isfinite(error) ? 1.0F / (1.0F + error) : 0.0F;
    }
  }
  writePfm(folder_ / "confidence.pfm", confidence);
  const std::string more = "--confidence " + quoted((folder_ / "confidence.pfm").string());
  const auto found = nlohmann::json::parse(evaluate("--json " + more).output)["sparsification"];
  EXPECT_NEAR(found["ause_mse"].get<double>(), 0.0, 1e-9);
  EXPECT_NEAR(found["ause_badpix_007"].get<double>(), 0.0, 1e-9);
  EXPECT_EQ(found["mse_100_curve"], found["mse_100_ideal_curve"]);
  EXPECT_NE(evaluate(more).output.find("  ause_mse 0.000  ause_badpix_007 0.000  "), std::string::npos);
}

TEST_F(EvaluateTool, SaysInOneSentenceWhatIsWrong)
{
  std::filesystem::resize_file(folder_ / "result.pfm", 1000);
  const Outcome lying = evaluate();
  EXPECT_EQ(lying.exit_code, 1);
  EXPECT_NE(lying.errors.find("result.pfm"), std::string::npos) << lying.errors;
  EXPECT_EQ(std::count(lying.errors.begin(), lying.errors.end(), '\n'), 1);
  EXPECT_EQ(evaluate("--border wide").exit_code, 1);
  EXPECT_EQ(testing::runProgram(quoted(EVALUATE_PROGRAM)).exit_code, 1);
}

}  // namespace
}  // namespace light_field_depth
