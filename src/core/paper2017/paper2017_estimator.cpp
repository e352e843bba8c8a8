#include "core/paper2017/paper2017_estimator.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/light_field/spread_views.h"
#include "core/paper2017/dense_flow.h"
#include "core/paper2017/disparity_fusion.h"
#include "core/paper2017/volume_matches.h"
#include "light_field_depth/core/enum_names.h"

namespace light_field_depth
{
namespace
{
/// Shares: milliseconds of the demo on two threads.
std::vector<ExpectedStage> expectedStages()
{
  return {{"descriptors", 140.0},
          {"matching", 350.0},
          {"feature_flow", 185.0},
          {"fusion", 40.0},
          {"variational", 150.0}};
}

constexpr EnumNames<Paper2017Parameters, 2> PARAMETERS_NAMES = {{
    {Paper2017Parameters::Tuned, "tuned"},
    {Paper2017Parameters::Published, "published"},
}};
constexpr EnumNames<FlowInitializer, 5> INITIALIZER_NAMES = {{
    {FlowInitializer::Cpm, "cpm"},
    {FlowInitializer::Dis, "dis"},
    {FlowInitializer::EpicFlow, "epicflow"},
    {FlowInitializer::DeepFlow, "deepflow"},
    {FlowInitializer::PcaFlow, "pcaflow"},
}};
constexpr EnumNames<MatchDirections, 2> DIRECTIONS_NAMES = {{
    {MatchDirections::Forward, "forward"},
    {MatchDirections::Both, "both"},
}};

/// The mean of two matches of one pixel, weighted by their confidence, or the one that there is.
SparseDisparity combined(const SparseDisparity& a, const SparseDisparity& b)
{
  SparseDisparity result;
  const cv::Mat total = a.confidence + b.confidence;
  result.disparity = (a.disparity.mul(a.confidence) + b.disparity.mul(b.confidence)) / total;
  result.disparity.setTo(0.0, total <= 0.0);
  result.confidence = cv::max(a.confidence, b.confidence);
  return result;
}

/// What is diffused in each view. The last view has no next one, so it takes the matches with its previous.
std::vector<SparseDisparity> estimatesOf(const VolumeMatches& matches, MatchDirections directions)
{
  std::vector<SparseDisparity> estimates = matches.forward;
  estimates.back() = matches.backward.back();
  if (directions == MatchDirections::Both)
  {
    for (std::size_t i = 1; i + 1 < estimates.size(); ++i)
    {
      estimates[i] = combined(matches.forward[i], matches.backward[i]);
    }
  }
  return estimates;
}

/// The range of all but a few values, so that single outliers do not count.
DisparityRange rangeOf(const cv::Mat& disparity)
{
  // Set by hand; the range is told to the user and to the colours of an image only.
  constexpr double OUTLIERS_PER_SIDE = 0.001;
  constexpr float NARROWEST_PX = 0.01F;
  std::vector<float> values(disparity.begin<float>(), disparity.end<float>());
  const auto rank = static_cast<std::ptrdiff_t>(OUTLIERS_PER_SIDE * static_cast<double>(values.size()));
  const auto low = values.begin() + rank;
  const auto high = values.end() - 1 - rank;
  std::nth_element(values.begin(), low, values.end());
  const float minimum = *low;
  std::nth_element(values.begin(), high, values.end());
  return {minimum, std::max(*high, minimum + NARROWEST_PX)};
}

std::string mapName(const std::string& stage, const AngularVolume& volume, std::size_t place)
{
  return stage + "_" + volume.name + "_view_" + std::to_string(place);
}

/// A view's own map, taking the refined disparity where that agrees. What the reference view does not see
/// keeps the view's own estimate.
cv::Mat withRefined(const cv::Mat& own, const cv::Mat& refined)
{
  // Set by hand: what the refinement moves on one surface, and less than what lies between two. It decides
  // about the maps of the other views only.
  constexpr float AGREEMENT_PX = 0.25F;
  cv::Mat result = own.clone();
  for (int y = 0; y < own.rows; ++y)
  {
    for (int x = 0; x < own.cols; ++x)
    {
      const float value = refined.at<float>(y, x);
      if (std::abs(value - own.at<float>(y, x)) < AGREEMENT_PX)
      {
        result.at<float>(y, x) = value;
      }
    }
  }
  return result;
}

/// One run of the method.
class Run
{
public:
  Run(const LightField& light_field, const EstimateRequest& request, const Paper2017Options& options,
      RunContext& context)
      : light_field_(toEightBit(light_field)), request_(request), options_(options), context_(context),
        volumes_(extractVolumes(light_field_, request.views, options.volumes))
  {
  }

  DisparityEstimate estimate();

private:
  void diffuse(const std::vector<VolumeMatches>& matches);
  FusedDisparity fuse();
  cv::Mat refine(const cv::Mat& disparity);
  std::vector<std::size_t> usedViews() const;
  std::vector<ViewDisparity> viewDisparities(const DenseDisparity& reference) const;
  ViewDisparity viewDisparity(std::size_t index, const DenseDisparity& reference) const;

  LightField light_field_;
  const EstimateRequest& request_;
  const Paper2017Options& options_;
  RunContext& context_;
  std::vector<AngularVolume> volumes_;
  std::vector<std::vector<DenseDisparity>> dense_;  ///< by volume and view
};

void Run::diffuse(const std::vector<VolumeMatches>& matches)
{
  const StageTimer timer(context_, "feature_flow");
  for (std::size_t v = 0; v < volumes_.size(); ++v)
  {
    std::vector<const View*> views;
    for (const std::size_t index : volumes_[v].view_indices)
    {
      views.push_back(&light_field_.views[index]);
    }
    const std::vector<SparseDisparity> estimates = estimatesOf(matches[v], options_.match_directions);
    dense_.push_back(featureFlow(views, estimates, matches[v].forward, matches[v].backward,
                                 options_.feature_flow, context_.pool));
    for (std::size_t i = 0; i < estimates.size(); ++i)
    {
      context_.save(mapName("matches", volumes_[v], i), estimates[i].disparity);
      context_.save(mapName("feature_flow", volumes_[v], i), dense_.back()[i].disparity);
    }
  }
}

FusedDisparity Run::fuse()
{
  const StageTimer timer(context_, "fusion");
  std::vector<std::pair<std::size_t, std::size_t>> places;
  for (std::size_t v = 0; v < volumes_.size(); ++v)
  {
    for (std::size_t i = 0; i < dense_[v].size(); ++i)
    {
      places.emplace_back(v, i);
    }
  }
  std::vector<DenseDisparity> warped(places.size());
  context_.pool.parallelFor(0, static_cast<int>(places.size()), 1,
                            [&](int place, int)
                            {
                              const auto [v, i] = places[static_cast<std::size_t>(place)];
                              warped[static_cast<std::size_t>(place)] = warpToReference(
                                  dense_[v][i], light_field_.views[volumes_[v].view_indices[i]]);
                            });
  FusedDisparity fused = fuseByMedian(warped, context_.pool);
  context_.save("median", fused.disparity);
  return fused;
}

std::vector<std::size_t> Run::usedViews() const
{
  std::vector<std::size_t> views = {light_field_.reference_index};
  for (const AngularVolume& volume : volumes_)
  {
    views.insert(views.end(), volume.view_indices.begin(), volume.view_indices.end());
  }
  std::sort(views.begin(), views.end());
  views.erase(std::unique(views.begin(), views.end()), views.end());
  return views;
}

cv::Mat Run::refine(const cv::Mat& disparity)
{
  if (!options_.variational.enabled)
  {
    return disparity;
  }
  const StageTimer timer(context_, "variational");
  return refineDisparity(light_field_, refinementViews(light_field_, usedViews(), options_.variational.views),
                         disparity, options_.variational, context_.pool);
}

std::vector<ViewDisparity> Run::viewDisparities(const DenseDisparity& reference) const
{
  LightField used = light_field_;
  used.views.clear();
  std::vector<std::size_t> indices = usedViews();
  for (const std::size_t index : indices)
  {
    used.reference_index = index == light_field_.reference_index ? used.views.size() : used.reference_index;
    used.views.push_back(light_field_.views[index]);
  }
  std::vector<ViewDisparity> maps;
  for (const std::size_t chosen : spreadViews(used, request_.solved_maps))
  {
    maps.push_back(viewDisparity(indices[chosen], reference));
  }
  return maps;
}

ViewDisparity Run::viewDisparity(std::size_t index, const DenseDisparity& reference) const
{
  for (std::size_t v = 0; v < volumes_.size() && index != light_field_.reference_index; ++v)
  {
    const std::vector<std::size_t>& members = volumes_[v].view_indices;
    const auto place = std::find(members.begin(), members.end(), index);
    if (place != members.end())
    {
      const DenseDisparity& own = dense_[v][static_cast<std::size_t>(place - members.begin())];
      return {index,
              withRefined(own.disparity, warpFromReference(reference, light_field_.views[index]).disparity),
              own.confidence};
    }
  }
  return {light_field_.reference_index, reference.disparity, reference.confidence};
}

DisparityEstimate Run::estimate()
{
  context_.expect(expectedStages());
  diffuse(matchVolumes(light_field_, volumes_, request_.disparity_range, options_, context_));
  const FusedDisparity fused = fuse();
  DisparityEstimate estimate;
  estimate.disparity = refine(fused.disparity);
  estimate.confidence = fused.confidence;
  estimate.range = request_.disparity_range.value_or(rangeOf(estimate.disparity));
  estimate.views_used = usedViews().size();
  if (request_.solved_maps > 0)
  {
    const StageTimer timer(context_, "view_maps");
    estimate.view_disparities = viewDisparities({estimate.disparity, estimate.confidence});
  }
  return estimate;
}

}  // namespace

std::string toString(Paper2017Parameters parameters)
{
  return enumName(PARAMETERS_NAMES, parameters);
}

Paper2017Parameters paper2017ParametersFromString(const std::string& name)
{
  return enumValue(PARAMETERS_NAMES, name, "choice of parameters");
}

Paper2017Options withPublishedParameters(const Paper2017Options& options)
{
  Paper2017Options published = options;
  published.patch_match.levels = 5;
  published.patch_match.pyramid_ratio = 0.5;
  published.patch_match.grid_spacing_px = 3;
  published.patch_match.subpixel = false;
  published.patch_match.weigh_by_centre = false;
  published.patch_match.min_region_seeds = 1;
  published.feature_flow.sigma_spatial_px = 2000.0;
  published.feature_flow.sigma_range = 0.4;
  published.feature_flow.sigma_angular_views = 5.0;
  published.feature_flow.sigma_angular_range = 0.1;
  published.variational.edge_kappa = 5.0;
  published.variational.presmoothing_px = 1.0;
  return published;
}

std::string toString(FlowInitializer initializer)
{
  return enumName(INITIALIZER_NAMES, initializer);
}

FlowInitializer flowInitializerFromString(const std::string& name)
{
  return enumValue(INITIALIZER_NAMES, name, "initializer");
}

std::string toString(MatchDirections directions)
{
  return enumName(DIRECTIONS_NAMES, directions);
}

MatchDirections matchDirectionsFromString(const std::string& name)
{
  return enumValue(DIRECTIONS_NAMES, name, "choice of match directions");
}

std::vector<std::string> validate(const Paper2017Options& options)
{
  std::vector<std::string> problems = validate(options.volumes);
  for (auto more :
       {validate(options.patch_match), validate(options.feature_flow), validate(options.variational)})
  {
    std::move(more.begin(), more.end(), std::back_inserter(problems));
  }
  if (const std::optional<std::string> missing = whatIsMissingFor(options.initializer))
  {
    problems.push_back(*missing);
  }
  return problems;
}

Paper2017Estimator::Paper2017Estimator(Paper2017Options options) : options_(std::move(options)) {}

DisparityEstimate Paper2017Estimator::estimate(const LightField& light_field, const EstimateRequest& request,
                                               RunContext& context)
{
  const bool published = options_.parameters == Paper2017Parameters::Published;
  return Run(light_field, request, published ? withPublishedParameters(options_) : options_, context)
      .estimate();
}

}  // namespace light_field_depth
