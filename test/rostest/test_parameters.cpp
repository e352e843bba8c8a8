// What is set wrongly is said, before anything is advertised.

#include <gtest/gtest.h>

#include "array_fixture.h"
#include "light_field_depth/core/error.h"
#include "ros/parameter_check.h"

namespace light_field_depth::testing
{
namespace
{
using ParametersTest = ArrayFixture;

bool contains(const std::vector<std::string>& sentences, const std::vector<std::string>& words)
{
  for (const std::string& sentence : sentences)
  {
    bool all = true;
    for (const std::string& word : words)
    {
      all = all && sentence.find(word) != std::string::npos;
    }
    if (all)
    {
      return true;
    }
  }
  return false;
}

TEST_F(ParametersTest, OfTheWrongTypeAreRefused)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), {64, 48});
  setParameter("min_confidence", std::string("abc"));
  EXPECT_THROW(startNode(scene.light_field), InputError);
  setParameter("min_confidence", 1);
  EXPECT_NO_THROW(startNode(scene.light_field)) << "a whole number is a number";
  node_.reset();
  setParameter("volume_rows", 4);
  EXPECT_THROW(startNode(scene.light_field), InputError) << "a text without quotes";
  setParameter("volume_rows", std::string("4"));
  setParameter("multiview_preset", std::string("slow"));
  EXPECT_THROW(startNode(scene.light_field), InputError) << "not a preset";
}

TEST_F(ParametersTest, ThatNobodyReadsAreNamed)
{
  setParameter("preset", std::string("fast"));
  setParameter("queue_sise", 7);
  setParameter("frame", std::string("x"));
  setParameter("disparity_color/compressed/jpeg_quality", 80);
  setParameter("method", std::string("multiview"));
  const auto sentences = describeUnknownParameters(*node_space_, {"queue_size", "frame_id"});
  EXPECT_EQ(sentences.size(), 3U);
  EXPECT_TRUE(contains(sentences, {"preset", "'multiview_preset'"}));
  EXPECT_TRUE(contains(sentences, {"queue_sise", "'queue_size'"}));
  EXPECT_TRUE(contains(sentences, {"/frame'", "README"}));
}

TEST_F(ParametersTest, BeyondALimitAreNamedWithWhatIsUsed)
{
  setParameter("min_confidence", 7.0);
  EXPECT_TRUE(contains(checkSettings(*node_space_), {"min_confidence", "is 7", "1 is used"}));
}

}  // namespace
}  // namespace light_field_depth::testing
