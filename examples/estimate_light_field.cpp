// From a folder of PNGs to a point cloud, without ROS.
//
// usage: estimate_light_field FOLDER CLOUD.ply

#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>

#include <light_field_depth/core/pipeline.h>
#include <light_field_depth/io/cloud_writer.h>
#include <light_field_depth/io/dataset.h>

int main(int argc, char** argv)
{
  namespace lfd = light_field_depth;
  if (argc != 3)
  {
    std::cerr << "usage: estimate_light_field FOLDER CLOUD.ply" << std::endl;
    return EXIT_FAILURE;
  }
  try
  {
    // The views, where each camera stands, and the calibration that the folder states.
    const lfd::Dataset dataset = lfd::readDataset(argv[1]);

    lfd::PipelineOptions options;
    options.multiview.preset = lfd::MultiviewPreset::Balanced;
    options.dense_cloud.maps = lfd::DenseCloudOptions::MAPS_WITH_TIME;
    lfd::ProductRequest request;
    request.dense_cloud = true;  // every view's own pixels, fused
    lfd::CloudWriter cloud(argv[2], lfd::CloudFormat::Ply);
    request.dense_cloud_sink = [&cloud](const lfd::DensePoint* block, std::size_t count)
    { cloud.write(block, count); };

    lfd::Pipeline pipeline;  // keeps threads and buffers; use it again for the next frame
    const lfd::PipelineResult result = pipeline.run(dataset.light_field, options, request);

    const std::size_t points = cloud.finish();
    std::cout << points << " points from " << result.estimate.views_used << " views in " << result.total_ms
              << " ms" << std::endl;
    return points > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << std::endl;  // one sentence that names the file or the value
    return EXIT_FAILURE;
  }
}
