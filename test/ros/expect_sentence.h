#ifndef LIGHT_FIELD_DEPTH_TEST_ROS_EXPECT_SENTENCE_H
#define LIGHT_FIELD_DEPTH_TEST_ROS_EXPECT_SENTENCE_H

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "light_field_depth/core/error.h"

namespace light_field_depth::testing
{
/// Expects an InputError whose text is a sentence with all the parts in it.
template <class Body>
void expectSentence(const Body& body, const std::vector<std::string>& parts)
{
  try
  {
    body();
    ADD_FAILURE() << "nothing was thrown";
  }
  catch (const InputError& error)
  {
    const std::string text = error.what();
    EXPECT_EQ(text.back(), '.') << text;
    for (const std::string& part : parts)
    {
      EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
    }
  }
}

}  // namespace light_field_depth::testing

#endif  // LIGHT_FIELD_DEPTH_TEST_ROS_EXPECT_SENTENCE_H
