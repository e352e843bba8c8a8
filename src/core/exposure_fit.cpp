#include "exposure_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace light_field_depth
{
namespace
{
/// Fewer pairs tell nothing.
constexpr std::size_t LEAST_PAIRS = 64;

double shadingAt(const ViewExposure& exposure, const BrightnessPair& pair)
{
  return 1.0 + exposure.shading.dot(shadingTerms(pair.place[0], pair.place[1]));
}

double corrected(const ViewExposure& exposure, const BrightnessPair& pair, int channel)
{
  return exposure.gain[channel] * shadingAt(exposure, pair) * pair.other[channel] + exposure.offset[channel];
}

/// gain = ratio of the standard deviations: unlike a regression it is not drawn towards zero by pairs that
/// are a little displaced.
void fitGain(const std::vector<BrightnessPair>& pairs, int channel, ViewExposure& exposure)
{
  constexpr double LEAST_VARIANCE = 9.0;
  cv::Vec2d sum(0.0, 0.0);
  cv::Vec2d square_sum(0.0, 0.0);
  for (const BrightnessPair& pair : pairs)
  {
    const cv::Vec2d values(pair.reference[channel], shadingAt(exposure, pair) * pair.other[channel]);
    sum += values;
    square_sum += values.mul(values);
  }
  const cv::Vec2d mean = sum / static_cast<double>(pairs.size());
  const cv::Vec2d variance = square_sum / static_cast<double>(pairs.size()) - mean.mul(mean);
  const bool contrast = std::min(variance[0], variance[1]) > LEAST_VARIANCE;
  exposure.gain[channel] = contrast ? std::sqrt(variance[0] / variance[1]) : 1.0;
  exposure.offset[channel] = mean[0] - exposure.gain[channel] * mean[1];
}

/// Adds to the shading what linear least squares over all channels find, beside a gain and an offset of their
/// own, drawn towards none.
void fitShading(const std::vector<BrightnessPair>& pairs, int channels, ViewExposure& exposure)
{
  /// As much evidence for no shading as this many pairs would be, each with full brightness at a corner.
  constexpr double PRIOR_PAIRS = 0.5;
  using Terms = cv::Vec<double, 5>;
  cv::Matx<double, 5, 5> normal = cv::Matx<double, 5, 5>::zeros();
  Terms right = Terms::all(0.0);
  double power = 0.0;
  for (const BrightnessPair& pair : pairs)
  {
    double value = 0.0;
    double misfit = 0.0;
    for (int channel = 0; channel < channels; ++channel)
    {
      value += exposure.gain[channel] * pair.other[channel] / channels;
      misfit += (pair.reference[channel] - corrected(exposure, pair, channel)) / channels;
    }
    const cv::Vec3d shape = value * shadingTerms(pair.place[0], pair.place[1]);
    const Terms terms(shape[0], shape[1], shape[2], value, 1.0);
    normal += terms * terms.t();
    right += misfit * terms;
    power += value * value;
  }
  const double prior = PRIOR_PAIRS * power / static_cast<double>(pairs.size());
  for (int i = 0; i < 3; ++i)
  {
    normal(i, i) += prior;
    right[i] -= prior * exposure.shading[i];
  }
  const Terms found = normal.solve(right, cv::DECOMP_CHOLESKY);
  exposure.shading += cv::Vec3d(found[0], found[1], found[2]);
}

void fit(const std::vector<BrightnessPair>& pairs, int channels, ViewExposure& exposure)
{
  fitShading(pairs, channels, exposure);
  for (int channel = 0; channel < channels; ++channel)
  {
    fitGain(pairs, channel, exposure);
  }
}

/// Mean over the channels.
double misfitOf(const ViewExposure& exposure, const BrightnessPair& pair, int channels)
{
  double sum = 0.0;
  for (int channel = 0; channel < channels; ++channel)
  {
    sum += std::abs(pair.reference[channel] - corrected(exposure, pair, channel));
  }
  return sum / channels;
}

/// The misfits in the order of the pairs.
std::vector<double> misfitsOf(const ViewExposure& exposure, const std::vector<BrightnessPair>& pairs,
                              int channels)
{
  std::vector<double> misfits(pairs.size());
  std::transform(pairs.begin(), pairs.end(), misfits.begin(),
                 [&](const BrightnessPair& pair) { return misfitOf(exposure, pair, channels); });
  return misfits;
}

/// The misfit that this fraction of them does not exceed.
double quantile(std::vector<double> misfits, double fraction)
{
  const auto place =
      misfits.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(misfits.size() - 1));
  std::nth_element(misfits.begin(), place, misfits.end());
  return *place;
}

void leaveOutWorst(const ViewExposure& exposure, int channels, double kept_fraction,
                   std::vector<BrightnessPair>& pairs)
{
  const std::vector<double> misfits = misfitsOf(exposure, pairs, channels);
  const double most = quantile(misfits, kept_fraction);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    if (misfits[i] <= most)
    {
      pairs[kept++] = pairs[i];
    }
  }
  pairs.resize(kept);
}

double rootMeanSquareChange(const ViewExposure& exposure, const std::vector<BrightnessPair>& pairs,
                            int channels)
{
  double sum = 0.0;
  for (const BrightnessPair& pair : pairs)
  {
    for (int channel = 0; channel < channels; ++channel)
    {
      const double change = corrected(exposure, pair, channel) - pair.other[channel];
      sum += change * change;
    }
  }
  return std::sqrt(sum / static_cast<double>(pairs.size() * static_cast<std::size_t>(channels)));
}

/// Whether the pairs speak for it: it changes something, and they fit clearly better with it. Where matches
/// are wrong, a fit finds some exposure as well, but one that helps the typical pair little.
bool isClear(const ViewExposure& exposure, const std::vector<BrightnessPair>& pairs, int channels)
{
  constexpr double LEAST_CHANGE = 0.5;
  constexpr double MOST_OF_MISFIT = 0.7;
  constexpr double MEDIAN = 0.5;
  const double misfit = quantile(misfitsOf(exposure, pairs, channels), MEDIAN);
  const double without = quantile(misfitsOf(ViewExposure{}, pairs, channels), MEDIAN);
  return misfit < MOST_OF_MISFIT * without && rootMeanSquareChange(exposure, pairs, channels) > LEAST_CHANGE;
}

}  // namespace

ViewExposure fitExposure(const std::vector<BrightnessPair>& pairs, int channels)
{
  constexpr int ROUNDS = 3;
  constexpr double KEPT_FRACTION_OF_ROUND = 0.8;
  ViewExposure exposure;
  if (pairs.size() < LEAST_PAIRS)
  {
    return exposure;
  }
  fit(pairs, channels, exposure);
  std::vector<BrightnessPair> fitting = pairs;
  for (int round = 0; round < ROUNDS && fitting.size() > LEAST_PAIRS; ++round)
  {
    leaveOutWorst(exposure, channels, KEPT_FRACTION_OF_ROUND, fitting);
    fit(fitting, channels, exposure);
  }
  exposure.differs = isClear(exposure, pairs, channels);
  return exposure.differs ? exposure : ViewExposure{};
}

}  // namespace light_field_depth
