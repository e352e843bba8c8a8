#include "core/paper2017/feature_flow.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include <opencv2/imgproc.hpp>

#include "core/paper2017/disparity_paths.h"

namespace light_field_depth
{
namespace
{
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 32;
/// Weight below which a value is known by no match.
constexpr float UNKNOWN_WEIGHT = 1e-6F;
/// G*(n) at which the confidence is one half. Most matches weigh little, and a few of them in reach suffice.
constexpr double HALF_CONFIDENCE_WEIGHT = 0.05;
/// Given to every pixel without a match, with the view's mean disparity: keeps the recursions away from
/// denormal numbers, which are slow, and is too small to be known.
constexpr float FLOOR_WEIGHT = 1e-9F;

WeightedValues weightedValues(const SparseDisparity& sparse)
{
  const double total = cv::sum(sparse.confidence)[0];
  const double mean = total > 0.0 ? sparse.disparity.dot(sparse.confidence) / total : 0.0;
  WeightedValues values;
  values.weighted = sparse.disparity.mul(sparse.confidence) + mean * FLOOR_WEIGHT;
  values.weight = sparse.confidence + static_cast<double>(FLOOR_WEIGHT);
  return values;
}

DenseDisparity normalized(const WeightedValues& values)
{
  DenseDisparity dense;
  dense.disparity = values.weighted / values.weight;
  dense.confidence = values.weight / (values.weight + HALF_CONFIDENCE_WEIGHT);
  dense.confidence.setTo(0.0, values.weight < UNKNOWN_WEIGHT);
  return dense;
}

/// One view takes part of its neighbour's values along the links.
void mixAlongPaths(const cv::Mat& image, const cv::Mat& neighbour_image,
                   const std::vector<std::int32_t>& links, const FeedbackTable& table,
                   const WeightedValues& neighbour, WeightedValues& values, int first_row, int last_row)
{
  const int channels = image.channels();
  const int width = image.cols;
  const auto* const neighbour_colors = neighbour_image.ptr<std::uint8_t>();
  const auto* const from_weighted = neighbour.weighted.ptr<float>();
  const auto* const from_weight = neighbour.weight.ptr<float>();
  for (int y = first_row; y < last_row; ++y)
  {
    const auto* const color = image.ptr<std::uint8_t>(y);
    const std::int32_t* link = links.data() + static_cast<std::ptrdiff_t>(y) * width;
    auto* const weighted = values.weighted.ptr<float>(y);
    auto* const weight = values.weight.ptr<float>(y);
    for (int x = 0; x < width; ++x)
    {
      const std::int32_t from = link[x];
      if (from == PathLinks::NONE)
      {
        continue;
      }
      int difference = 0;
      for (int c = 0; c < channels; ++c)
      {
        difference += std::abs(color[x * channels + c] - neighbour_colors[from * channels + c]);
      }
      const float a = table[difference];
      weighted[x] += a * (from_weighted[from] - weighted[x]);
      weight[x] += a * (from_weight[from] - weight[x]);
    }
  }
}

/// Filters a volume in place.
class VolumeFilter
{
public:
  VolumeFilter(const std::vector<const View*>& views, const FeatureFlowOptions& options, ThreadPool& pool)
      : options_(options), pool_(pool), count_(static_cast<int>(views.size()))
  {
    for (const View* view : views)
    {
      images_.push_back(view->image.isContinuous() ? view->image : view->image.clone());
    }
    for (std::size_t i = 0; i + 1 < views.size(); ++i)
    {
      pairs_.push_back(pairOf(*views[i], *views[i + 1]));
    }
  }

  std::vector<DenseDisparity> run(const std::vector<SparseDisparity>& estimates,
                                  const std::vector<SparseDisparity>& forward,
                                  const std::vector<SparseDisparity>& backward);

private:
  void linkAll(int iteration, const std::vector<SparseDisparity>& forward,
               const std::vector<SparseDisparity>& backward);
  void filterAlongPaths(const FeedbackTable& table);
  void mixView(std::size_t into, std::size_t from, const std::vector<std::int32_t>& links,
               const FeedbackTable& table);

  const FeatureFlowOptions& options_;
  ThreadPool& pool_;
  int count_;
  std::vector<cv::Mat> images_;
  std::vector<ViewPair> pairs_;
  std::vector<WeightedValues> values_;
  std::vector<PathLinks> links_;
};

void VolumeFilter::linkAll(int iteration, const std::vector<SparseDisparity>& forward,
                           const std::vector<SparseDisparity>& backward)
{
  links_.resize(pairs_.size());
  pool_.parallelFor(0, static_cast<int>(pairs_.size()), 1,
                    [&](int first, int last)
                    {
                      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
                      {
                        const SparseDisparity& home = backward[i + 1];
                        if (iteration == 0)
                        {
                          links_[i] = linkPaths(pairs_[i], forward[i].disparity, forward[i].confidence,
                                                home.disparity, home.confidence);
                        }
                        else
                        {
                          const DenseDisparity dense = normalized(values_[i]);
                          links_[i] = linkPaths(pairs_[i], dense.disparity, dense.confidence, home.disparity,
                                                home.confidence);
                        }
                      }
                    });
}

void VolumeFilter::mixView(std::size_t into, std::size_t from, const std::vector<std::int32_t>& links,
                           const FeedbackTable& table)
{
  pool_.parallelFor(0, images_[into].rows, ROWS_PER_CHUNK,
                    [&](int first, int last) {
                      mixAlongPaths(images_[into], images_[from], links, table, values_[from], values_[into],
                                    first, last);
                    });
}

void VolumeFilter::filterAlongPaths(const FeedbackTable& table)
{
  for (std::size_t i = 0; i < pairs_.size(); ++i)
  {
    mixView(i + 1, i, links_[i].predecessor, table);
  }
  for (std::size_t i = pairs_.size(); i-- > 0;)
  {
    mixView(i, i + 1, links_[i].successor, table);
  }
}

std::vector<DenseDisparity> VolumeFilter::run(const std::vector<SparseDisparity>& estimates,
                                              const std::vector<SparseDisparity>& forward,
                                              const std::vector<SparseDisparity>& backward)
{
  const int channels = images_.front().channels();
  values_.resize(static_cast<std::size_t>(count_));
  const auto for_each_view = [&](const std::function<void(std::size_t)>& body)
  { pool_.parallelFor(0, count_, 1, [&](int view, int) { body(static_cast<std::size_t>(view)); }); };
  for_each_view([&](std::size_t i) { values_[i] = weightedValues(estimates[i]); });
  for (int iteration = 0; iteration < options_.iterations; ++iteration)
  {
    if (options_.angular)
    {
      linkAll(iteration, forward, backward);
    }
    const FeedbackTable spatial({options_.sigma_spatial_px, options_.sigma_range}, iteration,
                                options_.iterations, channels);
    for_each_view([&](std::size_t i) { filterSpatially(images_[i], spatial, values_[i]); });
    if (options_.angular)
    {
      filterAlongPaths(FeedbackTable({options_.sigma_angular_views, options_.sigma_angular_range}, iteration,
                                     options_.iterations, channels));
    }
  }
  std::vector<DenseDisparity> dense(values_.size());
  for_each_view([&](std::size_t i) { dense[i] = normalized(values_[i]); });
  return dense;
}

/// Every pixel takes the nearest match.
DenseDisparity nearestMatches(const SparseDisparity& sparse)
{
  DenseDisparity dense{sparse.disparity.clone(), sparse.confidence.clone()};
  const cv::Mat unmatched = sparse.confidence <= 0.0F;
  if (cv::countNonZero(unmatched) == static_cast<int>(unmatched.total()))
  {
    return dense;
  }
  cv::Mat distance;
  cv::Mat labels;
  cv::distanceTransform(unmatched, distance, labels, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  double label_count = 0.0;
  cv::minMaxIdx(labels, nullptr, &label_count);
  std::vector<float> of_label(static_cast<std::size_t>(label_count) + 1);
  for (int y = 0; y < labels.rows; ++y)
  {
    for (int x = 0; x < labels.cols; ++x)
    {
      if (unmatched.at<std::uint8_t>(y, x) == 0)
      {
        of_label[static_cast<std::size_t>(labels.at<int>(y, x))] = sparse.disparity.at<float>(y, x);
      }
    }
  }
  for (int y = 0; y < labels.rows; ++y)
  {
    for (int x = 0; x < labels.cols; ++x)
    {
      dense.disparity.at<float>(y, x) = of_label[static_cast<std::size_t>(labels.at<int>(y, x))];
    }
  }
  return dense;
}

}  // namespace

std::vector<DenseDisparity> featureFlow(const std::vector<const View*>& views,
                                        const std::vector<SparseDisparity>& estimates,
                                        const std::vector<SparseDisparity>& forward,
                                        const std::vector<SparseDisparity>& backward,
                                        const FeatureFlowOptions& options, ThreadPool& pool)
{
  if (options.enabled)
  {
    return VolumeFilter(views, options, pool).run(estimates, forward, backward);
  }
  std::vector<DenseDisparity> dense(views.size());
  pool.parallelFor(0, static_cast<int>(views.size()), 1,
                   [&](int view, int)
                   {
                     const auto i = static_cast<std::size_t>(view);
                     dense[i] = nearestMatches(estimates[i]);
                   });
  return dense;
}

std::vector<std::string> validate(const FeatureFlowOptions& options)
{
  std::vector<std::string> problems;
  const auto require_between = [&](double value, double least, double most, const std::string& name)
  {
    if (!(value >= least && value <= most))
    {
      problems.push_back(name + " is " + std::to_string(value) + "; it must be between " +
                         std::to_string(least) + " and " + std::to_string(most) + ".");
    }
  };
  require_between(options.sigma_spatial_px, 1.0, 1e5, "filter_sigma_spatial_px");
  require_between(options.sigma_range, 1e-3, 100.0, "filter_sigma_range");
  require_between(options.sigma_angular_views, 0.1, 1e4, "filter_sigma_angular_views");
  require_between(options.sigma_angular_range, 1e-3, 100.0, "filter_sigma_angular_range");
  require_between(options.iterations, 1, 10, "filter_iterations");
  return problems;
}

}  // namespace light_field_depth
