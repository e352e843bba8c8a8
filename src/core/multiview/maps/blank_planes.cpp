#include "core/multiview/maps/blank_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "core/multiview/maps/disparity_plane.h"
#include "core/multiview/refine/cell_sums.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr std::uint8_t HELD = 255;
/// Planes through three known pixels that are tried: where half of them lie on one, all miss it once in 10^11
/// times.
constexpr int TRIALS = 200;
/// Least squares over what lies on the plane, and what lies on that then.
constexpr int FITS = 3;
/// More known pixels than this are thinned out.
constexpr std::size_t MAX_KNOWN = 1024;
constexpr std::size_t MIN_KNOWN = 64;
constexpr int RANDOM_SEED = 17;

/// Mean and spread of the colour of some pixels.
class ColourSum
{
public:
  explicit ColourSum(const PlanarImage& image) : image_(image) {}

  void add(int x, int y)
  {
    for (int channel = 0; channel < image_.channels(); ++channel)
    {
      const double level = levelAt(x, y, channel);
      sums_[index(channel)] += level;
      squares_[index(channel)] += level * level;
    }
    ++count_;
  }

  /// The greatest of any channel.
  double deviation() const
  {
    double most = 0.0;
    for (int channel = 0; channel < image_.channels(); ++channel)
    {
      const double mean = sums_[index(channel)] / count_;
      most = std::max(most, squares_[index(channel)] / count_ - mean * mean);
    }
    return std::sqrt(most);
  }

  bool isLike(int x, int y, int max_difference) const
  {
    for (int channel = 0; channel < image_.channels(); ++channel)
    {
      if (std::abs(levelAt(x, y, channel) - sums_[index(channel)] / count_) > max_difference)
      {
        return false;
      }
    }
    return true;
  }

private:
  static std::size_t index(int channel) { return static_cast<std::size_t>(channel); }

  double levelAt(int x, int y, int channel) const
  {
    return image_.row(y)[index(channel) * image_.channelStride() + static_cast<std::size_t>(x)];
  }

  const PlanarImage& image_;
  std::array<double, 4> sums_{};
  std::array<double, 4> squares_{};
  double count_ = 0.0;
};

/// A plane and how far it may be followed.
struct FittedPlane
{
  DisparityPlane plane;
  cv::Matx33d inverse;  ///< of the mean of the outer products of (x, y, 1) of what lies on it

  /// Variance at a place, 1 in the middle of what lies on the plane.
  double leverage(double x, double y) const
  {
    const cv::Vec3d place(x, y, 1.0);
    return place.dot(inverse * place);
  }
};

std::optional<FittedPlane> leastSquares(const std::vector<cv::Vec3d>& known, const DisparityPlane& plane,
                                        double tolerance)
{
  cv::Matx33d normal = cv::Matx33d::zeros();
  cv::Vec3d right;
  double count = 0.0;
  for (const cv::Vec3d& pixel : known)
  {
    if (isOn(plane, pixel, tolerance))
    {
      const cv::Vec3d place(pixel[0], pixel[1], 1.0);
      normal += place * place.t();
      right += place * pixel[2];
      count += 1.0;
    }
  }
  bool solved = false;
  const cv::Matx33d inverse = normal.inv(cv::DECOMP_CHOLESKY, &solved);
  if (!solved)
  {
    return std::nullopt;
  }
  return FittedPlane{{inverse * right}, inverse * count};
}

/// How many of the known pixels lie on a plane and behind it.
struct Support
{
  Support(const std::vector<cv::Vec3d>& known, const DisparityPlane& plane, double tolerance)
  {
    for (const cv::Vec3d& pixel : known)
    {
      const double nearer = pixel[2] - plane.at(pixel[0], pixel[1]);
      on_plane += std::abs(nearer) <= tolerance ? 1 : 0;
      behind += nearer < -tolerance ? 1 : 0;
    }
  }

  int on_plane = 0;
  int behind = 0;
};

/// The plane that enough of what is known lies on.
std::optional<FittedPlane> fitPlane(const std::vector<cv::Vec3d>& known, const BlankPlaneSettings& settings)
{
  cv::RNG random(RANDOM_SEED);
  const auto any = [&]() -> const cv::Vec3d&
  { return known[static_cast<std::size_t>(random.uniform(0, static_cast<int>(known.size())))]; };
  std::optional<DisparityPlane> best;
  int most = 0;
  for (int trial = 0; trial < TRIALS; ++trial)
  {
    const auto plane = planeThrough({any(), any(), any()});
    if (plane)
    {
      const Support support(known, *plane, settings.tolerance_px);
      if (support.on_plane - support.behind > most)
      {
        most = support.on_plane - support.behind;
        best = plane;
      }
    }
  }
  std::optional<FittedPlane> fitted;
  for (int fit = 0; best && fit < FITS; ++fit)
  {
    fitted = leastSquares(known, *best, settings.tolerance_px);
    if (!fitted)
    {
      return std::nullopt;
    }
    best = fitted->plane;
  }
  if (!best)
  {
    return std::nullopt;
  }
  const Support support(known, *best, settings.tolerance_px);
  const auto all = static_cast<double>(known.size());
  const bool holds =
      support.on_plane >= settings.min_on_plane * all && support.behind <= settings.max_behind * all;
  return holds ? fitted : std::nullopt;
}

/// Looks at one region after the other.
class BlankPlanes
{
public:
  BlankPlanes(const cv::Mat& share, const PlanarImage& image, const BlankPlaneSettings& settings,
              cv::Mat& disparity, cv::Mat& confidence)
      : image_(image), settings_(settings), disparity_(disparity), confidence_(confidence),
        blank_(share < settings.below_share), held_(cv::Mat::zeros(disparity.size(), CV_8UC1))
  {
  }

  cv::Mat run()
  {
    cv::Mat labels;
    cv::Mat statistics;
    cv::Mat centres;
    const int regions = cv::connectedComponentsWithStats(blank_, labels, statistics, centres, 4, CV_32S);
    for (int region = 1; region < regions; ++region)  // 0 is what is not blank
    {
      if (statistics.at<int>(region, cv::CC_STAT_AREA) >= settings_.min_cells)
      {
        const cv::Rect box(
            statistics.at<int>(region, cv::CC_STAT_LEFT), statistics.at<int>(region, cv::CC_STAT_TOP),
            statistics.at<int>(region, cv::CC_STAT_WIDTH), statistics.at<int>(region, cv::CC_STAT_HEIGHT));
        hold(labels == region, box);
      }
    }
    return held_;
  }

private:
  /// Calls for all pixels of the marked cells.
  template <typename ForPixel>
  void forPixels(const cv::Mat& cells, const cv::Rect& box, const ForPixel& for_pixel) const
  {
    for (int y = box.y * CELL_PX; y < std::min((box.y + box.height) * CELL_PX, disparity_.rows); ++y)
    {
      for (int x = box.x * CELL_PX; x < std::min((box.x + box.width) * CELL_PX, disparity_.cols); ++x)
      {
        if (cells.at<std::uint8_t>(y / CELL_PX, x / CELL_PX) != 0)
        {
          for_pixel(x, y);
        }
      }
    }
  }

  /// @param region CV_8UC1, its cells  @param box about them
  void hold(const cv::Mat& region, const cv::Rect& box)
  {
    ColourSum colour(image_);
    forPixels(region, box, [&](int x, int y) { colour.add(x, y); });
    if (colour.deviation() > settings_.max_shading_levels)
    {
      return;
    }
    const std::optional<FittedPlane> fitted = planeAround(region, box, colour);
    if (!fitted)
    {
      return;
    }
    forPixels(region, box,
              [&](int x, int y)
              {
                if (colour.isLike(x, y, settings_.max_difference_levels) &&
                    fitted->leverage(x, y) <= settings_.max_leverage)
                {
                  disparity_.at<float>(y, x) = static_cast<float>(fitted->plane.at(x, y));
                  float& confidence = confidence_.at<float>(y, x);
                  confidence = std::max(confidence, settings_.confidence);
                  held_.at<std::uint8_t>(y, x) = HELD;
                }
              });
  }

  /// Of what is known around a region and has its colour.
  std::optional<FittedPlane> planeAround(const cv::Mat& region, const cv::Rect& box,
                                         const ColourSum& colour) const
  {
    const int reach = settings_.reach_cells;
    cv::Mat around;
    cv::dilate(region, around, cv::Mat::ones(2 * reach + 1, 2 * reach + 1, CV_8UC1));
    around.setTo(0, blank_);
    const cv::Rect box_around =
        cv::Rect(box.x - reach, box.y - reach, box.width + 2 * reach, box.height + 2 * reach) &
        cv::Rect({}, region.size());
    std::vector<cv::Vec3d> like;
    std::size_t known = 0;
    forPixels(around, box_around,
              [&](int x, int y)
              {
                if (confidence_.at<float>(y, x) >= settings_.min_confidence)
                {
                  ++known;
                  if (colour.isLike(x, y, settings_.max_difference_levels))
                  {
                    like.emplace_back(x, y, disparity_.at<float>(y, x));
                  }
                }
              });
    if (like.size() < MIN_KNOWN ||
        static_cast<double>(like.size()) < settings_.min_like * static_cast<double>(known))
    {
      return std::nullopt;
    }
    const std::size_t step = (like.size() + MAX_KNOWN - 1) / MAX_KNOWN;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < like.size(); i += step)
    {
      like[kept++] = like[i];
    }
    like.resize(kept);
    return fitPlane(like, settings_);
  }

  const PlanarImage& image_;
  const BlankPlaneSettings& settings_;
  cv::Mat& disparity_;
  cv::Mat& confidence_;
  cv::Mat blank_;
  cv::Mat held_;
};

}  // namespace

cv::Mat holdBlankPlanes(const cv::Mat& share, const PlanarImage& image, const BlankPlaneSettings& settings,
                        cv::Mat& disparity, cv::Mat& confidence)
{
  return BlankPlanes(share, image, settings, disparity, confidence).run();
}

}  // namespace light_field_depth::multiview
