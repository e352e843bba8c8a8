#include "core/preprocess/exposure_fit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace light_field_depth
{
namespace
{
constexpr int PAIRS = 400;

/// What the other view shows for what the reference shows, by the model of ViewExposure.
template <class Other>
std::vector<BrightnessPair> pairsOf(const Other& other_of)
{
  std::vector<BrightnessPair> pairs;
  cv::RNG random(5);
  for (int i = 0; i < PAIRS; ++i)
  {
    BrightnessPair pair;
    pair.place = {random.uniform(-0.7F, 0.7F), random.uniform(-0.7F, 0.7F)};
    for (int channel = 0; channel < 3; ++channel)
    {
      pair.reference[channel] = random.uniform(30.0F, 220.0F);
      pair.other[channel] = other_of(pair.reference[channel], pair.place, channel);
    }
    pairs.push_back(pair);
  }
  return pairs;
}

float unchanged(float value, const cv::Vec2f& /*place*/, int /*channel*/)
{
  return value;
}

/// Mean difference from the reference that is left in a channel.
double misfit(const ViewExposure& exposure, const std::vector<BrightnessPair>& pairs)
{
  double sum = 0.0;
  for (const BrightnessPair& pair : pairs)
  {
    const double value = pair.other[0];
    const double shading = 1.0 + exposure.shading.dot(shadingTerms(pair.place[0], pair.place[1]));
    sum += std::abs(exposure.gain[0] * shading * value + exposure.offset[0] +
                    exposure.bend[0] * value * value / 255.0 - pair.reference[0]);
  }
  return sum / static_cast<double>(pairs.size());
}

TEST(ExposureFit, FindsGainAndOffsetOfEachChannel)
{
  const cv::Vec3f gains(1.2F, 0.9F, 1.1F);
  const cv::Vec3f offsets(-6.0F, 4.0F, 0.0F);
  const ViewExposure found = fitExposure(pairsOf([&](float value, const cv::Vec2f& /*place*/, int channel)
                                                 { return (value - offsets[channel]) / gains[channel]; }),
                                         3);
  ASSERT_TRUE(found.differs);
  for (int channel = 0; channel < 3; ++channel)
  {
    EXPECT_NEAR(found.gain[channel], gains[channel], 0.003);
    EXPECT_NEAR(found.offset[channel], offsets[channel], 0.3);
  }
  EXPECT_EQ(found.bend, cv::Vec3d());
  EXPECT_NEAR(cv::norm(found.shading), 0.0, 0.005);
}

TEST(ExposureFit, AQuarterOfWrongMatchesChangesLittle)
{
  int i = 0;
  const ViewExposure found = fitExposure(pairsOf(
                                             [&](float value, const cv::Vec2f& /*place*/, int channel)
                                             {
                                               const bool wrong = (i += channel == 0 ? 1 : 0) % 4 == 0;
                                               return wrong ? 250.0F - value : value / 1.25F;
                                             }),
                                         3);
  ASSERT_TRUE(found.differs);
  EXPECT_NEAR(found.gain[1], 1.25, 0.02);
  EXPECT_NEAR(found.offset[1], 0.0, 2.0);
}

TEST(ExposureFit, FindsShading)
{
  const cv::Vec3d shading(0.1, -0.05, 0.3);
  const std::vector<BrightnessPair> pairs =
      pairsOf([&](float value, const cv::Vec2f& place, int /*channel*/)
              { return value / static_cast<float>(1.0 + shading.dot(shadingTerms(place[0], place[1]))); });
  const ViewExposure found = fitExposure(pairs, 3);
  ASSERT_TRUE(found.differs);
  // Gain and the square term explain much of each other, so that neither is exact.
  EXPECT_LT(misfit(found, pairs), 0.2 * misfit(ViewExposure{}, pairs));
  EXPECT_NEAR(found.shading[0], shading[0], 0.02);
  EXPECT_NEAR(found.shading[1], shading[1], 0.02);
}

TEST(ExposureFit, FindsABendWhereItIsAllowed)
{
  const double bend = -0.3;
  const auto other = [&](float value, const cv::Vec2f& /*place*/, int /*channel*/)
  {
    // value = 1.2 * x + bend * x^2 / 255, solved for x.
    const double a = bend / 255.0;
    return static_cast<float>((-1.2 + std::sqrt(1.2 * 1.2 + 4.0 * a * value)) / (2.0 * a));
  };
  const std::vector<BrightnessPair> pairs = pairsOf(other);
  const ViewExposure curve = fitExposure(pairs, 3, ExposureModel::Curve);
  ASSERT_TRUE(curve.differs);
  EXPECT_NEAR(curve.gain[0], 1.2, 0.05);
  EXPECT_NEAR(curve.bend[0], bend, 0.05);
  const ViewExposure best_line = fitExposure(pairs, 3);
  EXPECT_EQ(best_line.bend, cv::Vec3d());
  EXPECT_LT(misfit(curve, pairs), 0.3 * misfit(best_line, pairs));
  const ViewExposure line = fitExposure(
      pairsOf([](float value, const cv::Vec2f& /*place*/, int /*channel*/) { return value / 1.2F; }), 3,
      ExposureModel::Curve);
  EXPECT_EQ(line.bend, cv::Vec3d()) << "a line fits as well";
}

TEST(ExposureFit, NeutralWhereNothingSpeaksForAChange)
{
  EXPECT_FALSE(fitExposure(pairsOf(unchanged), 3).differs);
  cv::RNG random(9);
  const std::vector<BrightnessPair> unrelated =
      pairsOf([&](float /*value*/, const cv::Vec2f& /*place*/, int /*channel*/)
              { return random.uniform(30.0F, 220.0F); });
  EXPECT_FALSE(fitExposure(unrelated, 3).differs) << "the typical pair fits no better with any exposure";
  std::vector<BrightnessPair> few =
      pairsOf([](float value, const cv::Vec2f& /*place*/, int /*channel*/) { return value / 1.5F; });
  EXPECT_TRUE(fitExposure(few, 1).differs);
  few.resize(63);
  EXPECT_FALSE(fitExposure(few, 1).differs);
  EXPECT_EQ(fitExposure(few, 1).gain, cv::Vec3d(1, 1, 1));
}

}  // namespace
}  // namespace light_field_depth
