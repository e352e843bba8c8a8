#include <cstddef>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <cv_bridge/cv_bridge.h>
#include <ros/time.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CompressedImage.h>
#include <opencv2/imgcodecs.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/files.h"
#include "tools/dataset_input.h"
#include "tools/interruption.h"
#include "tools/tool_main.h"

namespace light_field_depth
{
namespace
{
struct BagOptions
{
  std::string file;
  int count = 10;
  bool compress = false;
  int jpeg_quality = 0;  ///< of images as the compressed transport has them; 0: raw images
};

/// The image of each view as the compressed transport has it; none for raw ones.
std::vector<sensor_msgs::CompressedImage> compressedImages(const std::vector<ViewMessages>& views,
                                                           int jpeg_quality)
{
  std::vector<sensor_msgs::CompressedImage> images;
  if (jpeg_quality > 0)
  {
    for (const ViewMessages& view : views)
    {
      const cv_bridge::CvImageConstPtr image = cv_bridge::toCvShare(view.image);
      if (image->image.depth() != CV_8U)
      {
        throw InputError("--jpeg is given, but the images have more than 8 bits; leave it out.");
      }
      sensor_msgs::CompressedImage compressed;
      compressed.header = view.image->header;
      compressed.format = image->encoding + "; jpeg compressed " + image->encoding;
      cv::imencode(".jpg", image->image, compressed.data, {cv::IMWRITE_JPEG_QUALITY, jpeg_quality});
      images.push_back(std::move(compressed));
    }
  }
  return images;
}

/// Frames from now on, all alike.
void writeFrames(const std::vector<ViewMessages>& views, const BagOptions& options, double rate_hz,
                 const InterruptionGuard& guard, rosbag::Bag& bag)
{
  bag.setCompression(options.compress ? rosbag::compression::LZ4 : rosbag::compression::Uncompressed);
  std::vector<sensor_msgs::CompressedImage> compressed = compressedImages(views, options.jpeg_quality);
  const ros::WallTime now = ros::WallTime::now();
  const ros::Time start(now.sec, now.nsec);
  for (int frame = 0; frame < options.count; ++frame)
  {
    const ros::Time stamp = start + ros::Duration(frame / rate_hz);
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      const ViewMessages& view = views[i];
      guard.check();
      view.camera_info->header.stamp = stamp;
      bag.write(view.camera_info_topic, stamp, *view.camera_info);
      if (compressed.empty())
      {
        view.image->header.stamp = stamp;
        bag.write(view.image_topic, stamp, *view.image);
      }
      else
      {
        compressed[i].header.stamp = stamp;
        bag.write(view.image_topic + "/compressed", stamp, compressed[i]);
      }
    }
  }
}

/// The bag under its name when it is whole; until then, and after an error or a signal, what was there
/// before.
/// @throw InputError, Cancelled
void writeWholeBag(const std::vector<ViewMessages>& views, const BagOptions& options, double rate_hz)
{
  const InterruptionGuard guard;
  PendingFile pending(options.file);
  auto bag = std::make_unique<rosbag::Bag>();
  try
  {
    bag->open(pending.path().string(), rosbag::bagmode::Write);
    writeFrames(views, options, rate_hz, guard, *bag);
    bag->close();
  }
  catch (const rosbag::BagException& error)
  {
    // Its destructor would try to write again, and end the program when that fails again.
    static_cast<void>(bag.release());
    throw InputError("The bag " + options.file + " cannot be written (" + error.what() +
                     "); check the folder's permissions and the space on the disk.");
  }
  guard.check();
  pending.commit();
}

void writeBag(const DatasetInputOptions& input, const BagOptions& options)
{
  const CalibratedDataset dataset = readCalibratedDataset(input);
  if (!dataset.warning.empty())
  {
    std::cerr << "dataset_to_bag: " << dataset.warning << std::endl;
  }
  std_msgs::Header header;
  header.frame_id = input.frame_id;
  const std::vector<ViewMessages> views =
      viewMessages(dataset.light_field, *dataset.light_field.calibration, header, input.topics);

  writeWholeBag(views, options, input.rate_hz);
  std::cout << options.file << ": " << options.count << " frame(s) of " << views.size() << " views, "
            << views.front().image_topic << " to " << views.back().image_topic << std::endl;
}

}  // namespace
}  // namespace light_field_depth

int main(int argc, char** argv)
{
  using namespace light_field_depth;
  CLI::App app("Writes a light field from a folder into a bag, as a camera array would be recorded.",
               "dataset_to_bag");
  DatasetInputOptions input;
  BagOptions options;
  addDatasetInputOptions(app, input);
  app.add_option("--output", options.file, "The bag")->required();
  app.add_option("--count", options.count, "Frames, all alike but for their stamps")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_flag("--compress", options.compress, "LZ4");
  app.add_option("--jpeg", options.jpeg_quality,
                 "Images as the compressed transport has them, of this quality, instead of raw ones")
      ->check(CLI::Range(1, 100));
  return runTool(app, argc, argv, [&] { writeBag(input, options); });
}
