#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_CLOUD_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_CLOUD_KERNELS_H

#include <cstdint>

// The inner loops of the dense cloud, a row at a time. Those with a Plain version compute the same values.
namespace light_field_depth::cloud
{
/// Below this a plane is seen so obliquely that its slope says nothing any more.
constexpr float MIN_COMPRESSION = 0.1F;

/// How much the plane of a slope is compressed on the way to a view `steps` away: 1 on a frontal one, 0 and
/// below where the view sees its edge or its back.
inline float compression(float slope_x, float slope_y, float steps_x, float steps_y)
{
  return 1.0F - slope_x * steps_x - slope_y * steps_y;
}

/// The pixels of a row of a map on their way to a view.
struct ProjectedRow
{
  const float* disparity = nullptr;  ///< [width], finite; NaN: takes no part
  const float* slope_x = nullptr;    ///< [width]
  const float* slope_y = nullptr;    ///< [width]
  int width = 0;
  int height = 0;
  int row_mask = -1;     ///< of the rows of `target`, where these are a ring; -1: they are all there
  float begin_x = 0.0F;  ///< where disparity 0 brings the pixel 0, plus half a pixel
  float begin_y = 0.0F;  ///< likewise, of this row
  float steps_x = 0.0F;  ///< from the map's view to this one
  float steps_y = 0.0F;
  std::int32_t* target = nullptr;  ///< [width], result: index of the view's pixel; negative: none
  float* there = nullptr;          ///< [width], result: disparity at the middle of that pixel
};

void projectRow(const ProjectedRow& row);
void projectRowPlain(const ProjectedRow& row);

/// What one map gives to a row of a view.
struct MapOfRow
{
  const std::int32_t* source = nullptr;  ///< [width], index of the map's pixel; negative: none
  const float* disparity = nullptr;      ///< [width], where there is one
  const float* confidence = nullptr;     ///< of the whole map, 0..1
  const float* slope_x = nullptr;        ///< likewise
  const float* slope_y = nullptr;
  float steps_x = 0.0F;  ///< from the map's view to this one
  float steps_y = 0.0F;
  float nearness = 1.0F;  ///< factor of the weight
};

/// A row of a view where all maps show one surface. Where they do, results are written; disparity is NaN
/// where that is not supported.
struct AgreedRow
{
  const MapOfRow* maps = nullptr;  ///< [count]
  int count = 0;
  int width = 0;
  float offset_px = 0.0F;       ///< d_inf
  float floor_px = 0.0F;        ///< what a disparity may be off anyway
  float same_surface = 0.0F;    ///< part of depth
  float least_weight = 0.0F;    ///< of a map's candidate, plus its confidence
  float min_weight = 0.0F;      ///< of all maps, or ...
  float min_confidence = 0.0F;  ///< ... confidence of one whose nearness is `nearest`
  float nearest = 1.0F;
  float* disparity = nullptr;    ///< [width], results
  float* confidence = nullptr;   ///< [width]
  float* slope_x = nullptr;      ///< [width]
  float* slope_y = nullptr;      ///< [width]
  std::uint8_t* done = nullptr;  ///< [width], 0 where the maps do not all show one surface
};

/// One map agrees with itself: pixels that it does not show are done, too.
void agreeInRow(const AgreedRow& row);
void agreeInRowPlain(const AgreedRow& row);

/// A row of disparities on its way to points and normals.
struct UnprojectedRow
{
  const float* disparity = nullptr;       ///< [width]
  const float* slope_x = nullptr;         ///< [width], where the disparity is a number
  const float* slope_y = nullptr;         ///< [width]
  const float* confidence = nullptr;      ///< [width]
  const std::uint32_t* colour = nullptr;  ///< [width], as a point has colour and views
  int width = 0;
  float offset_px = 0.0F;  ///< d_inf
  float focal_length_px = 1.0F;
  float focal_times_baseline = 1.0F;  ///< px m
  float principal_x_px = 0.0F;
  float row_px = 0.0F;  ///< y of the row less that of the principal point
  float centre_x_m = 0.0F;
  float centre_y_m = 0.0F;
  // Results: what a point has, in two halves.
  float* place = nullptr;  ///< [4 * width]: x, y, z, metres, and normal x; z is 0 where there is no point
  float* look = nullptr;   ///< [4 * width]: normal y, normal z, colour, confidence
};

void unprojectRow(const UnprojectedRow& row);
void unprojectRowPlain(const UnprojectedRow& row);

}  // namespace light_field_depth::cloud

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_CLOUD_KERNELS_H
