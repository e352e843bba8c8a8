#include "light_field_depth/io/intermediate_files.h"

#include <vector>

#include "light_field_depth/io/files.h"
#include "light_field_depth/io/image_files.h"
#include "light_field_depth/io/pfm.h"

namespace light_field_depth
{
void writeIntermediate(const std::filesystem::path& folder, const std::string& name, const cv::Mat& values)
{
  if (values.empty())
  {
    return;
  }
  makeFolder(folder);
  const bool is_image = (values.depth() == CV_8U || values.depth() == CV_16U) &&
                        (values.channels() == 1 || values.channels() == 3);
  if (is_image)
  {
    writeImage(folder / (name + ".png"), values);
    return;
  }
  cv::Mat floats;
  values.convertTo(floats, CV_32F);
  std::vector<cv::Mat> channels;
  cv::split(floats, channels);
  for (std::size_t i = 0; i < channels.size(); ++i)
  {
    const std::string suffix = channels.size() == 1 ? "" : "_" + std::to_string(i);
    writePfm(folder / (name + suffix + ".pfm"), channels[i]);
  }
}

}  // namespace light_field_depth
