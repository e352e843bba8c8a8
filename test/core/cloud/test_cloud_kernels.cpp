#include "core/cloud/cloud_kernels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "support/instruction_sets.h"
#include "support/random_rows.h"

namespace light_field_depth::cloud
{
namespace
{
constexpr int HEIGHT = 40;
constexpr int RING = 8;
constexpr auto WIDTH = static_cast<std::size_t>(ROW_WIDTH);

class CloudKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, CloudKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

/// Rows of a map: some pixels take no part, some surfaces are oblique.
struct MapRows
{
  explicit MapRows(RandomRows& random)
      : disparity(random.floats(WIDTH, -3.0F, 3.0F)), confidence(random.floats(WIDTH, -0.3F, 1.0F)),
        slope_x(random.floats(WIDTH, -0.4F, 0.4F)), slope_y(random.floats(WIDTH, -0.4F, 0.4F))
  {
  }
  std::vector<float> disparity;
  std::vector<float> confidence;
  std::vector<float> slope_x;
  std::vector<float> slope_y;
};

TEST_P(CloudKernels, ProjectionEqualsThePlainVersion)
{
  RandomRows random;
  MapRows map(random);
  for (std::size_t x = 0; x < WIDTH; x += 7)
  {
    map.disparity[x] = std::numeric_limits<float>::quiet_NaN();
  }
  for (const float steps_y : {0.0F, -2.0F})
  {
    std::array<std::vector<std::int32_t>, 2> target{std::vector<std::int32_t>(WIDTH),
                                                    std::vector<std::int32_t>(WIDTH)};
    std::array<std::vector<float>, 2> there{std::vector<float>(WIDTH), std::vector<float>(WIDTH)};
    ProjectedRow row;
    row.disparity = map.disparity.data();
    row.slope_x = map.slope_x.data();
    row.slope_y = map.slope_y.data();
    row.width = ROW_WIDTH;
    row.height = HEIGHT;
    row.row_mask = RING - 1;
    row.begin_x = 0.7F;
    row.begin_y = 3.5F;
    row.steps_x = 3.0F;
    row.steps_y = steps_y;
    for (const std::size_t i : {0U, 1U})
    {
      row.target = target[i].data();
      row.there = there[i].data();
      i == 0 ? projectRow(row) : projectRowPlain(row);
    }
    std::size_t parts = 0;
    for (std::size_t x = 0; x < WIDTH; ++x)
    {
      ASSERT_EQ(target[0][x], target[1][x]) << x;
      if (target[1][x] >= 0)
      {
        ++parts;
        ASSERT_NE(x % 7, 0U) << "takes no part";
        ASSERT_LT(target[0][x], ROW_WIDTH * RING);
        ASSERT_EQ(there[0][x], there[1][x]) << x;
      }
    }
    EXPECT_GT(parts, WIDTH / 2);
  }
}

TEST_P(CloudKernels, AgreementEqualsThePlainVersion)
{
  RandomRows random;
  const MapRows values(random);
  std::vector<float> confidence = values.confidence;
  for (float& value : confidence)
  {
    value = std::max(value, 0.01F);
  }
  constexpr std::size_t MOST_MAPS = 4;
  std::array<std::vector<float>, MOST_MAPS> disparity;
  std::array<std::vector<std::int32_t>, MOST_MAPS> source;
  std::array<MapOfRow, MOST_MAPS> maps;
  for (std::size_t i = 0; i < MOST_MAPS; ++i)
  {
    disparity[i] = random.floats(WIDTH, 1.0F, 1.06F);
    for (std::size_t x = 0; x < WIDTH; ++x)
    {
      const bool none = (x + i) % 11 == 0;
      source[i].push_back(none ? -1 : static_cast<std::int32_t>((x * 7 + i) % WIDTH));
    }
    maps[i].source = source[i].data();
    maps[i].disparity = disparity[i].data();
    maps[i].confidence = confidence.data();
    maps[i].slope_x = values.slope_x.data();
    maps[i].slope_y = values.slope_y.data();
    maps[i].steps_x = static_cast<float>(i);
    maps[i].steps_y = -2.0F * static_cast<float>(i);
    maps[i].nearness = 1.0F / (1.0F + static_cast<float>(i));
  }
  for (const int count : {1, 2, 4})
  {
    AgreedRow row;
    row.maps = maps.data();
    row.count = count;
    row.width = ROW_WIDTH;
    row.offset_px = 2.0F;
    row.floor_px = 0.02F;
    row.same_surface = 0.015F;
    row.least_weight = 0.05F;
    row.min_weight = 0.5F;
    row.min_confidence = 0.2F;
    std::array<std::vector<float>, 8> results;
    std::array<std::vector<std::uint8_t>, 2> done{std::vector<std::uint8_t>(WIDTH),
                                                  std::vector<std::uint8_t>(WIDTH)};
    for (const std::size_t i : {0U, 1U})
    {
      for (std::size_t k = 0; k < 4; ++k)
      {
        results[4 * i + k].resize(WIDTH);
      }
      row.disparity = results[4 * i].data();
      row.confidence = results[4 * i + 1].data();
      row.slope_x = results[4 * i + 2].data();
      row.slope_y = results[4 * i + 3].data();
      row.done = done[i].data();
      i == 0 ? agreeInRow(row) : agreeInRowPlain(row);
    }
    EXPECT_EQ(done[0], done[1]);
    std::size_t kept = 0;
    for (std::size_t x = 0; x < WIDTH; ++x)
    {
      ASSERT_EQ(std::isnan(results[0][x]), std::isnan(results[4][x])) << count << " maps, " << x;
      if (!std::isnan(results[4][x]))
      {
        ++kept;
        for (std::size_t k = 0; k < 4; ++k)
        {
          ASSERT_EQ(results[k][x], results[4 + k][x]) << count << " maps, result " << k << ", " << x;
        }
      }
    }
    EXPECT_GT(kept, WIDTH / 20) << count;
    EXPECT_LT(kept, WIDTH) << count;
  }
}

TEST_P(CloudKernels, PointsEqualThePlainVersion)
{
  RandomRows random;
  MapRows map(random);
  map.disparity[5] = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> colours = random.floats(WIDTH, 0.0F, 1.0F);
  std::vector<std::uint32_t> colour(WIDTH);
  std::memcpy(colour.data(), colours.data(), WIDTH * sizeof(float));
  constexpr std::size_t half = 4;
  std::array<std::vector<float>, 2> places{std::vector<float>(half * WIDTH),
                                           std::vector<float>(half * WIDTH)};
  std::array<std::vector<float>, 2> looks = places;
  UnprojectedRow row;
  row.confidence = map.confidence.data();
  row.colour = colour.data();
  row.disparity = map.disparity.data();
  row.slope_x = map.slope_x.data();
  row.slope_y = map.slope_y.data();
  row.width = ROW_WIDTH;
  row.offset_px = 1.0F;
  row.focal_length_px = 500.0F;
  row.focal_times_baseline = 9.0F;
  row.principal_x_px = 100.5F;
  row.row_px = -17.0F;
  row.centre_x_m = 0.04F;
  row.centre_y_m = -0.02F;
  for (const std::size_t i : {0U, 1U})
  {
    row.place = places[i].data();
    row.look = looks[i].data();
    i == 0 ? unprojectRow(row) : unprojectRowPlain(row);
  }
  EXPECT_EQ(places[0][half * 5 + 2], 0.0F) << "no point";
  std::size_t points = 0;
  for (std::size_t x = 0; x < WIDTH; ++x)
  {
    ASSERT_EQ(places[0][half * x + 2], places[1][half * x + 2]) << x;
    if (places[1][half * x + 2] > 0.0F)
    {
      ++points;
      for (std::size_t k = half * x; k < half * (x + 1); ++k)
      {
        ASSERT_EQ(places[0][k], places[1][k]) << k - half * x << ", " << x;
        ASSERT_EQ(looks[0][k], looks[1][k]) << k - half * x << ", " << x;
      }
      ASSERT_EQ(looks[0][half * x + 2], colours[x]) << "bit for bit";
      ASSERT_EQ(looks[0][half * x + 3], map.confidence[x]);
    }
  }
  EXPECT_GT(points, WIDTH / 2);
  EXPECT_LT(points, WIDTH);
}

}  // namespace
}  // namespace light_field_depth::cloud
