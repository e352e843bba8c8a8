#include "tools/estimate_summary.h"

#include <iomanip>
#include <iostream>
#include <sstream>

namespace light_field_depth
{
namespace
{
std::string sentenceOfInput(const RunReport& report)
{
  std::ostringstream text;
  text << report.views_found << " views (" << report.format << ") of " << report.size.width << " x "
       << report.size.height << " pixels, " << report.views_used << " used; reference "
       << report.reference_file << "; method " << toString(report.options.method) << ".";
  return text.str();
}

std::string sentenceOfLayout(const RunReport& report)
{
  return "Layout of the views: " + report.order + ", flip " + report.flip + " (from the " +
         report.layout_source + ").";
}

}  // namespace

void printSummary(const RunReport& report, const std::string& folder)
{
  std::cout << std::fixed << std::setprecision(2) << sentenceOfInput(report) << "\n"
            << sentenceOfLayout(report) << "\n"
            << "Disparity range " << report.disparity_range.min << " .. " << report.disparity_range.max
            << " px (" << toString(report.range_source) << "), photometric error "
            << *report.photometric_error << " levels.\n"
            << std::setprecision(0) << "Decoding " << report.decode_ms << " ms, method " << report.total_ms
            << " ms on " << report.threads << " thread(s), writing " << report.write_ms << " ms, peak memory "
            << report.peak_memory_mb << " MB.\n";
  if (!report.calibration)
  {
    std::cout << "The dataset has no calibration, so there is no depth and no cloud.\n";
  }
  std::cout << "Wrote to " << folder << ":";
  for (const std::string& file : report.files)
  {
    std::cout << " " << file;
  }
  std::cout << std::endl;
  for (const std::string& note : report.notes)
  {
    std::cout << "Note: " << note << "\n";
  }
  for (const std::string& warning : report.verdict.warnings())
  {
    std::cerr << "Warning: " << warning << "\n";
  }
}

}  // namespace light_field_depth
