#ifndef LIGHT_FIELD_DEPTH_TEST_IO_DATASET_FILES_H
#define LIGHT_FIELD_DEPTH_TEST_IO_DATASET_FILES_H

#include <functional>
#include <optional>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/dataset.h"
#include "support/temporary_folder.h"

namespace light_field_depth::testing
{
/// The file name of the view in a row and column, both counted from 0; empty for no file.
using NameOf = std::function<std::string(int row, int column)>;

constexpr int TEST_WIDTH_PX = 24;
constexpr int TEST_HEIGHT_PX = 18;

/// A grey level that tells which view it is.
inline int levelOf(int row, int column)
{
  return 10 * row + column + 5;
}

inline void writeView(const TemporaryFolder& folder, const std::string& name, int level, int type = CV_8UC1)
{
  const cv::Mat image(TEST_HEIGHT_PX, TEST_WIDTH_PX, type, cv::Scalar::all(level));
  ASSERT_TRUE(cv::imwrite((folder / name).string(), image)) << name;
}

inline void writeGrid(const TemporaryFolder& folder, int rows, int columns, const NameOf& name_of)
{
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      const std::string name = name_of(row, column);
      if (!name.empty())
      {
        writeView(folder, name, levelOf(row, column));
      }
    }
  }
}

inline std::string twoDigits(int number)
{
  return (number < 10 ? "0" : "") + std::to_string(number);
}

inline std::string hciName(int row, int column, int columns = 9)
{
  const std::string number = std::to_string(row * columns + column);
  return "input_Cam" + std::string(3 - number.size(), '0') + number + ".png";
}

/// The view that writeGrid() wrote for a row and column, found by its grey level.
inline std::optional<View> viewOf(const LightField& light_field, int row, int column)
{
  for (const View& view : light_field.views)
  {
    if (cv::mean(view.image)[0] == levelOf(row, column))
    {
      return view;
    }
  }
  return std::nullopt;
}

/// Each view of the grid stands where it is expected: `steps_of` gives the expected View::steps.
inline void expectSteps(const LightField& light_field, int rows, int columns,
                        const std::function<cv::Point2d(int row, int column)>& steps_of)
{
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      const auto view = viewOf(light_field, row, column);
      ASSERT_TRUE(view) << row << " " << column;
      EXPECT_NEAR(view->steps.x, steps_of(row, column).x, 1e-9) << row << " " << column;
      EXPECT_NEAR(view->steps.y, steps_of(row, column).y, 1e-9) << row << " " << column;
    }
  }
}

/// What readDataset() complains about; "" if it does not.
inline std::string readingError(const std::filesystem::path& folder, const DatasetOptions& options = {})
{
  return messageOf<InputError>([&] { readDataset(folder, options); });
}

/// Whether a message is a sentence that has all the parts.
inline ::testing::AssertionResult says(const std::string& message, std::initializer_list<const char*> parts)
{
  if (message.empty())
  {
    return ::testing::AssertionFailure() << "there is no complaint";
  }
  if (message.back() != '.')
  {
    return ::testing::AssertionFailure() << "not a sentence: " << message;
  }
  for (const char* const part : parts)
  {
    if (message.find(part) == std::string::npos)
    {
      return ::testing::AssertionFailure() << "'" << part << "' is not in: " << message;
    }
  }
  return ::testing::AssertionSuccess() << message;
}

}  // namespace light_field_depth::testing

#endif  // LIGHT_FIELD_DEPTH_TEST_IO_DATASET_FILES_H
