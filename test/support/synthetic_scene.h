#ifndef LIGHT_FIELD_DEPTH_TEST_SUPPORT_SYNTHETIC_SCENE_H
#define LIGHT_FIELD_DEPTH_TEST_SUPPORT_SYNTHETIC_SCENE_H

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth::testing
{
/// Colour (b, g, r in 0..255) at a point of a surface, given by where the reference view sees it, in pixels.
using Texture = std::function<cv::Vec3f(double x, double y)>;

/// Smooth random texture of several octaves. @param scale_px size of the coarsest blobs
Texture noiseTexture(std::uint32_t seed, double scale_px = 24.0, cv::Vec3f mean = {128, 128, 128},
                     float contrast = 100.0F);
Texture constantTexture(cv::Vec3f color);
/// Vertical (horizontal) sinusoidal stripes.
Texture stripeTexture(double period_px, bool vertical, cv::Vec3f dark = {60, 60, 60},
                      cv::Vec3f bright = {200, 200, 200});
Texture checkerTexture(double square_px, cv::Vec3f dark = {60, 70, 80}, cv::Vec3f bright = {190, 200, 210});

/// A surface given over the pixels (x, y) of the reference view.
struct Surface
{
  /// Disparity in pixels per grid step.
  std::function<double(double x, double y)> disparity;
  /// Whether the surface is there; empty: everywhere.
  std::function<bool(double x, double y)> inside;
  Texture texture;
};

Surface plane(double disparity, double slope_x, double slope_y, Texture texture);
/// A part of a plane. @param area in pixels of the reference view
Surface rectangle(double disparity, const cv::Rect2d& area, Texture texture);
/// A half sphere that rises by `height_px` of disparity from `base` at its rim.
Surface bump(double base, double height_px, cv::Point2d centre, double radius, Texture texture);

struct SceneSettings
{
  cv::Size size{128, 96};
  std::vector<GridPosition> positions;    ///< of the views
  std::optional<GridPosition> reference;  ///< the middle view when absent
  int samples = 3;                        ///< per pixel and axis; 1 has no mixed pixels at edges
  double noise_sigma = 0.0;               ///< of additive Gaussian noise, in 8-bit units
  std::uint64_t noise_seed = 1;
  bool grey = false;
  std::optional<Calibration> calibration;
  /// Applied to each finished view before noise, for exposure and vignetting; in 8-bit units.
  std::function<void(const GridPosition&, cv::Mat& values_32fc3)> degrade;
};

struct SyntheticLightField
{
  LightField light_field;  ///< 8-bit views
  cv::Mat truth;           ///< CV_32FC1, exact disparity at the pixel centres of the reference view
};

/// All positions of a grid, a cross through its middle, one row.
std::vector<GridPosition> gridPositions(int rows, int columns);
std::vector<GridPosition> crossPositions(int rows, int columns);

/// Renders the surfaces, the nearest (largest disparity) in front, into every view. The first surface should
/// be everywhere. View::steps are those of an ideal grid.
SyntheticLightField renderScene(const std::vector<Surface>& surfaces, const SceneSettings& settings);

/// The exact disparity of another view of the same scene, in that view's pixels.
cv::Mat renderTruth(const std::vector<Surface>& surfaces, const cv::Size& size, const cv::Point2d& steps);

/// A background that slants, an occluder and a bump: the scene that most tests begin with. Disparities
/// -1.2..2.
std::vector<Surface> standardScene(const cv::Size& size);

/// Mean absolute error and percentage of pixels with an error above a threshold, `border` pixels left out.
double meanAbsoluteError(const cv::Mat& disparity, const cv::Mat& truth, int border = 8);
double badPercentage(const cv::Mat& disparity, const cv::Mat& truth, double threshold_px, int border = 8);

}  // namespace light_field_depth::testing

#endif  // LIGHT_FIELD_DEPTH_TEST_SUPPORT_SYNTHETIC_SCENE_H
