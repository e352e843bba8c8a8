// Camera chains of Kalibr, rectified to one plane.

#include "light_field_depth/io/camchain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "dataset_files.h"
#include "light_field_depth/core/error.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::messageOf;
using testing::says;
using testing::TemporaryFolder;

/// A camera in the axes of the first one: where it stands, and how it is turned about its own y axis.
struct Placed
{
  cv::Vec3d centre_m;
  double yaw = 0.0;
};

cv::Matx33d yawed(double angle)
{
  return {std::cos(angle), 0.0, std::sin(angle), 0.0, 1.0, 0.0, -std::sin(angle), 0.0, std::cos(angle)};
}

/// From the axes of one camera to those of the next one.
void writeTransform(const Placed& from, const Placed& to, std::ostream& text)
{
  const cv::Matx33d turn = yawed(to.yaw).t() * yawed(from.yaw);
  const cv::Vec3d shift = yawed(to.yaw).t() * (from.centre_m - to.centre_m);
  text << "  T_cn_cnm1:\n";
  for (int row = 0; row < 3; ++row)
  {
    text << "  - [" << turn(row, 0) << ", " << turn(row, 1) << ", " << turn(row, 2) << ", " << shift[row]
         << "]\n";
  }
  text << "  - [0.0, 0.0, 0.0, 1.0]\n";
}

std::string camchain(const std::vector<Placed>& cameras)
{
  std::ostringstream text;
  text.precision(17);
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    text << "cam" << i << ":\n";
    if (i > 0)
    {
      writeTransform(cameras[i - 1], cameras[i], text);
    }
    text << "  camera_model: pinhole\n  distortion_coeffs: [-0.1, 0.02, 0.001, -0.002]\n"
         << "  distortion_model: radtan\n  intrinsics: [400.0, 402.0, 318.5, 241.0]\n"
         << "  resolution: [640, 480]\n  rostopic: /cam" << i << "/image_raw\n";
  }
  return text.str();
}

std::string errorOf(const std::string& yaml)
{
  const TemporaryFolder folder;
  folder.write("camchain.yaml", yaml);
  return messageOf<InputError>([&] { rectifyCamchain(folder / "camchain.yaml"); });
}

TEST(Camchain, TurnedCamerasInARowGetOneDirectionAndTheirPlaces)
{
  const TemporaryFolder folder;
  folder.write("camchain.yaml",
               camchain({{{0.0, 0.0, 0.0}, 0.02}, {{0.2, 0.0, 0.0}, -0.03}, {{0.1, 0.0, 0.0}, 0.01}}));
  const RectifiedRig rig = rectifyCamchain(folder / "camchain.yaml");
  ASSERT_EQ(rig.cameras.size(), 3U);
  const std::vector<std::string> names = {"cam0", "cam2", "cam1"};
  for (std::size_t i = 0; i < 3; ++i)
  {
    const RectifiedCamera& camera = rig.cameras[i];
    EXPECT_EQ(camera.name, names[i]);
    EXPECT_EQ(camera.grid.row, 0);
    EXPECT_EQ(camera.grid.column, static_cast<int>(i));
    EXPECT_NEAR(camera.projection(0, 0), 401.0, 1e-9);
    EXPECT_NEAR(-camera.projection(0, 3) / camera.projection(0, 0), 0.1 * (static_cast<double>(i) - 1.0),
                1e-9);
    EXPECT_NEAR(camera.projection(1, 3), 0.0, 1e-6);
    EXPECT_EQ(camera.distortion_model, "plumb_bob");
    EXPECT_EQ(camera.distortion.size(), 5U);
  }
  EXPECT_EQ(rig.reference, 1U);
  EXPECT_EQ(rig.cameras[0].topic, "/cam0/image_raw");
  // A point of the scene is on one row in all rectified views, and moves by f T / Z.
  const cv::Vec3d point(0.13, -0.2, 2.0);
  const std::vector<Placed> placed = {
      {{0.0, 0.0, 0.0}, 0.02}, {{0.1, 0.0, 0.0}, 0.01}, {{0.2, 0.0, 0.0}, -0.03}};
  std::vector<cv::Point2d> pixels;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const cv::Vec3d seen = yawed(placed[i].yaw).t() * (point - placed[i].centre_m);
    const cv::Vec3d turned = rig.cameras[i].rectification * seen;
    const cv::Matx34d& p = rig.cameras[i].projection;
    pixels.emplace_back(p(0, 0) * turned[0] / turned[2] + p(0, 2), p(1, 1) * turned[1] / turned[2] + p(1, 2));
  }
  EXPECT_NEAR(pixels[0].y, pixels[1].y, 1e-6);
  EXPECT_NEAR(pixels[1].y, pixels[2].y, 1e-6);
  EXPECT_NEAR(pixels[0].x - pixels[1].x, pixels[1].x - pixels[2].x, 1e-6);
  EXPECT_NEAR(pixels[0].x - pixels[1].x, 401.0 * 0.1 / 2.0, 0.05);
}

TEST(Camchain, SaysHowFarFromAPlaneTheCamerasStand)
{
  const TemporaryFolder folder;
  folder.write("camchain.yaml",
               camchain({{{0.0, 0.0, 0.0}}, {{0.1, 0.0, 0.001}}, {{0.0, 0.1, 0.0}}, {{0.1, 0.1, 0.0}}}));
  const RectifiedRig rig = rectifyCamchain(folder / "camchain.yaml");
  EXPECT_NEAR(rig.off_plane_m, 0.00025, 1e-5);
  EXPECT_NEAR(rig.width_m, 0.1414, 1e-3);
  EXPECT_EQ(rig.cameras[2].grid.row, 1);
  EXPECT_EQ(rig.cameras[2].grid.column, 0);
}

TEST(Camchain, RefusesWhatCannotBeRectifiedAndNamesTheField)
{
  EXPECT_TRUE(
      says(errorOf(camchain({{{0.0, 0.0, 0.0}}, {{0.1, 0.0, 0.05}}, {{0.0, 0.1, 0.0}}, {{0.1, 0.1, 0.0}}})),
           {"away from a common plane"}));
  EXPECT_TRUE(says(errorOf(camchain({{{0.0, 0.0, 0.0}}, {{0.1, 0.0, 0.0}}, {{0.2, 0.0, 0.0}, 1.0}})),
                   {"cam2", "degrees"}));
  EXPECT_TRUE(says(errorOf(camchain({{{0.0, 0.0, 0.0}}})), {"no two cameras"}));
  const std::string good = camchain({{{0.0, 0.0, 0.0}}, {{0.1, 0.0, 0.0}}});
  for (const std::string field : {"intrinsics", "resolution", "distortion_model", "camera_model"})
  {
    std::string bad = good;
    const std::size_t at = bad.rfind(field + ":");
    bad.replace(at, bad.find('\n', at) - at, field + ": sideways");
    EXPECT_TRUE(errorOf(bad).find(field) != std::string::npos) << field << ": " << errorOf(bad);
  }
}

}  // namespace
}  // namespace light_field_depth
