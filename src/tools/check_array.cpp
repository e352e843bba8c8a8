#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iostream>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <boost/function.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/files.h"
#include "light_field_depth/ros/camera_info_url.h"
#include "tools/array_description.h"
#include "tools/tool_main.h"

namespace light_field_depth
{
namespace
{
struct CheckOptions
{
  std::string array_file;
  std::string bag;
  std::string write;
  std::string image_transport = "raw";
  double seconds = 5.0;
  int threads = 0;
};

/// Where the images of a view come from.
std::string imageTopic(const ViewTopics& view, const CheckOptions& options)
{
  return options.image_transport == "compressed" ? view.image + "/compressed" : view.image;
}

template <class Message>
ros::Subscriber subscribe(ros::NodeHandle& node_handle, const std::string& topic,
                          const std::function<void(const boost::shared_ptr<const Message>&)>& on_message)
{
  constexpr std::uint32_t QUEUE_SIZE = 10;
  const boost::function<void(const boost::shared_ptr<const Message>&)> callback = on_message;
  return node_handle.subscribe<Message>(topic, QUEUE_SIZE, callback);
}

void listen(const CheckOptions& options, ArrayCheck& check)
{
  ros::NodeHandle node_handle;
  std::vector<ros::Subscriber> subscribers;
  for (std::size_t i = 0; i < check.array().views.size(); ++i)
  {
    const ViewTopics& view = check.array().views[i];
    if (options.image_transport == "compressed")
    {
      subscribers.push_back(subscribe<sensor_msgs::CompressedImage>(
          node_handle, imageTopic(view, options), [&check, i](const auto& image) { check.add(i, image); }));
    }
    else
    {
      subscribers.push_back(subscribe<sensor_msgs::Image>(
          node_handle, imageTopic(view, options), [&check, i](const auto& image) { check.add(i, image); }));
    }
    if (view.camera_info_url.empty())
    {
      subscribers.push_back(subscribe<sensor_msgs::CameraInfo>(
          node_handle, view.camera_info, [&check, i](const auto& info) { check.add(i, info); }));
    }
  }
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(options.seconds);
  while (ros::ok() && std::chrono::steady_clock::now() < end)
  {
    ros::spinOnce();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

/// Topics in bags begin with '/'.
std::string inBag(const std::string& topic)
{
  return topic.empty() || topic.front() == '/' ? topic : "/" + topic;
}

void readBag(const CheckOptions& options, ArrayCheck& check)
{
  std::map<std::string, std::size_t> images;
  std::map<std::string, std::size_t> infos;
  std::vector<std::string> topics;
  for (std::size_t i = 0; i < check.array().views.size(); ++i)
  {
    const ViewTopics& view = check.array().views[i];
    images[inBag(imageTopic(view, options))] = i;
    infos[inBag(view.camera_info)] = i;
    // Bags that dataset_to_bag wrote have the topics as they were given.
    images[imageTopic(view, options)] = i;
    infos[view.camera_info] = i;
  }
  for (const auto* const map : {&images, &infos})
  {
    for (const auto& entry : *map)
    {
      topics.push_back(entry.first);
    }
  }
  try
  {
    rosbag::Bag bag(options.bag, rosbag::bagmode::Read);
    rosbag::View view(bag, rosbag::TopicQuery(topics));
    const ros::Time end =
        view.size() > 0 ? view.getBeginTime() + ros::Duration(options.seconds) : ros::Time();
    for (const rosbag::MessageInstance& message : view)
    {
      if (message.getTime() > end)
      {
        break;
      }
      if (const auto info = message.instantiate<sensor_msgs::CameraInfo>())
      {
        check.add(infos.at(message.getTopic()), info);
      }
      else if (const auto image = message.instantiate<sensor_msgs::Image>())
      {
        check.add(images.at(message.getTopic()), image);
      }
      else if (const auto compressed = message.instantiate<sensor_msgs::CompressedImage>())
      {
        check.add(images.at(message.getTopic()), compressed);
      }
    }
  }
  catch (const rosbag::BagException& error)
  {
    throw InputError("The bag '" + options.bag + "' cannot be read (" + error.what() + "); check the path.");
  }
}

/// @return whether the array would work
bool report(const std::vector<ArrayFinding>& findings)
{
  const std::map<ArrayFinding::Severity, const char*> names = {{ArrayFinding::Severity::Error, "ERROR    "},
                                                               {ArrayFinding::Severity::Warning, "warning  "},
                                                               {ArrayFinding::Severity::Fine, "fine     "}};
  std::size_t errors = 0;
  std::size_t warnings = 0;
  for (const ArrayFinding& finding : findings)
  {
    std::cout << names.at(finding.severity) << finding.sentence << "\n";
    errors += finding.severity == ArrayFinding::Severity::Error ? 1 : 0;
    warnings += finding.severity == ArrayFinding::Severity::Warning ? 1 : 0;
  }
  std::cout << (errors > 0     ? "This array does not work yet: see the errors above."
                : warnings > 0 ? "This array works; the warnings above say what would make it better."
                               : "This array works.")
            << std::endl;
  return errors == 0;
}

int checkArray(const CheckOptions& options)
{
  ArrayDescription description;
  description.array = defaultViewArray();
  if (!options.array_file.empty())
  {
    description = readArrayDescription(options.array_file);
  }
  ArrayCheck check(description.array, description.options);
  const auto infos = readCameraInfos(description.array);
  for (std::size_t i = 0; i < infos.size(); ++i)
  {
    if (infos[i] != nullptr)
    {
      check.add(i, infos[i]);
    }
  }
  if (options.bag.empty())
  {
    listen(options, check);
  }
  else
  {
    readBag(options, check);
  }
  Pipeline pipeline(options.threads);
  const bool works = report(check.judge(pipeline));
  if (!options.write.empty())
  {
    writeFile(options.write, arrayDescriptionText(description, check.neededToleranceS()));
    std::cout << "Wrote " << options.write
              << "; roslaunch light_field_depth depth.launch array_file:=" << options.write << std::endl;
  }
  return works ? 0 : EXIT_DOUBTFUL;
}

}  // namespace
}  // namespace light_field_depth

int main(int argc, char** argv)
{
  using namespace light_field_depth;
  ros::init(argc, argv, "check_array", ros::init_options::AnonymousName | ros::init_options::NoSigintHandler);
  CLI::App app(
      "Checks a camera array on live topics or a bag: rates, stamps, calibration, order, brightness and "
      "places of "
      "the views. Exits with 3 if it would not work.",
      "check_array");
  CheckOptions options;
  app.add_option("--array-file", options.array_file, "As for depth.launch; the cross of 9 x 9 by default");
  app.add_option("--bag", options.bag, "Read a bag instead of live topics");
  app.add_option("--seconds", options.seconds, "How long to listen")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  app.add_option("--image-transport", options.image_transport, "raw or compressed")
      ->check(CLI::IsMember({"raw", "compressed"}))
      ->capture_default_str();
  app.add_option("--write", options.write,
                 "Write the array's description, with the sync_tolerance that it needs");
  app.add_option("--threads", options.threads, "0: one per processor")->check(CLI::Range(0, 256));
  return runTool(app, argc, argv, [&] { return checkArray(options); });
}
