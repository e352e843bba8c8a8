#ifndef LIGHT_FIELD_DEPTH_TEST_IO_SCENE_FOLDERS_H
#define LIGHT_FIELD_DEPTH_TEST_IO_SCENE_FOLDERS_H

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "light_field_depth/core/light_field.h"
#include "support/synthetic_scene.h"
#include "support/temporary_folder.h"

/// Folders with the views of one rendered scene, under names of any kind.
namespace light_field_depth::testing
{
constexpr int SIDE = 5;
constexpr int LONG_ROW = 9;

/// A view of the scene by its row and column from 0, in the package's convention.
using Scene = std::function<cv::Mat(int row, int column)>;

/// Writes a scene of `grid` views into a folder.
using Write = std::function<void(const TemporaryFolder& folder, const Scene& scene)>;

/// A scene with depth, of 5 x 9 views, rendered once.
class RenderedScene
{
public:
  static cv::Mat view(int row, int column)
  {
    static const RenderedScene scene;
    const auto found = std::find_if(scene.views_.begin(), scene.views_.end(),
                                    [&](const View& view) {
                                      return view.grid == GridPosition{row, column};
                                    });
    return found->image;
  }

private:
  RenderedScene()
  {
    SceneSettings settings;
    settings.size = {80, 64};
    settings.positions = gridPositions(SIDE, LONG_ROW);
    settings.samples = 2;
    views_ = renderScene(standardScene(settings.size), settings).light_field.views;
  }

  std::vector<View> views_;
};

inline void write(const TemporaryFolder& folder, const std::string& name, const cv::Mat& image)
{
  std::filesystem::create_directories((folder / name).parent_path());
  ASSERT_TRUE(cv::imwrite((folder / name).string(), image)) << name;
}

inline std::string padded(int number, std::size_t digits)
{
  std::string text = std::to_string(std::abs(number));
  text = (text.size() < digits ? std::string(digits - text.size(), '0') : "") + text;
  return (number < 0 ? "-" : "") + text;
}

using NameOf = std::function<std::string(int row, int column)>;

/// All views of a grid, each in a file of its own.
inline Write grid(const cv::Size& size, const NameOf& name_of)
{
  return [=](const TemporaryFolder& folder, const Scene& scene)
  {
    for (int row = 0; row < size.height; ++row)
    {
      for (int column = 0; column < size.width; ++column)
      {
        write(folder, name_of(row, column), scene(row, column));
      }
    }
  };
}

inline Write both(const Write& first, const Write& second)
{
  return [=](const TemporaryFolder& folder, const Scene& scene)
  {
    first(folder, scene);
    second(folder, scene);
  };
}

inline Write text(const std::string& name, const std::string& content)
{
  return [=](const TemporaryFolder& folder, const Scene&) { folder.write(name, content); };
}

inline Write extraImage(const std::string& name)
{
  return [=](const TemporaryFolder& folder, const Scene&)
  { write(folder, name, cv::Mat(16, 20, CV_8UC1, 7.0)); };
}

inline const cv::Size FIVE(SIDE, SIDE);
inline const cv::Size ROW(SIDE, 1);
inline const cv::Size NINE(LONG_ROW, 1);
inline const cv::Size PAIR(2, 1);

/// The views of the scene as a plenoptic camera has them: pixel after pixel.
inline cv::Mat lenslets(const Scene& scene)
{
  const cv::Size size = scene(0, 0).size();
  cv::Mat image(size.height * SIDE, size.width * SIDE, CV_8UC3);
  for (int y = 0; y < image.rows; ++y)
  {
    for (int x = 0; x < image.cols; ++x)
    {
      image.at<cv::Vec3b>(y, x) = scene(y % SIDE, x % SIDE).at<cv::Vec3b>(y / SIDE, x / SIDE);
    }
  }
  return image;
}

/// The view that stands so many steps from the reference.
inline const View* viewAt(const LightField& light_field, double x, double y)
{
  for (const View& view : light_field.views)
  {
    if (std::hypot(view.steps.x - x, view.steps.y - y) < 0.01)
    {
      return &view;
    }
  }
  return nullptr;
}

}  // namespace light_field_depth::testing

#endif  // LIGHT_FIELD_DEPTH_TEST_IO_SCENE_FOLDERS_H
