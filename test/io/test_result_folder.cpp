// All results of a run or none, and none of an earlier one.

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "light_field_depth/io/files.h"
#include "light_field_depth/io/result_folder.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::TemporaryFolder;
using Names = std::set<std::string>;

Names namesIn(const std::filesystem::path& folder)
{
  Names names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    names.insert(entry.path().filename().string());
  }
  return names;
}

void writeRun(const std::filesystem::path& target, const Names& files, const std::string& content)
{
  ResultFolder results(target);
  std::string list;
  for (const std::string& file : files)
  {
    writeFile(results.path() / file, content);
    list += (list.empty() ? "\"" : ", \"") + file + "\"";
  }
  writeFile(results.path() / "report.json", "{\"files\": [" + list + "]}");
  results.commit();
}

TEST(ResultFolder, ShowsNothingBeforeItIsComplete)
{
  const TemporaryFolder folder;
  {
    ResultFolder results(folder / "new/results");
    writeFile(results.path() / "a.pfm", "half");
    EXPECT_FALSE(std::filesystem::exists(folder / "new/results"));
  }
  EXPECT_EQ(namesIn(folder / "new"), Names{});
  writeRun(folder / "new/results/", {"a.pfm"}, "whole");
  EXPECT_EQ(namesIn(folder / "new/results"), (Names{"a.pfm", "report.json"}));
  EXPECT_EQ(namesIn(folder / "new"), Names{"results"});
}

TEST(ResultFolder, TakesThePlaceOfAnEarlierRun)
{
  const TemporaryFolder folder;
  writeRun(folder / "results", {"depth.pfm", "cloud.ply"}, "old");
  std::filesystem::permissions(folder / "results", std::filesystem::perms::owner_all);
  {
    ResultFolder interrupted(folder / "results");
    writeFile(interrupted.path() / "depth.pfm", "half");
  }
  EXPECT_EQ(readFile(folder / "results/depth.pfm"), "old");
  writeRun(folder / "results", {"depth.pfm"}, "new");
  EXPECT_EQ(readFile(folder / "results/depth.pfm"), "new");
  EXPECT_EQ(namesIn(folder / "results"), (Names{"depth.pfm", "report.json"}));
  EXPECT_EQ(namesIn(folder.path()), Names{"results"});
  EXPECT_EQ(std::filesystem::status(folder / "results").permissions(), std::filesystem::perms::owner_all);
}

TEST(ResultFolder, LeavesForeignFilesWhereTheyAre)
{
  const TemporaryFolder folder;
  writeRun(folder / "results", {"depth.pfm", "cloud.ply"}, "old");
  folder.write("results/notes.txt", "mine");
  folder.write("results/sub/deep.txt", "mine");
  folder.write("outside.txt", "mine");
  folder.write("results/report.json",
               R"({"files": ["cloud.ply", "../outside.txt", "/etc/hostname", "..", ""]})");
  writeRun(folder / "results", {"depth.pfm"}, "new");
  EXPECT_EQ(readFile(folder / "results/depth.pfm"), "new");
  EXPECT_EQ(namesIn(folder / "results"), (Names{"depth.pfm", "notes.txt", "report.json", "sub"}));
  EXPECT_EQ(readFile(folder / "outside.txt"), "mine");
}

TEST(ResultFolder, FollowsALinkToTheFolder)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "elsewhere");
  std::filesystem::create_directory_symlink(folder / "elsewhere", folder / "results");
  writeRun(folder / "results", {"depth.pfm"}, "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "results"));
  EXPECT_EQ(readFile(folder / "elsewhere/depth.pfm"), "new");
}

}  // namespace
}  // namespace light_field_depth
