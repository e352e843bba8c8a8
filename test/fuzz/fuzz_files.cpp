// What lies in folders of others: maps, descriptions, names, settings.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <opencv2/imgcodecs.hpp>

#include "fuzz/byte_source.h"
#include "fuzz/harnesses.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/dataset.h"
#include "light_field_depth/io/pfm.h"
#include "light_field_depth/io/pipeline_options_io.h"
#include "support/temporary_folder.h"

namespace light_field_depth::fuzz
{
namespace
{
namespace fs = std::filesystem;
using testing::TemporaryFolder;

/// Views of a folder, made once and linked into it.
const fs::path& smallImage()
{
  static const TemporaryFolder folder;
  static const fs::path path = []
  {
    cv::Mat image(16, 18, CV_8UC3);
    cv::randu(image, 0, 255);
    cv::imwrite((folder / "image.png").string(), image);
    return folder / "image.png";
  }();
  return path;
}

void addView(const TemporaryFolder& folder, const std::string& name)
{
  std::error_code ignored;
  fs::create_hard_link(smallImage(), folder / name, ignored);
}

template <class Action>
void runOrSentence(const Action& action)
{
  try
  {
    action();
  }
  catch (const InputError& error)
  {
    if (std::string(error.what()).size() < 20)
    {
      std::abort();
    }
  }
}

void readFolder(const TemporaryFolder& folder)
{
  runOrSentence(
      [&]
      {
        DatasetOptions options;
        options.threads = 1;
        readDataset(folder.path(), options);
      });
}

std::string text(const std::uint8_t* data, std::size_t size)
{
  return {reinterpret_cast<const char*>(data), size};
}

/// A folder of views named by row and column, described by a file.
void readDescribed(const std::string& file, const std::string& content, const std::string& form)
{
  const TemporaryFolder folder;
  for (int row = 0; row < 2; ++row)
  {
    for (int column = 0; column < 2; ++column)
    {
      addView(folder, form == "grid" ? "view_" + std::to_string(row) + "_" + std::to_string(column) + ".png"
                                     : "input_Cam00" + std::to_string(2 * row + column) + ".png");
    }
  }
  folder.write(file, content);
  readFolder(folder);
}

}  // namespace

void fuzzPfm(const std::uint8_t* data, std::size_t size)
{
  const TemporaryFolder folder;
  const fs::path file = folder.write("map.pfm", text(data, size));
  runOrSentence([&] { readPfm(file); });
}

void fuzzLightFieldYaml(const std::uint8_t* data, std::size_t size)
{
  readDescribed("light_field.yaml", text(data, size), "grid");
}

void fuzzParametersCfg(const std::uint8_t* data, std::size_t size)
{
  readDescribed("parameters.cfg", text(data, size), "hci");
}

void fuzzTransformsJson(const std::uint8_t* data, std::size_t size)
{
  readDescribed("transforms.json", text(data, size), "grid");
}

void fuzzNames(const std::uint8_t* data, std::size_t size)
{
  constexpr int MOST = 16;
  const TemporaryFolder folder;
  std::istringstream lines(text(data, size));
  std::string line;
  for (int i = 0; i < MOST && std::getline(lines, line); ++i)
  {
    line = line.substr(0, line.find('\0')).substr(0, 200);
    const std::size_t slash = line.find('/');
    if (slash != std::string::npos && slash > 0 && line.substr(0, slash) != "..")
    {
      std::error_code ignored;
      fs::create_directory(folder / line.substr(0, slash), ignored);
    }
    if (line.find("..") == std::string::npos && !line.empty() && line.front() != '/')
    {
      addView(folder, line);
    }
  }
  readFolder(folder);
}

void fuzzOptions(const std::uint8_t* data, std::size_t size)
{
  ByteSource source(data, size);
  const bool from_file = source.flag();
  const std::string content = source.rest();
  PipelineOptions options;
  runOrSentence(
      [&]
      {
        if (from_file)
        {
          const TemporaryFolder folder;
          readOptionsFile(folder.write("options.yaml", content), options);
        }
        else
        {
          setOption(options, content);
        }
        validate(options);
      });
}

}  // namespace light_field_depth::fuzz
