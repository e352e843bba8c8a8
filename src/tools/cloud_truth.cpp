#include "tools/cloud_truth.h"

#include <array>
#include <cstdio>
#include <string>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/dataset.h"
#include "light_field_depth/io/image_files.h"
#include "light_field_depth/io/pfm.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

/// Of the values of 16-bit truths, as data/README.md says.
constexpr double LEVELS_PER_PX = 8192.0;
constexpr double FIRST_LEVEL_PX = -4.0;

std::string truthName(const GridPosition& position, const char* extension)
{
  std::array<char, 64> name{};
  std::snprintf(name.data(), name.size(), "truth_%02d_%02d%s", position.row, position.column, extension);
  return name.data();
}

/// The truth of a view, or nothing.
cv::Mat readViewTruth(const fs::path& folder, const GridPosition& position)
{
  const fs::path pfm = folder / truthName(position, ".pfm");
  if (fs::exists(pfm))
  {
    return readPfm(pfm);
  }
  const fs::path png = folder / truthName(position, ".png");
  if (!fs::exists(png))
  {
    return {};
  }
  const cv::Mat levels = readImage(png);
  if (levels.type() != CV_16UC1)
  {
    throw InputError("'" + png.string() + "' is no grey image of 16 bits; disparities are 8192 (d + 4).");
  }
  cv::Mat disparity;
  levels.convertTo(disparity, CV_32F, 1.0 / LEVELS_PER_PX, FIRST_LEVEL_PX);
  return disparity;
}

}  // namespace

CloudTruth readCloudTruth(const fs::path& folder)
{
  DatasetOptions options;
  options.selection = [](const LightField& /*without_images*/) { return ViewSelection::All; };
  const Dataset dataset = readDataset(folder, options);
  const LightField& light_field = dataset.light_field;
  if (!light_field.calibration || !dataset.truth)
  {
    throw InputError(
        "'" + folder.string() +
        "' states no calibration or no truth of the reference view, so clouds cannot be scored against "
        "it; light_field.yaml states both.");
  }
  CloudTruth truth;
  truth.calibration = *light_field.calibration;
  truth.views.push_back({{}, light_field.reference().offset_px, readPfm(*dataset.truth)});
  for (const View& view : light_field.views)
  {
    const cv::Mat disparity = readViewTruth(folder / "view_truths", view.grid);
    if (!disparity.empty() && !(view.grid == light_field.reference().grid))
    {
      truth.views.push_back({view.steps, view.offset_px, disparity});
    }
  }
  for (const ViewTruth& view : truth.views)
  {
    if (view.disparity.size() != light_field.size())
    {
      throw InputError("A truth in '" + folder.string() + "' has another size than the views.");
    }
  }
  return truth;
}

}  // namespace light_field_depth
