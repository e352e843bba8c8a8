#ifndef LIGHT_FIELD_DEPTH_NODELETS_RESULT_SAVER_H
#define LIGHT_FIELD_DEPTH_NODELETS_RESULT_SAVER_H

#include "light_field_depth/ros/depth_node.h"

namespace light_field_depth
{
/// The files that the tool estimate writes of a result, report.json among them. @throw InputError
void saveResult(const ResultToSave& saved);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_NODELETS_RESULT_SAVER_H
