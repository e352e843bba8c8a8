#include "light_field_depth/ros/camera_info_url.h"

#include <gtest/gtest.h>

#include <string>

#include "expect_sentence.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::expectSentence;

const std::string CAMCHAIN = R"(cam0:
  camera_model: pinhole
  distortion_coeffs: [-0.1, 0.02, 0.001, -0.002]
  distortion_model: radtan
  intrinsics: [400.0, 400.0, 319.5, 239.5]
  resolution: [640, 480]
  rostopic: /left/image_raw
cam1:
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, -0.1]
  - [0.0, 1.0, 0.0, 0.0]
  - [0.0, 0.0, 1.0, 0.0]
  - [0.0, 0.0, 0.0, 1.0]
  camera_model: pinhole
  distortion_coeffs: [-0.1, 0.02, 0.001, -0.002]
  distortion_model: equidistant
  intrinsics: [400.0, 400.0, 319.5, 239.5]
  resolution: [640, 480]
)";

TEST(CameraInfoUrl, NamesFilesAndPackages)
{
  EXPECT_EQ(fileOfUrl("file:///a/b.yaml", "View"), "/a/b.yaml");
  EXPECT_EQ(fileOfUrl("/a/b.yaml", "View"), "/a/b.yaml");
  expectSentence([] { fileOfUrl("package://no_such_package_here/b.yaml", "View"); },
                 {"View", "no_such_package_here"});
  expectSentence([] { fileOfUrl("http://a/b.yaml", "View"); }, {"View", "http"});
}

TEST(CameraInfoUrl, FilesOfCalibrateArrayAreRead)
{
  const testing::TemporaryFolder folder;
  folder.write("camchain.yaml", CAMCHAIN);
  const testing::Outcome outcome =
      testing::runProgram(std::string(CALIBRATE_ARRAY_PROGRAM) + " --camchain " +
                          testing::quoted((folder / "camchain.yaml").string()) + " --output " +
                          testing::quoted((folder / "out").string()));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("2 cameras, 100.0 mm wide"), std::string::npos) << outcome.output;
  ViewArray array;
  for (const std::string name : {"cam0", "cam1"})
  {
    ViewTopics view;
    view.camera_info_url = "file://" + (folder / "out" / (name + ".yaml")).string();
    array.views.push_back(view);
  }
  array.views.push_back({});
  const auto infos = readCameraInfos(array);
  ASSERT_EQ(infos.size(), 3U);
  EXPECT_EQ(infos[2], nullptr);
  EXPECT_EQ(infos[0]->width, 640U);
  EXPECT_DOUBLE_EQ(infos[0]->D[0], -0.1);
  EXPECT_EQ(infos[1]->distortion_model, "equidistant");
  EXPECT_NEAR(infos[1]->P[3] - infos[0]->P[3], -40.0, 1e-6);
  array.views[0].camera_info_url = (folder / "nothing.yaml").string();
  expectSentence([&] { readCameraInfos(array); }, {"nothing.yaml"});
}

}  // namespace
}  // namespace light_field_depth
