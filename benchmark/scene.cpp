#include "scene.h"

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/dataset.h"
#include "light_field_depth/io/pfm.h"

namespace light_field_depth::benchmark
{
Scene readScene(const std::filesystem::path& folder, int threads)
{
  DatasetOptions options;
  options.threads = threads;
  const Dataset dataset = readDataset(folder, options);
  if (!dataset.truth)
  {
    throw InputError("The folder '" + folder.string() +
                     "' has no disparity truth; the benchmark needs one, name it in light_field.yaml.");
  }
  return {folder.filename().string(), dataset.light_field, readPfm(*dataset.truth)};
}

DisparityRange rangeOf(const cv::Mat& truth)
{
  double minimum = 0.0;
  double maximum = 0.0;
  cv::minMaxIdx(truth, &minimum, &maximum);
  return {static_cast<float>(minimum), static_cast<float>(maximum)};
}

}  // namespace light_field_depth::benchmark
