// The HCI 4D Light Field Benchmark: input_Cam000, parameters.cfg, gt_disp_lowres.pfm.

#include <algorithm>
#include <cmath>

#include "io/dataset_format.h"
#include "io/name_groups.h"
#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

/// Of the HCI benchmark (Honauer et al. 2016).
constexpr int BENCHMARK_GRID_SIDE = 9;
constexpr const char* FORM = "input_cam#";
constexpr const char* PARAMETERS = "parameters.cfg";
constexpr const char* TRUTH = "gt_disp_lowres.pfm";

struct Indices
{
  long long first = 0;
  long long last = 0;
  bool complete = false;  ///< without a gap, from 0 or from 1
};

Indices indicesOf(const std::vector<NumberedName>& names)
{
  const auto [first, last] =
      std::minmax_element(names.begin(), names.end(),
                          [](const auto& a, const auto& b) { return a.numbers.front() < b.numbers.front(); });
  Indices indices{first->numbers.front(), last->numbers.front(), false};
  indices.complete = (indices.first == 0 || indices.first == 1) &&
                     indices.last - indices.first + 1 == static_cast<long long>(names.size());
  return indices;
}

/// The grid of a folder without a parameters.cfg: that of the options, a complete square, or the benchmark's.
std::optional<cv::Size> gridWithoutParameters(const Indices& indices, std::size_t count,
                                              const DatasetOptions& options)
{
  if (options.grid)
  {
    return options.grid;
  }
  const int side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(count))));
  if (indices.complete)
  {
    return static_cast<std::size_t>(side) * static_cast<std::size_t>(side) == count
               ? std::make_optional(cv::Size(side, side))
               : std::nullopt;
  }
  return cv::Size(BENCHMARK_GRID_SIDE, BENCHMARK_GRID_SIDE);
}

}  // namespace

Recognition recognizeHci(const FolderListing& listing, const DatasetOptions& options)
{
  auto names = viewNames(listing.folder, listing.images);
  if (!names || names->group.form != FORM)
  {
    return Recognition::no("the names are not input_Cam000, input_Cam001, ...");
  }
  FolderDescription description;
  description.format = "hci";
  description.notes = leftOutNotes(names->left_out);
  const std::vector<NumberedName>& files = names->group.names;
  const Indices indices = indicesOf(files);
  const fs::path cfg_file = listing.folder / PARAMETERS;
  const bool has_cfg = isFile(cfg_file);
  description.place_claim = PlaceClaim::TwoNumbers;
  if (has_cfg)
  {
    const cv::Size guess = gridWithoutParameters(indices, files.size(), options)
                               .value_or(cv::Size(BENCHMARK_GRID_SIDE, BENCHMARK_GRID_SIDE));
    description.grid = cv::Rect({0, 0}, guess);
    readHciParameters(cfg_file, description);
    description.place_claim = PlaceClaim::Stated;
  }
  else if (const auto grid = gridWithoutParameters(indices, files.size(), options))
  {
    description.grid = cv::Rect({0, 0}, *grid);
  }
  else
  {
    description.place_claim = PlaceClaim::SingleNumber;
  }
  const cv::Rect grid = description.grid.value_or(cv::Rect(0, 0, static_cast<int>(files.size()), 1));
  const long long origin = indices.first >= 1 && indices.last == grid.area() ? 1 : 0;
  for (const NumberedName& file : files)
  {
    const long long index = file.numbers.front() - origin;
    if (index < 0 || index >= grid.area())
    {
      throw InputError("The view '" + file.path.filename().string() + "' lies outside of the grid of " +
                       std::to_string(grid.height) + " x " + std::to_string(grid.width) + " views that " +
                       (has_cfg ? cfg_file.string() + " states" : "is assumed without a parameters.cfg") +
                       "; set num_cams_x and num_cams_y under [extrinsics] in parameters.cfg, or --grid.");
    }
    const int place = static_cast<int>(index);
    description.views.push_back({file.path, {place / grid.width, place % grid.width}, {}});
  }
  if (isFile(listing.folder / TRUTH))
  {
    description.truth = listing.folder / TRUTH;
  }
  return description;
}

}  // namespace light_field_depth
