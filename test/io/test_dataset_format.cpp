#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "io/dataset_format.h"
#include "io/scene_folders.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/dataset.h"

namespace light_field_depth
{
namespace
{
using testing::TemporaryFolder;

TEST(DatasetFormat, SaysWhatToDoWithFilesThatAreNoImages)
{
  for (const auto& [file, word] :
       {std::make_pair("buddha.h5", "HDF5"), std::make_pair("IMG_0001.LFP", "plenoptic"),
        std::make_pair("IMG_0001.HEIC", "HEIC"), std::make_pair("a.jxl", "JPEG XL"),
        std::make_pair("LF.mat", "MATLAB"), std::make_pair("scene.mp4", "video")})
  {
    const TemporaryFolder folder;
    folder.write(file, "content");
    const std::string message = testing::messageOf<InputError>([&] { readDataset(folder.path()); });
    EXPECT_NE(message.find(file), std::string::npos) << message;
    EXPECT_NE(message.find(word), std::string::npos) << message;
  }
}

TEST(DatasetFormat, ListsWhatWasTried)
{
  const TemporaryFolder folder;
  testing::write(folder, "holiday.png", cv::Mat(40, 40, CV_8UC1, 7.0));
  testing::write(folder, "dog.png", cv::Mat(40, 40, CV_8UC1, 7.0));
  const std::string message = testing::messageOf<InputError>([&] { readDataset(folder.path()); });
  for (const char* const part : {"dog.png", "HCI", "Middlebury", "no name has a number", "light_field.yaml"})
  {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST(DatasetFormat, LinksToNothingAreNamed)
{
  const TemporaryFolder folder;
  std::filesystem::create_symlink("nowhere.png", folder / "a_00_02.png");
  EXPECT_NE(testing::messageOf<InputError>([&] { describeFolder(folder.path(), {}); })
                .find("'a_00_02.png' is a link to nothing"),
            std::string::npos);
  for (const char* const name : {"a_00_00.png", "a_00_01.png"})
  {
    folder.write(name, "");
  }
  const FolderDescription description = describeFolder(folder.path(), {});
  EXPECT_EQ(description.views.size(), 2U);
  ASSERT_EQ(description.warnings.size(), 1U);
  EXPECT_NE(description.warnings.front().find("a link to nothing"), std::string::npos);
}

}  // namespace
}  // namespace light_field_depth
