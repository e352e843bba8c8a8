#include <gtest/gtest.h>

#include <string>

#include "io/folder_listing.h"
#include "io/scene_folders.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/dataset.h"

namespace light_field_depth
{
namespace
{
using testing::TemporaryFolder;

TEST(FolderListing, NumbersInNamesSortAsNumbers)
{
  EXPECT_TRUE(sortsBefore("view2", "view10"));
  EXPECT_FALSE(sortsBefore("view10", "view2"));
  EXPECT_TRUE(sortsBefore("a_002_b", "a_10_a"));
  EXPECT_TRUE(sortsBefore("view", "view1"));
  EXPECT_TRUE(sortsBefore("view002", "view2")) << "equal numbers still have an order";
  EXPECT_FALSE(sortsBefore("view2", "view2"));
  EXPECT_TRUE(sortsBefore("9", "123456789012345678901234567890")) << "longer than any number";
}

TEST(FolderListing, TellsImagesFoldersAndTheRest)
{
  const TemporaryFolder folder;
  for (const char* const name : {"b10.png", "b9.PNG", ".hidden.png", "notes.txt", "inner/a.png"})
  {
    folder.write(name, "x");
  }
  const FolderListing listing = listFolder(folder.path());
  ASSERT_EQ(listing.images.size(), 2U);
  EXPECT_EQ(listing.images[0].filename(), "b9.PNG");
  ASSERT_EQ(listing.folders.size(), 1U);
  EXPECT_EQ(listing.folders[0].filename(), "inner");
  ASSERT_EQ(listing.others.size(), 1U);
  EXPECT_EQ(listing.others[0].filename(), "notes.txt");
  EXPECT_TRUE(isFile(folder / "notes.txt"));
  EXPECT_FALSE(isFile(folder / "inner"));
  EXPECT_NE(testing::messageOf<InputError>([&] { listFolder(folder / "nowhere"); }).find("cannot be read"),
            std::string::npos);
}

TEST(FolderListing, RefusesPipesLoopsAndEmptyLists)
{
  const TemporaryFolder folder;
  testing::grid(testing::PAIR, [](int, int c) { return "00_0" + std::to_string(c) + ".png"; })(
      folder, testing::RenderedScene::view);
  const auto complaint = [&] { return testing::messageOf<InputError>([&] { readDataset(folder.path()); }); };
  folder.write("light_field.yaml", "views: []\n");
  EXPECT_NE(complaint().find("views"), std::string::npos);
  folder.write("light_field.yaml",
               "pattern: '" + std::string(300, 'x') + "{row}_{column}.png'\ngrid: {rows: 1, columns: 2}\n");
  EXPECT_NE(complaint().find("is there"), std::string::npos);
  std::filesystem::remove(folder / "light_field.yaml");
  std::filesystem::create_symlink("light_field.yaml", folder / "light_field.yaml");
  EXPECT_NE(complaint().find("light_field.yaml"), std::string::npos);
  std::filesystem::remove(folder / "light_field.yaml");
  ASSERT_EQ(std::system(("mkfifo '" + (folder / "light_field.yaml").string() + "'").c_str()), 0);
  EXPECT_NE(complaint().find("regular file"), std::string::npos);
  folder.write("b/light_field.yaml",
               "views: [{row: 0, column: 0, file: zero.png}, {row: 0, column: 1, file: zero.png}]\n");
  std::filesystem::create_symlink("/dev/zero", folder / "b/zero.png");
  EXPECT_NE(testing::messageOf<InputError>([&] { readDataset(folder / "b"); }).find("zero.png"),
            std::string::npos);
}

}  // namespace
}  // namespace light_field_depth
