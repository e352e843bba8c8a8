#include "core/preprocess/exposure_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>

namespace light_field_depth
{
namespace
{
/// Fewer pairs tell nothing.
constexpr std::size_t MIN_PAIRS = 64;
constexpr double WHITE = 255.0;  // of 8 bits

using Column = std::vector<double>;

/// Of all elements. Always in the same order, so that sums do not depend on the processor; several at once,
/// so that additions need not wait for each other.
template <class Value>
double sumOf(std::size_t count, const Value& value)
{
  constexpr std::size_t LANES = 4;  // an addition takes about four cycles
  std::array<double, LANES> sums = {};
  std::size_t i = 0;
  for (; i + LANES <= count; i += LANES)
  {
    for (std::size_t lane = 0; lane < LANES; ++lane)
    {
      sums[lane] += value(i + lane);
    }
  }
  for (; i < count; ++i)
  {
    sums[0] += value(i);
  }
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

double sum(const Column& values)
{
  return sumOf(values.size(), [&](std::size_t i) { return values[i]; });
}

double dot(const Column& a, const Column& b)
{
  return sumOf(a.size(), [&](std::size_t i) { return a[i] * b[i]; });
}

/// The pairs with a column for each of their numbers, so that loops over pairs are quick.
struct PairTable
{
  PairTable(const std::vector<BrightnessPair>& pairs, int channels)
      : count(pairs.size()), reference(static_cast<std::size_t>(channels), Column(count)), other(reference)
  {
    terms.fill(Column(count));
    for (std::size_t i = 0; i < count; ++i)
    {
      for (int channel = 0; channel < channels; ++channel)
      {
        reference[static_cast<std::size_t>(channel)][i] = pairs[i].reference[channel];
        other[static_cast<std::size_t>(channel)][i] = pairs[i].other[channel];
      }
      const cv::Vec3d shape = shadingTerms(pairs[i].place[0], pairs[i].place[1]);
      for (int term = 0; term < 3; ++term)
      {
        terms.at(static_cast<std::size_t>(term))[i] = shape[term];
      }
    }
  }

  template <class Body>
  void forEachColumn(const Body& body)
  {
    for (std::vector<Column>* columns : {&reference, &other})
    {
      std::for_each(columns->begin(), columns->end(), body);
    }
    std::for_each(terms.begin(), terms.end(), body);
  }

  std::size_t count;
  std::vector<Column> reference;  ///< of each channel
  std::vector<Column> other;      ///< of each channel
  std::array<Column, 3> terms;    ///< shadingTerms()
};

/// 1 + shading at the place of each pair.
Column shadingAt(const ViewExposure& exposure, const PairTable& pairs)
{
  Column shading(pairs.count);
  for (std::size_t i = 0; i < pairs.count; ++i)
  {
    shading[i] = 1.0 + exposure.shading[0] * pairs.terms[0][i] + exposure.shading[1] * pairs.terms[1][i] +
                 exposure.shading[2] * pairs.terms[2][i];
  }
  return shading;
}

/// What is left of a channel's difference from the reference.
template <class Body>
void forEachMisfit(const ViewExposure& exposure, const PairTable& pairs, const Column& shading,
                   std::size_t channel, const Body& body)
{
  const double gain = exposure.gain[static_cast<int>(channel)];
  const double offset = exposure.offset[static_cast<int>(channel)];
  const double bend = exposure.bend[static_cast<int>(channel)] / WHITE;
  const Column& reference = pairs.reference[channel];
  const Column& other = pairs.other[channel];
  for (std::size_t i = 0; i < pairs.count; ++i)
  {
    body(i, reference[i] - ((gain * shading[i] + bend * other[i]) * other[i] + offset));
  }
}

/// gain = ratio of the standard deviations: unlike a regression it is not drawn towards zero by pairs that
/// are a little displaced.
void fitGain(const PairTable& pairs, const Column& shading, std::size_t channel, ViewExposure& exposure)
{
  constexpr double MIN_VARIANCE = 9.0;  // a deviation of three levels: less is noise
  const Column& reference = pairs.reference[channel];
  Column shaded(pairs.count);
  std::transform(shading.begin(), shading.end(), pairs.other[channel].begin(), shaded.begin(),
                 std::multiplies<>());
  const auto count = static_cast<double>(pairs.count);
  const cv::Vec2d mean = cv::Vec2d(sum(reference), sum(shaded)) / count;
  const cv::Vec2d variance =
      cv::Vec2d(dot(reference, reference), dot(shaded, shaded)) / count - mean.mul(mean);
  const bool contrast = std::min(variance[0], variance[1]) > MIN_VARIANCE;
  const double gain = contrast ? std::sqrt(variance[0] / variance[1]) : 1.0;
  exposure.gain[static_cast<int>(channel)] = gain;
  exposure.offset[static_cast<int>(channel)] = mean[0] - gain * mean[1];
}

/// Adds to the shading what linear least squares over all channels find, beside a gain and an offset of their
/// own, drawn towards none.
void fitShading(const PairTable& pairs, ViewExposure& exposure)
{
  /// As much evidence for no shading as this many pairs would be, each with full brightness at a corner.
  constexpr double PRIOR_PAIRS = 0.5;
  constexpr int TERMS = 5;  // three of the shading, gain and offset
  const std::size_t channels = pairs.reference.size();
  const double share = 1.0 / static_cast<double>(channels);
  const Column shading = shadingAt(exposure, pairs);
  std::array<Column, TERMS> terms;  // the shape of the shading, the gain and the offset
  terms.fill(Column(pairs.count, 0.0));
  Column misfit(pairs.count, 0.0);
  Column& value = terms[TERMS - 2];
  terms[TERMS - 1].assign(pairs.count, 1.0);
  for (std::size_t channel = 0; channel < channels; ++channel)
  {
    const double gain = share * exposure.gain[static_cast<int>(channel)];
    const Column& other = pairs.other[channel];
    std::transform(value.begin(), value.end(), other.begin(), value.begin(),
                   [=](double before, double level) { return before + gain * level; });
    forEachMisfit(exposure, pairs, shading, channel,
                  [&](std::size_t i, double difference) { misfit[i] += share * difference; });
  }
  for (std::size_t term = 0; term < pairs.terms.size(); ++term)
  {
    std::transform(value.begin(), value.end(), pairs.terms.at(term).begin(), terms.at(term).begin(),
                   std::multiplies<>());
  }
  cv::Matx<double, TERMS, TERMS> normal;
  cv::Vec<double, TERMS> right;
  for (int i = 0; i < TERMS; ++i)
  {
    const Column& row = terms.at(static_cast<std::size_t>(i));
    right[i] = dot(row, misfit);
    for (int j = 0; j <= i; ++j)
    {
      normal(i, j) = normal(j, i) = dot(row, terms.at(static_cast<std::size_t>(j)));
    }
  }
  const double prior = PRIOR_PAIRS * dot(value, value) / static_cast<double>(pairs.count);
  for (int i = 0; i < 3; ++i)
  {
    normal(i, i) += prior;
    right[i] -= prior * exposure.shading[i];
  }
  const cv::Vec<double, TERMS> found = normal.solve(right, cv::DECOMP_CHOLESKY);
  exposure.shading += cv::Vec3d(found[0], found[1], found[2]);
}

void fit(const PairTable& pairs, ViewExposure& exposure)
{
  fitShading(pairs, exposure);
  const Column shading = shadingAt(exposure, pairs);
  for (std::size_t channel = 0; channel < pairs.reference.size(); ++channel)
  {
    fitGain(pairs, shading, channel, exposure);
  }
}

/// The mean over the channels, in the order of the pairs.
Column misfitsOf(const ViewExposure& exposure, const PairTable& pairs)
{
  const double share = 1.0 / static_cast<double>(pairs.reference.size());
  const Column shading = shadingAt(exposure, pairs);
  Column misfits(pairs.count, 0.0);
  for (std::size_t channel = 0; channel < pairs.reference.size(); ++channel)
  {
    forEachMisfit(exposure, pairs, shading, channel,
                  [&](std::size_t i, double difference) { misfits[i] += share * std::abs(difference); });
  }
  return misfits;
}

/// The misfit that this fraction of them does not exceed.
double quantile(Column misfits, double fraction = 0.5)
{
  const auto place =
      misfits.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(misfits.size() - 1));
  std::nth_element(misfits.begin(), place, misfits.end());
  return *place;
}

void leaveOutWorst(const ViewExposure& exposure, double kept_fraction, PairTable& pairs)
{
  const Column misfits = misfitsOf(exposure, pairs);
  const double most = quantile(misfits, kept_fraction);
  std::vector<std::size_t> kept;
  kept.reserve(pairs.count);
  for (std::size_t i = 0; i < pairs.count; ++i)
  {
    if (misfits[i] <= most)
    {
      kept.push_back(i);
    }
  }
  pairs.forEachColumn(
      [&](Column& column)
      {
        std::transform(kept.begin(), kept.end(), column.begin(), [&](std::size_t i) { return column[i]; });
        column.resize(kept.size());
      });
  pairs.count = kept.size();
}

double rootMeanSquareChange(const ViewExposure& exposure, const PairTable& pairs)
{
  const Column shading = shadingAt(exposure, pairs);
  double sum = 0.0;
  for (std::size_t channel = 0; channel < pairs.reference.size(); ++channel)
  {
    const double gain = exposure.gain[static_cast<int>(channel)];
    const double offset = exposure.offset[static_cast<int>(channel)];
    const double bend = exposure.bend[static_cast<int>(channel)] / WHITE;
    const Column& other = pairs.other[channel];
    sum += sumOf(pairs.count,
                 [&](std::size_t i)
                 {
                   const double change = (gain * shading[i] + bend * other[i]) * other[i] + offset - other[i];
                   return change * change;
                 });
  }
  return std::sqrt(sum / static_cast<double>(pairs.count * pairs.reference.size()));
}

/// Whether the pairs speak for it: it changes something, and they fit clearly better with it. Where matches
/// are wrong, a fit finds some exposure as well, but one that helps the typical pair little.
bool isClear(const ViewExposure& exposure, const PairTable& pairs)
{
  constexpr double MIN_CHANGE = 0.5;           // levels: less is lost in rounding
  constexpr double MAX_SHARE_OF_MISFIT = 0.7;  // set by hand
  return rootMeanSquareChange(exposure, pairs) > MIN_CHANGE &&
         quantile(misfitsOf(exposure, pairs)) <
             MAX_SHARE_OF_MISFIT * quantile(misfitsOf(ViewExposure{}, pairs));
}

/// Offset, gain and bend of a channel by least squares, the bend drawn towards none.
void fitCurve(const PairTable& pairs, const Column& shading, std::size_t channel, ViewExposure& exposure)
{
  /// As much evidence for a line as this many pairs would be, each of full brightness.
  constexpr double PRIOR_PAIRS = 0.05;
  const Column& reference = pairs.reference[channel];
  const Column& other = pairs.other[channel];
  std::array<Column, 3> terms;
  terms[0].assign(pairs.count, 1.0);
  terms[1].resize(pairs.count);
  terms[2].resize(pairs.count);
  std::transform(shading.begin(), shading.end(), other.begin(), terms[1].begin(), std::multiplies<>());
  std::transform(other.begin(), other.end(), terms[2].begin(),
                 [](double level) { return level * level / WHITE; });
  cv::Matx33d normal;
  cv::Vec3d right;
  for (int i = 0; i < 3; ++i)
  {
    const Column& row = terms.at(static_cast<std::size_t>(i));
    right[i] = dot(row, reference);
    for (int j = 0; j <= i; ++j)
    {
      normal(i, j) = normal(j, i) = dot(row, terms.at(static_cast<std::size_t>(j)));
    }
  }
  normal(2, 2) += PRIOR_PAIRS * WHITE * WHITE;
  const cv::Vec3d found = normal.solve(right, cv::DECOMP_CHOLESKY);
  const int c = static_cast<int>(channel);
  exposure.offset[c] = found[0];
  exposure.gain[c] = found[1];
  exposure.bend[c] = found[2];
}

/// Brighter stays brighter.
bool isRising(const ViewExposure& exposure, std::size_t channels)
{
  constexpr double LEAST_SLOPE = 0.05;  // of a tone curve that still tells levels apart
  for (int channel = 0; channel < static_cast<int>(channels); ++channel)
  {
    const double at_black = exposure.gain[channel];
    const double at_white = at_black + 2.0 * exposure.bend[channel];
    if (!(std::min(at_black, at_white) > LEAST_SLOPE))
    {
      return false;
    }
  }
  return true;
}

/// A curve for the same pairs, beginning with a line through them.
ViewExposure bent(const PairTable& pairs, const ViewExposure& line)
{
  // Set by hand: of two cameras many points are matched wrongly, and each round begins again with all of
  // them.
  constexpr int ROUNDS = 5;
  constexpr double KEPT_FRACTION = 0.6;
  ViewExposure curve = line;
  PairTable fitting = pairs;
  for (int round = 0; round < ROUNDS && fitting.count > MIN_PAIRS / 2; ++round)
  {
    fitShading(fitting, curve);
    const Column shading = shadingAt(curve, fitting);
    for (std::size_t channel = 0; channel < pairs.reference.size(); ++channel)
    {
      fitCurve(fitting, shading, channel, curve);
    }
    fitting = pairs;
    leaveOutWorst(curve, KEPT_FRACTION, fitting);
  }
  return curve;
}

/// The curve instead of the line, where it fits clearly better.
ViewExposure bentWhereNeeded(const PairTable& pairs, const ViewExposure& line)
{
  constexpr double MAX_SHARE_OF_MISFIT = 0.9;  // set by hand: a curve bends to noise as well
  ViewExposure curve = bent(pairs, line);
  curve.differs = isRising(curve, pairs.reference.size()) && isClear(curve, pairs);
  const bool better = !line.differs || quantile(misfitsOf(curve, pairs)) <
                                           MAX_SHARE_OF_MISFIT * quantile(misfitsOf(line, pairs));
  return curve.differs && better ? curve : line;
}

}  // namespace

ViewExposure fitExposure(const std::vector<BrightnessPair>& pairs, int channels, ExposureModel model)
{
  // Set by hand: half of the pairs are left, as where half of the matches are wrong.
  constexpr int ROUNDS = 3;
  constexpr double KEPT_FRACTION_OF_ROUND = 0.8;
  ViewExposure exposure;
  if (pairs.size() < MIN_PAIRS)
  {
    return exposure;
  }
  const PairTable table(pairs, channels);
  fit(table, exposure);
  PairTable fitting = table;
  for (int round = 0; round < ROUNDS && fitting.count > MIN_PAIRS; ++round)
  {
    leaveOutWorst(exposure, KEPT_FRACTION_OF_ROUND, fitting);
    fit(fitting, exposure);
  }
  exposure.differs = isClear(exposure, table);
  if (model == ExposureModel::Curve)
  {
    exposure = bentWhereNeeded(table, exposure);
  }
  return exposure.differs ? exposure : ViewExposure{};
}

}  // namespace light_field_depth
