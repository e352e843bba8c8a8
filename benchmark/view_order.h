#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_VIEW_ORDER_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_VIEW_ORDER_H

#include "report_files.h"

namespace light_field_depth::benchmark
{
/// How often the layout of the grid is found from the images: all light fields, in all eight symmetries,
/// whole and reduced to 5 x 5, 3 x 3, a cross and a row.
void measureViewOrder(const Settings& settings);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_VIEW_ORDER_H
