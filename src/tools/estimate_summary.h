#ifndef LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_SUMMARY_H
#define LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_SUMMARY_H

#include <string>

#include "light_field_depth/io/report.h"

namespace light_field_depth
{
/// What estimate says of one light field: a summary and the notes on stdout, the warnings on stderr.
/// @param folder of the results
void printSummary(const RunReport& report, const std::string& folder);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_SUMMARY_H
