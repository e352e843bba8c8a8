#ifndef LIGHT_FIELD_DEPTH_TEST_SUPPORT_MIS_SET_CASES_H
#define LIGHT_FIELD_DEPTH_TEST_SUPPORT_MIS_SET_CASES_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "light_field_depth/core/light_field.h"
#include "support/synthetic_scene.h"

namespace light_field_depth::testing
{
using Spoil = std::function<void(LightField&)>;

/// A way to hand over a light field that is not what it claims to be.
struct MisSetCase
{
  const char* name;
  Spoil spoil;
  std::optional<DisparityRange> range = std::nullopt;
};

/// The scene that is spoiled: 5 x 5 views of 160 x 120 pixels. @param seed 1, or that of another scene
SyntheticLightField rightScene(std::uint32_t seed = 1);

/// Where a view stands in its LightField::views.
std::size_t misSetIndex(int row, int column);

/// Exchanges the images of two views.
Spoil exchangeViews(std::size_t a, std::size_t b);

/// Gives some views the images of another scene.
Spoil viewsOfOtherScene(const std::vector<std::size_t>& views);

/// More than forty: orders, single views, and whole light fields that are wrong.
std::vector<MisSetCase> misSetCases();

}  // namespace light_field_depth::testing

#endif  // LIGHT_FIELD_DEPTH_TEST_SUPPORT_MIS_SET_CASES_H
