#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_EVEN_EXPOSURE_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_EVEN_EXPOSURE_H

#include "light_field_depth/core/light_field.h"

namespace light_field_depth::multiview
{
/// Whether the mean brightness of every view and of its quarters is that of the reference, but for what
/// parallax changes. A cheap test by which most light fields can do without estimateExposure(); what it
/// overlooks is less than one or two hundredths of the brightness.
/// @param light_field of 8-bit grey views
bool looksEvenlyExposed(const LightField& light_field);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_EVEN_EXPOSURE_H
