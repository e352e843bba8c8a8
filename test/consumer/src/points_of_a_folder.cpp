// What another package may use: the library, the messages, and what turns the one into the other.

#include <iostream>

#include <light_field_depth/LightFieldDepthStats.h>
#include <light_field_depth/core/pipeline.h>
#include <light_field_depth/io/dataset.h>
#include <light_field_depth/ros/view_messages.h>

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    std::cerr << "usage: points_of_a_folder FOLDER" << std::endl;
    return 1;
  }
  const light_field_depth::Dataset dataset = light_field_depth::readDataset(argv[1]);
  light_field_depth::ProductRequest request;
  request.organized_cloud = true;
  light_field_depth::LightFieldDepthStats stats;
  light_field_depth::Pipeline pipeline;
  const auto result = pipeline.run(dataset.light_field, {}, request);
  stats.views_used = static_cast<std::uint32_t>(result.estimate.views_used);
  const auto messages =
      light_field_depth::viewMessages(dataset.light_field, *dataset.light_field.calibration, {}, {});
  std::cout << result.organized_cloud.size() << " points from " << stats.views_used << " views, "
            << messages.size() << " topics" << std::endl;
  return result.organized_cloud.empty() ? 1 : 0;
}
